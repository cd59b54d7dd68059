#!/usr/bin/env bash
# Compiles the kernels with the compilers of GPU drivers, without a GPU. Prints the compilers' statistics of each kernel, and the
# number of commands of a frame. Fails if a figure violates a bound of tools/compilers/bounds.txt.
#
#   tools/test-compilers.sh [NAME...]     only hardware with these names; see `hardware` below
#
# The command renders with drivers that compile for absent hardware, through a layer (tools/compilers/layer.cpp) that answers for
# this hardware. Nothing is executed there, so times of frames are not known. The layer's reports are in out/compilers.
#
# AMD's drivers need only what tools/debian.sh fetches. Intel's and NVIDIA's also need a shim that replaces the kernel's driver.
# It is built from Mesa's sources with Meson 1.1 or later; if this is missing, the script says so. For NVIDIA, kernels are
# compiled by Mesa's compiler, not by NVIDIA's.
set -uo pipefail
cd "$(dirname "$0")/.."

mkdir -p out/compilers
. tools/debian.sh

# Name, Debian release of the driver, the driver's name in Mesa, variables that make it compile for the hardware, description.
hardware="
VEGA10 |bookworm|radeon |RADV_FORCE_FAMILY=VEGA10                                       |AMD GFX9
NAVI21 |bookworm|radeon |RADV_FORCE_FAMILY=NAVI21                                       |AMD GFX10.3
NAVI31 |trixie  |radeon |RADV_FORCE_FAMILY=NAVI31                                       |AMD GFX11
DG2    |trixie  |intel  |INTEL_STUB_GPU_PLATFORM=dg2                                    |Intel Xe HPG
LNL    |trixie  |intel  |INTEL_STUB_GPU_PLATFORM=lnl                                    |Intel Xe2
GA102  |trixie  |nouveau|NOUVEAU_CHIPSET=172 NVK_I_WANT_A_BROKEN_VULKAN_DRIVER=1        |NVIDIA Ampere
"

# Name, and the arguments of `gpc`. Together these frames need every kernel.
frames="
fence-none   |render assets/fence.glb --aa none
fence-64     |render assets/fence.glb --samples 64
fence-1024   |render assets/fence.glb --samples 1024
foliage-64   |render assets/foliage.glb --samples 64
glass-64     |render assets/glass.glb --samples 64
shadows-64   |render assets/fence.glb --samples 64 --shadows exact
shadows-glass|render assets/glass.glb --samples 64 --shadows exact
points-16    |render assets/foliage.glb --samples 16 --pattern sobol
points-64    |render assets/foliage.glb --samples 64 --pattern sobol
environment  |render assets/spheres.glb --environment out/compilers/image.exr
ssaa-64      |render assets/fence.glb --samples 64 --aa ssaa
msaa         |render assets/fence.glb --aa msaa
zoom         |zoom assets/foliage.glb --center 640,300 --radius 90 --multiplicity 0.3
edges        |render assets/letters.glb --edges 2
layers       |render assets/foliage.glb --aov depth,id,normal
"

# Builds a shim for a kernel driver from Mesa's sources of a release. If it fails, prints why.
build_shim() { # RELEASE intel|nouveau
    local own="$folder/$1" target source version build="$folder/$1/shim-$2"
    case "$2" in
        intel) target=src/intel/tools/libintel_noop_drm_shim.so ;;
        nouveau) target=src/nouveau/drm-shim/libnouveau_noop_drm_shim.so ;;
    esac
    shim="$build/$target"
    [ -e "$shim" ] && return
    version="$(meson --version 2>/dev/null || echo 0)"
    [ "$(printf '%s\n' 1.1 "$version" | sort -V | head -n 1)" = 1.1 ] || { echo "its shim needs Meson 1.1 or later"; return 1; }
    if ! compgen -G "$own/mesa-*/meson.build" >/dev/null; then
        grep -q '^deb-src' "$own/sources.list" || sed -n 's/^deb /deb-src /p' "$own/sources.list" >>"$own/sources.list"
        { private_apt "$own" update && (cd "$own" && private_apt "$own" source --download-only mesa && tar -xf mesa_*.orig.tar.xz); } \
            >"$own/log" 2>&1 || { echo "apt could not fetch Mesa's sources: $(tail -n 1 "$own/log")"; return 1; }
    fi
    source="$(ls -d "$own"/mesa-*/)"
    { meson setup "$build" "$source" -Dvulkan-drivers= -Dgallium-drivers=crocus,nouveau -Dplatforms= -Dglx=disabled -Degl=disabled \
        -Dgbm=disabled -Dopengl=true -Dgles1=disabled -Dgles2=disabled -Dllvm=disabled -Dvalgrind=disabled -Dlibunwind=disabled \
        -Dintel-rt=disabled -Dbuildtype=release -Dtools=drm-shim,intel && ninja -C "$build" "$target"; } >"$own/log" 2>&1 ||
        { echo "its shim does not build: see $own/log"; return 1; }
}

