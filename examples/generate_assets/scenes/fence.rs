//! A lane between a picket fence and a chain-link fence, with wires overhead. Nearly everything is thinner than a
//! pixel somewhere along it.

use super::glb::{Builder, Placement};
use super::mesh::Mesh;
use glam::{DQuat, DVec3, dvec2, dvec3};
use gpc::testing::Random;

/// Length of one fence panel in metres, and how many stand in a row.
const PANEL: f64 = 2.0;
const PANELS: i32 = 45;
/// z at which the lane starts; it runs towards -z.
const START: f64 = 4.0;

/// Builds the scene.
pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    ground(&mut file);
    picket_fence(&mut file);
    chain_link(&mut file);
    overhead_line(&mut file);
    cottage(&mut file);
    file.daylight();
    file.perspective("lane", dvec3(0.35, 1.55, 5.0), dvec3(-0.15, 1.75, -8.0), 44.0);
    file.perspective("pickets", dvec3(1.2, 1.3, 3.0), dvec3(-3.2, 0.8, -9.0), 32.0);
    file.finish("Fences and wires")
}

fn add(file: &mut Builder, mesh: &Mesh, material: usize) {
    let surface = file.surface(mesh);
    let mesh = file.mesh(&[(surface, material)]);
    file.place(mesh, Placement::at(DVec3::ZERO));
}

fn ground(file: &mut Builder) {
    let grass = file.paint("grass", [128, 156, 84], 0.95);
    let gravel = file.paint("gravel", [205, 188, 158], 0.95);
    let hill = file.paint("hill", [104, 140, 92], 0.95);
    let mut meadow = Mesh::default();
    meadow.cuboid(dvec3(-260.0, -1.0, -300.0), dvec3(260.0, 0.0, 30.0));
    add(file, &meadow, grass);
    let mut lane = Mesh::default();
    lane.cuboid(dvec3(-0.9, -0.5, -300.0), dvec3(0.9, 0.03, 30.0));
    add(file, &lane, gravel);
    let mut hills = Mesh::default();
    let mut random = Random::new(11);
    for i in -6..=6 {
        let centre = dvec3(f64::from(i) * 38.0, -4.0, -250.0 + random.range(-15.0, 15.0));
        let [width, height] = [random.range(30.0, 60.0), random.range(12.0, 26.0)];
        let peak = centre + dvec3(random.range(-8.0, 8.0), height, 0.0);
        let rim = |k: i32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 9.0).sin_cos();
            centre + dvec3(cos * width, 0.0, sin * width * 0.5)
        };
        for k in 0..9 {
            hills.polygon(&[rim(k + 1), rim(k), peak]);
        }
    }
    add(file, &hills, hill);
}

fn picket_fence(file: &mut Builder) {
    let white = file.paint("white paint", [244, 241, 232], 0.6);
    let mut panel = Mesh::default();
    for i in 0..16 {
        let x = 0.03 + f64::from(i) * PANEL / 16.0;
        let picket = [[0.0, 0.06], [0.07, 0.06], [0.07, 0.95], [0.035, 1.03], [0.0, 0.95]];
        let outline = picket.map(|[dx, y]| dvec2(x + dx, y));
        panel.prism(&outline, 0.0, 0.022);
    }
    for y in [0.25, 0.72] {
        panel.cuboid(dvec3(0.0, y, -0.04), dvec3(PANEL, y + 0.08, 0.0));
    }
    panel.cuboid(dvec3(-0.05, 0.0, -0.14), dvec3(0.05, 1.12, -0.04));
    row(file, &panel, white, -1.5);
}

fn chain_link(file: &mut Builder) {
    let steel = file.paint("galvanised wire", [120, 132, 140], 0.5);
    let height = 1.6;
    let mut panel = Mesh::default();
    // Two families of diagonal wires, 3.2 mm thick, each cut to the panel.
    let mut offset = -height + 0.04;
    while offset < PANEL {
        let [from, to] = [offset.max(0.0), (offset + height).min(PANEL)];
        let up = [dvec3(from, from - offset, 0.0), dvec3(to, to - offset, 0.0)];
        panel.tube(&up, [0.0016; 2], 4);
        let down = up.map(|p| dvec3(p.x, height - p.y, 0.004));
        panel.tube(&down, [0.0016; 2], 4);
        offset += 0.085;
    }
    for y in [0.02, height] {
        panel.tube(&[dvec3(0.0, y, 0.0), dvec3(PANEL, y, 0.0)], [0.018; 2], 6);
    }
    panel.tube(&[DVec3::ZERO, dvec3(0.0, height + 0.15, 0.0)], [0.03; 2], 8);
    row(file, &panel, steel, 1.7);
}

