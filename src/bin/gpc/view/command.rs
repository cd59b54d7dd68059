//! The `gpc render` or `gpc zoom` command that makes the visible picture.

use super::look::Look;
use super::source::SceneSource;
use super::standpoint::Standpoint;
use glam::DVec3;
use gpc::camera::zoom::{Shape, Transition, ZoomRegion};
use gpc::names::name;
use gpc::render::{Footprint, Method, Settings, SuperpixelOptions};
use std::path::Path;

/// A picture to be made by a command.
pub struct Shot<'a> {
    pub source: &'a SceneSource,
    pub standpoint: &'a Standpoint,
    pub look: &'a Look,
    /// Options for the appearance of scenes, as words of a command line.
    pub appearance: &'a [String],
    /// Whether the scene's environment is the background.
    pub shows_environment: bool,
    /// Time of the animation in seconds.
    pub time: f64,
    /// Regions that are enlarged.
    pub lenses: &'a [ZoomRegion],
}

impl Shot<'_> {
    /// The command's arguments, `gpc` itself left out, to write a file.
    pub fn arguments(&self, output: &Path) -> Vec<String> {
        let mut arguments = Arguments(vec![
            if self.lenses.is_empty() { "render" } else { "zoom" }.to_owned(),
            self.source.path.display().to_string(),
        ]);
        let settings = self.look.at(self.look.samples(), None);
        arguments.add("-o", output.display());
        arguments.lenses(self.lenses);
        let [width, height] = settings.size;
        arguments.add("--size", format_args!("{width}x{height}"));
        arguments.settings(&settings);
        // `gpc zoom` has no environment as background.
        if self.shows_environment && self.lenses.is_empty() {
            arguments.0.push("--background=environment".to_owned());
        }
        arguments.0.extend_from_slice(self.appearance);
        arguments.view(self);
        arguments.0
    }
}

/// The arguments that make the picture of a photograph, `gpc` itself left out.
pub fn zoom_photo(photo: &Path, lenses: &[ZoomRegion], output: &Path) -> Vec<String> {
    let mut arguments = Arguments(vec!["zoom".to_owned(), photo.display().to_string()]);
    arguments.add("-o", output.display());
    arguments.lenses(lenses);
    arguments.0
}

/// The arguments that unzoom a region of an image, or all of it, `gpc` itself left out.
pub fn unzoom_photo(photo: &Path, region: Option<usize>, output: &Path) -> Vec<String> {
    let mut arguments = Arguments(vec!["unzoom".to_owned(), photo.display().to_string()]);
    arguments.add("-o", output.display());
    match region {
        Some(region) => arguments.add("--region", region),
        None => arguments.0.push("--whole".to_owned()),
    }
    arguments.0
}

struct Arguments(Vec<String>);

impl Arguments {
    fn add(&mut self, option: &str, value: impl std::fmt::Display) {
        self.0.extend([option.to_owned(), value.to_string()]);
    }

    /// Adds a vector with all its digits.
    fn add_vector(&mut self, option: &str, vector: DVec3) {
        let DVec3 { x, y, z } = vector;
        // With an equals sign, a negative first number is not taken for an option.
        self.0.push(format!("{option}={x},{y},{z}"));
    }

    fn lenses(&mut self, lenses: &[ZoomRegion]) {
        for lens in lenses {
            let [x, y] = lens.center;
            self.0.push(format!("--center={x},{y}"));
            let [rx, ry] = lens.radius;
            self.add("--radius", format_args!("{rx},{ry}"));
            self.add("--multiplicity", lens.multiplicity);
        }
        // If one lens differs from the default, all are given.
        if lenses.iter().any(|lens| lens.shape != Shape::default()) {
            for lens in lenses {
                self.add("--shape", name(&lens.shape));
            }
        }
        let is_smooth = |lens: &ZoomRegion| lens.transition == Transition::Smooth;
        if lenses.iter().any(is_smooth) {
            for lens in lenses {
                self.add("--transition", name(&lens.transition));
            }
        }
    }

    /// Adds the settings that differ from the command's defaults.
    fn settings(&mut self, settings: &Settings) {
        let default = Settings::new(settings.size[0], settings.size[1]);
        if settings.method.kind() != default.method.kind() {
            self.add("--aa", settings.method.kind());
        }
        if settings.method != Method::None {
            self.add("--samples", settings.method.samples());
        }
        if let Method::Superpixel(options) = &settings.method {
            self.superpixels(options);
        }
        if settings.scene.footprint == Footprint::Pixel {
            self.add("--footprint", "pixel");
        }
        if settings.scene.exposure != default.scene.exposure {
            self.0.push(format!("--exposure={}", settings.scene.exposure));
        }
        if settings.scene.line_width != default.scene.line_width {
            self.add("--line-width", settings.scene.line_width);
        }
        if settings.scene.point_size != default.scene.point_size {
            self.add("--point-size", settings.scene.point_size);
        }
    }

    /// Options of superpixels that differ from the command's defaults.
    fn superpixels(&mut self, options: &SuperpixelOptions) {
        let default = SuperpixelOptions::new(options.cells.samples);
        if let Some(contrast) = options.contrast {
            self.add("--contrast", contrast);
        }
        if options.detection != default.detection {
            self.add("--detect", name(&options.detection));
        }
        if options.cells.pattern != default.cells.pattern {
            self.add("--pattern", &options.cells.pattern);
        }
        if options.cells.shading != default.cells.shading {
            self.add("--shading", name(&options.cells.shading));
        }
    }

