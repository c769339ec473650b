#!/usr/bin/env bash
# Makes the pictures of README and docs anew: drives the viewer, runs the commands that stand under the pictures of
# docs/optics.md, and those below. Needs ImageMagick, Xvfb and xdotool. Look at what `git diff --stat docs/images` lists.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v montage >/dev/null || { echo "install ImageMagick: apt-get install imagemagick" >&2; exit 1; }
cargo build --release
PATH=$PWD/target/release:$PATH
scripts/viewer-pictures.sh

# The blocks of commands that write a picture. The drawing is cut out of a picture of the viewer.
commands=$(awk '
    /^```sh$/ { block = ""; inside = 1; next }
    /^```$/ && inside { inside = 0; if (block ~ /docs\/images/) printf "%s", block; next }
    inside { block = block $0 "\n" }
    /^\*?`(thinlens|convert) .*docs\/images.*`\*$/ { gsub(/^\*?`|`\*$/, ""); print }
' docs/optics.md)
bash -euxc "$commands"

thinlens render -n 1024 -q -o target/version-4.png
convert target/version-4.png -strip docs/images/version-4.png
thinlens sweep -s 560x315 -n 256 -q -o target/sweep.png
convert target/sweep.png -strip docs/images/sweep.png
