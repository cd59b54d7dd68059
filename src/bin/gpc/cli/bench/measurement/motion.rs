//! Benchmark of motion: each frame's distance from its own reference, and the flicker of this error.

use super::accuracy::differences;
use glam::{DVec2, DVec3};
use gpc::camera::Camera;
use gpc::compare::CompareError;
use gpc::output::DecodedImage;
use gpc::sampling::owen_sobol;
use serde::Serialize;
use std::fmt;

/// Motion of the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// Pan of the image by fractions of a pixel, to the points of an Owen-scrambled Sobol set: every frame shows the
    /// same picture, sampled in other places.
    Pan,
    /// Turn of the camera about the vertical axis through its target, by 0.25 degrees a frame.
    Turn,
}

/// Number of frames of a motion; a power of two, for which a Sobol set is evenly spread.
const FRAMES: u32 = 16;

/// Degrees between two frames of a turn.
const TURN: f64 = 0.25;

/// Scrambling seed of a pan's places. Superpixels and references have other seeds, so that a pan does not coincide
/// with their samples.
const SEED: u32 = 3;

impl Motion {
    /// All motions.
    pub const ALL: [Self; 2] = [Self::Pan, Self::Turn];

    /// Cameras of the 16 frames for an image of `size` = [width, height]; `target` is the point that the camera looks
    /// at.
    pub fn cameras(self, camera: &Camera, target: DVec3, size: [u32; 2]) -> Vec<Camera> {
        match self {
            Self::Pan => {
                let size = DVec2::from(size.map(f64::from));
                let shifts = owen_sobol(FRAMES, SEED).into_iter();
                let pan = |pixels: [f32; 2]| Camera {
                    shift: camera.shift + DVec2::from(pixels.map(f64::from)) / size,
                    ..*camera
                };
                shifts.map(pan).collect()
            }
            Self::Turn => (0..FRAMES).map(|frame| camera.turned(target, f64::from(frame) * TURN)).collect(),
        }
    }
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Pan => "pan",
            Self::Turn => "turn",
        })
    }
}

/// Error and flicker of a sequence, in sRGB-encoded values of 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Steadiness {
    /// Mean over the frames of each frame's RMSE against its own reference.
    pub rmse: f64,
    /// Flicker: root mean square, over pixels and colours, of the error's standard deviation over time. An error that
    /// is the same in all frames does not count.
    pub flicker: f64,
}

/// Accumulated errors of a sequence of frames.
#[derive(Clone, Debug, Default)]
pub struct SequenceErrors {
    frames: u32,
    rmse: f64,
    /// Sum of the errors and sum of their squares, for each colour of each pixel.
    sums: Vec<[[f64; 2]; 3]>,
}

impl SequenceErrors {
    /// Adds a frame and its reference.
    ///
    /// # Errors
    /// [`CompareError::Size`] if their sizes differ, or are not those of the earlier frames.
    pub fn add(&mut self, truth: &DecodedImage, image: &DecodedImage) -> Result<(), CompareError> {
        let errors = differences(truth, image)?;
        if self.frames == 0 {
            self.sums = vec![[[0.0; 2]; 3]; errors.len()];
        }
        let mut squares = 0.0;
        for (sums, errors) in self.sums.iter_mut().zip(&errors) {
            for ([sum, square], error) in sums.iter_mut().zip(errors) {
                *sum += error;
                *square += error * error;
                squares += error * error;
            }
        }
        self.frames += 1;
        self.rmse += (squares / (3 * errors.len()) as f64).sqrt();
        Ok(())
    }

    /// Error and flicker of the frames so far; all zero without frames.
    pub fn steadiness(&self) -> Steadiness {
        if self.frames == 0 {
            return Steadiness::default();
        }
        let frames = f64::from(self.frames);
        let variance = |[sum, square]: &[f64; 2]| square / frames - (sum / frames).powi(2);
        let variances = self.sums.as_flattened().iter().map(variance);
        let mean = variances.sum::<f64>() / (3 * self.sums.len()) as f64;
        Steadiness {
            rmse: self.rmse / frames,
            // Rounding may make the variance negative.
            flicker: mean.max(0.0).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(values: [f32; 2]) -> DecodedImage {
        DecodedImage { size: [2, 1], pixels: values.map(|v| [v, v, v, 1.0]).to_vec() }
    }

    fn steadiness(frames: &[([f32; 2], [f32; 2])]) -> Steadiness {
        let mut sequence = SequenceErrors::default();
        for (truth, image) in frames {
            sequence.add(&frame(*truth), &frame(*image)).unwrap();
        }
        sequence.steadiness()
    }

    #[test]
    fn an_error_that_stays_does_not_flicker() {
        let found = steadiness(&[([0.0, 0.5], [0.25, 0.75]), ([0.5, 0.25], [0.75, 0.5])]);
        assert!((found.rmse - 0.25).abs() < 1e-9, "{found:?}");
        assert!(found.flicker < 1e-6, "{found:?}");
    }

    #[test]
    fn an_error_that_comes_and_goes_flickers() {
        // One pixel's error varies by a quarter around its mean; the other has no error.
        let found = steadiness(&[([0.5, 0.5], [0.75, 0.5]), ([0.5, 0.5], [0.25, 0.5])]);
        let expected = 0.25 / 2_f64.sqrt();
        assert!((found.flicker - expected).abs() < 1e-9, "{found:?}");
        assert!((found.rmse - expected).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn a_change_of_the_scene_is_no_flicker() {
        let found = steadiness(&[([0.0, 1.0], [0.0, 1.0]), ([1.0, 0.0], [1.0, 0.0])]);
        assert_eq!(found, Steadiness::default());
        assert_eq!(steadiness(&[]), Steadiness::default());
    }

    #[test]
    fn frames_have_one_size() {
        let mut sequence = SequenceErrors::default();
        sequence.add(&frame([0.0; 2]), &frame([0.0; 2])).unwrap();
        let other = DecodedImage { size: [1, 1], pixels: vec![[0.0; 4]] };
        assert!(sequence.add(&frame([0.0; 2]), &other).is_err());
    }

    #[test]
    fn a_pan_stays_within_a_pixel_and_a_turn_keeps_its_distance() {
        let eye = DVec3::new(0.0, 1.0, 5.0);
        let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, 50.0, 0.1).unwrap();
        let pans = Motion::Pan.cameras(&camera, DVec3::ZERO, [200, 100]);
        assert_eq!(pans.len(), 16);
        for (index, pan) in pans.iter().enumerate() {
            let moved = pan.shift * DVec2::new(200.0, 100.0);
            assert!(moved.abs().max_element() <= 0.5, "{moved}");
            assert!(pans[..index].iter().all(|other| other.shift != pan.shift));
        }
        let turns = Motion::Turn.cameras(&camera, DVec3::ZERO, [200, 100]);
        assert_eq!((turns.len(), turns[0]), (16, camera));
        for turn in &turns {
            assert!((turn.eye.length() - eye.length()).abs() < 1e-12);
            assert!((turn.direction() + turn.eye.normalize()).length() < 1e-12);
        }
    }
}
