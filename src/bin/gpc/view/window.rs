//! The window: loads scenes, and draws pictures when they are due.

use super::app::Event;
use super::canvas::{Canvas, ShownPicture};
use super::compose;
use super::cover::{Change, Cover};
use super::device::Device;
use super::engine::Engine;
use super::files::scenes_at;
use super::fly::Flight;
use super::keys::Action;
use super::look::Look;
use super::losses::is_lost;
use super::notes::Notes;
use super::open::Loading;
use super::painter::Painting;
use super::photo::Easel;
use super::player::Player;
use super::pointer::Pointer;
use super::preparer::Preparer;
use super::source::SceneSource;
use super::standpoint::Standpoint;
use super::worker::{Made, PictureWorker};
use super::{NoDisplay, Options, ending};
use gpc::render::HeadlessOptions;
use gpc::scene::{Moment, SceneCamera};
use notify::RecommendedWatcher;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use winit::dpi::PhysicalSize;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::keyboard::ModifiersState;
use winit::window::Window;

/// Time to wait before asking the device again whether it is done.
const POLL: Duration = Duration::from_millis(3);
/// Time for which a file has to stay unchanged before it is reloaded: programs may write it in parts.
const SETTLE: Duration = Duration::from_millis(300);

/// The window and everything in it.
pub struct Viewer {
    pub proxy: EventLoopProxy<Event>,
    pub canvas: Canvas,
    pub interface: egui_winit::State,
    pub window: Arc<Window>,

    /// Files that the arrow keys go through.
    pub scenes: Vec<PathBuf>,
    pub scene: usize,
    /// Source that was requested.
    pub source: SceneSource,
    pub loading: Option<Loading>,
    /// Number of requests to load a file.
    pub loads: u64,
    pub loaders: Vec<JoinHandle<()>>,
    /// Watcher of the scene's file.
    pub watcher: Option<RecommendedWatcher>,
    /// Time at which to reload the scene.
    pub reload: Option<Instant>,

    /// Player of the animation, if the scene has one.
    pub player: Option<Player>,
    /// Moment of the animation that is shown; `None` for the first pose.
    pub moment: Option<Arc<Moment>>,

    pub standpoint: Standpoint,
    /// Whether the standpoint of the options was taken, in the first scene.
    pub has_started: bool,
    /// Flight, while keys move the eye.
    pub flight: Option<Flight>,
    /// Antialiasing of the pictures, the left one first.
    pub looks: Vec<Look>,
    /// Position of the split / width of the window.
    pub split: f64,
    /// Enlargement of the magnifier; `None` while it is off.
    pub magnifier: Option<u32>,

    pub pointer: Pointer,
    pub modifiers: ModifiersState,
    /// Cover: a picture that is shown instead of the frames.
    pub cover: Cover,
    pub cover_figures: Option<String>,
    /// Photograph that is shown instead of a scene.
    pub easel: Option<Easel>,
    /// Worker that makes covers and files.
    pub worker: PictureWorker,
    pub notes: Notes,
    pub shows_keys: bool,
    pub shows_panel: bool,
    /// Whether the window has to be redrawn.
    pub is_dirty: bool,
    /// Time at which egui wants the panel redrawn.
    pub repaint: Option<Instant>,
    /// Whether it was announced that the picture has all samples.
    pub rests: bool,
    pub wants_to_quit: bool,

    pub options: Options,
    /// Messages of the validation layer about devices that are lost by now.
    messages: Vec<String>,
}

