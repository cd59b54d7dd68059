#!/usr/bin/env bash
# Measures what antialiasing costs and how exact it is, on the scenes of assets/ and, where they are, on larger ones.
#
#   tools/bench.sh [FOLDER [OPTION...]]
#
# OPTIONs are those of `gpc bench`.
set -euo pipefail
cd "$(dirname "$0")/.."

folder="${1:-out/bench}"
shift || true

scenes=(assets/*.glb)
shared=../shared/scenes
for scene in \
    DutchShip/dutch_ship_medium_1k.gltf \
    FlightHelmet/FlightHelmet.gltf \
    LowpolyCity/scene.gltf \
    ToyCar/ToyCar.gltf \
    DeskFanAnimated/vintageFan_animated.gltf \
    CesiumMan/CesiumMan.glb \
    SpecularTest/SpecularTest.glb \
    NormalTangentTest/NormalTangentTest.glb \
    TextureSettingsTest/TextureSettingsTest.glb \
    TennisRacquet/TennisRacquet.gltf \
    Suzanne/Suzanne.gltf \
    DiffuseTransmissionPlant/DiffuseTransmissionPlant.glb \
    SauerbratenZdm2/zdm2.glb \
    MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb; do
    if [ -f "$shared/$scene" ]; then
        scenes+=("$shared/$scene")
    fi
done

cargo run --release --quiet --bin gpc -- bench "${scenes[@]}" --out "$folder" "$@"
echo
echo "$folder holds report.html, results.csv and results.json"
