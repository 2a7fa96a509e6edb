//! The outputs that show a session: followers of every step, the live view, recordings,
//! films, and pictures for the prompt.

mod film;
mod following;
mod pace;
pub(super) mod task_news;
mod views;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::dialogue::Swept;
use crate::options::SessionOptions;
use crate::outside::Outside;
use crate::simulation::Simulation;
use film::Film;
pub use film::Filming;
pub(crate) use following::FollowerId;
use following::Followers;
use pace::Pace;
use robotics::world::World;
use view::picture::Image;
use view::watch::live::{PaceControl, Place, Speed};
pub use views::WatchError;
use views::{KeptRun, LiveView, OpenRecording};

/// Called with the world after every step of a motion.
pub(crate) type Observer = Box<dyn FnMut(&World)>;

/// Everything that shows a session.
#[derive(Default)]
pub struct Audience {
    /// Limits how fast simulated time passes.
    pace: Option<Pace>,
    /// Whether it does not, for now.
    is_hurried: bool,
    observer: Option<Observer>,
    film: Option<Film>,
    followers: Followers,
    view: Option<LiveView>,
    /// Where the live view is whenever it is open.
    place: Place,
    recording: Option<OpenRecording>,
    kept: Option<KeptRun>,
    /// Whether a follower from elsewhere has been shown robot and kitchen.
    is_shown_elsewhere: bool,
    /// Pictures that have not been reported as events yet.
    pictures: Vec<Arc<Image>>,
    /// What came of the latest sweep, for front ends that can show tables.
    pub(super) swept: Option<Swept>,
    outside: Outside,
}

impl Audience {
    /// An audience that has the session's options for its pace, its live view, its files and its clock.
    pub(super) fn new(options: &SessionOptions) -> Self {
        let outside = options.outside.clone();
        let control = options
            .realtime
            .map(|factor| PaceControl::new(Speed::Times(factor)));
        Self {
            pace: control.map(|control| Pace::new(control, Arc::clone(&outside.clock))),
            place: Place::new(options.view_port),
            outside,
            ..Self::default()
        }
    }

    /// Files, and the clock of those who watch.
    pub(crate) fn outside(&self) -> &Outside {
        &self.outside
    }

    /// Sets whether simulated time passes as fast as possible, whatever its pace.
    pub(super) fn set_hurried(&mut self, is_hurried: bool) {
        self.is_hurried = is_hurried;
    }

    /// How much simulated time (s) may pass at once when nothing happens; `None` if unlimited.
    pub(super) fn slice(&self) -> Option<f64> {
        let waits = !self.is_hurried;
        self.pace.as_ref().and_then(|pace| pace.slice(waits))
    }

    /// Waits until so much simulated time (s) may have passed since the last wait, or until the
    /// interrupt flag is set.
    pub(super) fn wait(&mut self, seconds: f64, interrupt: &AtomicBool) {
        if let Some(pace) = self.pace.as_mut().filter(|_| !self.is_hurried) {
            pace.wait(seconds, interrupt);
        }
    }

    /// Whether somebody has been shown the kitchen, and would have to be shown another one.
    pub(super) fn shows_kitchen(&self) -> bool {
        self.view.is_some() || self.writes_files() || self.is_shown_elsewhere
    }

    /// Whether nobody is shown anything.
    pub(super) fn is_empty(&self) -> bool {
        self.observer.is_none()
            && !self.has_followers()
            && self.view.is_none()
            && !self.writes_files()
            && self.pictures.is_empty()
            && self.swept.is_none()
    }

    /// Whether a film, a recording or a page of the run is being made.
    pub(super) fn writes_files(&self) -> bool {
        self.film.is_some() || self.recording.is_some() || self.kept.is_some()
    }

    /// Sets a function to be called after every step of a motion.
    pub fn set_observer(&mut self, observer: Observer) {
        self.observer = Some(observer);
    }

    /// Calls the observer.
    pub(super) fn observe(&mut self, simulation: &Simulation) {
        if let Some(observer) = &mut self.observer {
            observer(&simulation.world);
        }
    }

    /// Queues a picture to be shown by front ends that can show pictures.
    pub(super) fn add_picture(&mut self, picture: Image) {
        self.pictures.push(Arc::new(picture));
    }

    /// Takes the pictures made since the last call.
    pub(super) fn take_pictures(&mut self) -> Vec<Arc<Image>> {
        std::mem::take(&mut self.pictures)
    }
}
