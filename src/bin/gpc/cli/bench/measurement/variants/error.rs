//! Errors of camera variants.

use gpc::camera::PinholeError;
use gpc::camera::panorama::PanoramaError;
use gpc::camera::set::SetError;
use gpc::camera::zoom::ZoomError;
use gpc::render::RenderError;

/// Error: a variant that a camera or a device can't have.
#[derive(Debug, thiserror::Error)]
pub enum VariantError {
    /// Camera that is no pinhole.
    #[error(transparent)]
    Pinhole(#[from] PinholeError),
    /// Locations that make no set.
    #[error(transparent)]
    Set(#[from] SetError),
    /// Image that can't be zoomed.
    #[error(transparent)]
    Zoom(#[from] ZoomError),
    /// Camera without a panorama.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
    /// Sampling that failed.
    #[error(transparent)]
    Render(#[from] RenderError),
}
