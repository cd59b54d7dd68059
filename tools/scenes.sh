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

# Views that fill most of a frame: scenes, each with the options of its camera.
views=()
_add_view() { # SCENE OPTIONS
    if [ -f "$1" ]; then
        views+=("$1 $2")
    else
        echo "left out: $1 is not there" >&2
    fi
}
_add_view $shared/LowpolyCity/scene.gltf "--zoom 4 --elevation 10"
_add_view $shared/WebXRGarage/garage.gltf "--eye 0,1.6,0 --target 0,1.4,-1 --fov 70"
_add_view $shared/SauerbratenZdm2/zdm2.glb "--zoom 5 --elevation 30"
_add_view $shared/GrassFieldInstanced/GrassFieldInstanced.glb "--zoom 4 --elevation 12"
_add_view assets/fence.glb ""
_add_view assets/foliage.glb ""
_add_view $shared/ToyCar/ToyCar.gltf "--eye 0.032,0.032,0.036 --target 0.006,0.004,0"
_add_view $shared/FlightHelmet/FlightHelmet.gltf "--eye 0.1,0.62,0.3 --target 0.03,0.53,0"
_add_view $shared/DutchShip/dutch_ship_medium_1k.gltf "--eye 5,7.5,5 --target 0,3,-1 --fov 60"
_add_view $shared/GodotRoom/room.glb "--eye 4,2.2,4 --target -2,1.5,-3 --fov 75"
