//! One scene, measured.

use super::BenchArgs;
use super::gallery::Gallery;
use super::progress::Progress;
use super::results::{Row, SceneResults};
use crate::cli::input;
use crate::cli::render::{Antialiasing, CameraArgs, choose_views};
use gpc::bench::{self, Accuracy, Cache, Cause, Contender, Fingerprint, Looks, Yardstick};
use gpc::camera::Camera;
use gpc::output::{DecodedImage, Picture};
use gpc::reference::srgb;
use gpc::render::{Footprint, Headless, PreparedScene, RenderError, Rendered, Settings};
use gpc::scene::{Geometry, PoseRequest, Scene};
use std::path::Path;
use std::time::Instant;

/// sRGB values of the background: opaque, so that colours tell everything.
const BACKGROUND: [f64; 3] = [0.87, 0.89, 0.91];

/// What measures scene after scene.
pub struct Bench<'a> {
    pub headless: Headless,
    pub cache: Cache,
    pub args: &'a BenchArgs,
    pub progress: Progress,
}

/// A scene on the device.
pub(super) struct Subject {
    pub prepared: PreparedScene,
    geometry: Geometry,
    pub camera: Camera,
    textured: bool,
}

/// A method that takes part, with what is known of it before it is timed.
struct Entry {
    contender: Contender,
    row: Row,
}

