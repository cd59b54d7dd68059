#!/usr/bin/env bash
# Checks that no shader reads or writes beyond the end of a buffer. Drivers on CPUs answer such a read with zero and ignore such
# a write, so their images do not show it. A GPU may return or overwrite whatever lies there.
#
#   tools/test-bounds.sh [NAME...]        only images with these names; see `images` below
#
# The validation layer adds the checks to the shaders (GPU-assisted validation). The layer of Debian 12 makes invalid code of
# loops with a single block, so tools/debian.sh fetches the layer and lavapipe of Debian 13. The layer compiles slowly: an
# image takes one to five minutes. Its messages are in out/bounds.
set -uo pipefail
cd "$(dirname "$0")/.."

mkdir -p out/bounds
out="$(realpath out/bounds)"
. tools/debian.sh

# Name, and the arguments of `gpc`.
images="
opaque   |render assets/fence.glb --size 240x135
samples  |render assets/fence.glb --size 240x135 --samples 1024
mask     |render assets/foliage.glb --size 240x135
blend    |render assets/glass.glb --size 240x135
shadows  |render assets/letters.glb --size 240x135 --shadows exact
points   |render assets/fence.glb --size 240x135 --pattern sobol
zoom     |zoom assets/letters.glb --size 240x135 --center 120,67 --radius 30 --multiplicity 0.4
panorama |panorama assets/fence.glb --size 240x120 --projection equirectangular
list     |sample assets/fence.glb --size 480x270 --samples out/bounds/places.csv --aa none
ssaa     |render assets/fence.glb --size 240x135 --aa ssaa --samples 4
"

if ! why="$(fetch_release trixie)"; then
    echo "not run: $why" >&2
    exit 1
fi
root="$folder/trixie/root"
driver="$(manifest_of_release trixie lvp)"
mapfile -t runner < <(runner_of_release trixie)
cat >"$out/vk_layer_settings.txt" <<SETTINGS
khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG
khronos_validation.report_flags = error
khronos_validation.log_filename = stdout
khronos_validation.validate_core = false
khronos_validation.thread_safety = false
khronos_validation.gpuav_enable = true
SETTINGS
awk 'BEGIN { OFS = ","; print "u,v,row,col"; for (y = 0; y < 90; y++) for (x = 0; x < 160; x++) print 3.1 * x, 2.9 * y, y, x }' \
    >"$out/places.csv"
cargo build --release --bin gpc || exit 1

failed=0
while IFS='|' read -r name arguments; do
    name="${name// /}"
    [ -n "$name" ] || continue
    [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
    log="$out/$name.log"
    # shellcheck disable=SC2086
    env VK_DRIVER_FILES="$driver" VK_ICD_FILENAMES="$driver" VK_LAYER_PATH="$root/usr/share/vulkan/explicit_layer.d" \
        VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation VK_LAYER_SETTINGS_PATH="$out" \
        MESA_SHADER_CACHE_DIR="$folder/cache-bounds" \
        "${runner[@]}" "$gpc" $arguments -o "$out/$name.png" --quiet </dev/null >"$log" 2>&1
    status=$?
    errors="$(grep -c '^Validation Error' "$log")"
    if [ "$status" -ne 0 ] || [ "$errors" -ne 0 ]; then
        failed=1
        echo "$name: exit status $status, $errors errors; see $log"
    else
        echo "$name: no access out of bounds"
    fi
done <<<"$images"
exit $failed
