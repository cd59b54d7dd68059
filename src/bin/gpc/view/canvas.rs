//! Canvas of the window: pictures of the scene, and the panel over them.

use super::compose::Piece;
use super::engine::Engine;
use super::layer::{Layer, Sight};
use super::look::Look;
use super::painter::{Painter, Painting};
use super::picture::{self, DESTINATION, LAYERS, Picture, SOURCE, UNUSED};
use super::preparer::{Prepared, Preparer};
use super::presenter::Presenter;
use super::slot::{SLOTS, Slot};
use super::source::LoadedScene;
use super::swapchain::{Acquired, Swapchain, Turn};
use anyhow::bail;
use ash::vk;
use gpc::camera::Camera;
use gpc::render::ImageState;
use gpc::scene::Moment;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

/// State of the window's image while the panel is drawn.
const DRAWN: ImageState = ImageState {
    layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
    stage: vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT,
    access: vk::AccessFlags2::from_raw(
        vk::AccessFlags2::COLOR_ATTACHMENT_READ.as_raw() | vk::AccessFlags2::COLOR_ATTACHMENT_WRITE.as_raw(),
    ),
};

/// State of the window's image after the last command, before it is presented.
const PRESENTED: ImageState = ImageState {
    layout: vk::ImageLayout::PRESENT_SRC_KHR,
    stage: vk::PipelineStageFlags2::NONE,
    access: vk::AccessFlags2::NONE,
};

/// Pictures of the scene, the panel, and the swapchain that shows them.
///
/// Fields are dropped in their order: users of the device come before the device.
pub struct Canvas {
    slots: [Slot; SLOTS],
    /// Index of the slot to record into next.
    turn: usize,
    /// The picture of the scene, or both pictures of a split view, left first.
    layers: Vec<Layer>,
    /// Pictures of the stage before, shown until the layers have rendered something.
    before: Vec<Picture>,
    /// Picture that is shown instead of all others.
    cover: Option<Picture>,
    /// Whether pictures get more samples at rest.
    pub refines: bool,
    stage: Option<Arc<LoadedScene>>,
    painter: Painter,
    preparer: Preparer,
    presenter: Presenter,
    /// Whether the swapchain has to be made anew.
    is_stale: bool,
    /// The window's images; `None` while the window has no pixels.
    swapchain: Option<Swapchain>,
    pub engine: Arc<Engine>,
}

/// Contents of the next image of the window.
pub struct ShownPicture<'a> {
    pub camera: Option<&'a Camera>,
    pub moment: Option<&'a Arc<Moment>>,
    pub pieces: &'a [Piece],
    /// Pieces of pictures that are enlarged over the others.
    pub magnified: &'a [Piece],
}

impl Canvas {
    /// Makes the canvas of a window of `size` = [width, height]. The caller passes the frames that the preparer
    /// delivers to [`Self::prepared`].
    pub fn new(engine: Arc<Engine>, size: [u32; 2], preparer: Preparer) -> anyhow::Result<Self> {
        let device = &engine.device;
        let swapchain = Swapchain::new(device, size, None)?;
        Ok(Self {
            slots: [Slot::new(device)?, Slot::new(device)?],
            turn: 0,
            layers: Vec::new(),
            before: Vec::new(),
            cover: None,
            refines: true,
            stage: None,
            painter: Painter::new(device, swapchain.format)?,
            preparer,
            presenter: Presenter::new(device),
            is_stale: false,
            swapchain: Some(swapchain),
            engine,
        })
    }

    /// Width and height in pixels; `None` while the window has none.
    pub fn size(&self) -> Option<[u32; 2]> {
        let extent = self.swapchain.as_ref()?.extent;
        Some([extent.width, extent.height])
    }

    /// Makes the swapchain anew for a window of `size` = [width, height].
    pub fn resize(&mut self, size: [u32; 2]) -> anyhow::Result<()> {
        self.wait()?;
        self.is_stale = false;
        let older = self.swapchain.take();
        if size.contains(&0) {
            return Ok(());
        }
        let format = older.as_ref().map(|older| older.format);
        let swapchain = Swapchain::new(&self.engine.device, size, older)?;
        if format.is_some_and(|format| format != swapchain.format) {
            bail!("the window changed the format of its images");
        }
        self.swapchain = Some(swapchain);
        Ok(())
    }

