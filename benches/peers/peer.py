"""What every renderer's worker shares: one job in, one result out, in a process of its own.

    python3 PEER_peer.py JOB.json

A job is {"scene": scene file, "size": [width, height], "threads": n, "samples": [n, ...],
"seed": n, "folder": where pictures go, "thinlens": its binary, and what one peer alone looks at}.
The result is printed as the last line, as JSON: {"version": words, "renders": [{"samples": n,
"seconds": wall-clock time of the rendering alone, "picture": file}]}. Pictures are NumPy files:
height x width x 3, float32, linear radiance.
"""

import json
import pathlib
import sys

import numpy


def main(prepare):
    """prepare(job) gives (version, render); render(samples) gives (seconds, pixels)."""
    job = json.loads(pathlib.Path(sys.argv[1]).read_text())
    version, render = prepare(job)
    renders = []
    for samples in job["samples"]:
        seconds, pixels = render(samples)
        picture = pathlib.Path(job["folder"]) / f"{samples}.npy"
        numpy.save(picture, numpy.asarray(pixels, numpy.float32))
        # POV-Ray counts in milliseconds, from none.
        seconds = max(seconds, 1e-3)
        renders.append({"samples": samples, "seconds": seconds, "picture": str(picture)})
    print(json.dumps({"version": version, "renders": renders}))
