//! Who watches a session: followers of every step, the live view, recordings, films, and
//! pictures on their way to the prompt.

mod film;
mod following;
mod pace;
mod views;

use std::sync::Arc;

use crate::picture::Image;
use crate::session::simulation::Simulation;
use crate::watch::live::{PaceControl, Speed};
use crate::world::World;
use film::Film;
pub(crate) use film::Filming;
use following::Followers;
use pace::Pace;
pub(crate) use views::WatchError;
use views::{LiveView, OpenRecording};

/// Looks at the world after every step of a motion.
pub(crate) type Observer = Box<dyn FnMut(&World)>;

/// Who watches a session.
#[derive(Default)]
pub(crate) struct Audience {
    /// Keeps simulated time from passing faster than somebody wants to see.
    pub(super) pace: Option<Pace>,
    observer: Option<Observer>,
    film: Option<Film>,
    followers: Followers,
    view: Option<LiveView>,
    recording: Option<OpenRecording>,
    /// Pictures that were made and not yet told of.
    pictures: Vec<Arc<Image>>,
}

impl Audience {
    /// Somebody who wants to see simulated time pass at that multiple of the real one, or as
    /// fast as it can.
    pub(super) fn new(realtime: Option<f64>) -> Self {
        let control = realtime.map(|factor| PaceControl::new(Speed::Times(factor)));
        Self {
            pace: control.map(Pace::new),
            ..Self::default()
        }
    }

    /// Has a function look at the world after every step that a motion takes.
    #[cfg(test)]
    pub(crate) fn set_observer(&mut self, observer: Observer) {
        self.observer = Some(observer);
    }

    /// Lets the observer look.
    pub(super) fn observe(&mut self, simulation: &Simulation) {
        if let Some(observer) = &mut self.observer {
            observer(&simulation.world);
        }
    }

    /// A picture was made, which is to be shown to whoever can see it.
    pub(super) fn add_picture(&mut self, picture: Image) {
        self.pictures.push(Arc::new(picture));
    }

    /// The pictures that were made since this was asked last.
    pub(super) fn take_pictures(&mut self) -> Vec<Arc<Image>> {
        std::mem::take(&mut self.pictures)
    }
}
