"""Figures from pictures and times: errors in linear radiance, seconds to an error, medians."""

import statistics

import numpy

# Radiance is cut off here before pictures are compared, so that a rare bright dot in a path
# traced picture does not decide its error.
CLIP = 4.0


def rmse(picture, reference):
    """Root of the mean square difference over pixels and channels, in linear radiance."""
    difference = numpy.clip(picture, 0, CLIP) - numpy.clip(reference, 0, CLIP)
    return float(numpy.sqrt(numpy.mean(difference.astype(numpy.float64) ** 2)))


def without_reference_noise(error, samples, reference_samples):
    """An error without the part that independent noise in the reference picture has in it."""
    return error * (reference_samples / (reference_samples + samples)) ** 0.5


def seconds_to(target, renders):
    """Seconds to an RMSE, between the measured renders along straight lines in log-log.

    renders are (seconds, RMSE), by rising number of samples. Beyond the last the last line is
    drawn on. None where the first picture is already better.
    """
    if target > renders[0][1]:
        return None
    end = next((i for i, (_, error) in enumerate(renders) if error <= target), len(renders) - 1)
    # The first picture may be just as good as wanted.
    (seconds0, error0), (seconds1, error1) = renders[max(end, 1) - 1], renders[max(end, 1)]
    share = numpy.log(target / error0) / numpy.log(error1 / error0)
    return float(seconds0 * (seconds1 / seconds0) ** share)


def summary(values):
    """Median, lowest and highest."""
    return {"median": statistics.median(values), "low": min(values), "high": max(values)}


def compare(rounds, pixels):
    """The figures of one scene: the common RMSE, and each renderer's speed and seconds to it.

    rounds: for each renderer a list of rounds, each a list of renders {samples, seconds, rmse}. The
    common RMSE is the lowest that every renderer reached. The ratios to thinlens are within a
    round; above 1 thinlens is ahead. They are missing where thinlens is.
    """
    if not rounds:
        return None
    target = max(statistics.median(row[-1]["rmse"] for row in own) for own in rounds.values())
    speeds = {name: [_speed(row, pixels) for row in own] for name, own in rounds.items()}
    times = {name: [_time(row, target) for row in own] for name, own in rounds.items()}
    figures = {}
    for name, own in rounds.items():
        figures[name] = {
            "msamples_per_second": summary(speeds[name]),
            "rmse": [
                {"samples": column[0]["samples"], **summary([r["rmse"] for r in column])}
                for column in zip(*own, strict=True)
            ],
        }
        if None not in times[name]:
            figures[name]["seconds_to_rmse"] = summary(times[name])
        if "thinlens" in rounds:
            ratios = [a / b for a, b in zip(speeds["thinlens"], speeds[name], strict=True)]
            figures[name]["throughput_ratio"] = summary(ratios)
            if None not in times[name] + times["thinlens"]:
                ratios = [b / a for a, b in zip(times["thinlens"], times[name], strict=True)]
                figures[name]["time_ratio"] = summary(ratios)
    return {"target_rmse": target, "renderers": figures}


def _speed(renders, pixels):
    """M samples/s of the longest render, where what a render costs to start weighs least."""
    return pixels * renders[-1]["samples"] / renders[-1]["seconds"] / 1e6


def _time(renders, target):
    return seconds_to(target, [(render["seconds"], render["rmse"]) for render in renders])
