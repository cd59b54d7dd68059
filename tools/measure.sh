#!/usr/bin/env bash
# Measures all figures of the documents on one driver, and writes docs/bench/KIND-DRIVER.csv. Takes an hour.
#
#   tools/measure.sh [KIND...]        quality, speed, motion, variants, choices, growth, hosts; all of these if none is named
#   tools/measure.sh views many large only where they are named, since they take hours without a GPU: views that fill a frame
#                                     of 1920x1080 with all methods and up to 64 samples, one of them with up to 1,024, and time
#                                     and memory of four of them at 3840x2160
#
# Views are measured one after the other. Where a run was stopped, the next run of the same commit goes on with the view that is
# missing.
#
# The driver is the one that VK_ICD_FILENAMES or VK_DRIVER_FILES names, otherwise that of the best device. Nothing else should
# run on the machine. `make figures` updates the documents from the files.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/scenes.sh

gpc() { "${CARGO_TARGET_DIR:-target}/release/gpc" "$@"; }
cargo build --release --bin gpc

rivals=none,msaa,ssaa,accumulate,rotated,superpixel
kinds=("$@")
[ ${#kinds[@]} -gt 0 ] || kinds=(quality speed motion variants choices growth hosts)
if ! git diff --quiet HEAD -- src shaders examples Cargo.toml; then
    echo "src, shaders, examples or Cargo.toml differ from the commit that the files would name; commit first" >&2
    exit 1
fi
commit="$(git rev-parse --short HEAD)"
work="$(mktemp -d)"
trap 'rm -r "$work"' EXIT

# Prints the driver's name for use in a file's name: lavapipe-22.3 for "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)".
slug() { # CSV
    local driver
    driver="$(sed -n 's/^# driver: //p' "$1" | tr '[:upper:]' '[:lower:]')"
    driver="${driver/llvmpipe mesa/lavapipe}"
    sed -E 's/\(.*//; s/([0-9]+\.[0-9]+)(\.[0-9]+)*/\1/g; s/[^a-z0-9.]+/-/g; s/^-|-$//g' <<<"$driver"
}

# Prints lines with the driver, the machine and the date, as `gpc bench` writes them.
head_of_run() {
    gpc bench assets/checker.glb --out "$work/head" --size 16x16 --methods none --samples 1 --reference 256 --repeat 1 \
        >"$work/log"
    grep -E '^# (driver|machine|date): ' "$work/head/results.csv"
}

# Copies the CSV of a run to docs/bench, with the commit in its head.
keep() { # KIND CSV
    local name
    name="docs/bench/$1-$(slug "$2").csv"
    # Removes the files of an earlier run, which may have measured the kind in several parts.
    rm -f "${name%.csv}"*.csv
    { echo "# commit: $commit" && cat "$2"; } >"$name"
    echo "$name"
}

# Measures views one after the other into out/measure, and keeps their rows in one file.
measure_views() { # KIND FIRST COUNT OPTION...
    local kind="$1" first="$2" count="$3" view scene options folder
    shift 3
    for view in "${views[@]:first:count}"; do
        read -r scene options <<<"$view"
        folder="out/measure/$commit/$kind-$(basename "$(dirname "$scene")")-$(basename "$scene")"
        # The file is in place only after a whole run.
        if [ ! -f "$folder/done.csv" ]; then
            # shellcheck disable=SC2086
            gpc bench "$scene" $options --out "$folder" "$@"
            cp "$folder/results.csv" "$folder/done.csv"
        fi
        if [ -f "$work/$kind.csv" ]; then
            grep -v '^#' "$folder/done.csv" | tail -n +2 >>"$work/$kind.csv"
        else
            cp "$folder/done.csv" "$work/$kind.csv"
        fi
    done
    keep "$kind" "$work/$kind.csv"
}

for kind in "${kinds[@]}"; do
    out="$work/$kind"
    case "$kind" in
        quality)
            gpc bench "${quality_scenes[@]}" --out "$out" --size 480x270 --samples 4,16,64,256,1024 \
                --superpixel-samples 8,32,128,512 --repeat 3 --budget 2
            keep quality "$out/results.csv"
            ;;
        speed)
            gpc bench "${speed_scenes[@]}" --out "$out" --samples 4,64,256,1024 --reference 256 --repeat 5 --budget 2
            keep speed "$out/results.csv"
            ;;
        motion)
            gpc bench --motion "${motion_scenes[@]}" --out "$out" --samples 4,16,64 --reference 1024
            keep motion "$out/motion.csv"
            ;;
        variants)
            gpc bench "${speed_scenes[@]}" --out "$out" --methods none --samples 1 --reference 256 --repeat 3 --variants
            keep variants "$out/variants.csv"
            ;;
        choices)
            gpc bench "${quality_scenes[@]}" --out "$out" --size 480x270 --methods none --samples 1 --repeat 9 --budget 2 \
                --choices
            keep choices "$out/choices.csv"
            ;;
        growth)
            gpc bench --out "$out" --size 640x360 --samples 64 --repeat 3 --budget 4 --growth
            keep growth "$out/growth.csv"
            ;;
        views)
            measure_views views 0 ${#views[@]} --size 1920x1080 --methods "$rivals" --samples 4,16,64 --reference 1024 \
                --repeat 3 --budget 2
            ;;
        many)
            measure_views many $((${#views[@]} - 1)) 1 --size 1920x1080 --methods "$rivals" --samples 4,16,64,256,1024 \
                --reference 4096 --repeat 3 --budget 2
            ;;
        large)
            measure_views large 0 4 --size 3840x2160 --methods none,ssaa,superpixel --samples 4,64 --reference 256 \
                --repeat 3 --budget 2
            ;;
        hosts)
            sizes=240x135,480x270,960x540,1280x720,1920x1080
            make install PREFIX="$work/gpc" >"$work/log"
            export PKG_CONFIG_PATH="$work/gpc/lib/pkgconfig" LD_LIBRARY_PATH="$work/gpc/lib"
            read -ra flags <<<"$(pkg-config --cflags --libs gpc vulkan)"
            c++ -std=c++17 -O2 examples/forward/forward.cpp -o "$work/forward" "${flags[@]}"
            { head_of_run && echo "# size: $sizes" &&
                "$work/forward" examples/forward/shaders/spirv --sizes "$sizes"; } >"$work/hosts.csv"
            keep hosts "$work/hosts.csv"
            ;;
        *)
            echo "no kind \"$kind\"; there are quality, speed, motion, variants, choices, growth, hosts, views, many and large" >&2
            exit 2
            ;;
    esac
done
