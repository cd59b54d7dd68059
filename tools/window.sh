#!/bin/sh
# Makes docs/window.png, the picture of the window in the README. Needs ffmpeg beside what tools/setup.sh window display
# installs.
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

# How often the viewer has said something.
count() { grep -c "$1" "$work/said" || true; }

RUST_LOG=gpc=debug "$gpc" view assets/fence.glb --size 960x540 --samples 64 --background '#a8c0d8' 2>"$work/said" &
viewer=$!
xdotool search --sync --name 'gpc$' windowfocus
until [ "$(count 'at rest')" -gt 0 ]; do sleep 0.2; done
# The window takes keys once it has the focus.
until [ "$(count copied)" -gt 0 ]; do
    xdotool key ctrl+c
    sleep 1
done

# Superpixels left of the line, none right of it, and both under the magnifier.
said=$(count 'at rest')
xdotool key x
until [ "$(count 'at rest')" -gt "$said" ]; do sleep 0.2; done
xdotool mousemove 480 270 mousedown 1 mousemove 500 270 mousemove 640 270 mouseup 1 mousemove 640 300 key l
# What was said by then goes after a while.
sleep 7
# The pointer itself is left out.
ffmpeg -loglevel error -y -f x11grab -draw_mouse 0 -video_size 960x540 -i "$DISPLAY" -frames:v 1 docs/window.png
