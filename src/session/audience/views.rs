//! The live view and recordings.

use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;

use super::Audience;
use super::following::FollowerId;
use super::pace::Pace;
use crate::simulation::Simulation;
use lisp::files::{Contents, Files, Opening, Output};
use lisp::image::Image;
use view::watch::live::{
    History, LiveFollower, Origin, PaceControl, PlaceError, Server, Speed, Updates, Views, run_file,
};
use view::watch::recording::{Recorder, RecordingError, RecordingResult};
use view::watch::{Cause, Follower, FrameBuilder};

/// A recording in progress.
pub(crate) struct OpenRecording {
    follower: FollowerId,
    path: PathBuf,
    result: RecordingResult,
}

/// A run that is kept to be written into a file at its end.
pub(crate) struct KeptRun {
    follower: FollowerId,
    path: PathBuf,
    seen: Seen,
}

/// What a follower sees, and the views of it.
struct Seen {
    history: History,
    views: Views,
}

/// The live view while it is open.
pub(crate) struct LiveView {
    server: Server,
    follower: FollowerId,
    seen: Seen,
    /// Whether there was a pace before the view was opened.
    had_pace: bool,
}

/// Why the session cannot be watched.
#[derive(Debug, Error)]
pub enum WatchError {
    /// The server cannot be started.
    #[error("the live view cannot be opened: {0}")]
    View(PlaceError),
    /// The page with the run cannot be written.
    #[error("cannot write {}: {error}", path.display())]
    Save {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: RecordingError,
    },
    /// The recording cannot be written.
    #[error("cannot record into {}: {error}", path.display())]
    Record {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: RecordingError,
    },
}

impl Audience {
    /// Opens the live view, unless it is open; returns the page's address.
    pub fn open_view(
        &mut self,
        simulation: &Simulation,
        image: &Image,
    ) -> Result<String, WatchError> {
        if let Some(view) = &self.view {
            return Ok(view.server.address());
        }
        let had_pace = self.pace.is_some();
        let history = History::new(Origin::Session);
        let (follower, views) = self.live_follower(simulation, &history);
        let control = self.pace_control();
        let shown = Some(control.clone());
        let server = Server::start(&mut self.place, history.clone(), shown, views.clone());
        let server = server.map_err(WatchError::View)?;
        self.keep_pace(control);
        let address = server.address();
        let seen = Seen { history, views };
        let follower = self.add_follower(simulation, image, Box::new(follower));
        self.view = Some(LiveView {
            server,
            follower,
            seen,
            had_pace,
        });
        Ok(address)
    }

    /// What a page of the program's own shows of the session from now on, at a pace that it sets.
    pub(crate) fn updates(&mut self, simulation: &Simulation, image: &Image) -> Updates {
        let history = History::new(Origin::Session);
        let (follower, views) = self.live_follower(simulation, &history);
        let control = self.pace_control();
        self.keep_pace(control.clone());
        let updates = Updates::new(history, Some(control), &views);
        self.add_follower(simulation, image, Box::new(follower));
        updates
    }

    /// Simulated time passes as real time does, unless another pace has been set.
    pub(crate) fn keep_real_time(&mut self) {
        self.keep_pace(self.pace_control());
    }

    /// Shows a follower from elsewhere what happens from now on, at a pace.
    pub(crate) fn show_to(
        &mut self,
        simulation: &Simulation,
        image: &Image,
        follower: Box<dyn Follower>,
    ) {
        self.keep_pace(self.pace_control());
        self.add_follower(simulation, image, follower);
        self.is_shown_elsewhere = true;
    }

    /// A follower that shows the session to viewers as it goes on, and the views of it.
    fn live_follower(&self, simulation: &Simulation, history: &History) -> (LiveFollower, Views) {
        let world = &simulation.world;
        let frames = FrameBuilder::new(world);
        let views = Views::new(world, |link| frames.node_named(link));
        let clock = Arc::clone(&self.outside.clock);
        let now = Box::new(move || clock.now());
        (LiveFollower::new(history.clone(), frames, now), views)
    }

    /// The control of the pace; of that of real time unless one has been set.
    fn pace_control(&self) -> PaceControl {
        let set = self.pace.as_ref().map(|pace| pace.control().clone());
        set.unwrap_or_else(|| PaceControl::new(Speed::Times(1.0)))
    }

    /// From now on the session keeps a pace, unless it does already.
    fn keep_pace(&mut self, control: PaceControl) {
        let clock = &self.outside.clock;
        self.pace
            .get_or_insert_with(|| Pace::new(control, Arc::clone(clock)));
    }

    /// Closes the live view, if it is open.
    pub(crate) fn close_view(&mut self) {
        if let Some(view) = self.view.take() {
            self.remove_follower(view.follower);
            if !view.had_pace {
                self.pace = None;
            }
        }
    }

