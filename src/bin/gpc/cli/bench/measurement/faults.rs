//! Faults: whether edges, texture or light cause an error.

use super::accuracy::squares;
use super::{Cause, PixelTriangles, Yardstick};
use gpc::compare::CompareError;
use gpc::output::{DecodedImage, Picture};
use gpc::render::{Detection, Headless, PreparedScene, Settings, Shading};
use serde::Serialize;

/// Part of rendering that causes an error in a superpixel or in a pixel of one triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Edges: the superpixel holds several triangles, and at least half of its squared error remains when every sample
    /// is shaded. Number, places and weights of the samples are to blame.
    Edges,
    /// Texture: the scene's paint alone has at least as large an error in the pixel as its light alone. Texture
    /// filtering and the number of texture reads are to blame.
    Texture,
    /// Light: the scene's light alone has the larger error. Highlights, normals and roughness are to blame.
    Light,
}

/// Squared error of superpixel antialiasing by fault. Each part is a share of the squared error of one sample a pixel,
/// of sRGB-encoded colours. The first three add up to [`super::Split::superpixels`], the last two to
/// [`super::Split::inside`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Within {
    /// Share in superpixels by edges, including the number of samples.
    pub superpixel_edges: f64,
    /// Share in superpixels by texture.
    pub superpixel_texture: f64,
    /// Share in superpixels by light.
    pub superpixel_light: f64,
    /// Share in pixels of one triangle by texture.
    pub inside_texture: f64,
    /// Share in pixels of one triangle by light.
    pub inside_light: f64,
}

/// Squared errors of a stripped scene, one for each pixel.
struct Errors {
    /// Errors if every pixel is a superpixel.
    superpixels: Vec<f64>,
    /// Errors if no pixel is a superpixel.
    inside: Vec<f64>,
}

impl PixelTriangles<'_> {
    /// Fault of each pixel's error, rows from the top; `None` for causes other than superpixels and one triangle.
    /// `picture` is the whole scene under superpixel antialiasing with `settings`, and `causes` holds the causes of
    /// its errors. `halves` are the scene's paint alone and its light alone, each with its reference as a display shows it.
    ///
    /// The whole scene is rendered with every sample of its superpixels shaded, and each stripped scene twice: with
    /// superpixels everywhere and nowhere. Stripped scenes can't use the whole scene's superpixels, because they
    /// contrast in other places.
    ///
    /// # Errors
    /// As [`Headless::render`]; [`CompareError::Size`] if an image does not have the reference's size.
    pub fn faults(
        &self,
        headless: &mut Headless,
        halves: &[(PreparedScene, DecodedImage); 2],
        settings: &Settings,
        yardstick: &Yardstick,
        picture: &Picture<'_>,
        causes: &[Cause],
    ) -> anyhow::Result<Vec<Option<Fault>>> {
        let mut render = |scene: &PreparedScene, settings: &Settings| {
            let mut frame = headless.prepare(scene, settings)?;
            let rendered = headless.render(&mut frame, &self.camera)?;
            let picture = Picture::new(rendered.size, &rendered.colors)?;
            anyhow::Ok(DecodedImage::from(&picture))
        };
        let every_sample = settings.clone().map_superpixels(|options| options.shading(Shading::Sample));
        let everywhere = settings.clone().map_superpixels(|options| options.detection(Detection::Every));
        // No two 8-bit codes differ by more than this threshold.
        let nowhere = settings
            .clone()
            .map_superpixels(|options| options.contrast(Some(u8::MAX)).detection(Detection::Contrast).thin(false));
        let image = squares(yardstick.reference(), &DecodedImage::from(picture))?;
        let sampled = squares(yardstick.reference(), &render(self.scene, &every_sample)?)?;
        let mut errors = |(scene, truth): &(PreparedScene, DecodedImage)| {
            anyhow::Ok(Errors {
                superpixels: squares(truth, &render(scene, &everywhere)?)?,
                inside: squares(truth, &render(scene, &nowhere)?)?,
            })
        };
        let [paint, light] = [errors(&halves[0])?, errors(&halves[1])?];
        let at = |errors: &[f64], pixel: usize| errors.get(pixel).copied().unwrap_or_default();
        let fault = |(pixel, cause): (usize, &Cause)| {
            let [paint, light] = [&paint, &light].map(|errors| match cause {
                Cause::Superpixel => at(&errors.superpixels, pixel),
                _ => at(&errors.inside, pixel),
            });
            fault(*cause, self.holds_several(pixel), at(&sampled, pixel) / at(&image, pixel), [paint, light])
        };
        Ok(causes.iter().enumerate().map(fault).collect())
    }
}

