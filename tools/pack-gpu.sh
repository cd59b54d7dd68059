#!/usr/bin/env bash
# Packs what tests gpc on the GPU of an x86-64 Linux machine with a driver and Python 3, which needs neither Rust nor this
# repository.
#
#   tools/pack-gpu.sh [--libraries] [--before GPC] OUT [SCENE...]
#
# OUT is a folder, or an archive if it ends in .tar.xz. On the other machine:
#
#   tar -xf gpc-gpu.tar.xz && gpc-gpu/run.py
#
# SCENE is a .gltf or .glb file, which is packed with the folder that it lies in; it is compared and timed as those of assets/
# are. --libraries packs the Vulkan loader and the validation layer, for machines that lack them. GPC is an earlier command, which
# is timed by turns with the present one.
#
# The references are rendered here, by lavapipe.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
    echo "usage: tools/pack-gpu.sh [--libraries] [--before GPC] OUT [SCENE...]" >&2
    exit 2
}

libraries=false before= arguments=()
while [ $# -gt 0 ]; do
    case "$1" in
        --libraries) libraries=true ;;
        --before)
            [ $# -gt 1 ] || usage
            before="$2"
            shift
            ;;
        -*) usage ;;
        *) arguments+=("$1") ;;
    esac
    shift
done
[ ${#arguments[@]} -gt 0 ] || usage
out="${arguments[0]}"
scenes=("${arguments[@]:1}")

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
case "$out" in
    *.tar.xz) pack="$work/$(basename "$out" .tar.xz)" ;;
    *) pack="$out" ;;
esac
rm -rf "$pack"
mkdir -p "$pack/bin" "$pack/tests" "$pack/examples/forward" "$pack/scenes"

# The features are those of `make test`, so that nothing is compiled twice.
cargo build --release --features capi --bin gpc --example visibility
tests="$(cargo test --release --features capi --test gpu --no-run 2>&1 | sed -nE 's/.*Executable .*\((.*)\)$/\1/p')"
[ -n "$tests" ] || { echo "The tests do not build: see \`cargo test --release --features capi --test gpu\`" >&2; exit 1; }
make --no-print-directory install PREFIX="$work/gpc" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
read -ra flags <<<"$(PKG_CONFIG_PATH="$work/gpc/lib/pkgconfig" pkg-config --static --cflags gpc)"
read -ra vulkan <<<"$(pkg-config --libs vulkan)"
c++ -std=c++17 -O2 examples/forward/forward.cpp -o "$pack/bin/forward" "${flags[@]}" "$work/gpc/lib/libgpc.a" "${vulkan[@]}" \
    -lpthread -ldl -lm
target="${CARGO_TARGET_DIR:-target}/release"
cp "$target/gpc" "$target/examples/visibility" "$pack/bin/"
cp "$tests" "$pack/bin/gpu-tests"
[ -z "$before" ] || cp "$before" "$pack/bin/gpc-before"
strip "$pack"/bin/*

install -m 755 tools/gpu/run.py "$pack/run.py"
cp -r assets "$pack/assets"
cp -r tests/goldens "$pack/tests/goldens"
cp examples/forward/shaders/spirv/*.spv "$pack/examples/forward/"
cp LICENSE-MIT LICENSE-APACHE "$pack/"
for scene in "${scenes[@]}"; do
    [ -f "$scene" ] || { echo "$scene is not there" >&2; exit 1; }
    folder="$(dirname "$scene")"
    case "$scene" in
        *.glb) install -D -m 644 "$scene" "$pack/scenes/$(basename "$folder")/$(basename "$scene")" ;;
        *) cp -rL "$folder" "$pack/scenes/" ;;
    esac
done
commit="$(git rev-parse --short=8 HEAD)"
git diff --quiet HEAD || commit="$commit, changed"
echo "$commit" >"$pack/commit"

if $libraries; then
    # NVIDIA's driver needs libX11 and the libraries of GLVND.
    packages=(libvulkan1 vulkan-validationlayers libglvnd0 libglx0 libgl1 libegl1 libopengl0 libgles2
        libx11-6 libxext6 libxcb1 libxau6 libxdmcp6 libbsd0 libmd0)
    . tools/debian.sh
    mkdir -p "$work/packages" "$pack/libraries/layer"
    (cd "$work/packages" && private_apt "$work/apt" update && private_apt "$work/apt" download "${packages[@]}") >"$work/log" 2>&1 ||
        { cat "$work/log" >&2; exit 1; }
    for package in "$work"/packages/*.deb; do
        dpkg-deb -x "$package" "$work/root"
    done
    mv "$work"/root/usr/lib/x86_64-linux-gnu/libVkLayer_*.so "$pack/libraries/layer/"
    cp "$work"/root/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json "$pack/libraries/"
    cp -P "$work"/root/usr/lib/x86_64-linux-gnu/*.so.* "$pack/libraries/"
    cp -rL "$work/root/usr/share/doc" "$pack/libraries/doc"
    find "$pack/libraries/doc" -type f ! -name copyright -delete
fi

lavapipe="$(ls /usr/share/vulkan/icd.d/lvp_icd*.json /etc/vulkan/icd.d/lvp_icd*.json 2>/dev/null | head -n 1 || true)"
[ -n "$lavapipe" ] || { echo "lavapipe, which renders the references, is not installed" >&2; exit 1; }
# Images of vectors of 256 bits do not depend on the machine.
env VK_DRIVER_FILES="$lavapipe" VK_ICD_FILENAMES="$lavapipe" LP_NATIVE_VECTOR_WIDTH=256 \
    MESA_SHADER_CACHE_DIR="$work/cache" "$pack/run.py" --references --out "$work/results"

if [ "$pack" != "$out" ]; then
    mkdir -p "$(dirname "$out")"
    tar -C "$work" --sort=name --owner=0 --group=0 -c "$(basename "$pack")" | xz -T0 >"$out"
    echo "$out: $(du -h "$out" | cut -f 1)"
fi
