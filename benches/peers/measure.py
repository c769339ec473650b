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


def seconds_to(target, renders):
    """Seconds to an RMSE, between the measured renders along straight lines in log-log.

    renders are (seconds, RMSE), by rising number of samples. Beyond the last the last line is
    drawn on. None where the first picture is already better.
    """
    if target > renders[0][1]:
        return None
    segments = zip(renders, renders[1:])
    for (seconds0, error0), (seconds1, error1) in segments:
        if error1 <= target or (seconds1, error1) == renders[-1]:
            break
    share = numpy.log(target / error0) / numpy.log(error1 / error0)
    return float(seconds0 * (seconds1 / seconds0) ** share)


def summary(values):
    """Median, lowest and highest."""
    return {"median": statistics.median(values), "low": min(values), "high": max(values)}


def compare(rounds, pixels, reference_samples):
    """The figures of one scene.

    rounds: for each renderer a list of rounds, each a list of renders {samples, seconds, rmse}.
    thinlens is the one that the others' ratios are to. Ratios above 1 mean that it is ahead.
    """
    ours = rounds["thinlens"]
    target = max(
        statistics.median(renders[-1]["rmse"] for renders in own) for own in rounds.values()
    )
    figures = {}
    for name, own in rounds.items():
        speeds = [_speed(renders, pixels) for renders in own]
        times = [_time(renders, target) for renders in own]
        our_times = [_time(renders, target) for renders in ours]
        figures[name] = {
            "msamples_per_second": summary(speeds),
            "throughput_ratio": summary(
                [_speed(a, pixels) / b for a, b in zip(ours, speeds, strict=True)]
            ),
            "rmse": [
                {"samples": row[0]["samples"], **summary([render["rmse"] for render in row])}
                for row in zip(*own)
            ],
        }
        if None not in times + our_times:
            figures[name]["seconds_to_rmse"] = summary(times)
            figures[name]["time_ratio"] = summary([b / a for a, b in zip(our_times, times)])
    return {"target_rmse": target, "reference_samples": reference_samples, "renderers": figures}


def _speed(renders, pixels):
    """M samples/s of the longest render, where what a render costs to start weighs least."""
    return pixels * renders[-1]["samples"] / renders[-1]["seconds"] / 1e6


def _time(renders, target):
    return seconds_to(target, [(render["seconds"], render["rmse"]) for render in renders])