    /// Scene that is shown.
    pub fn stage(&self) -> Option<&Arc<LoadedScene>> {
        self.stage.as_ref()
    }

    /// Shows another scene, or none.
    pub fn set_stage(&mut self, stage: Option<Arc<LoadedScene>>) {
        let seen = self.take_pictures();
        let before = std::mem::replace(&mut self.before, seen);
        self.keep(before);
        // Frames keep the scene before on the device while commands use it.
        self.stage = stage;
    }

    /// The pictures.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Replaces the looks of the pictures. The old pictures stay visible until the new ones have rendered something.
    pub fn set_looks(&mut self, looks: &[Look], now: Instant) -> anyhow::Result<()> {
        let layer = |look: &Look| Layer::new(&self.engine, look.clone(), now);
        let layers = looks.iter().map(layer).collect::<anyhow::Result<_>>()?;
        let mut before = std::mem::take(&mut self.before);
        before.extend(self.take_pictures());
        self.layers = layers;
        let mut before = before.into_iter();
        for (layer, picture) in self.layers.iter_mut().zip(before.by_ref()) {
            layer.set_before(picture);
        }
        self.keep(before.collect());
        Ok(())
    }

    /// Removes the layers, and returns the pictures that are visible.
    fn take_pictures(&mut self) -> Vec<Picture> {
        let layers = std::mem::take(&mut self.layers);
        let (seen, others): (_, Vec<_>) = layers.into_iter().map(Layer::into_pictures).unzip();
        self.keep(others.into_iter().flatten().collect());
        seen
    }

    /// Keeps replaced pictures until no commands use them.
    fn keep(&mut self, kept: Vec<Picture>) {
        let kept = Rc::new(kept);
        for slot in self.slots.iter_mut().filter(|slot| slot.is_busy()) {
            slot.kept.push(kept.clone());
        }
    }

    /// Takes a frame that the preparer has delivered.
    pub fn prepared(&mut self, prepared: Prepared) -> anyhow::Result<()> {
        let is_meant = |layer: &&mut Layer| layer.is_meant(&prepared.ticket);
        match self.layers.iter_mut().find(is_meant) {
            Some(layer) => Ok(layer.prepared(&prepared.settings, prepared.frame)?),
            None => Ok(()),
        }
    }

    /// Sets the picture that is shown instead of all others, or removes it.
    pub fn set_cover(&mut self, cover: Option<Picture>) {
        if let Some(before) = std::mem::replace(&mut self.cover, cover) {
            self.keep(vec![before]);
        }
    }

    /// Restarts all pictures because the view or the scene has changed.
    pub fn restart(&mut self, now: Instant) {
        for layer in &mut self.layers {
            layer.restart(now);
        }
    }

    /// Finishes the work that the device has done. Returns whether that included work on pictures.
    ///
    /// # Errors
    /// If the device is lost, or a picture can't be finished.
    pub fn collect(&mut self) -> anyhow::Result<bool> {
        let mut any = false;
        let mut outcome = Ok(());
        if let Some(shown) = self.presenter.poll() {
            self.is_stale |= shown?;
        }
        for index in 0..SLOTS {
            if self.slots[index].poll()? {
                any |= !self.slots[index].jobs.is_empty();
                // An error of one picture does not keep the other slots from being finished.
                outcome = outcome.and(self.finish(index));
            }
        }
        outcome.map(|()| any)
    }

    /// Whether the device is still at work.
    pub fn is_busy(&self) -> bool {
        self.presenter.is_busy() || self.slots.iter().any(Slot::is_busy)
    }

    /// Time at which the next work on a picture is due, if there is any.
    pub fn due(&self) -> Option<Instant> {
        self.stage.as_ref()?;
        let is_wanted = self.wanted();
        self.layers.iter().filter(|layer| is_wanted(layer)).filter_map(Layer::due).min()
    }

