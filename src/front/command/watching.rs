//! Lets a session be watched as the command line asks.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use clap::Args;

use super::failure::CommandError;
use super::real_robot::{self, Driving};
use super::ros2::{self, Publishing};
use session::Session;
use session::dialogue::Evaluate;
use view::watch::live::open_in_browser;

/// How to watch a run.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct WatchArguments {
    /// Show the robot in the browser while it moves; simulated time then passes in real time
    /// unless --realtime says otherwise
    #[arg(long)]
    pub(crate) view: bool,
    /// MCAP file to record the run to
    #[arg(long, value_name = "MCAP")]
    pub(crate) record: Option<PathBuf>,
    /// HTML file to write the run to: the page of the live view with the whole run in it, which
    /// any browser shows without planwright
    #[arg(long, value_name = "HTML")]
    pub(crate) html: Option<PathBuf>,
    /// Show the session to nodes of ROS 2, with messages of a distribution such as humble [default:
    /// ROS_DISTRO, or jazzy]; simulated time then passes in real time unless --realtime says otherwise
    #[arg(
        long,
        value_name = "DISTRIBUTION",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = ""
    )]
    pub(crate) ros2: Option<String>,
    /// Let with-real-robot drive the robot whose actions are served over ROS 2, with messages of a distribution such as
    /// humble [default: ROS_DISTRO, or jazzy]; joints then move no faster than the URDF says, and time is real
    #[arg(
        long,
        value_name = "DISTRIBUTION",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "",
        conflicts_with = "ros2"
    )]
    pub(crate) real_robot: Option<String>,
}

/// What goes on while a session is watched; what it sends ends with it.
#[derive(Default)]
pub(crate) struct Watching {
    /// Whether a browser was started.
    has_browser: bool,
    _publishing: Option<Publishing>,
    /// The robot that plans drive.
    robot: Option<Driving>,
}

/// How long to wait for a browser to show the page.
const BROWSER_START: Duration = Duration::from_secs(5);

/// Starts the recording, the page of the run, the node of ROS 2 and the live view if they are asked for, and
/// prints where the last two are on standard error.
pub(crate) fn begin(
    session: &mut Session,
    watch: &WatchArguments,
) -> Result<Watching, CommandError> {
    if watch.ros2.is_some() && watch.real_robot.is_some() {
        return Err(CommandError::Open(
            "--ros2 would tell the plan what it believes itself as if the robot had said so: leave it out with --real-robot"
                .to_owned(),
        ));
    }
    if let Some(path) = &watch.record {
        session.begin_recording(path)?;
    }
    if let Some(path) = &watch.html {
        session.keep_run(path)?;
    }
    let publishing = match &watch.ros2 {
        Some(distribution) => Some(ros2::publish(session, distribution)?),
        None => None,
    };
    let robot = match &watch.real_robot {
        Some(distribution) => Some(real_robot::connect(session, distribution)?),
        None => None,
    };
    let mut has_browser = false;
    if watch.view {
        let address = session.open_view()?;
        // If standard error is closed, the browser may still show the page.
        let _ = writeln!(io::stderr(), "The live view is at {address}");
        has_browser = open_in_browser(&address);
    }
    Ok(Watching {
        has_browser,
        _publishing: publishing,
        robot,
    })
}

/// While files are being written, lets Ctrl-C end the evaluation only, so that they can be
/// completed; again, it ends the program. Without files, or if this is not possible, it ends the
/// program at once.
///
/// While a robot is driven, Ctrl-C lets it stop, too; the program ends when it stands, or at the next one.
pub(crate) fn finish_at_interrupt(
    session: &Session,
    watch: &WatchArguments,
    watching: &Watching,
) -> Writing {
    let writing = Writing(Arc::new(AtomicBool::new(true)));
    if watch.record.is_none() && watch.html.is_none() && watching.robot.is_none() {
        return writing;
    }
    let (flag, is_writing) = (session.interrupt_handle(), Arc::clone(&writing.0));
    let halt = watching.robot.as_ref().map(Driving::halt);
    let _ = ctrlc::set_handler(move || {
        if let Some(halt) = &halt {
            halt.store(true, Ordering::Relaxed);
        }
        if !is_writing.load(Ordering::Relaxed) || flag.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
    writing
}

/// Exit status after Ctrl-C, as shells tell it.
pub(super) const INTERRUPTED: i32 = 130;

/// Whether files are being written.
#[derive(Default)]
pub(crate) struct Writing(Arc<AtomicBool>);

impl Writing {
    /// The files are complete.
    pub(crate) fn end(&self) {
        self.0.store(false, Ordering::Relaxed);
    }
}

/// Waits while there are viewers, so that they can look at the end; also waits for a browser
/// that is just starting. Then nothing more is sent.
pub(crate) fn linger(session: &Session, watching: Watching) {
    let Some(server) = session.audience().view_server() else {
        return;
    };
    let begin = Instant::now();
    let is_starting =
        || watching.has_browser && !server.had_viewer() && begin.elapsed() < BROWSER_START;
    while server.viewers() > 0 || is_starting() {
        thread::sleep(Duration::from_millis(100));
    }
}