impl Bench<'_> {
    /// Measures the scene of a file.
    pub fn measure(&mut self, path: &Path) -> anyhow::Result<(SceneResults, Gallery)> {
        let name = name(path);
        self.progress.begin(&name);
        let subject = self.upload(path)?;
        let settings = self.settings(Antialiasing::None, 1);
        let (reference, reference_seconds) = self.reference(&subject, &settings)?;
        let (_, one_sample) = self.warm_up(&subject, &settings)?;
        let triangles = one_sample.statistics.triangles.total;
        let one_sample = Picture::new(settings.size, &one_sample.colors)?;
        let reference = Picture::new(settings.size, &reference)?;
        let yardstick = Yardstick::new(&reference, &one_sample)?;
        let geometry = self.geometry_yardstick(&subject, &one_sample)?;
        let looks = self.looks(&subject)?;

        let shown = self.shown_samples();
        let mut notes = Notes::default();
        let mut entries = Vec::new();
        let mut superpixels = None;
        for (method, samples) in self.args.cells() {
            self.progress
                .say(&format!("{method} {samples}, warming up"));
            let (contender, rendered) =
                match self.warm_up(&subject, &self.settings(method, samples)) {
                    Err(RenderError::Samples { possible, .. }) => {
                        notes.leave_out(method, samples, possible);
                        continue;
                    }
                    done => done?,
                };
            let picture = Picture::new(rendered.size, &rendered.colors)?;
            if (method, Some(samples)) == (Antialiasing::Superpixel, shown) {
                superpixels = Some((samples, DecodedImage::from(&picture)));
            }
            let statistics = &rendered.statistics;
            entries.push(Entry {
                row: Row {
                    method,
                    samples,
                    cost: contender.cost(),
                    memory_bytes: statistics.memory_bytes,
                    superpixel_fraction: statistics.superpixels as f64
                        / rendered.colors.len() as f64,
                    candidates: statistics.candidates,
                    accuracy: yardstick.measure(&picture)?,
                    geometry: match &geometry {
                        Some(geometry) => Some(self.geometry(&subject, geometry, method, samples)?),
                        None => None,
                    },
                    left: match &looks {
                        Some(looks) => {
                            let causes = self.causes(&subject, looks, method, samples)?;
                            Some(yardstick.split(&picture, &causes)?)
                        }
                        None => None,
                    },
                },
                contender,
            });
        }
        let scene = SceneResults {
            name,
            file: path.display().to_string(),
            triangles,
            textured: subject.textured,
            reference_seconds,
            notes: notes.lines(),
            rows: self.time(&subject, entries)?,
        };
        let gallery = Gallery::new(&yardstick, superpixels.as_ref())?;
        Ok((scene, gallery))
    }

    /// Puts the scene of a file on the device.
    pub(super) fn upload(&mut self, path: &Path) -> anyhow::Result<Subject> {
        let loaded = input::load(path)?;
        let pose = loaded.scene.pose(&PoseRequest::default())?;
        let [width, height] = self.args.size.map(f64::from);
        let views = choose_views(&CameraArgs::default(), &pose, width / height)?;
        let Some(view) = views.first() else {
            anyhow::bail!("{}: there is no camera to see it with", path.display());
        };
        Ok(Subject {
            prepared: self.headless.upload(&loaded.scene, &pose, None)?,
            textured: shows_textures(&loaded.scene, &pose.geometry),
            geometry: pose.geometry,
            camera: view.camera,
        })
    }

    fn settings(&self, method: Antialiasing, samples: u32) -> Settings {
        settings(method, samples, self.args.size)
    }

    /// Samples of the superpixels that the report shows: the default number, or else the most there are.
    fn shown_samples(&self) -> Option<u32> {
        let cells = self.args.cells();
        let counts = cells
            .iter()
            .filter(|(method, _)| *method == Antialiasing::Superpixel)
            .map(|(_, samples)| *samples);
        counts.max_by_key(|samples| (*samples == Settings::DEFAULT_SAMPLES, *samples))
    }

    /// What geometry alone is measured against, if that is wanted. One sample a pixel is the same image either way.
    fn geometry_yardstick(
        &mut self,
        subject: &Subject,
        one_sample: &Picture<'_>,
    ) -> anyhow::Result<Option<Yardstick>> {
        if !self.args.geometry {
            return Ok(None);
        }
        let settings = for_whole_pixels(self.settings(Antialiasing::None, 1));
        let (reference, _) = self.reference(subject, &settings)?;
        let reference = Picture::new(settings.size, &reference)?;
        Ok(Some(Yardstick::new(&reference, one_sample)?))
    }

    /// How exact a method is by geometry alone.
    fn geometry(
        &mut self,
        subject: &Subject,
        yardstick: &Yardstick,
        method: Antialiasing,
        samples: u32,
    ) -> anyhow::Result<Accuracy> {
        let settings = for_whole_pixels(self.settings(method, samples));
        let (_, rendered) = self.warm_up(subject, &settings)?;
        Ok(yardstick.measure(&Picture::new(rendered.size, &rendered.colors)?)?)
    }

    /// Looks into pixels, if superpixels are measured.
    fn looks(&mut self, subject: &Subject) -> anyhow::Result<Option<Looks>> {
        if self.shown_samples().is_none() {
            return Ok(None);
        }
        let settings = self.settings(Antialiasing::None, 1);
        let progress = &self.progress;
        let mut looks = 0;
        Ok(Some(Looks::new(
            &mut self.headless,
            &subject.prepared,
            &subject.camera,
            &settings,
            || {
                looks += 1;
                progress.say(&format!("what pixels hold, {looks} of {}", bench::LOOKS));
            },
        )?))
    }

    /// Why pixels err under a method; those without superpixels are split by the superpixels that the report shows.
    fn causes(
        &mut self,
        subject: &Subject,
        looks: &Looks,
        method: Antialiasing,
        samples: u32,
    ) -> Result<Vec<Cause>, RenderError> {
        let samples = match (method, self.shown_samples()) {
            (Antialiasing::Superpixel, _) | (_, None) => samples,
            (_, Some(shown)) => shown,
        };
        let settings = self.settings(Antialiasing::Superpixel, samples);
        looks.causes(
            &mut self.headless,
            &subject.prepared,
            &subject.camera,
            &settings,
        )
    }

    /// The reference, and how many seconds it took unless it was there already.
    fn reference(
        &mut self,
        subject: &Subject,
        settings: &Settings,
    ) -> anyhow::Result<(Vec<[f32; 4]>, Option<f64>)> {
        let samples = self.args.reference;
        self.progress.say("looking for its reference");
        let fingerprint = Fingerprint::new(
            &mut self.headless,
            &subject.prepared,
            &subject.geometry,
            &subject.camera,
            settings,
            samples,
        )?;
        if let Some(known) = self.cache.get(fingerprint, settings.size) {
            return Ok((known, None));
        }
        let start = Instant::now();
        let parts = samples / bench::GRID_SAMPLES;
        let mut done = 0;
        let progress = &self.progress;
        let mut count = || {
            progress.say(&format!("reference, {done} of {parts} renderings"));
            done += 1;
        };
        count();
        let reference = bench::brute_force(
            &mut self.headless,
            &subject.prepared,
            &subject.camera,
            settings,
            samples,
            count,
        )?;
        let seconds = start.elapsed().as_secs_f64();
        let picture = Picture::new(settings.size, &reference)?;
        self.cache.put(fingerprint, &picture)?;
        Ok((reference, Some(seconds)))
    }

    fn warm_up(
        &mut self,
        subject: &Subject,
        settings: &Settings,
    ) -> Result<(Contender, Rendered), RenderError> {
        Contender::warm_up(
            &mut self.headless,
            &subject.prepared,
            &subject.camera,
            settings,
        )
    }

    fn time(
        &mut self,
        subject: &Subject,
        mut entries: Vec<Entry>,
    ) -> Result<Vec<Row>, RenderError> {
        let progress = &self.progress;
        bench::take_turns(
            &mut self.headless,
            &subject.prepared,
            &subject.camera,
            entries.iter_mut().map(|entry| &mut entry.contender),
            self.args.repeat,
            self.args.budget(),
            |contender| {
                let settings = contender.settings();
                progress.say(&format!("{:?} {}", settings.method, settings.samples));
            },
        )?;
        Ok(entries
            .into_iter()
            .map(|Entry { contender, row }| Row {
                cost: contender.cost(),
                ..row
            })
            .collect())
    }
}