    /// Tells whether the next work on a picture is wanted. Nothing begins under a cover.
    fn wanted(&self) -> impl Fn(&Layer) -> bool + use<> {
        let (is_covered, refines) = (self.cover.is_some(), self.refines);
        move |layer| !is_covered && (refines || layer.schedule.is_draft())
    }

    /// Whether work has to be repeated in a frame with more room.
    pub fn has_again(&self) -> bool {
        self.layers.iter().any(Layer::has_again)
    }

    /// Whether every picture has all its samples, as far as it is seen.
    pub fn rests(&self) -> bool {
        let is_wanted = self.wanted();
        let is_done = |layer: &Layer| {
            let is_finished = !is_wanted(layer) || layer.schedule.is_done();
            is_finished && !layer.has_again() && !layer.is_waiting()
        };
        !self.layers.is_empty() && self.layers.iter().all(is_done) && self.slots.iter().all(|slot| slot.jobs.is_empty())
    }

    /// An image of the window to draw into; `None` if none is free now.
    pub fn acquire(&mut self) -> anyhow::Result<Option<Acquired>> {
        let slot = &self.slots[self.turn];
        let is_busy = slot.is_busy() || self.presenter.is_busy();
        let Some(swapchain) = self.swapchain.as_ref().filter(|_| !is_busy) else {
            return Ok(None);
        };
        let turn = if self.is_stale { Turn::Stale } else { swapchain.acquire(slot.free)? };
        match turn {
            Turn::Ready(acquired) => Ok(Some(acquired)),
            Turn::Busy => Ok(None),
            Turn::Stale => {
                let size = [swapchain.extent.width, swapchain.extent.height];
                self.resize(size)?;
                Ok(None)
            }
        }
    }

    /// Renders the work that is due, draws an image of the window and presents it.
    ///
    /// # Errors
    /// If memory runs out, settings are impossible or the device is lost. If only the pictures fail, the image is
    /// presented without them.
    pub fn draw(
        &mut self,
        acquired: Acquired,
        seen: &ShownPicture<'_>,
        painting: Painting,
        now: Instant,
    ) -> anyhow::Result<()> {
        self.painter.upload(&painting)?;
        let commands = self.slots[self.turn].begin()?;
        // SAFETY: the commands are being recorded, and the slot keeps the objects that they use until they have run.
        let (rendered, painted) = unsafe {
            let rendered = self.record_work(commands, seen, now);
            self.record_pieces(commands, &acquired, seen);
            let device = &self.engine.device;
            picture::change(device, commands, acquired.image, DESTINATION, DRAWN);
            let extent = self.swapchain.as_ref().map_or_else(Default::default, |s| s.extent);
            let painted = self.painter.record(commands, (acquired.view, extent), &painting);
            let device = &self.engine.device;
            picture::change(device, commands, acquired.image, DRAWN, PRESENTED);
            (rendered, painted)
        };
        let slot = &mut self.slots[self.turn];
        slot.textures = painting.textures.free;
        slot.submit(acquired.drawn)?;
        self.turn = (self.turn + 1) % SLOTS;
        self.presenter.show(acquired);
        rendered.and(painted)
    }

    /// # Safety
    /// `commands` is being recorded in the slot whose turn it is.
    unsafe fn record_work(
        &mut self,
        commands: vk::CommandBuffer,
        seen: &ShownPicture<'_>,
        now: Instant,
    ) -> anyhow::Result<()> {
        if let Some(cover) = &mut self.cover {
            // SAFETY: guaranteed by the caller; a cover that is replaced is kept until its commands have run.
            unsafe { cover.record_pixels(commands) };
        }
        let (Some(stage), Some(camera)) = (&self.stage, seen.camera) else {
            return Ok(());
        };
        let is_wanted = self.wanted();
        let slot = &mut self.slots[self.turn];
        let sight = Sight { scene: &stage.prepared, camera, moment: seen.moment };
        for layer in &mut self.layers {
            let is_begun = layer.has_again() || layer.is_waiting();
            if !is_wanted(layer) && !is_begun {
                continue;
            }
            let makers = (&self.engine, &self.preparer);
            // SAFETY: guaranteed by the caller; the slot keeps the job.
            let job = unsafe { layer.record(makers, commands, &sight, now) }?;
            slot.jobs.extend(job);
        }
        Ok(())
    }