impl Viewer {
    pub fn new(events: &ActiveEventLoop, options: Options, proxy: EventLoopProxy<Event>) -> anyhow::Result<Self> {
        let [width, height] = options.look.settings.size;
        let attributes =
            Window::default_attributes().with_title("gpc").with_inner_size(PhysicalSize::new(width, height));
        let window = events.create_window(attributes).map_err(|error| NoDisplay::new(&error))?;
        let window = Arc::new(window);
        let canvas = canvas(&window, &options.device, &proxy)?;
        let interface = interface(&window);
        let worker = worker(&proxy);
        let cover = Cover::new(options.shows_environment);
        let (mut scenes, mut notes) = (Vec::new(), Notes::default());
        let mut source = options.source.clone();
        for path in std::iter::once(&source.path).chain(&options.others) {
            match scenes_at(path) {
                Ok(found) => scenes.extend(found),
                Err(error) => notes.fail(&error),
            }
        }
        if let Some(first) = scenes.first() {
            source.path.clone_from(first);
        }
        let mut view = Self {
            scenes,
            looks: vec![options.look.clone()],
            standpoint: Standpoint::Camera(0),
            has_started: false,
            source,
            options,
            proxy,
            canvas,
            interface,
            window,
            scene: 0,
            loading: None,
            loads: 0,
            loaders: Vec::new(),
            watcher: None,
            reload: None,
            player: None,
            moment: None,
            flight: None,
            split: 0.5,
            magnifier: None,
            pointer: Pointer::default(),
            modifiers: ModifiersState::empty(),
            cover,
            cover_figures: None,
            easel: None,
            worker,
            notes,
            shows_keys: false,
            shows_panel: true,
            is_dirty: true,
            repaint: None,
            rests: false,
            wants_to_quit: false,
            messages: Vec::new(),
        };
        view.canvas.refines = !view.cover.is_wanted();
        if !view.scenes.is_empty() {
            view.load(false);
        }
        Ok(view)
    }

    /// Opens a device again after one was lost, and restores the view.
    pub fn reopened(mut self) -> anyhow::Result<Self> {
        let mut messages = std::mem::take(&mut self.messages);
        messages.extend(self.canvas.engine.device.validation_messages());
        let keeps_view = match &self.loading {
            Some(loading) => loading.keeps_view,
            None => self.shows_source(),
        };
        let stopped = self.worker.stop_files();
        // The old swapchain must be gone before the window gets another one, and nothing keeps the old device.
        drop((self.canvas, self.worker));
        let mut view = Self {
            canvas: canvas(&self.window, &self.options.device, &self.proxy)?,
            worker: worker(&self.proxy),
            interface: interface(&self.window),
            messages,
            moment: None,
            ..self
        };
        for path in stopped {
            view.notes.say(format!("stopped writing {}", path.display()));
        }
        view.canvas.refines = !view.cover.is_wanted();
        view.source.request.time = view.time();
        view.notes.say("the device was lost; everything is made again");
        view.load(keeps_view);
        Ok(view)
    }

    /// Ends all work, and returns the messages of the validation layer. Files that are being written are abandoned.
    /// Threads are waited for: for a moment, or to their end if the validation layer is on.
    pub fn close(mut self) -> Vec<String> {
        self.window.set_visible(false);
        for path in self.worker.stop_files() {
            log::warn!("closed before {} was written", path.display());
        }
        self.loading = None;
        if !self.options.device.validation {
            ending::end_soon();
        }
        let device = self.canvas.engine.device.clone();
        let loaders = std::mem::take(&mut self.loaders);
        let mut messages = std::mem::take(&mut self.messages);
        drop(self);
        for loader in loaders {
            // The thread has reported its own panic.
            let _ = loader.join();
        }
        messages.extend(device.validation_messages());
        messages
    }

    /// Handles the result of another thread.
    pub fn on_done(&mut self, event: Event) -> anyhow::Result<()> {
        self.is_dirty = true;
        match event {
            Event::Opened(number, opened) => self.opened(number, *opened)?,
            Event::Changed => self.reload = Some(Instant::now() + SETTLE),
            Event::Prepared(prepared) => {
                if let Err(error) = self.canvas.prepared(*prepared) {
                    self.report(error)?;
                }
            }
            Event::Made(Made::File(path, written)) => {
                self.worker.delivered(&path);
                match written {
                    Ok(()) => self.notes.say(format!("wrote {}", path.display())),
                    Err(error) => self.note(&error),
                }
            }
            Event::Made(Made::Pixels(number, Ok(pixels))) => self.show_made(number, &pixels)?,
            Event::Made(Made::Pixels(_, Err(error))) => {
                self.cover_failed();
                self.note(&error);
            }
        }
        Ok(())
    }

    /// Shows an error of the worker, unless the device is lost. The window notices that by itself when it is drawn, and this
    /// may be the device before the present one.
    fn note(&mut self, error: &anyhow::Error) {
        if !is_lost(error) {
            self.notes.fail(error);
        }
    }

    /// Makes new pictures in the window's size.
    pub fn renew_layers(&mut self) -> anyhow::Result<()> {
        self.is_dirty = true;
        self.rests = false;
        let Some(size) = self.canvas.size() else {
            return Ok(());
        };
        let now = Instant::now();
        for look in &mut self.looks {
            look.settings.size = size;
        }
        self.canvas.set_looks(&self.looks, now)?;
        self.view_changed(Change::Scene);
        Ok(())
    }

    /// Width / height of the picture.
    pub fn aspect(&self) -> f64 {
        let [width, height] = self.size();
        width / height
    }

    /// Width and height of the picture in pixels.
    pub fn size(&self) -> [f64; 2] {
        self.pixels().map(f64::from)
    }

    /// Size of the window in whole pixels; 1 x 1 for a window without pixels.
    pub fn pixels(&self) -> [u32; 2] {
        self.canvas.size().unwrap_or([1, 1])
    }

    /// Column of the split, if there is one.
    pub fn split_column(&self) -> Option<u32> {
        (self.looks.len() > 1).then(|| (self.split * self.size()[0]).round() as u32)
    }

    /// Does the work that is due. Returns when to call `advance` again.
    ///
    /// # Errors
    /// If the device is lost or memory runs out.
    pub fn advance(&mut self, now: Instant) -> anyhow::Result<ControlFlow> {
        match self.canvas.collect() {
            Ok(any) => self.is_dirty |= any,
            Err(error) => self.report(error)?,
        }
        let due = self.canvas.due();
        let is_due = |at: Option<Instant>| at.is_some_and(|at| at <= now);
        if is_due(self.reload) {
            self.source.request.time = self.time();
            self.load(self.shows_source());
        }
        self.is_dirty |= self.player.as_ref().is_some_and(Player::is_playing);
        self.is_dirty |= self.flight.as_ref().is_some_and(Flight::is_moving);
        self.is_dirty |= is_due(due) || is_due(self.repaint) || self.canvas.has_again();
        self.is_dirty |= is_due(self.notes.next_change());
        if is_due(self.cover.due()) {
            self.refine_cover();
        }
        if self.is_dirty {
            self.draw(now)?;
        }
        self.note_rest();
        if self.is_dirty || self.canvas.is_busy() {
            return Ok(ControlFlow::WaitUntil(now + POLL));
        }
        let next = [self.canvas.due(), self.repaint, self.reload, self.cover.due(), self.notes.next_change()];
        Ok(next.into_iter().flatten().min().map_or(ControlFlow::Wait, ControlFlow::WaitUntil))
    }

    /// Draws the window, if one of its images is free.
    fn draw(&mut self, now: Instant) -> anyhow::Result<()> {
        let Some(acquired) = self.canvas.acquire()? else {
            return Ok(());
        };
        self.is_dirty = false;
        if let Some(player) = &mut self.player
            && player.is_playing()
        {
            player.advance(now);
            self.show_time();
        }
        self.fly(now);
        let (painting, asked) = self.lay_out(now);
        let aspect = self.aspect();
        let camera = match self.canvas.stage() {
            Some(stage) => Some(self.standpoint.camera(self.cameras(), stage.bounds, aspect)?),
            None => None,
        };
        let size = self.pixels();
        let split = self.split_column();
        let magnified = self
            .magnifier
            .map_or_else(Vec::new, |factor| compose::magnified(size, split, self.pointer.place(), factor));
        let seen = ShownPicture {
            camera: camera.as_ref(),
            moment: self.moment.as_ref(),
            pieces: &compose::pictures(size, split),
            magnified: &magnified,
        };
        if let Err(error) = self.canvas.draw(acquired, &seen, painting, now) {
            self.report(error)?;
        }
        asked.into_iter().try_for_each(|action| self.act(action))
    }