/// Whether a material of something drawn has a texture.
fn shows_textures(scene: &Scene, geometry: &Geometry) -> bool {
    geometry
        .draws
        .iter()
        .filter_map(|draw| scene.materials.get(draw.material as usize))
        .any(|material| material.textures().next().is_some())
}

impl Subject {
    pub fn triangles(&self) -> u64 {
        self.geometry.triangles.len() as u64
    }
}

/// What a method is rendered with.
pub fn settings(method: Antialiasing, samples: u32, [width, height]: [u32; 2]) -> Settings {
    Settings {
        method: method.method(),
        samples,
        contrast: Settings::default_contrast(samples),
        background: Some(BACKGROUND.map(|value| srgb::decode(value) as f32)),
        ..Settings::new(width, height)
    }
}

/// The same with textures read for a whole pixel, whatever the number of samples.
fn for_whole_pixels(settings: Settings) -> Settings {
    Settings {
        footprint: Footprint::Pixel,
        ..settings
    }
}

/// What is left out: a line for each method and reason.
#[derive(Default)]
struct Notes(Vec<(Antialiasing, String, Vec<u32>)>);

impl Notes {
    fn leave_out(&mut self, method: Antialiasing, samples: u32, possible: String) {
        match self
            .0
            .iter_mut()
            .find(|(known, reason, _)| *known == method && *reason == possible)
        {
            Some((_, _, counts)) => counts.push(samples),
            None => self.0.push((method, possible, vec![samples])),
        }
    }

    fn lines(&self) -> Vec<String> {
        let line = |(method, possible, counts): &(Antialiasing, String, Vec<u32>)| {
            let counts: Vec<_> = counts.iter().map(ToString::to_string).collect();
            format!(
                "{method} left out at {} samples: it can have {possible}",
                counts.join(", ")
            )
        };
        self.0.iter().map(line).collect()
    }
}

/// A file's name without its ending, or its folder's where files of all scenes are called `scene`, as Sketchfab's are.
pub(super) fn name(path: &Path) -> String {
    let stem = input::stem(path);
    let folder = || Some(path.parent()?.file_name()?.to_string_lossy().into_owned());
    if stem == "scene" {
        folder().unwrap_or(stem)
    } else {
        stem
    }
}