/// Places panels in a row, with their length along -z.
fn row(file: &mut Builder, panel: &Mesh, material: usize, x: f64) {
    let surface = file.surface(panel);
    let mesh = file.mesh(&[(surface, material)]);
    for i in 0..PANELS {
        file.place(
            mesh,
            Placement {
                rotation: DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2),
                ..Placement::at(dvec3(x, 0.0, START - PANEL * f64::from(i)))
            },
        );
    }
}

fn overhead_line(file: &mut Builder) {
    let wood = file.paint("pole", [112, 86, 66], 0.9);
    let copper = file.paint("wire", [58, 52, 50], 0.6);
    let span = 16.0;
    let insulators = [[-1.0, 5.75], [-0.55, 5.75], [0.55, 5.75], [1.0, 5.75], [-0.7, 5.05], [0.7, 5.05]];
    let pole_x = -3.4;
    let mut poles = Mesh::default();
    let mut wires = Mesh::default();
    for i in 0..9 {
        let z = -6.0 - span * f64::from(i);
        poles.tube(&[dvec3(pole_x, 0.0, z), dvec3(pole_x, 6.1, z)], [0.13, 0.09], 10);
        poles.cuboid(dvec3(pole_x - 1.15, 5.6, z - 0.05), dvec3(pole_x + 1.15, 5.7, z + 0.05));
        poles.cuboid(dvec3(pole_x - 0.85, 4.9, z - 0.05), dvec3(pole_x + 0.85, 5.0, z + 0.05));
        for (k, [x, y]) in insulators.into_iter().enumerate() {
            let start = dvec3(pole_x + x, y, z + span);
            let end = dvec3(pole_x + x, y, z);
            let sag = 0.45 + 0.05 * k as f64;
            let path: Vec<_> = (0..=12)
                .map(|step| {
                    let t = f64::from(step) / 12.0;
                    start.lerp(end, t) - DVec3::Y * sag * 4.0 * t * (1.0 - t)
                })
                .collect();
            wires.tube(&path, [0.009; 2], 4);
        }
    }
    add(file, &poles, wood);
    add(file, &wires, copper);
}

fn cottage(file: &mut Builder) {
    let wall = file.paint("wall", [233, 214, 184], 0.9);
    let tile = file.paint("roof", [176, 82, 62], 0.8);
    let glass = file.paint("window", [58, 78, 96], 0.3);
    let at = dvec3(7.0, 0.0, -26.0);
    let mut walls = Mesh::default();
    walls.cuboid(at, at + dvec3(7.0, 2.8, 5.0));
    let gable = [[0.0, 2.8], [7.0, 2.8], [3.5, 5.0]].map(|[x, y]| dvec2(at.x + x, y));
    walls.prism(&gable, at.z, at.z + 5.0);
    add(file, &walls, wall);
    let mut roof = Mesh::default();
    for side in [-1.0, 1.0] {
        let middle = at.x + 3.5;
        let eave = dvec2(middle + side * 4.1, 2.45);
        let ridge = dvec2(middle, 5.05);
        let thickness = dvec2(0.0, 0.18);
        let mut outline = [eave, eave + thickness, ridge + thickness, ridge];
        // On the left side the same corners are clockwise.
        if side < 0.0 {
            outline.reverse();
        }
        roof.prism(&outline, at.z - 0.4, at.z + 5.4);
    }
    add(file, &roof, tile);
    let mut windows = Mesh::default();
    for x in [1.0, 4.6] {
        let low = at + dvec3(x, 1.0, 5.0);
        windows.cuboid(low, low + dvec3(1.4, 1.2, 0.03));
    }
    add(file, &windows, glass);
    let mut bars = Mesh::default();
    for x in [1.0, 1.69, 2.37, 4.6, 5.29, 5.97] {
        let low = at + dvec3(x, 0.98, 5.03);
        bars.cuboid(low, low + dvec3(0.035, 1.24, 0.03));
    }
    for x in [1.0, 4.6] {
        for y in [1.0, 1.58, 2.17] {
            let low = at + dvec3(x, y, 5.03);
            bars.cuboid(low, low + dvec3(1.4, 0.035, 0.03));
        }
    }
    add(file, &bars, wall);
}