    /// Starts a recording into the file; any earlier recording ends.
    pub fn begin_recording(
        &mut self,
        simulation: &Simulation,
        image: &Image,
        path: &Path,
    ) -> Result<(), WatchError> {
        self.end_recording(simulation)?;
        let failed = |error| WatchError::Record {
            path: path.to_owned(),
            error,
        };
        let file = open(&*image.files, path, Contents::Drop);
        let file = file.map_err(|error| failed(error.into()))?;
        let (recorder, result) = Recorder::new(file, &simulation.world).map_err(failed)?;
        let follower = self.add_follower(simulation, image, Box::new(recorder));
        self.recording = Some(OpenRecording {
            follower,
            path: path.to_owned(),
            result,
        });
        Ok(())
    }

    /// Ends the recording, if there is one; fails if it could not be written.
    pub fn end_recording(&mut self, simulation: &Simulation) -> Result<(), WatchError> {
        let Some(open) = self.recording.take() else {
            return Ok(());
        };
        self.show(simulation, Cause::Rest);
        self.remove_follower(open.follower);
        match open.result.take() {
            Some(error) => Err(WatchError::Record {
                path: open.path,
                error,
            }),
            None => Ok(()),
        }
    }

    /// Keeps what happens from now on, to be written into the file as a page.
    pub fn keep_run(
        &mut self,
        simulation: &Simulation,
        image: &Image,
        path: &Path,
    ) -> Result<(), WatchError> {
        // A file that cannot be written is known before the robot moves.
        try_out(&*image.files, path)?;
        let (seen, follower) = follower_of(simulation);
        let follower = self.add_follower(simulation, image, follower);
        self.kept = Some(KeptRun {
            follower,
            path: path.to_owned(),
            seen,
        });
        Ok(())
    }

    /// Writes the run that was to be kept, if there is one.
    pub fn write_kept_run(&mut self, simulation: &Simulation) -> Result<(), WatchError> {
        let Some(kept) = self.kept.take() else {
            return Ok(());
        };
        self.show(simulation, Cause::Rest);
        self.remove_follower(kept.follower);
        write_run(&*self.outside.files, &kept.path, &kept.seen)
    }

    /// Writes what has been seen since the live view was opened, or since the beginning of a run
    /// that is kept, into a file as a page; otherwise the world as it is now.
    pub(crate) fn save_view(
        &mut self,
        simulation: &Simulation,
        image: &Image,
        path: &Path,
    ) -> Result<(), WatchError> {
        try_out(&*image.files, path)?;
        self.show(simulation, Cause::Rest);
        let kept = self.kept.as_ref().map(|kept| &kept.seen);
        if let Some(seen) = kept.or(self.view.as_ref().map(|view| &view.seen)) {
            return write_run(&*image.files, path, seen);
        }
        let (seen, follower) = follower_of(simulation);
        let follower = self.add_follower(simulation, image, follower);
        self.remove_follower(follower);
        write_run(&*image.files, path, &seen)
    }

    /// The reason why the recording has ended by itself, if it has; told once.
    pub(crate) fn broken_recording(&mut self) -> Option<WatchError> {
        let error = self.recording.as_ref()?.result.take()?;
        let open = self.recording.take()?;
        self.remove_follower(open.follower);
        Some(WatchError::Record {
            path: open.path,
            error,
        })
    }

    /// The server of the live view, if it is open.
    pub fn view_server(&self) -> Option<&Server> {
        self.view.as_ref().map(|view| &view.server)
    }
}

/// A follower that keeps a run, and where it keeps it.
fn follower_of(simulation: &Simulation) -> (Seen, Box<LiveFollower>) {
    let history = History::new(Origin::Recording);
    let world = &simulation.world;
    let frames = FrameBuilder::new(world);
    let views = Views::new(world, |link| frames.node_named(link));
    let follower = LiveFollower::without_viewers(history.clone(), frames);
    (Seen { history, views }, Box::new(follower))
}

/// Fails if the file cannot be written; it keeps what it contains.
fn try_out(files: &dyn Files, path: &Path) -> Result<(), WatchError> {
    let opened = open(files, path, Contents::Overwrite);
    opened
        .map(drop)
        .map_err(|error| unsaved(path, error.into()))
}

fn write_run(files: &dyn Files, path: &Path, seen: &Seen) -> Result<(), WatchError> {
    let text = run_file(&seen.history, &seen.views);
    let written = name_of(path).and_then(|name| files.write(name, text.as_bytes()));
    written.map_err(|error| unsaved(path, error.into()))
}

/// Opens a file, which is created if it is missing.
fn open(files: &dyn Files, path: &Path, contents: Contents) -> Result<Box<dyn Output>, Error> {
    let opening = Opening {
        creates: true,
        contents,
    };
    files.open(name_of(path)?, opening)
}

/// The name by which files are known.
fn name_of(path: &Path) -> Result<&str, Error> {
    let name = path.to_str();
    name.ok_or_else(|| Error::new(ErrorKind::InvalidInput, "the name is no text"))
}

fn unsaved(path: &Path, error: RecordingError) -> WatchError {
    WatchError::Save {
        path: path.to_owned(),
        error,
    }
}
