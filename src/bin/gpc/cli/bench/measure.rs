//! Measurement of one scene: the cost of every method, and its distance from the reference.

use super::gallery::{Gallery, GalleryImage};
use super::measurement::{Accuracy, Yardstick};
use super::results::{Row, SceneResults};
use super::split::Splitter;
use super::subject::{self, Bench, Subject};
use gpc::output::{DecodedImage, Picture};
use gpc::render::{CellOptions, EngineError, Footprint, MethodKind, RenderError};
use std::path::Path;

impl Bench<'_> {
    /// Measures the scene of a file.
    pub fn measure(&mut self, path: &Path) -> anyhow::Result<SceneResults> {
        let name = subject::name(path);
        self.progress.begin(&name);
        let subject = self.upload(path, self.args.size)?;
        let settings = self.settings(MethodKind::None, 1);
        let wanted = subject.wanted(&settings, self.args.reference, "its truth");
        let (truth, reference_seconds) = self.reference(&wanted)?;
        let (_, one_sample) = self.warm_up(&subject, &settings.clone().attributes(true))?;
        let triangles = one_sample.statistics.triangles.total;
        let seeing = one_sample.attributes.iter().filter(|pixel| pixel.id != 0);
        let surface_fraction = seeing.count() as f64 / one_sample.attributes.len() as f64;
        let one_sample = Picture::new(settings.size, &one_sample.colors)?;
        let truth = Picture::new(settings.size, &truth)?;
        let yardstick = Yardstick::new(&truth, &one_sample)?;
        let geometry = self.geometry_yardstick(&subject, &one_sample)?;
        let shown = self.shown_samples();
        let splitter = match shown {
            Some(shown) => Some(Splitter::new(self, &subject, shown)?),
            None => None,
        };

        let mut notes = SkippedSamples::default();
        let (mut contenders, mut rows) = (Vec::new(), Vec::new());
        let mut ssaa = None;
        let mut superpixels = None;
        for (method, samples) in self.args.cells() {
            self.progress.say(&format!("{method} {samples}, warming up"));
            let (contender, rendered) = match self.warm_up(&subject, &self.settings(method, samples)) {
                Err(RenderError::Engine(EngineError::Samples { possible, .. })) => {
                    notes.leave_out(method, samples, possible);
                    continue;
                }
                done => done?,
            };
            let picture = Picture::new(rendered.size, &rendered.colors)?;
            let pieces = match &splitter {
                Some(splitter) => {
                    self.progress.say(&format!("{method} {samples}, whose fault its errors are"));
                    Some(splitter.split(self, &yardstick, &picture, method, samples)?)
                }
                None => None,
            };
            let statistics = &rendered.statistics;
            rows.push(Row {
                method,
                samples,
                cost: contender.cost(),
                memory_bytes: statistics.memory_bytes,
                superpixel_fraction: statistics.superpixels as f64 / rendered.colors.len() as f64,
                candidates: statistics.candidates,
                accuracy: yardstick.measure(&picture)?,
                geometry: match &geometry {
                    Some(geometry) => Some(self.geometry(&subject, geometry, method, samples)?),
                    None => None,
                },
                left: pieces.as_ref().map(|pieces| pieces.split),
                left_within: pieces.as_ref().and_then(|pieces| pieces.within),
            });
            contenders.push(contender);
            if (method, Some(samples)) == (MethodKind::Ssaa, shown) {
                ssaa = Some(DecodedImage::from(&picture));
            }
            if let Some(pieces) = pieces
                && (method, Some(samples)) == (MethodKind::Superpixel, shown)
            {
                superpixels = Some(GalleryImage { samples, image: DecodedImage::from(&picture), pieces });
            }
        }
        self.take_turns(&mut contenders, |progress, index| {
            if let Some(Row { method, samples, .. }) = rows.get(index) {
                progress.say(&format!("{method} {samples}"));
            }
        })?;
        for (row, contender) in rows.iter_mut().zip(&contenders) {
            row.cost = contender.cost();
        }
        Ok(SceneResults {
            name,
            file: path.display().to_string(),
            triangles,
            textured: subject.is_textured(),
            surface_fraction,
            reference_seconds,
            notes: notes.lines(),
            rows,
            gallery: Gallery::new(&yardstick, ssaa.as_ref(), superpixels.as_ref())?,
        })
    }

    /// Samples of the superpixels that the report shows: the default number, or otherwise the largest that is
    /// measured.
    fn shown_samples(&self) -> Option<u32> {
        let cells = self.args.cells();
        let counts = cells.iter().filter(|(method, _)| *method == MethodKind::Superpixel).map(|(_, samples)| *samples);
        counts.max_by_key(|samples| (*samples == CellOptions::DEFAULT_SAMPLES, *samples))
    }

    /// Yardstick of geometry alone, if it is asked for. `one_sample` serves both yardsticks, because one sample a
    /// pixel is the same image with either footprint.
    fn geometry_yardstick(&mut self, subject: &Subject, one_sample: &Picture<'_>) -> anyhow::Result<Option<Yardstick>> {
        if !self.args.geometry {
            return Ok(None);
        }
        let settings = self.settings(MethodKind::None, 1).footprint(Footprint::Pixel);
        let name = "its reference for geometry alone";
        let (reference, _) = self.reference(&subject.wanted(&settings, self.args.reference, name))?;
        let reference = Picture::new(settings.size, &reference)?;
        Ok(Some(Yardstick::new(&reference, one_sample)?))
    }

    /// Accuracy of a method with textures read over a whole pixel.
    fn geometry(
        &mut self,
        subject: &Subject,
        yardstick: &Yardstick,
        method: MethodKind,
        samples: u32,
    ) -> anyhow::Result<Accuracy> {
        let settings = self.settings(method, samples).footprint(Footprint::Pixel);
        let (_, rendered) = self.warm_up(subject, &settings)?;
        Ok(yardstick.measure(&Picture::new(rendered.size, &rendered.colors)?)?)
    }
}

/// Notes on numbers of samples that were left out: a line for each method and reason.
#[derive(Default)]
struct SkippedSamples(Vec<(MethodKind, String, Vec<u32>)>);

impl SkippedSamples {
    fn leave_out(&mut self, method: MethodKind, samples: u32, possible: String) {
        match self.0.iter_mut().find(|(known, reason, _)| *known == method && *reason == possible) {
            Some((_, _, counts)) => counts.push(samples),
            None => self.0.push((method, possible, vec![samples])),
        }
    }

    fn lines(&self) -> Vec<String> {
        let line = |(method, possible, counts): &(MethodKind, String, Vec<u32>)| {
            let counts: Vec<_> = counts.iter().map(ToString::to_string).collect();
            format!("{method} left out at {} samples: it can have {possible}", counts.join(", "))
        };
        self.0.iter().map(line).collect()
    }
}
