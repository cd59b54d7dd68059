//! Images that a host lends.

use super::{HostError, Member, Options};
use crate::engine::sampler::ImageState;
use crate::vulkan::Recorder;
use ash::vk;

/// Image of a host: single-sampled, with one level, and at least as large as
/// [`Options::size`](super::Options::size).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LentImage {
    /// Handle of the image.
    pub image: vk::Image,
    /// Two-dimensional view of the image, with a single aspect and a single layer.
    pub view: vk::ImageView,
    /// All aspects of the image's format, including stencil, which the library does not read.
    pub aspects: vk::ImageAspectFlags,
    /// State of the image when the recording begins.
    pub before: ImageState,
    /// State of the image when the recording is done.
    pub after: ImageState,
}

/// Kinds of images with which a frame is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageKinds {
    /// Whether the host lends triangle IDs; otherwise the library draws IDs and depth itself.
    pub ids: bool,
    /// Whether the host lends depth; requires `ids`.
    pub depth: bool,
    /// Format of the views of the colour image.
    pub color_format: vk::Format,
    /// Whether the host's shaders write sRGB codes into a format of plain numbers. Otherwise the colour image holds
    /// linear light, or its format encodes the light.
    pub color_encoded: bool,
    /// Whether the colour image has the usage `TRANSFER_SRC` in the place of `SAMPLED`, as the images of some swapchains. The
    /// library then reads a copy of the frame's part, in an image of its own.
    pub color_copied: bool,
}

/// Images that the host has drawn with one sample a pixel. The result is drawn into `color`. The images are of the
/// [kinds](ImageKinds) for which the frame was prepared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Images {
    /// Image of triangle IDs, `R32_UINT`, created with `SAMPLED`: 1 + the index of the nearest triangle in the order of
    /// the frame's draws, 0 for no triangle. Without this image, the library draws IDs and depth itself.
    pub ids: Option<LentImage>,
    /// Image of the nearest triangle's depth, of any depth format, created with `SAMPLED`; its view has the depth
    /// aspect only.
    pub depth: Option<LentImage>,
    /// Colour image, created with `COLOR_ATTACHMENT` and with `SAMPLED`, or `TRANSFER_SRC` if it is
    /// [copied](ImageKinds::color_copied). Superpixels are drawn into it.
    pub color: LentImage,
    /// Upper left pixel of the frame's part of these images. The part has the size
    /// [`Options::size`](super::Options::size); the library neither reads nor writes pixels outside of it.
    pub corner: [u32; 2],
    /// Array layer of the images that the views show, of which the library changes the layout.
    pub layer: u32,
}

/// Colour formats that shaders can read as floats and that can be drawn to.
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
const ENCODING: [vk::Format; 3] =
    [vk::Format::R8G8B8A8_SRGB, vk::Format::B8G8R8A8_SRGB, vk::Format::A8B8G8R8_SRGB_PACK32];

/// Possible aspects of images, with their names; the last name covers all possibilities.
const COLOR: [(vk::ImageAspectFlags, &str); 1] = [(vk::ImageAspectFlags::COLOR, "COLOR")];
const DEPTH: [(vk::ImageAspectFlags, &str); 2] = [
    (vk::ImageAspectFlags::DEPTH, "DEPTH"),
    (
        vk::ImageAspectFlags::from_raw(vk::ImageAspectFlags::DEPTH.as_raw() | vk::ImageAspectFlags::STENCIL.as_raw()),
        "DEPTH, and STENCIL where its format has that too",
    ),
];

