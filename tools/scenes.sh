# Lists of the benchmark's scenes. Scripts source this file at the root of the repository. docs/scenes.md says where the scenes
# come from. Missing scenes are left out, with a message.

shared=../shared/scenes

# Adds those scenes of a list that exist to the array with a name.
_add() { # ARRAY SCENE...
    local -n _array="$1"
    shift
    local scene
    for scene in "$@"; do
        if [ -f "$scene" ]; then
            _array+=("$scene")
        else
            echo "left out: $scene is not there" >&2
        fi
    done
}

motion_scenes=()
_add motion_scenes \
    $shared/FlightHelmet/FlightHelmet.gltf \
    $shared/CesiumMan/CesiumMan.glb \
    $shared/LowpolyCity/scene.gltf \
    $shared/DeskFanAnimated/vintageFan_animated.gltf \
    $shared/ToyCar/ToyCar.gltf

speed_scenes=()
_add speed_scenes \
    $shared/LowpolyCity/scene.gltf \
    $shared/SauerbratenZdm2/zdm2.glb \
    $shared/DeskFanAnimated/vintageFan_animated.gltf \
    $shared/FlightHelmet/FlightHelmet.gltf \
    $shared/ToyCar/ToyCar.gltf \
    $shared/DutchShip/dutch_ship_medium_1k.gltf \
    $shared/MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb

quality_scenes=()
_add quality_scenes \
    $shared/DutchShip/dutch_ship_medium_1k.gltf \
    $shared/FlightHelmet/FlightHelmet.gltf \
    $shared/LowpolyCity/scene.gltf \
    $shared/ToyCar/ToyCar.gltf \
    $shared/DeskFanAnimated/vintageFan_animated.gltf \
    assets/checker.glb \
    assets/foliage.glb \
    $shared/CesiumMan/CesiumMan.glb \
    $shared/SpecularTest/SpecularTest.glb \
    $shared/NormalTangentTest/NormalTangentTest.glb \
    $shared/TextureSettingsTest/TextureSettingsTest.glb \
    $shared/TennisRacquet/TennisRacquet.gltf \
    $shared/Suzanne/Suzanne.gltf \
    $shared/DiffuseTransmissionPlant/DiffuseTransmissionPlant.glb \
    $shared/SauerbratenZdm2/zdm2.glb \
    $shared/MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb
