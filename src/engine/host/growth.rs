//! Growth of the memory of frames and lists whose last recording was not finished.

use super::HostError;
use super::sampling::Sampling;
use crate::engine::sampler::{Capacity, EngineError};
use crate::vulkan::VulkanError;

/// Growth of a frame or list in its recordings.
#[derive(Default)]
pub(super) struct Growth {
    /// Capacity for which the device had no memory. It is not tried again, because a failed allocation takes long.
    refused: Option<Capacity>,
}

impl Growth {
    /// What `make` makes with more of what the last recording lacked. `None` if it lacked nothing, if its commands are not done,
    /// or if more would not help or can't be had.
    ///
    /// # Errors
    /// If the device is lost, or counters can't be read; if anything but a lack of memory prevents `make`.
    pub fn larger<T>(
        &mut self,
        sampling: &Sampling,
        make: impl FnOnce(Capacity) -> Result<T, HostError>,
    ) -> Result<Option<T>, HostError> {
        let more = match sampling.shortfall() {
            Ok(shortfall) => sampling.job.capacity().next(&shortfall),
            Err(HostError::Engine(EngineError::Vulkan(VulkanError::NotDone | VulkanError::NotRecorded))) => None,
            Err(error) => return Err(error),
        };
        match more.filter(|more| self.refused != Some(*more)) {
            Some(more) => self.made(more, make(more)),
            None => Ok(None),
        }
    }

    /// What was `made` with a capacity; `None` if there is no memory for it.
    fn made<T>(&mut self, capacity: Capacity, made: Result<T, HostError>) -> Result<Option<T>, HostError> {
        match made {
            Ok(made) => Ok(Some(made)),
            Err(error) if is_refusal(&error) => {
                log::warn!("the memory of an unfinished recording stays as it is: {error}");
                self.refused = Some(capacity);
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }
}

/// Whether an error says that there is no more memory, or that a buffer can't be larger.
fn is_refusal(error: &HostError) -> bool {
    matches!(
        error,
        HostError::Engine(
            EngineError::Memory { .. }
                | EngineError::Vulkan(VulkanError::OutOfMemory { .. } | VulkanError::TooLarge { .. })
        )
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame goes on with the memory that it has if there is no more, and does not ask for the same again.
    #[test]
    fn a_refusal_is_remembered() {
        let mut growth = Growth::default();
        let more = Capacity::default().with_lists(4);
        let refused = |error: VulkanError| Err::<(), _>(HostError::from(error));
        let full = VulkanError::OutOfMemory { what: "candidates".to_owned(), bytes: 1 << 40 };
        assert!(matches!(growth.made(more, refused(full)), Ok(None)));
        assert_eq!(growth.refused, Some(more));
        assert!(growth.made(more, refused(VulkanError::DeviceLost)).is_err());
        assert!(matches!(growth.made(more, Ok(7)), Ok(Some(7))));
    }
}
