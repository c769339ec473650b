"""The table, in Markdown, and the contact sheets."""

import datetime
import os
import pathlib
import platform

import numpy
from PIL import Image, ImageDraw

LABEL_HEIGHT = 20  # pixels


def about(args):
    """Where and how the comparison runs."""
    return {
        "date": str(datetime.date.today()),
        "cpu": _cpu(),
        "system": f"{platform.system()} {platform.release()}",
        # What else the machine was doing, in busy threads, over the last minute.
        "load_before": round(os.getloadavg()[0], 2),
        "threads": args.threads,
        "size": args.size,
        "rounds": args.rounds,
        "reference_samples": args.reference_samples,
        "quick": args.quick,
    }


def _cpu():
    info = pathlib.Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def header(about, versions):
    width, height = about["size"]
    words = "A smoke run, of no use as figures. " if about["quick"] else ""
    words += (
        f"{about['date']}, {about['cpu']}, {about['threads']} threads, {about['system']}, load "
        f"before {about['load_before']}; {width} x {height} pixels, medians (lowest to highest) of "
        f"{about['rounds']} rounds in turn, converged pictures of {about['reference_samples']} "
        "samples."
    )
    return "\n".join([words, "", *(f"- {name}: {version}" for name, version in versions.items())])


def table(scene, figures, failures):
    """One scene's table; figures as measure.compare gives them, failures {renderer: reason}."""
    rows = figures["renderers"] if figures else {}
    most, target = "most", "?"
    if rows:
        most = next(iter(rows.values()))["rmse"][-1]["samples"]
        target = f"{figures['target_rmse']:.2g}"
    lines = [
        f"### {scene}",
        "",
        f"| renderer | M samples/s | thinlens is ahead | RMSE at {most} samples "
        f"| seconds to RMSE {target} | thinlens is ahead |",
        "|---|---|---|---|---|---|",
    ]
    for name, row in rows.items():
        cells = [
            name,
            _spread(row["msamples_per_second"]),
            _spread(row.get("throughput_ratio"), "x"),
            f"{row['rmse'][-1]['median']:.2g}",
            # Better with its first samples than the common RMSE: no time to compare.
            _spread(row.get("seconds_to_rmse")),
            _spread(row.get("time_ratio"), "x"),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    for name, reason in failures.items():
        lines.append(f"| {name} | failed: {reason.replace('|', '/')} | | | | |")
    return "\n".join(lines)


def _spread(values, unit=""):
    if values is None:
        return "?"
    median, low, high = (f"{values[key]:.3g}" for key in ("median", "low", "high"))
    return f"{median}{unit} ({low} to {high})"


def contact_sheet(pictures, path):
    """The renderers' pictures (linear) two abreast, each with its name above, as an 8-bit PNG."""
    height, width, _ = next(iter(pictures.values())).shape
    cell = height + LABEL_HEIGHT
    sheet = Image.new("RGB", (2 * width, cell * ((len(pictures) + 1) // 2)))
    draw = ImageDraw.Draw(sheet)
    for number, (name, linear) in enumerate(pictures.items()):
        x, y = number % 2 * width, number // 2 * cell
        draw.text((x + 4, y + 4), name, fill="white")
        sheet.paste(Image.fromarray(srgb(linear)), (x, y + LABEL_HEIGHT))
    sheet.save(path)


def srgb(linear):
    value = numpy.clip(linear, 0, 1)
    encoded = numpy.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
    return (255 * encoded + 0.5).astype(numpy.uint8)
