//! A scene at the times of a sequence.

use super::image::ImageArgs;
use super::sequence::SequenceFrame;
use super::session::Session;
use super::startup::Clock;
use super::view::{self, NamedView};
use crate::cli::exit::Usage;
use glam::DVec3;
use gpc::scene::{Environment, Loaded, Motion, Pose, SceneCamera};

/// A scene in motion. Its first pose is uploaded once and then moved. A time that the first pose can't be moved to is
/// posed and uploaded anew. A camera that frames the whole scene keeps the framing of the first pose.
pub struct Film<'a> {
    image: &'a ImageArgs,
    loaded: Loaded,
    /// The first pose; `motion` says how it moves, if the sequence has several times.
    pub pose: Pose,
    motion: Option<Motion>,
    bounds: (DVec3, DVec3),
    first: f64,
    /// Cameras of the scene that is rendered.
    cameras: Vec<SceneCamera>,
    shown: Option<ShownMoment>,
}

#[derive(Clone, Copy, PartialEq)]
enum ShownMoment {
    /// The first pose, moved to this time in seconds.
    Moved(f64),
    /// A separate pose for this time in seconds.
    Posed(f64),
}

impl<'a> Film<'a> {
    /// A film of these steps. `first` is the time of the first pose, in seconds.
    pub fn new(image: &'a ImageArgs, loaded: Loaded, first: f64, steps: &[SequenceFrame]) -> anyhow::Result<Self> {
        let moves = steps.iter().any(|step| step.time != first);
        let (pose, motion) = if moves {
            let (pose, motion) = image.pose_in_motion(&loaded, first)?;
            (pose, Some(motion))
        } else {
            (image.pose(&loaded, first)?, None)
        };
        Ok(Self {
            image,
            loaded,
            motion,
            bounds: view::bounds(&pose),
            first,
            cameras: pose.cameras.clone(),
            pose,
            shown: None,
        })
    }

    /// Environment that lights the scene; `None` for the built-in studio.
    pub fn environment(&self) -> Option<&Environment> {
        self.pose.environment(&self.loaded.scene)
    }

    /// Cameras of the scene that is rendered.
    pub fn cameras(&self) -> &[SceneCamera] {
        &self.cameras
    }

    /// Views of the scene that is rendered, for images of `aspect` = width / height.
    pub fn views(&self, aspect: f64) -> Result<Vec<NamedView>, Usage> {
        view::choose_among(&self.image.camera, &self.cameras, self.bounds, aspect)
    }

    /// Brings the scene to a time in seconds. Returns warnings about what could not be posed.
    pub fn show(&mut self, time: f64, session: &mut Session, clock: &mut Clock) -> anyhow::Result<Vec<String>> {
        if matches!(self.shown, Some(ShownMoment::Moved(now) | ShownMoment::Posed(now)) if now == time) {
            return Ok(Vec::new());
        }
        let scene = &self.loaded.scene;
        let at_first = time == self.first;
        let moment = match &self.motion {
            Some(motion) if !at_first => motion.at(scene, time)?,
            _ => None,
        };
        if let Some(moment) = moment {
            if !matches!(self.shown, Some(ShownMoment::Moved(_))) {
                session.show(scene, &self.pose, self.motion.as_ref(), clock)?;
            }
            self.cameras.clone_from(&moment.cameras);
            session.show_moment(moment)?;
            self.shown = Some(ShownMoment::Moved(time));
            return Ok(Vec::new());
        }
        if at_first {
            session.show(scene, &self.pose, self.motion.as_ref(), clock)?;
            self.cameras.clone_from(&self.pose.cameras);
            self.shown = Some(ShownMoment::Moved(time));
            return Ok(Vec::new());
        }
        let pose = self.image.pose(&self.loaded, time)?;
        session.show(scene, &pose, None, clock)?;
        self.cameras = pose.cameras;
        self.shown = Some(ShownMoment::Posed(time));
        Ok(pose.warnings)
    }
}
