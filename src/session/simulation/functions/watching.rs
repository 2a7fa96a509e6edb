//! Watching the session: the live view, and recordings.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::plan::Reply;
use crate::session::simulation::Simulation;
use crate::session::simulation::call::{done, host};
use crate::session::simulation::following::FollowerId;
use crate::session::simulation::pace::Pace;
use crate::watch::live::{
    History, LiveFollower, Origin, PaceControl, Server, Speed, Views, open_in_browser,
};
use crate::watch::recording::{Recorder, RecordingError, RecordingResult};
use crate::watch::{Cause, FrameBuilder};

/// Builtins of package `PLANWRIGHT`.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "VIEW",
        "&optional (on t)",
        "Opens the live view in the browser and returns its address; closes it if told NIL. Simulated time passes as fast as the real one while it is open.",
        &["(pw:view nil) => NIL"],
        host!(view),
    ),
    control(
        "RECORD",
        "file",
        "Records from here on what happens into an MCAP file, which Foxglove and `planwright view` show; ends the recording if told NIL.",
        &["(pw:record nil) => NIL"],
        host!(record),
    ),
];

/// Who watches the session.
#[derive(Default)]
pub(crate) struct Watching {
    view: Option<LiveView>,
    recording: Option<(FollowerId, PathBuf, RecordingResult)>,
}

/// The live view while it is open.
struct LiveView {
    server: Server,
    follower: FollowerId,
    /// Whether time kept pace before.
    had_pace: bool,
}

/// Why the session cannot be watched.
#[derive(Debug, Error)]
pub(crate) enum WatchError {
    /// There is no port.
    #[error("the live view cannot be opened: {0}")]
    View(io::Error),
    /// The file cannot be written.
    #[error("cannot record into {}: {error}", path.display())]
    Record {
        /// The file.
        path: PathBuf,
        /// Why.
        error: RecordingError,
    },
}

impl Simulation {
    /// Opens the live view, unless it is open; returns the page's address.
    pub(in crate::session) fn open_view(&mut self, image: &Image) -> Result<String, WatchError> {
        if let Some(view) = &self.watching.view {
            return Ok(view.server.address());
        }
        let had_pace = self.pace.is_some();
        let pace = self
            .pace
            .get_or_insert_with(|| Pace::new(PaceControl::new(Speed::Times(1.0))));
        let control = pace.control().clone();
        let history = History::new(Origin::Session);
        let witness = FrameBuilder::new(&self.world);
        let views = Views::new(&self.world, |link| witness.node_named(link));
        let server =
            Server::start(history.clone(), Some(control), views).map_err(WatchError::View)?;
        let address = server.address();
        let follower = Box::new(LiveFollower::new(history, witness));
        let follower = self.add_follower(image, follower);
        self.watching.view = Some(LiveView {
            server,
            follower,
            had_pace,
        });
        Ok(address)
    }

    /// Closes the live view, if it is open.
    pub(in crate::session) fn close_view(&mut self) {
        if let Some(view) = self.watching.view.take() {
            self.remove_follower(view.follower);
            if !view.had_pace {
                self.pace = None;
            }
        }
    }

    /// Records from here on into the file; a recording before ends.
    pub(in crate::session) fn begin_recording(
        &mut self,
        image: &Image,
        path: &Path,
    ) -> Result<(), WatchError> {
        self.end_recording()?;
        let failed = |error| WatchError::Record {
            path: path.to_owned(),
            error,
        };
        let (recorder, result) = Recorder::create(path, &self.world).map_err(failed)?;
        let follower = self.add_follower(image, Box::new(recorder));
        self.watching.recording = Some((follower, path.to_owned(), result));
        Ok(())
    }

    /// Ends the recording, if there is one, and tells what went wrong with it.
    pub(in crate::session) fn end_recording(&mut self) -> Result<(), WatchError> {
        let Some((follower, path, result)) = self.watching.recording.take() else {
            return Ok(());
        };
        self.show(Cause::Rest);
        self.remove_follower(follower);
        match result.take() {
            Some(error) => Err(WatchError::Record { path, error }),
            None => Ok(()),
        }
    }

    /// The server of the live view, if it is open.
    pub(crate) fn view_server(&self) -> Option<&Server> {
        self.watching.view.as_ref().map(|view| &view.server)
    }
}

fn view(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply, Box<Raise>> {
    if args.first().is_some_and(Value::is_nil) {
        simulation.close_view();
        return done(Value::NIL);
    }
    let was_open = simulation.view_server().is_some();
    let address = simulation
        .open_view(image)
        .map_err(|error| Raise::simple(format!("{error}.")))?;
    if !was_open {
        open_in_browser(&address);
    }
    done(Value::string(address))
}

fn record(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply, Box<Raise>> {
    let told = match &args[0] {
        Value::Str(name) => simulation.begin_recording(image, Path::new(&name.text())),
        nothing if nothing.is_nil() => simulation.end_recording(),
        other => return Err(Raise::type_error(other, known::STRING)),
    };
    told.map_err(|error| Raise::simple(format!("{error}.")))?;
    done(args[0].clone())
}
