"""The table, in Markdown, and the contact sheets."""

import datetime
import pathlib
import platform

import numpy
from PIL import Image, ImageDraw

LABEL_HEIGHT = 20  # pixels


def cpu():
    info = pathlib.Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def header(options, versions):
    lines = [
        f"{datetime.date.today()}, {cpu()}, {options['threads']} threads, {platform.system()} "
        f"{platform.release()}; {options['width']} x {options['height']} pixels, medians (lowest "
        f"to highest) of {options['rounds']} rounds in turn.",
        "",
    ]
    lines += [f"- {name}: {version}" for name, version in versions.items()]
    return "\n".join(lines)


def table(scene, result, failures):
    """One scene's table; failures are (renderer, reason)."""
    most = result["renderers"]["thinlens"]["rmse"][-1]["samples"] if result else 0
    target = f"{result['target_rmse']:.2g}" if result else "?"
    lines = [
        f"### {scene}",
        "",
        f"| renderer | M samples/s | thinlens is ahead | RMSE at {most} samples "
        f"| seconds to RMSE {target} | thinlens is ahead |",
        "|---|---|---|---|---|---|",
    ]
    for name, row in (result["renderers"] if result else {}).items():
        cells = [
            name,
            _spread(row["msamples_per_second"]),
            _spread(row["throughput_ratio"], "x"),
            f"{row['rmse'][-1]['median']:.2g}",
            _spread(row["seconds_to_rmse"]) if "time_ratio" in row else "less than the first",
            _spread(row["time_ratio"], "x") if "time_ratio" in row else "?",
        ]
        lines.append("| " + " | ".join(cells) + " |")
    for name, reason in failures:
        lines.append(f"| {name} | failed: {reason.replace('|', '/')} | | | | |")
    return "\n".join(lines)


def _spread(values, unit=""):
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
