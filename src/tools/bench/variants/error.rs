//! Why a variant can't be measured.

use crate::camera::PinholeError;
use crate::camera::panorama::PanoramaError;
use crate::camera::set::SetError;
use crate::camera::zoom::ZoomError;
use crate::render::RenderError;

/// A variant that a camera or a device can't have.
#[derive(Debug, thiserror::Error)]
pub enum VariantError {
    /// The camera is no pinhole.
    #[error(transparent)]
    Pinhole(#[from] PinholeError),
    /// The locations make no set.
    #[error(transparent)]
    Set(#[from] SetError),
    /// The image has no middle to zoom.
    #[error(transparent)]
    Zoom(#[from] ZoomError),
    /// There is no panorama.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
    /// Sampling failed.
    #[error(transparent)]
    Render(#[from] RenderError),
}
