#!/usr/bin/env bash
# Renders a scene without and with antialiasing, and prints the paths of the images and the times.
#
#   tools/demo.sh [SCENE [FOLDER]]
set -euo pipefail
cd "$(dirname "$0")/.."

scene="${1:-assets/fence.glb}"
folder="${2:-out}"
name="$(basename "${scene%.*}")"
mkdir -p "$folder"

gpc() { cargo run --profile demo --quiet --bin gpc -- "$@"; }

# Prints a number from the command's JSON: the value of a key or, with two keys, of the second one in the object of the first.
number() { # JSON KEY [KEY]
    local inside="${3:+\{[^\}]*\"$3\":}"
    tr -d ' \n' <<<"$1" | sed -nE "s/.*\"$2\":$inside([0-9.eE+-]+).*/\1/p"
}

render() { # OUT OPTION...
    local image="$1"
    shift
    # With --repeat the time is that of warm frames: drivers compile shaders during the first frame.
    gpc render "$scene" -o "$image" --size 1280x720 --background '#87b5e0' --repeat 3 --json --quiet "$@"
}

line() { # IMAGE JSON NOTE
    printf '  %-28s %9.1f ms   %s\n' "$1" "$(number "$2" gpu_ms total)" "$3"
}

plain="$folder/$name-none.png"
fine="$folder/$name-superpixel.png"
plain_json="$(render "$plain" --aa none)"
fine_json="$(render "$fine" --aa superpixel --samples 64)"

share="$(number "$fine_json" superpixels fraction)"
percent="$(LC_ALL=C awk -v share="$share" 'BEGIN { printf "%.1f", 100 * share }')"
device="$(sed -nE 's/.*"device": *"([^"]*)".*/\1/p' <<<"$(tr -d '\n' <<<"$fine_json")")"

echo
echo "$scene at 1280 x 720 on $device, time of a warm frame:"
line "$plain" "$plain_json" "one sample a pixel"
line "$fine" "$fine_json" "64 samples in each of the $percent % of pixels that alias"
echo
echo "To install the command (optimized, unlike this build): cargo install --path ."