# Prepares a driver: sets `environment` and `runner` for the command. If it fails, prints why.
prepare() { # RELEASE DRIVER SETTINGS
    local manifest shim
    runner=()
    environment=($3)
    if [ "$1" = "$release" ]; then
        manifest="$(ls /usr/share/vulkan/icd.d/"$2"_icd*.json 2>/dev/null | head -n 1)"
        [ -n "$manifest" ] || { echo "Mesa's driver is not installed"; return 1; }
    else
        fetch_release "$1" || return 1
        manifest="$(manifest_of_release "$1" "$2")"
        mapfile -t runner < <(runner_of_release "$1")
    fi
    if [ "$2" != radeon ]; then
        build_shim "$1" "$2" || return 1
        environment+=("LD_PRELOAD=$shim")
    fi
    environment+=("VK_DRIVER_FILES=$manifest" "VK_ICD_FILENAMES=$manifest" MESA_SHADER_CACHE_DISABLE=true
        "VK_LAYER_PATH=$folder/layer" VK_INSTANCE_LAYERS=VK_LAYER_GPC_compilers "GPC_LAYER_SPIRV=$PWD/shaders/spirv")
}

cargo build --release --bin gpc || exit 1
mkdir -p "$folder/layer"
c++ -std=c++17 -O1 -Wall -shared -fPIC -o "$folder/layer/libgpc_layer.so" tools/compilers/layer.cpp || exit 1
cat >"$folder/layer/gpc_layer.json" <<'END'
{"file_format_version": "1.2.0", "layer": {"name": "VK_LAYER_GPC_compilers", "type": "GLOBAL", "library_path": "./libgpc_layer.so",
"api_version": "1.3.0", "implementation_version": "1", "description": "Reports what compilers of GPU drivers make of kernels"}}
END

failed=0
while IFS='|' read -r name of driver settings what; do
    name="${name// /}"
    [ -n "$name" ] || continue
    [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
    echo "== $name: $what, Mesa of Debian $of"
    driver="${driver// /}" of="${of// /}"
    if ! why="$(prepare "$of" "$driver" "$settings")"; then
        echo "   not compiled: $why"
        continue
    fi
    prepare "$of" "$driver" "$settings"
    report="out/compilers/$name.tsv"
    rm -f "$report"
    while IFS='|' read -r frame options; do
        frame="${frame// /}"
        [ -n "$frame" ] || continue
        printf 'frame\t%s\n' "$frame" >>"$report"
        env "${environment[@]}" "GPC_LAYER_REPORT=$report" "${runner[@]}" "$gpc" $options --size 1280x720 --quiet \
            -o out/compilers/image.exr 2>out/compilers/log || { echo "   failed: gpc $options: $(tail -n 1 out/compilers/log)"; failed=1; }
    done <<<"$frames"
    awk -F '\t' -v hardware="$name" -v kernels="$(cd shaders/spirv && ls -- *.spv | sed 's/\.spv$//' | paste -sd ' ')" \
        -f tools/compilers/figures.awk tools/compilers/bounds.txt "$report" || failed=1
done <<<"$hardware"
exit $failed
