//! Images that a host lends.

use super::HostError;
use crate::engine::sampler::ImageState;
use crate::vulkan::Recorder;
use ash::vk;

/// An image that is read: single-sampled, one level, one layer, of the size in [`Options`](super::Options) or larger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LentImage {
    /// The image.
    pub image: vk::Image,
    /// A two-dimensional view of it, of one aspect.
    pub view: vk::ImageView,
    /// The aspects of the image; of a format with stencil, that too, although it is not read.
    pub aspects: vk::ImageAspectFlags,
    /// Its state when the recording begins.
    pub before: ImageState,
    /// Its state when the recording is done.
    pub after: ImageState,
}

/// The image that superpixels are drawn into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColorImage {
    /// The image, made with `SAMPLED` and `COLOR_ATTACHMENT`.
    pub lent: LentImage,
    /// The view's format.
    pub format: vk::Format,
    /// Whether the host's shaders write sRGB codes into a format of plain numbers; otherwise the image holds linear light,
    /// or encodes it itself.
    pub encoded: bool,
}

/// What the host has drawn, one sample a pixel, and where its picture goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Images {
    /// Triangle IDs, `R32_UINT`, made with `SAMPLED`: 1 + the index of the nearest triangle in the order of the frame's
    /// draws, 0 where there is none. Without them, the library draws IDs and depth for itself.
    pub ids: Option<LentImage>,
    /// Depth of the nearest triangle, of any depth format, made with `SAMPLED`; the view shows depth alone.
    pub depth: Option<LentImage>,
    /// Colours.
    pub color: ColorImage,
    /// Upper left corner of the part of these images that the frame is of, in pixels. The part has the size in
    /// [`Options`](super::Options); the library neither reads nor writes what lies around it.
    pub corner: [u32; 2],
}

/// Formats of colour that shaders read as floats and draw.
const FORMATS: [vk::Format; 12] = [
    vk::Format::R8G8B8A8_UNORM,
    vk::Format::R8G8B8A8_SRGB,
    vk::Format::B8G8R8A8_UNORM,
    vk::Format::B8G8R8A8_SRGB,
    vk::Format::A8B8G8R8_UNORM_PACK32,
    vk::Format::A8B8G8R8_SRGB_PACK32,
    vk::Format::A2B10G10R10_UNORM_PACK32,
    vk::Format::A2R10G10B10_UNORM_PACK32,
    vk::Format::B10G11R11_UFLOAT_PACK32,
    vk::Format::R16G16B16A16_UNORM,
    vk::Format::R16G16B16A16_SFLOAT,
    vk::Format::R32G32B32A32_SFLOAT,
];
const ENCODING: [vk::Format; 3] = [
    vk::Format::R8G8B8A8_SRGB,
    vk::Format::B8G8R8A8_SRGB,
    vk::Format::A8B8G8R8_SRGB_PACK32,
];

impl LentImage {
    fn check(&self, image: &'static str, view: &'static str) -> Result<(), HostError> {
        match (self.image, self.view) {
            (raw, _) if raw == vk::Image::null() => Err(HostError::NullHandle(image)),
            (_, raw) if raw == vk::ImageView::null() => Err(HostError::NullHandle(view)),
            _ => Ok(()),
        }
    }

    fn record(&self, recorder: &Recorder<'_>, from: ImageState, to: ImageState) {
        from.change(recorder, self.image, self.aspects, to);
    }
}

