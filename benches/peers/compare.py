"""Renders equal scenes with Mitsuba 3, POV-Ray and Cycles in turn with thinlens, and prints how
fast each is, and how soon each picture is as good.

    benches/peers/setup.sh && python3 benches/peers/compare.py

README.md beside this file says what is measured and what differs between the renderers.
"""

import argparse
import dataclasses
import json
import pathlib
import shlex
import shutil
import signal
import sys
import tempfile

try:
    import measure
    import mesh_scenes
    import report
    import turns
except ImportError as error:
    sys.exit(f"compare: {error}: benches/peers/setup.sh installs what is needed")

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILTIN = ROOT / "src" / "scene" / "builtin"
SCENES = ["version-4", "suffern-boxes", *mesh_scenes.GRIDS]


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n\n")[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter
    )
    add = parser.add_argument
    add("--only", type=_list, help="these renderers, by how their names begin; thinlens always")
    add("--scenes", type=_list, default=",".join(SCENES), help="these scenes")
    add("--quick", action="store_true", help="a smoke run, of no use as figures: small, two rounds")
    add("--rounds", type=int, default=5, help="how often each renders")
    add("--samples", type=_numbers, default="1,4,16,64,256", help="samples per pixel")
    add("--reference-samples", type=int, default=4096, help="of the converged pictures")
    add("--size", type=_size, default="640x480", help="WxH, in pixels")
    add("--threads", type=int, default=2, help="for each renderer on a CPU")
    add("--thinlens", help="its binary (default: target/release/thinlens here)")
    add("--timeout", type=float, default=3600, help="seconds for one renderer's turn")
    add(
        "--wrap",
        type=shlex.split,
        default=[],
        help="goes before each turn's command, such as a lock",
    )
    add(
        "--references",
        type=pathlib.Path,
        help="folder of converged pictures, to keep and use again",
    )
    add(
        "--pictures",
        type=pathlib.Path,
        help="folder for a sheet of each scene's converged pictures",
    )
    add("--json", type=pathlib.Path, help="file for all figures")
    args = parser.parse_args()
    args.thinlens = args.thinlens or ROOT / "target" / "release" / "thinlens"
    if args.quick:
        args.rounds, args.samples, args.reference_samples, args.size = (
            2,
            [1, 4, 16],
            256,
            (160, 120),
        )
    if unknown := set(args.scenes) - set(SCENES):
        parser.error(f"no such scene: {', '.join(unknown)}; there are {', '.join(SCENES)}")
    for start in args.only or []:
        if not any(name.startswith(start) for name in turns.RENDERERS):
            parser.error(f"no such renderer: {start}; there are {', '.join(turns.RENDERERS)}")
    if not shutil.which(args.thinlens):
        parser.error(f"{args.thinlens} is missing: cargo build --release")
    return args


def _list(text):
    return text.split(",")


def _numbers(text):
    return sorted(int(number) for number in text.split(","))


def _size(text):
    width, height = text.split("x")
    return int(width), int(height)


def main():
    args = arguments()
    # Ended from outside, it still ends what it started.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    starts = ("thinlens", *(args.only or [""]))
    names = [name for name in turns.RENDERERS if name.startswith(starts)]
    about = report.about(args)
    tables, scenes, versions = [], {}, {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for name in args.scenes:
            scene = BUILTIN / f"{name}.toml"
            if name in mesh_scenes.GRIDS:
                scene = mesh_scenes.write(name, folder)
            outcome = turns.take(args, names, scene, folder / "work")
            figures = measure.compare(outcome.rounds, args.size[0] * args.size[1])
            tables.append(report.table(name, figures, outcome.failures))
            versions |= outcome.versions
            scenes[name] = dataclasses.asdict(outcome) | {"figures": figures}
            pictures = scenes[name].pop("pictures")
            if args.pictures and pictures:
                args.pictures.mkdir(parents=True, exist_ok=True)
                report.contact_sheet(pictures, args.pictures / f"{name}.png")
    print(report.header(about, versions), *tables, sep="\n\n")
    if args.json:
        everything = about | {"versions": versions, "scenes": scenes}
        args.json.write_text(json.dumps(everything, indent=1) + "\n")
    return 1 if any(scene["failures"] for scene in scenes.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
