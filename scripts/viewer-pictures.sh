#!/usr/bin/env bash
# Makes the pictures of the viewer in README and docs: drives it under Xvfb as the walk in README does. Needs Xvfb,
# xdotool and ImageMagick, and the release build of thinlens. scripts/pictures.sh runs it.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$PWD/target/release/thinlens

folder=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$folder"' EXIT
log=$folder/log

Xvfb -displayfd 3 -screen 0 1280x720x24 -nolisten tcp 3>"$folder/display" 2>/dev/null &
until [ -s "$folder/display" ]; do sleep 0.1; done
DISPLAY=:$(cat "$folder/display")
export DISPLAY

(cd "$folder" && exec env -u WAYLAND_DISPLAY -u WAYLAND_SOCKET XDG_STATE_HOME="$folder" RUST_LOG=thinlens=trace \
    "$program" view version-4 --size 960x720 2>"$log" >/dev/null) &
viewer=$!

idle_lines() { grep -c '\] idle$' "$log" || true; }

# Waits until the viewer has drawn all that comes of the last action, and has been idle for a second since.
idle=0
settle() {
    local last=$idle still=0
    local ends=$((SECONDS + 300))
    while [ "$last" -eq "$idle" ] || [ "$still" -lt 5 ]; do
        kill -0 "$viewer" && [ "$SECONDS" -lt "$ends" ] || { tail "$log" >&2; exit 1; }
        sleep 0.2
        if [ "$(idle_lines)" -eq "$last" ]; then still=$((still + 1)); else still=0; fi
        last=$(idle_lines)
    done
    idle=$last
}

point() { xdotool mousemove "$1" "$2"; settle; }
click_at() { point "$1" "$2"; xdotool click 1; settle; }

# Without a window manager, the window has to be told that a key is meant for it.
press() { xdotool search --class thinlens windowfocus --sync key --delay 0 "$1"; settle; }

# Clicks a control of the panel near its left end. The viewer's log says where it is: left, top, width, height.
click() {
    local place
    place=$(grep -F "control '$1' at " "$log" | tail -n 1 | sed "s/.*' at //")
    [ -n "$place" ] || { echo "the panel has no $1" >&2; exit 1; }
    # shellcheck disable=SC2086
    set -- $place
    click_at $(($1 + $4 / 2)) $(($2 + $4 / 2))
}

# Saves what the display shows.
save() { import -window root -strip "docs/images/$1"; }

box=(1095 290)
settle
point "${box[@]}"
save viewer.png

press o
# The drawing stands below the picture, which is smaller now. The checked box is blurred, in front of the focal plane.
click_at 612 300
save optics.png
press o

click Lens
click f/2.8
press c
click f/32
point 972 360
save split.png
