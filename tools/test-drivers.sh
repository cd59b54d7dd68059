#!/usr/bin/env bash
# Runs the tests of the passes (tests/gpu) with every driver that works on this machine, and says which ones do not.
#
#   tools/test-drivers.sh [NAME...]       only drivers with these names; see `drivers` below
#   FILTER=... tools/test-drivers.sh      only tests whose names contain this text
#
# Drivers that are not installed are fetched by apt, from where the machine gets its own packages, and unpacked in the build
# folder. This needs no root. The output of the tests is in out/drivers.
set -uo pipefail
cd "$(dirname "$0")/.."

mkdir -p out/drivers
scene=assets/fence.glb

# Name, and description. Lavapipe's subgroups have an invocation for each 32 bits of a vector.
drivers="
lavapipe      |the installed lavapipe
lavapipe-128  |the installed lavapipe, vectors of 128 bits
lavapipe-512  |the installed lavapipe, vectors of 512 bits
bookworm      |lavapipe of Debian 12
bookworm-128  |lavapipe of Debian 12, vectors of 128 bits
trixie        |lavapipe of Debian 13
trixie-128    |lavapipe of Debian 13, vectors of 128 bits
trixie-512    |lavapipe of Debian 13, vectors of 512 bits
swiftshader   |SwiftShader of Debian's chromium-common
gpu           |the machine's GPU
"

. tools/debian.sh

fetch_swiftshader() {
    local own="$folder/swiftshader" package
    [ -n "$(manifest_of_swiftshader)" ] && return
    mkdir -p "$own/root"
    if ! { private_apt "$own" update && (cd "$own" && private_apt "$own" download chromium-common); } >"$own/log" 2>&1; then
        echo "apt has no chromium-common: $(tail -n 1 "$own/log")"
        return 1
    fi
    for package in "$own"/*.deb; do
        dpkg-deb --fsys-tarfile "$package" | tar -x -C "$own/root" --wildcards './usr/lib/chromium/*swiftshader*' || return 1
    done
}

manifest_of_swiftshader() {
    find "$folder/swiftshader" -name vk_swiftshader_icd.json 2>/dev/null | head -n 1
}

# Prepares a driver: sets `environment`, `runner` and `kibibytes` for its programs. If it fails, prints why.
prepare() { # NAME
    local json
    environment=(VK_DRIVER_FILES= VK_ICD_FILENAMES=)
    runner=()
    kibibytes=$((8 << 20))
    case "$1" in
        *-512) grep -qw avx512f /proc/cpuinfo || { echo "the processor has no vectors of 512 bits"; return 1; } ;;
    esac
    case "$1" in
        lavapipe*)
            json="$(ls /usr/share/vulkan/icd.d/lvp_icd*.json /etc/vulkan/icd.d/lvp_icd*.json 2>/dev/null | head -n 1)"
            [ -n "$json" ] || { echo "none is installed"; return 1; }
            ;;
        bookworm* | trixie*)
            [ "${1%-*}" != "$release" ] || { echo "it is the installed one"; return 1; }
            fetch_release "${1%-*}" || return 1
            json="$(manifest_of_release "${1%-*}" lvp)"
            environment+=("VK_LAYER_PATH=$folder/${1%-*}/root/usr/share/vulkan/explicit_layer.d")
            mapfile -t runner < <(runner_of_release "${1%-*}")
            ;;
        swiftshader)
            fetch_swiftshader || return 1
            json="$(manifest_of_swiftshader)"
            ;;
        gpu)
            "$gpc" devices | grep -qE '^  (discrete|integrated|virtual),' || { echo "there is none"; return 1; }
            environment=()
            kibibytes=unlimited
            return
            ;;
    esac
    # Each driver has a shader cache of its own, since Mesa's cache does not distinguish widths of vectors.
    environment+=("VK_DRIVER_FILES=$json" "VK_ICD_FILENAMES=$json" "MESA_SHADER_CACHE_DIR=$folder/cache-$1")
    case "$1" in
        *-128) environment+=(LP_NATIVE_VECTOR_WIDTH=128) ;;
        *-512) environment+=(LP_NATIVE_VECTOR_WIDTH=512) ;;
    esac
}

# Runs a program on the driver. It is ended if it takes too long, or (except on a GPU) too much memory.
run() { (ulimit -v "$kibibytes" && env "${environment[@]}" timeout "${LIMIT:-3600}" "${runner[@]}" "$@"); }

cargo build --release --bin gpc || exit 1
tests="$(cargo test --release --test gpu --no-run 2>&1 | sed -nE 's/.*Executable .*\((.*)\)$/\1/p')"
[ -n "$tests" ] || { echo "The tests do not build: see \`cargo test --release --test gpu\`" >&2; exit 1; }

failed=0
first=
while IFS='|' read -r name what; do
    name="${name// /}"
    [ -n "$name" ] || continue
    [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
    echo "== $name: $what"
    if ! why="$(prepare "$name")"; then
        echo "   not run: $why"
        continue
    fi
    prepare "$name"
    run "$gpc" devices | grep -B 1 -A 1 ', Vulkan ' | sed 's/^ */   /'
    image="out/drivers/$name.png"
    # A driver that can't render a small image is not tested.
    if ! LIMIT=600 run "$gpc" render "$scene" --size 320x180 -o "$image" --quiet 2>/dev/null; then
        echo "   not tested: it crashes, or takes more than ten minutes or 8 GiB, on an image of $scene"
        continue
    fi
    if [ -z "$first" ]; then
        first="$image"
    else
        echo "   against $first: $("$gpc" compare "$first" "$image" | paste -sd ' ')"
    fi
    log="out/drivers/$name.log"
    run "$tests" ${FILTER:+"$FILTER"} </dev/null >"$log" 2>&1 || failed=1
    grep -a '^test result' "$log" | sed 's/^test result: /   /'
    grep -aq '^test result' "$log" || echo "   ended without a result: see $log"
    sed -nE 's/^test (.*) \.\.\. FAILED$/   failed: \1/p' "$log"
done <<<"$drivers"
exit $failed
