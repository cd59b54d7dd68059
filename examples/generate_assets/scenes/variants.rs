//! `KHR_materials_variants` and `KHR_node_visibility`: spheres in the colours of a day or of a night, behind a hidden
//! sphere.

use super::glb::{Builder, Placement};
use super::mesh::globe;
use glam::dvec3;
use serde_json::json;

pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    let ball = file.surface(&globe(32, 18));
    const COUNT: u8 = 5;
    for index in 0..COUNT {
        let day = file.paint("day", [230, 200 - 30 * index, 60 + 20 * index], 0.5);
        let night = file.paint("night", [20 + 8 * index, 24, 90 + 20 * index], 0.3);
        let mesh = file.mesh_of_variants(ball, &[("day", day), ("night", night)]);
        let x = 2.2 * (f64::from(index) - f64::from(COUNT - 1) / 2.0);
        file.place(mesh, Placement::at(dvec3(x, 1.0, 0.0)));
    }
    let green = file.material(json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0.0, 1.0, 0.0, 1.0] },
        "extensions": { "KHR_materials_unlit": {} },
    }));
    let hidden = file.mesh(&[(ball, green)]);
    file.place(hidden, Placement::at(dvec3(0.0, 1.0, 4.0)));
    file.hide();
    file.perspective("front", dvec3(0.0, 2.6, 13.5), dvec3(0.0, 0.9, 0.0), 27.0);
    file.finish("Variants")
}
