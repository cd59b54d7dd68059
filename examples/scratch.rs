use gpc::camera::{Camera, Orbit, Pinhole, Site};
use gpc::render::{Detection, Headless, HeadlessOptions, Method, Settings};
use gpc::scene::{PoseRequest, Scene};
use std::time::Instant;
fn save(path: &str, size: [u32; 2], colors: &[[f32; 4]]) {
    let enc = |v: f32| gpc::reference::srgb::encode_u8(f64::from(v));
    let mut img = image::RgbaImage::new(size[0], size[1]);
    for (p, c) in img.pixels_mut().zip(colors) {
        *p = image::Rgba([enc(c[0]), enc(c[1]), enc(c[2]), (c[3] * 255.0) as u8]);
    }
    img.save(path).unwrap();
}
fn show(name: &str, s: &gpc::render::Statistics, wall: f64, n: usize) {
    let p: Vec<String> = s
        .passes
        .iter()
        .map(|p| format!("{} {:.1}", p.pass, p.ms))
        .collect();
    println!(
        "{name}: wall {:.1} ms, gpu {:.1} ms, {:.1} / {:.1} ns a sample; regions {} rounds {} cells {} records {} unlisted {}: {}",
        wall * 1e3,
        s.gpu_ms(),
        wall * 1e9 / n as f64,
        s.gpu_ms() * 1e6 / n as f64,
        s.regions,
        s.rounds,
        s.superpixels,
        s.records,
        s.unlisted_tiles,
        p.join(", ")
    );
}
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let scene = Scene::load(args[1].as_ref()).unwrap().scene;
    let pose = scene.pose(&PoseRequest::default()).unwrap();
    let size = [1280u32, 784];
    let aspect = size[0] as f64 / size[1] as f64;
    let (low, high) = pose.geometry.bounds().unwrap();
    let camera = match pose.cameras.first() {
        Some(c) => Camera::from_scene(c),
        None => Orbit::default().frame(low, high, aspect).unwrap(),
    };
    let mut gpu = Headless::new(&HeadlessOptions {
        device: None,
        validation: std::env::var("GPC_VALIDATION").is_ok(),
    })
    .unwrap();
    let prepared = gpu.upload(&scene, &pose, None).unwrap();
    let pinhole = Pinhole::from_camera(&camera, size).unwrap();
    let settings = Settings {
        method: Method::None,
        attributes: true,
        background: Some([0.1, 0.1, 0.2]),
        samples: 64,
        ..Settings::new(size[0], size[1])
    };
    let n = (size[0] * size[1]) as usize;
    let mut frame = gpu.prepare(&prepared, &settings).unwrap();
    let mut raster = gpu.render(&prepared, &mut frame, &camera).unwrap();
    for _ in 0..3 {
        let t = Instant::now();
        raster = gpu.render(&prepared, &mut frame, &camera).unwrap();
        show("raster", &raster.statistics, t.elapsed().as_secs_f64(), n);
    }
    save("/tmp/raster.png", size, &raster.colors);
    let planar: Vec<Site> = (0..n as u32)
        .map(|i| Site {
            uv: [f64::from(i % size[0]) + 0.5, f64::from(i / size[0]) + 0.5],
            jacobian: [[1.0, 0.0], [0.0, 1.0]],
            output: i,
        })
        .collect();
    let mut state = 1u64;
    let mut next = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 40) as f64 / (1u64 << 24) as f64
    };
    let random: Vec<Site> = (0..n as u32)
        .map(|i| Site {
            uv: [next() * f64::from(size[0]), next() * f64::from(size[1])],
            ..planar[i as usize]
        })
        .collect();
    for (name, sites) in [("planar", &planar), ("random", &random)] {
        for _ in 0..3 {
            let t = Instant::now();
            let r = gpu
                .sample_points(&prepared, &pinhole, sites, &settings)
                .unwrap();
            show(name, &r.statistics, t.elapsed().as_secs_f64(), n);
            if name == "planar" {
                let colors: Vec<[f32; 4]> = r.values.iter().map(|v| v.color).collect();
                save("/tmp/points.png", size, &colors);
                let ids = r
                    .values
                    .iter()
                    .zip(&raster.attributes)
                    .filter(|(a, b)| a.id != b.id)
                    .count();
                let far = r
                    .values
                    .iter()
                    .zip(&raster.colors)
                    .filter(|(a, b)| (0..4).any(|c| (a.color[c] - b[c]).abs() > 1e-3))
                    .count();
                println!("ids differ {ids}, colours {far}");
            }
        }
    }
    let part = &planar[..n / 8];
    let every = Settings {
        method: Method::Superpixel,
        detection: Detection::Every,
        attributes: false,
        ..settings.clone()
    };
    let mut frame = gpu.prepare(&prepared, &every).unwrap();
    let full = gpu.render(&prepared, &mut frame, &camera).unwrap();
    for _ in 0..2 {
        let t = Instant::now();
        let r = gpu
            .sample_superpixels(&prepared, &pinhole, part, &every)
            .unwrap();
        show(
            "superpixels",
            &r.statistics,
            t.elapsed().as_secs_f64(),
            n / 8 * 64,
        );
        let differ = r
            .values
            .iter()
            .zip(&full.colors)
            .filter(|(a, b)| a != b)
            .count();
        println!("colours differ {differ}");
    }
    let t = Instant::now();
    let r = gpu
        .sample_superpixels(&prepared, &pinhole, &planar, &every)
        .unwrap();
    show(
        "superpixels all",
        &r.statistics,
        t.elapsed().as_secs_f64(),
        n * 64,
    );
    save("/tmp/super.png", size, &r.values);
    let differ = r
        .values
        .iter()
        .zip(&full.colors)
        .filter(|(a, b)| a != b)
        .count();
    println!("colours differ {differ}");
    println!("{:?}", gpu.validation_messages());
}