impl LentImage {
    /// Checks the image: its handles exist, its aspects are among `possible`, and its layouts keep the contents, before
    /// the recording if `is_read`, and afterwards.
    fn check(
        &self,
        image: Member,
        is_read: bool,
        possible: &[(vk::ImageAspectFlags, &'static str)],
    ) -> Result<(), HostError> {
        if self.image == vk::Image::null() {
            return Err(HostError::NullImage { image, handle: "image" });
        }
        if self.view == vk::ImageView::null() {
            return Err(HostError::NullImage { image, handle: "view" });
        }
        if !possible.iter().any(|(aspects, _)| *aspects == self.aspects) {
            return Err(HostError::Aspects {
                image,
                found: self.aspects,
                possible: possible.last().map_or("", |(_, names)| names),
            });
        }
        let layout = |when, found| Err(HostError::Layout { image, when, found });
        let undefined = vk::ImageLayout::UNDEFINED;
        match (self.before.layout, self.after.layout) {
            (found, _) if is_read && found == undefined => layout("before", found),
            (_, found) if found == undefined || found == vk::ImageLayout::PREINITIALIZED => layout("after", found),
            _ => Ok(()),
        }
    }

    fn record(&self, recorder: &Recorder<'_>, layer: u32, from: ImageState, to: ImageState) {
        from.change(recorder, self.image, self.aspects, layer, to);
    }
}

impl ImageKinds {
    /// State in which the library reads the colour image.
    pub(super) fn read_state(&self) -> ImageState {
        if self.color_copied { ImageState::COPIED } else { ImageState::READ }
    }

    pub(super) fn check(&self, options: &Options) -> Result<(), HostError> {
        match (self.ids, self.depth) {
            (true, false) if options.thin => return Err(HostError::NoDepth),
            (false, true) => return Err(HostError::NoIds),
            _ => {}
        }
        if !FORMATS.contains(&self.color_format) {
            return Err(HostError::Format(self.color_format));
        }
        if self.color_encoded && ENCODING.contains(&self.color_format) {
            return Err(HostError::Encoded(self.color_format));
        }
        Ok(())
    }
}

impl Images {
    /// Checks the images and the frame's part of them. `most` is the largest side of an image on the device.
    pub(super) fn check(&self, kinds: &ImageKinds, options: &Options, most: u32) -> Result<(), HostError> {
        let size = options.size;
        let end = [0, 1].map(|axis| u64::from(self.corner[axis]) + u64::from(size[axis]));
        if end.iter().any(|end| *end > u64::from(most)) {
            return Err(HostError::Part { end, most });
        }
        if let Some(ids) = &self.ids {
            ids.check(Member::Ids, true, &COLOR)?;
        }
        if let Some(depth) = &self.depth {
            depth.check(Member::Depth, true, &DEPTH)?;
        }
        for (image, kind, lent, expected) in [
            (Member::Ids, Member::KindIds, self.ids.is_some(), kinds.ids),
            (Member::Depth, Member::KindDepth, self.depth.is_some(), kinds.depth),
        ] {
            match (lent, expected) {
                (true, false) => return Err(HostError::UnexpectedImage { image, kind }),
                (false, true) => return Err(HostError::MissingImage { image, kind }),
                _ => {}
            }
        }
        self.color.check(Member::Color, !options.shade_all || options.keep_alpha, &COLOR)
    }

    fn read(&self) -> impl Iterator<Item = &LentImage> {
        self.ids.iter().chain(&self.depth)
    }

    /// Records the barriers that ready all images for reading, `color` as its kind says.
    pub(super) fn record_begin(&self, recorder: &Recorder<'_>, kinds: &ImageKinds) {
        for image in self.read() {
            image.record(recorder, self.layer, image.before, ImageState::READ);
        }
        self.color.record(recorder, self.layer, self.color.before, kinds.read_state());
    }

    /// Rectangle of the frame's part, `width` x `height` pixels large.
    pub(super) fn part(&self, [width, height]: [u32; 2]) -> vk::Rect2D {
        let [x, y] = self.corner.map(|corner| corner as i32);
        vk::Rect2D { offset: vk::Offset2D { x, y }, extent: vk::Extent2D { width, height } }
    }

    /// Records the barrier that readies the colour image for drawing.
    pub(super) fn record_draw(&self, recorder: &Recorder<'_>, kinds: &ImageKinds) {
        self.color.record(recorder, self.layer, kinds.read_state(), ImageState::DRAWN);
    }

    /// Records the barriers that change all images to their final states.
    pub(super) fn record_end(&self, recorder: &Recorder<'_>) {
        for image in self.read() {
            image.record(recorder, self.layer, ImageState::READ, image.after);
        }
        self.color.record(recorder, self.layer, ImageState::DRAWN, self.color.after);
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
            depth: Some(LentImage { aspects: vk::ImageAspectFlags::DEPTH, ..lent }),
            color: lent,
            corner: [0, 0],
            layer: 0,
        }
    }

    const KINDS: ImageKinds = ImageKinds {
        ids: true,
        depth: true,
        color_format: vk::Format::B8G8R8A8_UNORM,
        color_encoded: true,
        color_copied: false,
    };

    #[test]
    fn what_is_missing_or_does_not_fit_is_named() {
        let check = |images: &Images| images.check(&KINDS, &Options::new(64, 32), 1024);
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
        assert_eq!(ids, "Images::ids.image is VK_NULL_HANDLE");
        let view = refused(&|images| images.color.view = vk::ImageView::null());
        assert_eq!(view, "Images::color.view is VK_NULL_HANDLE");
        let depth = refused(&|images| images.depth = None);
        assert!(depth.starts_with("Images::depth is missing"));
        let alone = refused(&|images| images.ids = None);
        assert!(alone.starts_with("Images::ids is missing"));
        let bare = ImageKinds { ids: false, depth: false, ..KINDS };
        let more = images().check(&bare, &Options::new(64, 32), 1024);
        let more = more.unwrap_err().to_string();
        assert!(more.starts_with("Images::ids is lent"));
        let beyond = refused(&|images| images.corner = [961, 0]);
        assert!(beyond.starts_with("the frame's part of the images ends at 1025 x 32 pixels"));
        let lost = refused(&|images| images.color.after.layout = vk::ImageLayout::UNDEFINED);
        assert_eq!(
            lost,
            "Images::color.after.layout is VK_IMAGE_LAYOUT_UNDEFINED; it can be any that keeps what the image holds"
        );
        let empty = refused(&|images| images.color.before.layout = vk::ImageLayout::UNDEFINED);
        assert!(empty.starts_with("Images::color.before.layout is VK_IMAGE_LAYOUT_UNDEFINED"));
        let mut shaded = images();
        shaded.color.before.layout = vk::ImageLayout::UNDEFINED;
        let options = Options { shade_all: true, ..Options::new(64, 32) };
        assert!(shaded.check(&KINDS, &options, 1024).is_ok());
        assert!(shaded.check(&KINDS, &options.keep_alpha(true), 1024).is_err(), "there is no alpha to keep");
        let aspects = refused(&|images| images.color.aspects = vk::ImageAspectFlags::DEPTH);
        assert_eq!(aspects, "Images::color.aspects is 0x2; it can have COLOR");
        let none = refused(&|images| {
            let depth = images.depth.as_mut();
            depth.unwrap().aspects = vk::ImageAspectFlags::empty();
        });
        assert!(none.starts_with("Images::depth.aspects is 0x0"));
    }

    #[test]
    fn kinds_that_do_not_fit_are_named() {
        let refused = |kinds: ImageKinds| {
            let checked = kinds.check(&Options::new(64, 32));
            checked.unwrap_err().to_string()
        };
        assert!(KINDS.check(&Options::new(64, 32)).is_ok());
        let shallow = ImageKinds { depth: false, ..KINDS };
        assert!(refused(shallow).starts_with("thin triangles are found by depth"));
        let alone = ImageKinds { ids: false, ..KINDS };
        assert!(refused(alone).starts_with("ImageKinds::depth is true without ImageKinds::ids"));
        let of = |color_format| ImageKinds { color_format, ..KINDS };
        let integers = refused(of(vk::Format::R8G8B8A8_UINT));
        assert!(integers.starts_with("ImageKinds::color_format is VK_FORMAT_R8G8B8A8_UINT"));
        let twice = refused(of(vk::Format::B8G8R8A8_SRGB));
        assert!(twice.ends_with("set ImageKinds::color_encoded to false"));
    }
}
