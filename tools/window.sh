#!/bin/sh
# Makes docs/window.png, the picture of the window in docs/viewer.md. Needs ffmpeg, and the packages that `tools/setup.sh window
# display` installs. Nothing else should run on the machine: the picture shows times.
set -eu
cd "$(dirname "$0")/.."
gpc=${GPC:-target/release/gpc}
[ -n "${GPC:-}" ] || cargo build --release --features view --bin gpc
work=$(mktemp -d)
trap 'kill $viewer $server 2>/dev/null; rm -r "$work"' EXIT

Xvfb -displayfd 3 -screen 0 960x540x24 -nolisten tcp 3>"$work/display" 2>"$work/server" &
server=$!
viewer=
until [ -s "$work/display" ]; do sleep 0.1; done
DISPLAY=:$(cat "$work/display")
export DISPLAY

# Prints how many lines of the viewer's output contain a text.
count() { grep -c "$1" "$work/said" || true; }

# Opens the window with the scene of fences, in a size.
open() {
    RUST_LOG=gpc=debug "$gpc" view assets/fence.glb --size "$1" --samples 64 --background '#a8c0d8' 2>"$work/said" &
    viewer=$!
    xdotool search --sync --name 'gpc$' windowfocus
    until [ "$(count 'at rest')" -gt 0 ]; do sleep 0.2; done
    # Keys reach the window only when it has the focus.
    until [ "$(count copied)" -gt 0 ]; do
        xdotool key ctrl+c
        sleep 1
    done
}

# Sends input, and waits until the picture is finished.
settle() {
    said=$(count 'at rest')
    xdotool "$@"
    until [ "$(count 'at rest')" -gt "$said" ]; do sleep 0.2; done
}

# Writes a screenshot without the pointer to a file.
grab() { ffmpeg -loglevel error -y -f x11grab -draw_mouse 0 -video_size "$1" -i "$DISPLAY" -frames:v 1 "$2"; }

# Split view: superpixels on the left of the line, no antialiasing on the right, and the magnifier over both.
open 960x540
settle key x
xdotool mousemove 480 270 mousedown 1 mousemove 500 270 mousemove 640 270 mouseup 1 mousemove 640 300 key l
# Notes disappear after a few seconds.
sleep 7
grab 960x540 docs/window.png
xdotool key q
wait "$viewer"
