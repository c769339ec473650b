"""Renders equal scenes with Mitsuba 3, POV-Ray and Cycles in turn with thinlens, and prints how fast
each is, and how soon each picture is as good.

    benches/peers/setup.sh && python3 benches/peers/compare.py

README.md beside this file says what is measured and what differs between the renderers.
"""

import argparse
import json
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

import measure
import mesh_scenes
import numpy
import report

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILTIN = ROOT / "src" / "scene" / "builtin"

# name: (worker, its variant)
RENDERERS = {
    "thinlens": ("thinlens_peer.py", ""),
    "mitsuba-path": ("mitsuba_peer.py", "path"),
    "mitsuba-direct": ("mitsuba_peer.py", "direct"),
    "povray": ("povray_peer.py", ""),
}
SCENES = ["version-4", "suffern-boxes", *mesh_scenes.GRIDS]


class Failed(Exception):
    """A renderer did not do its job; the message says why, in one line."""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--only", type=_list, help="these renderers, by how their names begin; thinlens always")
    parser.add_argument("--scenes", type=_list, default=SCENES, help=f"of {', '.join(SCENES)}")
    parser.add_argument("--quick", action="store_true", help="a smoke run: small, two rounds, nothing to quote")
    parser.add_argument("--rounds", type=int, help="how often each renders, in turn (default 5)")
    parser.add_argument("--samples", type=_numbers, help="samples per pixel, rising (default 1,4,16,64,256)")
    parser.add_argument("--reference-samples", type=int, help="of the converged pictures (default 4096)")
    parser.add_argument("--size", type=_size, help="WxH (default 640x480)")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--thinlens", default=ROOT / "target" / "release" / "thinlens", help="its binary")
    parser.add_argument("--timeout", type=float, default=3600, help="seconds for one renderer's turn (default 3600)")
    parser.add_argument("--wrap", type=shlex.split, default=[], help="put this before each renderer's command, for instance a lock")
    parser.add_argument("--references", type=pathlib.Path, help="keep the converged pictures here, and use those that are here")
    parser.add_argument("--pictures", type=pathlib.Path, help="write a sheet of the converged pictures of each scene here")
    parser.add_argument("--json", type=pathlib.Path, help="write all figures here")
    args = parser.parse_args()
    defaults = dict(rounds=5, samples=[1, 4, 16, 64, 256], reference_samples=4096, size=(640, 480))
    if args.quick:
        defaults = dict(rounds=2, samples=[1, 4, 16], reference_samples=256, size=(160, 120))
    for key, value in defaults.items():
        if getattr(args, key) is None:
            setattr(args, key, value)
    if unknown := set(args.scenes) - set(SCENES):
        parser.error(f"no such scene: {', '.join(unknown)}; there are {', '.join(SCENES)}")
    for start in args.only or []:
        if not any(name.startswith(start) for name in RENDERERS):
            parser.error(f"no such renderer: {start}; there are {', '.join(RENDERERS)}")
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


def run(args, name, scene, samples, seed, folder):
    """One renderer's turn: its version, and its renders {samples, seconds, picture}."""
    worker, variant = RENDERERS[name]
    folder.mkdir(exist_ok=True)
    job = {
        "scene": str(scene),
        "size": args.size,
        "threads": args.threads,
        "samples": samples,
        "seed": seed,
        "variant": variant,
        "folder": str(folder),
        "thinlens": str(args.thinlens),
    }
    file = folder / "job.json"
    file.write_text(json.dumps(job))
    command = [*args.wrap, sys.executable, str(HERE / worker), str(file)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=args.timeout)
    except subprocess.TimeoutExpired:
        raise Failed(f"not done after {args.timeout:.0f} s") from None
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["it said nothing"])[-1]
        raise Failed(f"{last} (exit status {done.returncode})")
    return json.loads(done.stdout.splitlines()[-1])


def reference(args, name, scene, folder):
    """The renderer's own converged picture, from args.references where it is kept."""
    width, height = args.size
    kept = args.references or folder
    kept.mkdir(parents=True, exist_ok=True)
    file = kept / f"{scene.stem}-{name}-{width}x{height}-{args.reference_samples}.npy"
    if not file.exists():
        result = run(args, name, scene, [args.reference_samples], 0, folder)
        shutil.move(result["renders"][0]["picture"], file)
    return numpy.load(file)


def compare_scene(args, names, scene, folder):
    """Figures of one scene, the converged pictures, versions, and (renderer, reason) of failures."""
    references, rounds, versions, failures = {}, {}, {}, []

    def attempt(name, work):
        try:
            work(name)
        except Failed as failed:
            say(f"{scene.stem}: {name} failed: {failed}")
            failures.append((name, str(failed)))
            references.pop(name, None)
            rounds.pop(name, None)

    def converge(name):
        say(f"{scene.stem}: {name}, converged picture")
        references[name] = reference(args, name, scene, folder)
        rounds[name] = []

    def turn(name):
        say(f"{scene.stem}: {name}, round {number} of {args.rounds}")
        result = run(args, name, scene, args.samples, number, folder)
        versions[name] = result["version"]
        for render in result["renders"]:
            picture = numpy.load(render.pop("picture"))
            render["rmse"] = measure.rmse(picture, references[name])
        rounds[name].append(result["renders"])

    for name in names:
        attempt(name, converge)
    for number in range(1, args.rounds + 1):
        for name in list(rounds):
            attempt(name, turn)
    width, height = args.size
    figures = None
    if "thinlens" in rounds:
        figures = measure.compare(rounds, width * height, args.reference_samples)
    return figures, references, versions, failures, rounds


def say(text):
    print(f"compare: {text}", file=sys.stderr, flush=True)


def main():
    args = arguments()
    starts = ("thinlens", *(args.only or [""]))
    names = [name for name in RENDERERS if name.startswith(starts)]
    everything = {"scenes": {}, "versions": {}}
    tables, failed = [], False
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for scene in args.scenes:
            path = BUILTIN / f"{scene}.toml"
            if scene in mesh_scenes.GRIDS:
                path = mesh_scenes.write(scene, folder)
            figures, references, versions, failures, rounds = compare_scene(
                args, names, path, folder / "work"
            )
            everything["versions"] |= versions
            everything["scenes"][scene] = {"figures": figures, "failures": failures, "rounds": rounds}
            tables.append(report.table(scene, figures, failures))
            failed = failed or bool(failures)
            if args.pictures and references:
                args.pictures.mkdir(parents=True, exist_ok=True)
                report.contact_sheet(references, args.pictures / f"{scene}.png")
    width, height = args.size
    options = {"width": width, "height": height, "threads": args.threads, "rounds": args.rounds}
    everything |= {"options": options, "cpu": report.cpu(), "quick": args.quick}
    print(report.header(options, everything["versions"]), *tables, sep="\n\n")
    if args.json:
        args.json.write_text(json.dumps(everything, indent=1) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
