#!/usr/bin/env bash
# Runs the tests of the passes (tests/gpu) on every driver that the machine can run, and says which it could not.
#
#   tools/test-drivers.sh [NAME...]       the drivers of these names alone; see `drivers` below
#   FILTER=... tools/test-drivers.sh      only tests whose names hold this
#
# Packages that are not installed are fetched by apt, from where the machine gets its own, and unpacked below the build's
# folder. That takes no rights. What each test printed is in out/drivers.
set -uo pipefail
cd "$(dirname "$0")/.."

folder="${CARGO_TARGET_DIR:-target}/drivers"
mkdir -p "$folder" out/drivers
folder="$(realpath "$folder")"
gpc="$(realpath "${CARGO_TARGET_DIR:-target}")/release/gpc"
scene=assets/fence.glb

# Name, and what it is. Subgroups have as many invocations as 32 bits fit in a vector.
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

release="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")"

# apt with lists, status and cache of its own. The first argument is a folder with a sources.list, or nothing for the
# machine's sources.
private_apt() { # FOLDER COMMAND...
    local own="$1" options=()
    shift
    mkdir -p "$own/lists/partial" "$own/archives/partial"
    : >>"$own/status"
    options=(-q -o "Dir::State::Lists=$own/lists" -o "Dir::State::status=$own/status" -o "Dir::Cache=$own"
        -o "Dir::Cache::archives=$own/archives" -o APT::Sandbox::User= -o Debug::NoLocking=1)
    if [ -e "$own/sources.list" ]; then
        options+=(-o "Dir::Etc::SourceList=$own/sources.list" -o Dir::Etc::SourceParts=/dev/null
            -o Dir::Etc::Preferences=/dev/null -o Dir::Etc::PreferencesParts=/dev/null)
    fi
    apt-get "${options[@]}" "$@"
}

# Unpacks lavapipe of a release, with all that it needs from the loader down, into $folder/RELEASE/root.
fetch_release() { # RELEASE
    local own="$folder/$1" site keys package
    [ -e "$own/lavapipe.json" ] && return
    site="$(apt-get indextargets --format '$(SITE) $(RELEASE)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' |
        sed -nE "s/^([^ ]+) $release\$/\1/p" | head -n 1)"
    keys=/usr/share/keyrings/debian-archive-keyring.gpg
    if [ -z "$site" ] || [ ! -e "$keys" ]; then
        echo "the machine's apt gets no packages of Debian"
        return 1
    fi
    mkdir -p "$own/root"
    echo "deb [signed-by=$keys] $site $1 main" >"$own/sources.list"
    if ! { private_apt "$own" update && private_apt "$own" install -y --no-install-recommends --download-only \
        mesa-vulkan-drivers libvulkan1 vulkan-validationlayers; } >"$own/log" 2>&1; then
        echo "apt could not fetch it: $(tail -n 1 "$own/log")"
        return 1
    fi
    for package in "$own"/archives/*.deb; do
        dpkg-deb -x "$package" "$own/root" || return 1
    done
    local library
    library="$(find "$own/root/usr/lib" -name libvulkan_lvp.so | head -n 1)"
    printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' "$library" \
        >"$own/lavapipe.json"
}

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

# Makes a driver ready: sets `environment`, `runner` and `kibibytes` for its programs. Prints why where it can't.
prepare() { # NAME
    local root json
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
            root="$folder/${1%-*}/root"
            json="$folder/${1%-*}/lavapipe.json"
            environment+=("VK_LAYER_PATH=$root/usr/share/vulkan/explicit_layer.d")
            # With the C library that it was built for.
            runner=("$(find "$root" -name 'ld-linux-*.so.*' | head -n 1)"
                --library-path "$(find "$root/usr/lib" -maxdepth 1 -name '*-linux-gnu*' | paste -sd :)")
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
    # Mesa's cache does not tell widths of vectors apart.
    environment+=("VK_DRIVER_FILES=$json" "VK_ICD_FILENAMES=$json" "MESA_SHADER_CACHE_DIR=$folder/cache-$1")
    case "$1" in
        *-128) environment+=(LP_NATIVE_VECTOR_WIDTH=128) ;;
        *-512) environment+=(LP_NATIVE_VECTOR_WIDTH=512) ;;
    esac
}

# Runs a program on the driver; one that takes too long, or on a CPU too much memory, is ended.
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
    # A driver that can't do this much is broken.
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