/// Fault of a pixel's error. `stays` is the share of the error that remains when every sample is shaded.
fn fault(cause: Cause, several: bool, stays: f64, [paint, light]: [f64; 2]) -> Option<Fault> {
    match cause {
        Cause::BelowThreshold | Cause::Unseen => None,
        Cause::Superpixel if several && stays >= 0.5 => Some(Fault::Edges),
        Cause::Superpixel | Cause::Inside if paint >= light => Some(Fault::Texture),
        Cause::Superpixel | Cause::Inside => Some(Fault::Light),
    }
}

impl Yardstick {
    /// Splits an image's error in superpixels and in pixels of one triangle by fault; all parts are zero if one sample
    /// a pixel has no error.
    ///
    /// # Errors
    /// [`CompareError::Size`] if the image does not have the reference's size.
    pub fn split_within(
        &self,
        picture: &Picture<'_>,
        causes: &[Cause],
        faults: &[Option<Fault>],
    ) -> Result<Within, CompareError> {
        let mut within = Within::default();
        for ((share, cause), fault) in self.shares(picture)?.iter().zip(causes).zip(faults) {
            let part = match (cause, fault) {
                (_, None) | (Cause::BelowThreshold | Cause::Unseen, _) => continue,
                (Cause::Superpixel, Some(Fault::Edges)) => &mut within.superpixel_edges,
                (Cause::Superpixel, Some(Fault::Texture)) => &mut within.superpixel_texture,
                (Cause::Superpixel, Some(Fault::Light)) => &mut within.superpixel_light,
                (Cause::Inside, Some(Fault::Light)) => &mut within.inside_light,
                (Cause::Inside, Some(Fault::Texture | Fault::Edges)) => &mut within.inside_texture,
            };
            *part += share;
        }
        Ok(within)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_is_told_by_what_errs_alone() {
        use Cause::{BelowThreshold, Inside, Superpixel, Unseen};
        let cases = [
            (Superpixel, true, 0.6, [3.0, 1.0], Some(Fault::Edges)),
            (Superpixel, true, 0.4, [3.0, 1.0], Some(Fault::Texture)),
            (Superpixel, true, 0.4, [1.0, 3.0], Some(Fault::Light)),
            // A pixel of one triangle has no edges to blame.
            (Superpixel, false, 0.9, [1.0, 3.0], Some(Fault::Light)),
            (Inside, false, 0.9, [1.0, 3.0], Some(Fault::Light)),
            (Inside, false, 0.9, [3.0, 1.0], Some(Fault::Texture)),
            (BelowThreshold, true, 0.9, [3.0, 1.0], None),
            (Unseen, true, 0.9, [3.0, 1.0], None),
        ];
        for (cause, several, stays, halves, expected) in cases {
            assert_eq!(fault(cause, several, stays, halves), expected, "{cause:?} {several} {stays} {halves:?}");
        }
    }

    #[test]
    fn shares_add_up_to_those_of_their_causes() {
        let pixels = |codes: [f32; 6]| codes.map(|v| [v, v, v, 1.0]);
        let reference = pixels([0.5; 6]);
        let one = pixels([0.4; 6]);
        let image = pixels([0.45, 0.47, 0.48, 0.44, 0.46, 0.41]);
        let picture = |pixels| Picture::new([6, 1], pixels).unwrap();
        let yardstick = Yardstick::new(&picture(&reference), &picture(&one)).unwrap();
        let (superpixel, inside) = (Cause::Superpixel, Cause::Inside);
        let causes = [superpixel, superpixel, superpixel, inside, inside, Cause::Unseen];
        let faults = [
            Some(Fault::Edges),
            Some(Fault::Texture),
            Some(Fault::Light),
            Some(Fault::Texture),
            Some(Fault::Light),
            None,
        ];
        let image = picture(&image);
        let split = yardstick.split(&image, &causes).unwrap();
        let within = yardstick.split_within(&image, &causes, &faults).unwrap();
        let superpixels = within.superpixel_edges + within.superpixel_texture + within.superpixel_light;
        let amid = within.inside_texture + within.inside_light;
        assert!((superpixels - split.superpixels).abs() < 1e-9, "{within:?}");
        assert!((amid - split.inside).abs() < 1e-9, "{within:?}");
        assert!(within.superpixel_edges > within.superpixel_texture, "{within:?}");
        assert!(within.inside_texture > within.inside_light, "{within:?}");
    }
}
