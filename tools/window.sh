#!/bin/sh
# Makes docs/window.png, the picture of the window in docs/viewer.md, and docs/window.webp, the animation in the gallery. Needs
# ffmpeg, and the packages that `tools/setup.sh window display` installs.
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

# The animation: a picture for each step.
frames=0
frame() {
    frames=$((frames + 1))
    grab 640x400 "$work/$(printf %03d $frames).png"
}
# Repeats the current picture for a number of steps.
hold() {
    frame
    last="$work/$(printf %03d $frames).png"
    for _ in $(seq 2 "$1"); do
        frames=$((frames + 1))
        cp "$last" "$work/$(printf %03d $frames).png"
    done
}
# Moves the pointer from a place in steps, with a picture for each step.
move() { # X Y DX DY STEPS
    for step in $(seq 1 "$5"); do
        xdotool mousemove $(($1 + step * $3)) $(($2 + step * $4))
        sleep 0.4
        frame
    done
}
open 640x400
xdotool key p
sleep 7
hold 6
# Zooms in along the fences; the picture is refined at the end.
xdotool mousemove 320 210
for _ in 1 2 3; do
    settle click 4
    frame
done
hold 5
# Moves the line between superpixels and no antialiasing.
settle key x
xdotool mousemove 320 200 mousedown 1
move 320 200 16 0 8
move 448 200 -32 0 8
move 192 200 28 0 8
xdotool mouseup 1
# Moves the magnifier along the line.
xdotool key l
move 416 150 0 10 10
xdotool key l key l key l
settle key x
hold 4
# A lens.
xdotool mousemove 470 220
settle key z
hold 3
for _ in 1 2 3 4; do
    settle click 4
    frame
done
for x in 450 430 410 390 370 350; do
    settle mousemove $x 210 click 1
    frame
done
hold 8
ffmpeg -loglevel error -y -framerate 8 -i "$work/%03d.png" -c:v libwebp_anim -loop 0 -quality 75 -compression_level 6 \
    docs/window.webp
