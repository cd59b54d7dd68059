#!/bin/sh
# Makes the pictures of docs/gallery.md, by the commands that are printed there.
set -eu
cd "$(dirname "$0")/.."
gpc() { cargo run --quiet --release -- "$@"; }
out=docs/gallery
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

# Planar and superpixel sets.
gpc render assets/letters.glb -o $out/planar.png --size 480x300 --background '#708090' --aa none --quiet
gpc render assets/letters.glb -o "$work/superpixel.png" --size 480x300 --background '#708090' --aov superpixels --quiet
cp "$work/superpixel.png" "$work/superpixel.superpixels.png" $out

# An offset set: the zoom of a scene, and its steps.
gpc zoom assets/letters.glb -o "$work/zoom.png" --size 480x300 --background '#708090' \
    --center 225,222 --radius 60 --multiplicity 0.3 --transition smooth --steps
for step in '' .original .locations .resampled .transition .direct; do cp "$work/zoom$step.png" $out; done

# The same seen again in an ordinary way, without the scene.
gpc unzoom "$work/zoom.png" -o $out/unzoom.png --reference "$work/zoom.direct.png"

# Of a photograph: two regions.
gpc render assets/fence.glb -o "$work/photograph.jpg" --size 480x300 --background '#a8c0d8' --quiet
gpc zoom "$work/photograph.jpg" -o $out/photograph.png --center 135,140 --radius 28 --multiplicity 0.4 \
    --center 370,80 --radius 40,24 --multiplicity 0.5 --shape circle --shape rectangle

# No pattern: rings around a focus, ever wider, as rows and their angles as columns.
awk 'BEGIN { print "u,v,row,col"; for (row = 0; row < 200; row++) for (col = 0; col < 480; col++) {
    r = 2 * exp(row / 40); a = col / 480 * 6.283185307
    print 240 + r * cos(a) "," 150 + r * sin(a) "," row "," col } }' > "$work/rings.csv"
gpc sample assets/letters.glb --samples "$work/rings.csv" -o $out/no-pattern.png --size 480x300 \
    --background '#708090' --aa superpixel

# Rigs.
for projection in equirectangular cylindrical fisheye cubemap; do
    gpc panorama assets/fence.glb -o $out/$projection.png --projection $projection --size 480x240 \
        --background '#a8c0d8'
done

# Projectors: two with keystone, from correspondences.
gpc project assets/fence.glb -o "$work/projector-{projector}.png" --size 480x300 --background '#a8c0d8' \
    --projector $out/left.csv --projector $out/right.csv --projector-size 320x240 \
    --weights --wall $out/wall.png
cp "$work/projector-0.png" "$work/projector-0.weights.png" "$work/projector-1.png" $out

# Lines: the edges of meshes.
for aa in none superpixel; do
    gpc render assets/spheres.glb -o "$work/edges-$aa.png" --size 480x300 --background '#a8c0d8' --edges 1.5 --aa $aa --quiet
done
cp "$work/edges-none.png" $out
cp "$work/edges-superpixel.png" $out/edges.png

# Shadows: what is seen, on the planes of the lights.
for scene in letters fence; do
    gpc render assets/$scene.glb -o $out/shadows-$scene.png --size 480x300 --background '#a8c0d8' --shadows exact \
        --quiet
done