    /// Adds the options that select the scene, the time and the standpoint.
    fn view(&mut self, shot: &Shot<'_>) {
        let request = &shot.source.request;
        if let Some(scene) = request.scene {
            self.add("--scene", scene);
        }
        if let Some(variant) = &shot.source.variant {
            self.add("--variant", variant);
        }
        if let Some(animation) = &request.animation {
            self.add("--animation", animation);
        }
        if shot.time > 0.0 {
            self.add("--time", shot.time);
        }
        match shot.standpoint {
            Standpoint::Camera(index) => self.add("--camera", index),
            Standpoint::Free(turntable) => {
                let viewpoint = turntable.viewpoint();
                self.add_vector("--eye", viewpoint.eye);
                self.add_vector("--target", viewpoint.target);
                self.add("--fov", viewpoint.fov);
            }
        }
    }
}

/// A command line for a POSIX shell.
pub fn line(arguments: &[String]) -> String {
    let quoted = arguments.iter().map(|argument| quote(argument));
    std::iter::once("gpc".to_owned()).chain(quoted).collect::<Vec<_>>().join(" ")
}

/// A word, quoted where a POSIX shell needs it.
fn quote(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./,=:+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::super::navigate::Turntable;
    use super::*;
    use gpc::render::{Detection, Shading};
    use gpc::sampling::Pattern;

    fn source(path: &str) -> SceneSource {
        SceneSource::new(path.into())
    }

    fn look(settings: Settings) -> Look {
        Look::new(settings, SuperpixelOptions::new(64))
    }

    fn shot<'a>(source: &'a SceneSource, standpoint: &'a Standpoint, look: &'a Look) -> Shot<'a> {
        let (appearance, lenses) = (&[], &[]);
        Shot { source, standpoint, look, appearance, shows_environment: false, time: 0.0, lenses }
    }

    fn turntable() -> Turntable {
        Turntable { target: DVec3::new(-1.5, 0.1, 2.0), azimuth: 0.0, elevation: 0.0, distance: 1.0, fov: 40.0 }
    }

    #[test]
    fn defaults_are_left_out() {
        let look = look(Settings::new(640, 480));
        let source = source("a b.glb");
        let shot = shot(&source, &Standpoint::Camera(2), &look);
        let found = line(&shot.arguments(Path::new("a.png")));
        let expected = "gpc render 'a b.glb' -o a.png --size 640x480 --samples 64 --camera 2";
        assert_eq!(found, expected);
    }

    #[test]
    fn everything_else_is_said() {
        let settings = Settings::new(64, 48).exposure(-0.5).line_width(2.5).background(Some([0.0; 3])).method(
            SuperpixelOptions::new(1024)
                .contrast(Some(5))
                .pattern(Pattern::Lattice)
                .detection(Detection::Edges)
                .shading(Shading::Sample),
        );
        let look = look(settings);
        let mut source = source("a.glb");
        source.request.animation = Some("run".to_owned());
        let appearance = ["--background", "#000000"].map(str::to_owned);
        let standpoint = Standpoint::Free(turntable());
        let shot = Shot { appearance: &appearance, time: 0.25, ..shot(&source, &standpoint, &look) };
        let found = line(&shot.arguments(Path::new("a.png")));
        let expected = "gpc render a.glb -o a.png --size 64x48 --samples 1024 --contrast 5 --detect edges \
             --pattern lattice --shading sample --exposure=-0.5 --line-width 2.5 --background '#000000' --animation run --time 0.25 \
             --eye=-1.5,0.1,3 --target=-1.5,0.1,2 --fov 40";
        assert_eq!(found, expected);
    }

    #[test]
    fn a_lens_is_a_zoom() {
        let look = look(Settings::new(64, 48));
        let lens = ZoomRegion {
            center: [20.0, 30.0],
            radius: [9.0, 9.0],
            multiplicity: 0.25,
            shape: Shape::Rectangle,
            transition: Transition::Smooth,
        };
        let source = source("a.glb");
        let shot = Shot { lenses: &[lens], ..shot(&source, &Standpoint::Camera(0), &look) };
        let found = line(&shot.arguments(Path::new("a.png")));
        let expected = "gpc zoom a.glb -o a.png --center=20,30 --radius 9,9 --multiplicity 0.25 --shape rectangle \
             --transition smooth --size 64x48 --samples 64 --camera 0";
        assert_eq!(found, expected);
    }

    #[test]
    fn photographs_have_lenses_and_are_unzoomed() {
        let lens = |x: f64, transition: Transition| ZoomRegion {
            center: [x, 30.0],
            radius: [9.0, 9.0],
            multiplicity: 0.25,
            shape: Shape::Circle,
            transition,
        };
        let lenses = [lens(-1.0, Transition::Linear), lens(5.0, Transition::Smooth)];
        let (photo, output) = (Path::new("a.jpg"), Path::new("b.png"));
        assert_eq!(
            line(&zoom_photo(photo, &lenses, output)),
            "gpc zoom a.jpg -o b.png --center=-1,30 --radius 9,9 --multiplicity 0.25 \
             --center=5,30 --radius 9,9 --multiplicity 0.25 --transition linear --transition smooth"
        );
        let unzoom = |region| line(&unzoom_photo(photo, region, output));
        assert_eq!(unzoom(Some(1)), "gpc unzoom a.jpg -o b.png --region 1");
        assert_eq!(unzoom(None), "gpc unzoom a.jpg -o b.png --whole");
    }

    #[test]
    fn quotes_are_quoted() {
        assert_eq!(quote("it's"), r"'it'\''s'");
        assert_eq!(quote(""), "''");
    }
}
