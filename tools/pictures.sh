#!/usr/bin/env bash
# Renders the pictures of the README, of docs/filters.md and of docs/gallery.md again, with the commands that are printed there, and
# those of docs/embedding-reference.md, which a test makes. Look at each picture.
#
# Scenes that are not part of the repository (docs/scenes.md says where they come from) are expected in ../shared/scenes. If a
# scene is missing, its pictures stay as they are. Enlarging needs ffmpeg. tools/window.sh makes the pictures of the window.
set -euo pipefail
cd "$(dirname "$0")/.."

cargo build --release --bin gpc
gpc() { "${CARGO_TARGET_DIR:-target}/release/gpc" "$@"; }
shared=../shared/scenes
out=docs/gallery
work="$(mktemp -d)"
trap 'rm -r "$work"' EXIT

# The picture of the README: a frame that the scene fills, and a part of it by three methods, enlarged three times. The times are kept.
front=(assets/fence.glb --size 1920x1080 --background '#a8c0d8' --quiet --json)
for method in none:1:5 ssaa:4:5 superpixel:64:5 ssaa:64:1; do
    IFS=: read -r aa samples repeat <<<"$method"
    image="$work/front-$aa-$samples.png"
    gpc render "${front[@]}" -o "$image" --aa "$aa" --samples "$samples" --repeat "$repeat" >"$work/front.json"
    echo "fence,$aa,$samples,$(sed -n '/"gpu_ms"/,/}/s/.*"total": *\([0-9.]*\).*/\1/p' "$work/front.json")" >>"$work/front.rows"
done
cp "$work/front-superpixel-64.png" docs/pictures/front.png
for part in none-1 ssaa-4 superpixel-64; do
    ffmpeg -loglevel error -y -i "$work/front-$part.png" -vf crop=160:120:1020:540,scale=iw*3:ih*3:flags=neighbor \
        "docs/pictures/front-${part%-*}.png"
done
gpc bench assets/checker.glb --out "$work/head" --size 16x16 --methods none --samples 1 --reference 256 --repeat 1 >"$work/log"
{
    echo "# commit: $(git rev-parse --short HEAD)"
    grep -E '^# (driver|machine|date): ' "$work/head/results.csv"
    echo "# size: 1920x1080"
    echo scene,method,samples,gpu_ms_median
    cat "$work/front.rows"
} >docs/bench/picture-lavapipe-22.3.csv

# Pixel filters: a part of an image by each of them, enlarged, side by side. The zone plate is made of rings of equal area.
awk 'BEGIN { rings = 180; sides = 720
    print "ply\nformat ascii 1.0\nelement vertex " 2 * rings * sides "\nproperty float x\nproperty float y\nproperty float z"
    print "element face " rings * sides "\nproperty list uchar int vertex_indices\nend_header"
    for (edge = 0; edge < 2 * rings; edge++) for (i = 0; i < sides; i++) {
        angle = 6.283185307 * i / sides; radius = sqrt(edge / (2 * rings)); print radius * cos(angle), radius * sin(angle), 0 }
    for (ring = 0; ring < rings; ring++) for (i = 0; i < sides; i++) {
        next_ = (i + 1) % sides; inner = 2 * ring * sides; outer = inner + sides
        print 4, inner + i, outer + i, outer + next_, inner + next_ } }' >"$work/plate.ply"
filters=(box tent gaussian mitchell blackman-harris)
strip() { # NAME CROP SCENE OPTIONS...
    local inputs=() crops='' joined='' i
    for i in "${!filters[@]}"; do
        gpc render "${@:3}" --filter "${filters[i]}" -o "$work/$1-$i.png" --quiet
        inputs+=(-i "$work/$1-$i.png")
        crops+="[$i]crop=$2,scale=iw*5:ih*5:flags=neighbor,pad=iw+4:ih:0:0:white[c$i];"
        joined+="[c$i]"
    done
    ffmpeg -loglevel error -y "${inputs[@]}" -filter_complex "$crops${joined}hstack=${#filters[@]},crop=iw-4:ih:0:0" \
        "docs/pictures/filter-$1.png"
}
strip wires 60:45:150:0 assets/fence.glb --size 480x270 --background '#a8c0d8'
strip letters 60:45:180:195 assets/letters.glb --size 480x270 --background '#708090'
strip plate 60:45:128:50 "$work/plate.ply" --eye 0,0,3 --fov 36.87 --size 256x256 --background '#000000'