impl Images {
    /// `most` is the largest side of an image on the device.
    pub(super) fn check(&self, thin: bool, size: [u32; 2], most: u32) -> Result<(), HostError> {
        let end = [0, 1].map(|axis| u64::from(self.corner[axis]) + u64::from(size[axis]));
        if end.iter().any(|end| *end > u64::from(most)) {
            return Err(HostError::Part { end, most });
        }
        if let Some(ids) = &self.ids {
            ids.check("the image of IDs", "the view of IDs")?;
        }
        if let Some(depth) = &self.depth {
            depth.check("the image of depth", "the view of depth")?;
        }
        match (&self.ids, &self.depth) {
            (Some(_), None) if thin => return Err(HostError::NoDepth),
            (None, Some(_)) => return Err(HostError::NoIds),
            _ => {}
        }
        let ColorImage {
            lent,
            format,
            encoded,
        } = &self.color;
        lent.check("the image of colours", "the view of colours")?;
        if !FORMATS.contains(format) {
            return Err(HostError::Format(*format));
        }
        if *encoded && ENCODING.contains(format) {
            return Err(HostError::Encoded(*format));
        }
        Ok(())
    }

    fn read(&self) -> impl Iterator<Item = &LentImage> {
        self.ids.iter().chain(&self.depth)
    }

    /// Readies all of them for reading.
    pub(super) fn record_begin(&self, recorder: &Recorder<'_>) {
        for image in self.read().chain([&self.color.lent]) {
            image.record(recorder, image.before, ImageState::READ);
        }
    }

    /// The part that the frame is of, `width` x `height` pixels large.
    pub(super) fn part(&self, [width, height]: [u32; 2]) -> vk::Rect2D {
        let [x, y] = self.corner.map(|corner| corner as i32);
        vk::Rect2D {
            offset: vk::Offset2D { x, y },
            extent: vk::Extent2D { width, height },
        }
    }

    /// Readies the colours for drawing.
    pub(super) fn record_draw(&self, recorder: &Recorder<'_>) {
        let color = &self.color.lent;
        color.record(recorder, ImageState::READ, ImageState::DRAWN);
    }

    /// Hands all of them back.
    pub(super) fn record_end(&self, recorder: &Recorder<'_>) {
        for image in self.read() {
            image.record(recorder, ImageState::READ, image.after);
        }
        let color = &self.color.lent;
        color.record(recorder, ImageState::DRAWN, color.after);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ash::vk::Handle;

    fn images() -> Images {
        let state = ImageState::READ;
        let lent = LentImage {
            image: vk::Image::from_raw(1),
            view: vk::ImageView::from_raw(2),
            aspects: vk::ImageAspectFlags::COLOR,
            before: state,
            after: state,
        };
        Images {
            ids: Some(lent),
            depth: Some(lent),
            color: ColorImage {
                lent,
                format: vk::Format::B8G8R8A8_UNORM,
                encoded: true,
            },
            corner: [0, 0],
        }
    }

    #[test]
    fn what_is_missing_or_does_not_fit_is_named() {
        let check = |images: &Images| images.check(true, [64, 32], 1024);
        assert!(check(&images()).is_ok());
        let refused = |spoil: &dyn Fn(&mut Images)| {
            let mut images = images();
            spoil(&mut images);
            check(&images).unwrap_err().to_string()
        };
        let ids = refused(&|images| {
            let ids = images.ids.as_mut();
            ids.unwrap().image = vk::Image::null();
        });
        assert_eq!(ids, "the image of IDs is VK_NULL_HANDLE");
        let view = refused(&|images| images.color.lent.view = vk::ImageView::null());
        assert_eq!(view, "the view of colours is VK_NULL_HANDLE");
        let depth = refused(&|images| images.depth = None);
        assert!(depth.starts_with("thin triangles are found by depth"));
        let alone = refused(&|images| images.ids = None);
        assert!(alone.starts_with("depth is lent without IDs"));
        let beyond = refused(&|images| images.corner = [961, 0]);
        assert!(beyond.starts_with("the frame's part of the images ends at 1025 x 32 pixels"));
        let integers = refused(&|images| images.color.format = vk::Format::R8G8B8A8_UINT);
        assert!(integers.starts_with("a colour image of format R8G8B8A8_UINT"));
        let twice = refused(&|images| images.color.format = vk::Format::B8G8R8A8_SRGB);
        assert!(twice.ends_with("it can't be encoded as well"));
    }
}
