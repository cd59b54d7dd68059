#!/bin/sh
# Prints a hash of each image that a gpc command makes, so that two versions can be compared:
#
#     tools/image-hashes.sh old/gpc > old.txt
#     tools/image-hashes.sh target/release/gpc > new.txt
#     diff old.txt new.txt
#
# The images are of the scenes in assets/, and of those in the folder SCENES if it is set. All are 480 pixels wide.
set -eu

gpc=$1
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# image NAME COMMAND...: the hash of the image that a command writes to a file, or the exit status of the command.
image() {
    label=$1
    shift
    if "$gpc" "$@" --quiet -o "$out/image.png" >"$out/log" 2>&1; then
        printf '%s  %s\n' "$(sha256sum <"$out/image.png" | cut -c 1-16)" "$label"
    else
        printf 'exit status %s  %s\n' "$?" "$label"
    fi
    rm -f "$out/image.png"
}

for scene in assets/*.glb; do
    name=$(basename "$scene")
    image "$name none" render "$scene" --size 480x270 --aa none
    image "$name msaa 4" render "$scene" --size 480x270 --aa msaa --samples 4
    image "$name ssaa 16" render "$scene" --size 480x270 --aa ssaa --samples 16
    for samples in 16 64 256 1024; do
        image "$name $samples" render "$scene" --size 480x270 --samples "$samples"
    done
done
for scene in letters glass foliage; do
    image "$scene shadows" render "assets/$scene.glb" --size 480x270 --shadows exact
done
for pattern in sobol grid; do
    image "fence $pattern" render assets/fence.glb --size 480x270 --pattern "$pattern"
done
for shading in triangle sample; do
    image "foliage $shading" render assets/foliage.glb --size 480x270 --shading "$shading"
done
image zoom zoom assets/letters.glb --size 480x270 --center 240,135 --radius 60 --multiplicity 0.4
image "zoom shadows" zoom assets/letters.glb --size 480x270 --center 240,135 --radius 60 --multiplicity 0.4 --shadows exact
for projection in cubemap equirectangular; do
    image "$projection" panorama assets/fence.glb --size 480x240 --projection "$projection"
done
awk 'BEGIN { OFS = ","; print "u,v,row,col"; for (y = 0; y < 90; y++) for (x = 0; x < 160; x++) print 3.1 * x, 2.9 * y, y, x }' \
    >"$out/places.csv"
for method in none superpixel; do
    image "list $method" sample assets/fence.glb --samples "$out/places.csv" --size 480x270 --aa "$method"
done
if [ -n "${SCENES:-}" ]; then
    find "$SCENES" -name '*.glb' -o -name '*.gltf' | sort | while read -r scene; do
        image "$(basename "$scene")" render "$scene" --size 480x270
    done
fi
