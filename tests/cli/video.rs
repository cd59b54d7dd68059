//! Frames on standard output.

use crate::command::{Run, asset, files, gpc};
use std::path::Path;

const SIZE: [usize; 2] = [50, 27];

fn render(folder: &Path, options: &[&str]) -> Run {
    let scene = asset("letters.glb");
    let small = ["--size", "50x27", "--samples", "4"];
    gpc(folder, &[&["render", &scene], &small[..], options].concat()).ok()
}

/// The opaque frames of a turntable, as PNG files.
fn images(folder: &Path, background: &[&str]) -> Vec<image::RgbaImage> {
    let options = ["-o", "{frame}.png", "--turntable", "3"];
    render(folder, &[&options, background].concat());
    files(folder).iter().map(|name| image::open(folder.join(name)).unwrap().into_rgba8()).collect()
}

#[test]
fn raw_frames_are_the_images() {
    let folder = tempfile::tempdir().unwrap();
    let images = images(folder.path(), &[]);
    let options = ["-o", "-", "--turntable", "3", "--format", "raw"];
    let run = render(folder.path(), &options);
    let frames: Vec<_> = run.stdout.chunks(SIZE[0] * SIZE[1] * 4).collect();
    assert_eq!(frames.len(), 3);
    for (frame, image) in frames.iter().zip(images) {
        assert!(*frame == image.as_raw());
    }
}

/// Another program's decoder reads the frames; their colours are those of the images, except for the rounding of both.
#[test]
fn y4m_frames_are_the_images() {
    let folder = tempfile::tempdir().unwrap();
    let background = ["--background", "#336699"];
    let images = images(folder.path(), &background);
    let film = ["-o", "-", "--turntable", "3", "--format", "y4m", "--fps", "29.97"];
    let run = render(folder.path(), &[&film, &background[..]].concat());
    let header: &[u8] = b"YUV4MPEG2 W50 H27 F30000:1001 XCOLORRANGE=LIMITED C444\nFRAME\n";
    assert!(run.stdout.starts_with(header));
    let mut decoder = y4m::decode(&run.stdout[..]).unwrap();
    assert_eq!([decoder.get_width(), decoder.get_height()], SIZE);
    assert!(matches!(decoder.get_colorspace(), y4m::Colorspace::C444));
    for image in images {
        let frame = decoder.read_frame().unwrap();
        let planes = [frame.get_y_plane(), frame.get_u_plane(), frame.get_v_plane()];
        for (index, pixel) in image.pixels().enumerate() {
            let [y, cb, cr] = planes.map(|plane| f64::from(plane[index]));
            let luma = (y - 16.0) / 219.0;
            let red = luma + 1.5748 / 224.0 * (cr - 128.0);
            let blue = luma + 1.8556 / 224.0 * (cb - 128.0);
            let green = (luma - 0.2126 * red - 0.0722 * blue) / 0.7152;
            let [r, g, b, _] = pixel.0.map(|code| f64::from(code) / 255.0);
            for (found, expected) in [(red, r), (green, g), (blue, b)] {
                assert!((found - expected).abs() < 2.1 / 255.0, "{found} {expected}");
            }
        }
    }
    assert!(decoder.read_frame().is_err(), "three frames and no more");
}

#[test]
fn a_still_image_is_a_film_of_one_frame() {
    let folder = tempfile::tempdir().unwrap();
    let run = render(folder.path(), &["-o", "-", "--format", "y4m"]);
    let header = b"YUV4MPEG2 W50 H27 F24:1 XCOLORRANGE=LIMITED C444\n".len();
    assert_eq!(run.stdout.len(), header + 6 + 3 * SIZE[0] * SIZE[1]);
    assert!(files(folder.path()).is_empty());
}