    /// Lays out the panel. Returns the layout, and what the user asked for.
    fn lay_out(&mut self, now: Instant) -> (Painting, Vec<Action>) {
        self.notes.expire(now);
        let input = self.interface.take_egui_input(&self.window);
        let context = self.interface.egui_ctx().clone();
        let mut asked = Vec::new();
        let output = context.run(input, |context| asked = self.show_interface(context, now));
        self.interface.handle_platform_output(&self.window, output.platform_output);
        let again = output
            .viewport_output
            .get(&egui::ViewportId::ROOT)
            .and_then(|viewport| now.checked_add(viewport.repaint_delay));
        self.repaint = again;
        let painting = Painting {
            textures: output.textures_delta,
            primitives: context.tessellate(output.shapes, output.pixels_per_point),
            pixels_per_point: output.pixels_per_point,
        };
        (painting, asked)
    }

    /// The scene's cameras at the time that is shown.
    pub fn cameras(&self) -> &[SceneCamera] {
        match (&self.moment, self.canvas.stage()) {
            (Some(moment), _) => &moment.cameras,
            (None, Some(stage)) => &stage.pose.cameras,
            (None, None) => &[],
        }
    }

    /// Time of the animation in seconds.
    pub fn time(&self) -> f64 {
        self.player.as_ref().map_or(self.source.request.time, Player::time)
    }

    /// Moves the scene to the player's time.
    pub fn show_time(&mut self) {
        let time = self.time();
        let Some((stage, motion)) = self.canvas.stage().and_then(|stage| Some((stage, stage.motion.as_ref()?))) else {
            return;
        };
        match motion.at(&stage.scene, time) {
            Ok(Some(moment)) => {
                self.moment = Some(Arc::new(moment));
                self.restart();
            }
            // The scene can't be moved there: a mesh turns inside out, or something appears or disappears. Posing it
            // anew takes a while.
            Ok(None) => {
                if let Some(player) = &mut self.player
                    && player.is_playing()
                {
                    player.toggle(Instant::now());
                    self.notes.say(
                        "this animation turns meshes inside out, or has something come and go: it can't be played; choose its times by hand",
                    );
                }
                self.source.request.time = time;
                self.load(true);
            }
            Err(error) => self.notes.fail(&error.into()),
        }
    }

    /// Shows an error in the window. A lost device is returned as an error.
    fn report(&mut self, error: anyhow::Error) -> anyhow::Result<()> {
        if is_lost(&error) {
            return Err(error);
        }
        self.notes.fail(&error);
        self.is_dirty = true;
        Ok(())
    }

    /// Announces that the visible picture has all its samples.
    fn note_rest(&mut self) {
        let is_drawn = self.easel.is_some() || self.canvas.rests();
        if !(is_drawn && self.cover.is_done()) {
            self.rests = false;
        } else if !self.rests && !self.is_dirty && !self.canvas.is_busy() {
            self.rests = true;
            log::debug!("at rest");
        }
    }
}

/// Opens a device that can present pictures in the window.
fn canvas(window: &Arc<Window>, options: &HeadlessOptions, proxy: &EventLoopProxy<Event>) -> anyhow::Result<Canvas> {
    let device = Device::new(window.clone(), options.device.as_deref(), options.validation)?;
    let engine = Engine::new(Arc::new(device))?;
    let deliver = proxy.clone();
    let preparer = Preparer::new(move |prepared| {
        // An error means that the window is closed and that the result is no longer needed.
        let _ = deliver.send_event(Event::Prepared(Box::new(prepared)));
    });
    Canvas::new(Arc::new(engine), window.inner_size().into(), preparer)
}

/// Starts the worker of a device.
fn worker(proxy: &EventLoopProxy<Event>) -> PictureWorker {
    let deliver = proxy.clone();
    PictureWorker::new(move |made| {
        // An error means that the window is closed and that the result is no longer needed.
        let _ = deliver.send_event(Event::Made(made));
    })
}

/// Makes a new context of the panel: a new device has none of the old one's textures.
fn interface(window: &Window) -> egui_winit::State {
    let context = egui::Context::default();
    context.set_visuals(egui::Visuals::dark());
    egui_winit::State::new(
        context,
        egui::ViewportId::ROOT,
        window,
        Some(window.scale_factor() as f32),
        window.theme(),
        None,
    )
}