# Planar and superpixel sets.
gpc render assets/letters.glb -o $out/planar.png --size 480x300 --background '#708090' --aa none --quiet
gpc render assets/letters.glb -o "$work/superpixel.png" --size 480x300 --background '#708090' --aov superpixels --quiet
cp "$work/superpixel.png" "$work/superpixel.superpixels.png" $out

# An offset set: the zoom of a scene, and its steps.
gpc zoom assets/letters.glb -o "$work/zoom.png" --size 480x300 --background '#708090' \
    --center 225,222 --radius 60 --multiplicity 0.3 --transition smooth --steps
for step in '' .original .locations .direct; do cp "$work/zoom$step.png" $out; done

# The zoomed image turned back to an ordinary image, without the scene.
gpc unzoom "$work/zoom.png" -o $out/unzoom.png --reference "$work/zoom.direct.png"

# Locations without a pattern: the mesh of a fence that recedes, sampled at equal steps along it.
awk 'BEGIN { print "u,v,row,col"; for (row = 0; row < 160; row++) for (col = 0; col < 480; col++) {
    distance = 1.2 + 3 * col / 480
    print 253 + 227 / distance "," 156.8 + (1.68125 * row - 13.6) / distance "," row "," col } }' > "$work/fence.csv"
gpc sample assets/fence.glb --samples "$work/fence.csv" -o $out/no-pattern.png --size 480x300 --background '#a8c0d8' \
    --aa superpixel

# A room (CC-BY), in which every direction shows something: a rig of six pinholes, panoramas, an image file without its scene, and
# edges of meshes as lines.
room="$shared/WebXRGarage/garage.gltf"
if [ -f "$room" ]; then
    eye=(--background '#202830' --eye 0,1.6,0)
    gpc panorama "$room" -o $out/cubemap.png --projection cubemap --size 960x480 "${eye[@]}" --target 0,1.6,-1
    for projection in equirectangular cylindrical fisheye; do
        gpc panorama "$room" -o $out/$projection.png --projection $projection --size 480x240 "${eye[@]}" --target 0,1.5,-1
    done
    gpc render "$room" -o "$work/photo.jpg" --size 480x300 "${eye[@]}" --target 0,1.4,-1 --fov 70 --quiet
    gpc zoom "$work/photo.jpg" -o $out/image-zoom.png --center 305,130 --radius 50,32 --multiplicity 0.5 --shape rectangle
    for aa in none superpixel; do
        gpc render "$room" -o "$work/edges-$aa.png" --size 480x300 "${eye[@]}" --target 0.5,1.2,-1 --fov 60 --edges 1.5 --aa $aa --quiet
    done
    cp "$work/edges-none.png" $out
    cp "$work/edges-superpixel.png" $out/edges.png
else
    echo "left out: $room is not there" >&2
fi

# Projectors: two with keystone, from correspondences.
gpc project assets/fence.glb -o "$work/projector-{projector}.png" --size 480x300 --background '#a8c0d8' \
    --projector $out/left.csv --projector $out/right.csv --projector-size 320x240 \
    --weights --wall $out/wall.png
cp "$work/projector-0.png" "$work/projector-0.weights.png" "$work/projector-1.png" $out

# Exact shadows, and a part of them with and without antialiasing, enlarged three times.
for aa in none superpixel; do
    gpc render assets/fence.glb -o "$work/shadows-$aa.png" --size 480x300 --background '#a8c0d8' --shadows exact --quiet --aa $aa
    ffmpeg -loglevel error -y -i "$work/shadows-$aa.png" -vf crop=160:130:180:170,scale=iw*3:ih*3:flags=neighbor \
        "$out/shadows-part-$aa.png"
done
for scene in letters fence; do
    gpc render assets/$scene.glb -o $out/shadows-$scene.png --size 480x300 --background '#a8c0d8' --shadows exact --quiet
done

# What an application draws besides the triangles that the library knows.
GPC_PICTURES=write cargo test --release --test gpu host::besides
