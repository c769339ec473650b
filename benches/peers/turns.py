"""The renderers, each in a process of its own, taking turns at one scene."""

import dataclasses
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys

import measure
import numpy

HERE = pathlib.Path(__file__).resolve().parent


@dataclasses.dataclass
class Renderer:
    """worker: its program here; besides: what its job has besides; same_picture: the renderer that
    converges to the same picture, and sooner."""

    worker: str
    besides: dict = dataclasses.field(default_factory=dict)
    same_picture: str | None = None


RENDERERS = {"thinlens": Renderer("thinlens_peer.py")}
for integrator in ("path", "direct", "lights"):
    name = f"mitsuba-{integrator}"
    for short, sampler in (("", "independent"), ("-mj", "multijitter")):
        besides = {"integrator": integrator, "sampler": sampler}
        RENDERERS[name + short] = Renderer("mitsuba_peer.py", besides, f"{name}-mj")
RENDERERS["povray"] = Renderer("povray_peer.py")
RENDERERS["cycles"] = Renderer("cycles_peer.py")


class Failed(Exception):
    """A renderer did not do its job; the message says why, in one line."""


def say(text):
    print(f"compare: {text}", file=sys.stderr, flush=True)


def run(args, name, scene, samples, seed, folder):
    """One renderer's turn: its version, and its renders {samples, seconds, picture}."""
    renderer = RENDERERS[name]
    folder.mkdir(exist_ok=True)
    job = {
        "scene": str(scene),
        "size": args.size,
        "threads": args.threads,
        "samples": samples,
        "seed": seed,
        "folder": str(folder),
        "thinlens": str(args.thinlens),
        **renderer.besides,
    }
    file = folder / "job.json"
    file.write_text(json.dumps(job))
    out, errors, status = _output(
        [*args.wrap, sys.executable, str(HERE / renderer.worker), str(file)], args.timeout
    )
    if status != 0:
        last = (errors.strip().splitlines() or ["it said nothing"])[-1]
        raise Failed(f"{last} (exit status {status})")
    # A renderer may write to standard output too, before the answer and after it.
    start = out.rfind('{"version"')
    if start < 0:
        raise Failed("it ended without figures")
    return json.JSONDecoder().raw_decode(out, start)[0]


def _output(command, timeout):
    """What a command writes to stdout and stderr, and its status. Seconds until it is ended."""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    # A session of its own, so that what the command itself started can be ended with it.
    with subprocess.Popen(command, start_new_session=True, **pipes) as process:
        try:
            return *process.communicate(timeout=timeout), process.returncode
        except BaseException as error:
            os.killpg(process.pid, signal.SIGKILL)
            if isinstance(error, subprocess.TimeoutExpired):
                raise Failed(f"not done after {timeout:.0f} s") from None
            raise


def converged(args, name, scene, folder):
    """The picture that the renderer converges to, from args.references where it is kept."""
    name = RENDERERS[name].same_picture or name
    width, height = args.size
    kept = args.references or folder
    kept.mkdir(parents=True, exist_ok=True)
    file = kept / f"{scene.stem}-{name}-{width}x{height}-{args.reference_samples}.npy"
    if not file.exists():
        result = run(args, name, scene, [args.reference_samples], 0, folder)
        shutil.move(result["renders"][0]["picture"], file)
    return numpy.load(file)


@dataclasses.dataclass
class Outcome:
    """Of one scene, by renderer: the converged pictures; rounds, each a list of renders {samples,
    seconds, rmse}; versions; and why some failed, in which case they have no rounds."""

    pictures: dict = dataclasses.field(default_factory=dict)
    rounds: dict = dataclasses.field(default_factory=dict)
    versions: dict = dataclasses.field(default_factory=dict)
    failures: dict = dataclasses.field(default_factory=dict)


def take(args, names, scene, folder):
    """Has the named renderers render the scene, in turn. Gives its Outcome."""
    outcome = Outcome()

    def attempt(name, what, work):
        say(f"{scene.stem}: {name}, {what}")
        try:
            return work()
        except Failed as failed:
            say(f"{scene.stem}: {name} failed: {failed}")
            outcome.failures[name] = str(failed)
            outcome.rounds.pop(name, None)
            return None

    for name in names:
        picture = attempt(name, "converged picture", lambda: converged(args, name, scene, folder))
        if picture is not None:
            outcome.pictures[name], outcome.rounds[name] = picture, []
    for number in range(1, args.rounds + 1):
        for name in list(outcome.rounds):
            result = attempt(
                name,
                f"round {number} of {args.rounds}",
                lambda: run(args, name, scene, args.samples, number, folder),
            )
            if result:
                outcome.versions[name] = result["version"]
                renders = [_with_error(args, name, r, outcome) for r in result["renders"]]
                outcome.rounds[name].append(renders)
    return outcome


def _with_error(args, name, render, outcome):
    """The render with its error instead of its picture."""
    picture = numpy.load(render.pop("picture"))
    error = measure.rmse(picture, outcome.pictures[name])
    # In the peers' favour: this takes off too much where their samples are not independent.
    if name != "thinlens":
        error = measure.without_reference_noise(error, render["samples"], args.reference_samples)
    return render | {"rmse": error}
