#!/usr/bin/env bash
# Checks and measures a Vulkan device that has not been tried yet, in at most four minutes, and writes what it found to
# one JSON file. It builds nothing, and needs a shell, awk and timeout beside the program.
#
#   scripts/check-gpu.sh target/release/thinlens gpu.json [DEVICE]
#
# DEVICE is the index or part of the name of a device, as `thinlens devices` lists them. The validation layer has to
# be installed; where it lies in a folder of its own, name that folder in VK_LAYER_PATH.
#
# The file has a list of steps, each with its exit status (124: it was cut off when the four minutes were over), its
# seconds, its last lines of text, and the figures that it gave as JSON. The script fails if any step failed. On a
# software device the benchmarks do not end in time.
set -uo pipefail

usage="usage: scripts/check-gpu.sh THINLENS OUTPUT.json [DEVICE]"
program=$(realpath -- "${1:?$usage}") output=$(realpath -- "${2:?$usage}")
device=(${3:+--device "$3"})
[[ -x $program ]] || { echo "$program cannot be run" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2
ends=$((SECONDS + 235))

# Reads a text and writes it as a JSON string, without control characters but for new lines.
json_string() {
    tr -d '\000-\010\013-\037' | awk '
        BEGIN { printf "\"" }
        { gsub(/\\/, "\\\\"); gsub(/"/, "\\\""); gsub(/\t/, " "); printf "%s%s", (NR > 1 ? "\\n" : ""), $0 }
        END { printf "\"" }'
}

failed=0
steps=""
# step NAME FIGURES ARGUMENTS...: runs the program. FIGURES is the JSON file that it writes, or "none". A name that ends
# in "or refused" is that of a step whose settings may be too large for the device: then the program ends with 1.
step() {
    local name=$1 figures=$2 status=0 start=$SECONDS left=$((ends - SECONDS))
    shift 2
    echo "$name ..." >&2
    if ((left > 0)); then
        timeout "$left" "$program" "$@" >out 2>&1 || status=$?
    else
        echo "no time was left for it" >out
        status=124
    fi
    if ((status != 0)) && ! [[ $status == 1 && $name == *" or refused" ]]; then
        failed=1
        echo "  failed with $status:" >&2
        tail -n 5 out >&2
    fi
    local json=null
    [[ $figures != none && -s $figures ]] && json=$(<"$figures")
    steps+="${steps:+,}
{\"step\": $(json_string <<<"$name"), \"status\": $status, \"seconds\": $((SECONDS - start)),
\"text\": $(tail -n 40 out | json_string), \"figures\": $json}"
}

# A hilly ground of 1,002,528 triangles below the middle of the picture, and nothing but sky above it: rays cost
# hardly anything in the upper rows and much in the lower ones.
awk 'BEGIN {
    n = 708
    for (z = 0; z <= n; ++z) {
        for (x = 0; x <= n; ++x) {
            printf "v %.4f %.4f %.4f\n", 24 * x / n - 12, \
                0.25 * sin(50 * x / n) * cos(41 * z / n) + 0.02 * sin(700 * x / n), -24 * z / n
        }
    }
    for (z = 0; z < n; ++z) {
        for (x = 1; x <= n; ++x) {
            a = z * (n + 1) + x
            printf "f %d %d %d\nf %d %d %d\n", a, a + 1, a + n + 2, a, a + n + 2, a + n + 1
        }
    }
}' >ground.obj
cat >ground.toml <<'T'
size = [1920, 1080]

[camera]
eye = [0, 2, 3]
look_at = [0, 2, -6]
vfov_degrees = 40
lens_diameter = 0.1
focal_distance = 7

[background]
color = [0.4, 0.5, 0.65]

[ambient]
radiance = 0.3

[[directional]]
direction = [-0.6, 1, 0.5]
radiance = 2.6

[matte.clay]
ka = 0.7
kd = 0.8
color = [0.75, 0.5, 0.35]

[[mesh]]
file = "ground.obj"
material = "clay"
T

step "devices" none devices
for scene in $("$program" scenes | awk '$1 { print $1 }'); do
    step "verify $scene" none verify "$scene" -s 96x72 --validation "${device[@]}"
    step "render $scene" stats.json render "$scene" -s 1920x1080 -n 16 --validation -q --stats stats.json -o a.png "${device[@]}"
    rm -f stats.json
done
step "longest submission: sky over a million triangles" sky.json \
    render ground.toml -s 2560x1440 -n 8 -q --stats sky.json -o a.png "${device[@]}"
step "adaptive picture of 8192x4096, rendered or refused" large.json \
    render version-4 -s 8192x4096 -n 2 --noise-threshold 0.02 --validation -q --stats large.json -o a.exr "${device[@]}"
for scene in version-4 suffern-boxes ground.toml; do
    step "bench $scene" bench.json \
        bench "$scene" -s 1920x1080 -n 16 --runs 3 --json=bench.json "${device[@]}"
    rm -f bench.json
done

printf '{"program": %s, "system": %s, "steps": [%s\n]}\n' \
    "$("$program" --version | json_string)" "$(uname -srm | json_string)" "$steps" >"$output"
echo "wrote $output" >&2
exit $failed
