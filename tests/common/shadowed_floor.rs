//! A scene with one shadow.

use super::scene_builder::Builder;
use serde_json::json;

/// A floor with a triangle above its middle, and light from straight above.
pub fn shadowed_floor() -> Vec<u8> {
    let mut builder = Builder::new();
    let floor = [[-4.0, 0.0, 4.0], [4.0, 0.0, 4.0], [4.0, 0.0, -4.0], [-4.0, 0.0, -4.0]];
    let over = [[-1.0, 1.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, -1.5]];
    for (corners, indices) in [(&floor[..], &[0, 1, 2, 0, 2, 3][..]), (&over, &[0, 1, 2])] {
        let positions = builder.floats(corners);
        let indices = builder.indices(indices);
        let primitive = json!({"attributes": {"POSITION": positions}, "indices": indices});
        builder.node_with(primitive, json!({}));
    }
    builder.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = json!([{"type": "directional", "intensity": 5}]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    builder
        .push("nodes", json!({"rotation": [-half, 0, 0, half], "extensions": {"KHR_lights_punctual": {"light": 0}}}));
    builder.glb()
}