    /// Copies the pictures to the window's image, which is then in [`DESTINATION`].
    ///
    /// # Safety
    /// As for [`Self::record_work`].
    unsafe fn record_pieces(&self, commands: vk::CommandBuffer, acquired: &Acquired, seen: &ShownPicture<'_>) {
        let device = &self.engine.device;
        let black = vk::ClearColorValue { float32: [0.0, 0.0, 0.0, 1.0] };
        // SAFETY: guaranteed by the caller.
        unsafe {
            picture::change(device, commands, acquired.image, UNUSED, DESTINATION);
            // The clear colour fills areas without a picture: before the first picture, or around a picture of a
            // smaller window.
            device.handle.cmd_clear_color_image(
                commands,
                acquired.image,
                DESTINATION.layout,
                &black,
                &[picture::COLOR],
            );
            for pieces in [seen.pieces, seen.magnified] {
                // Magnified pieces overwrite what was copied before, so that they need a barrier.
                picture::change(device, commands, acquired.image, DESTINATION, DESTINATION);
                for piece in pieces {
                    self.record_piece(commands, acquired.image, piece);
                }
            }
        }
    }

    /// # Safety
    /// As for [`Self::record_work`]; the window's image is in [`DESTINATION`].
    unsafe fn record_piece(&self, commands: vk::CommandBuffer, image: vk::Image, piece: &Piece) {
        let layer = self.layers.get(piece.layer).map(Layer::picture);
        let Some(picture) = self.cover.as_ref().or(layer) else {
            return;
        };
        let Some(piece) = piece.within(picture.size()).filter(|_| picture.is_written()) else {
            return;
        };
        let offsets = |rect: &super::compose::Rect| {
            let corner = |add: [u32; 2]| vk::Offset3D {
                x: (rect.corner[0] + add[0]) as i32,
                y: (rect.corner[1] + add[1]) as i32,
                z: i32::from(add[0] > 0),
            };
            [corner([0, 0]), corner(rect.size)]
        };
        let blit = [vk::ImageBlit::default()
            .src_subresource(LAYERS)
            .src_offsets(offsets(&piece.from))
            .dst_subresource(LAYERS)
            .dst_offsets(offsets(&piece.to))];
        // SAFETY: guaranteed by the caller; both rectangles lie in their images.
        unsafe {
            self.engine.device.handle.cmd_blit_image(
                commands,
                picture.image(),
                SOURCE.layout,
                image,
                DESTINATION.layout,
                &blit,
                vk::Filter::NEAREST,
            );
        }
    }

    /// Finishes a slot whose commands have run, and takes back the objects that they used.
    fn finish(&mut self, index: usize) -> anyhow::Result<()> {
        let slot = &mut self.slots[index];
        let textures = std::mem::take(&mut slot.textures);
        let jobs = std::mem::take(&mut slot.jobs);
        slot.kept.clear();
        self.painter.free(&textures)?;
        let mut outcome = Ok(());
        for job in jobs {
            let is_meant = |layer: &&mut Layer| layer.is_meant(&job.ticket);
            if let Some(layer) = self.layers.iter_mut().find(is_meant) {
                outcome = outcome.and(layer.finish(&self.engine, job));
            }
        }
        Ok(outcome?)
    }

    /// Waits until the device is idle.
    fn wait(&mut self) -> anyhow::Result<()> {
        self.engine.device.wait();
        if let Some(shown) = self.presenter.wait() {
            self.is_stale |= shown?;
        }
        // An error of the pictures doesn't matter: they are about to be dropped.
        let _ = self.collect();
        if self.is_busy() {
            bail!(gpc::vulkan::VulkanError::DeviceLost);
        }
        Ok(())
    }
}

impl Drop for Canvas {
    fn drop(&mut self) {
        // A lost device has nothing left to wait for.
        let _ = self.wait();
    }
}
