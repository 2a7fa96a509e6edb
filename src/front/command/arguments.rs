//! The arguments of the command line, from which its help is generated.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use super::heap;
use super::jupyter::JupyterCommand;
use super::picture::PictureArguments;
use super::swank::SwankOptions;
use super::sweep::SweepOptions;

/// Program a simulated kitchen robot in a Common-Lisp-like plan language.
///
/// Without a command, starts the prompt. If the input is not a terminal, evaluates it and
/// prints what the prompt would print.
#[derive(Parser, Debug)]
#[command(
    name = "planwright",
    version,
    after_help = "Exit status: 0 success; 1 a condition was not handled, a transcript \
                  differs, or a check found a problem; 2 wrong usage, or a file cannot be read."
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) options: Options,
    #[command(flatten)]
    pub(crate) prompt: PromptOptions,
    /// Show the robot in the browser while it moves; simulated time then passes in real time
    /// unless --realtime says otherwise
    #[arg(long)]
    pub(crate) view: bool,
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

/// Options of the prompt.
#[derive(Args, Debug, Default)]
pub(crate) struct PromptOptions {
    /// Resume the last session that is over, or the one recorded in the journal FILE: evaluate
    /// all its inputs again, which leads to the same state
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true)]
    pub(crate) resume: Option<Option<PathBuf>>,
    /// New file to save the inputs to [default: a file in the state directory]
    #[arg(long, value_name = "FILE", conflicts_with = "resume")]
    pub(crate) journal: Option<PathBuf>,
}

/// Options of all commands.
#[derive(Args, Clone, Debug)]
pub(crate) struct Options {
    /// Seed for everything random
    #[arg(long, global = true, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Kitchen to load (a URDF file) instead of the built-in one
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) world: Option<PathBuf>,
    /// What the kitchen's furniture is for (in the form of world/kitchen.sexp) [default: with
    /// --world FILE.urdf, a file FILE.sexp beside it]
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) world_description: Option<PathBuf>,
    /// Robot to load (a URDF file) instead of the built-in PR2
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) robot: Option<PathBuf>,
    /// What the robot's links and joints are for (in the form of world/pr2.sexp), for a robot
    /// whose names are not those of the built-in PR2
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) robot_description: Option<PathBuf>,
    /// Folder in which (asdf:load-system …) and (ql:quickload …) look for systems, with the
    /// folders inside it; may be given several times
    #[arg(long, global = true, value_name = "FOLDER")]
    pub(crate) systems: Vec<PathBuf>,
    /// Let the robot's sensors and motors make errors, such as position=0.01,misses=0.1 (see
    /// set-noise in the manual); usual ones if no SETTINGS are given
    #[arg(
        long,
        global = true,
        value_name = "SETTINGS",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = ""
    )]
    pub(crate) noise: Option<String>,
    /// Least severe log messages to show
    #[arg(long, global = true, value_name = "LEVEL", default_value = "info")]
    pub(crate) log_level: LogLevel,
    /// When to use colours; auto: if the output is a terminal and NO_COLOR is not set
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub(crate) color: ColorWhen,
    /// Run simulated time at FACTOR times real time instead of as fast as possible
    #[arg(
        long,
        global = true,
        value_name = "FACTOR",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "1",
        value_parser = positive_factor
    )]
    pub(crate) realtime: Option<f64>,
    /// Port of the page of the live view, which only this machine can reach [default: any that is
    /// free]
    #[arg(
        long,
        global = true,
        value_name = "N",
        value_parser = clap::value_parser!(u16).range(1..)
    )]
    pub(crate) view_port: Option<u16>,
    /// Memory that may be in use, such as 500M or 2G; beyond it, a program gets a condition
    /// HEAP-EXHAUSTED-ERROR [default: half of the machine's memory]
    #[arg(long, global = true, value_name = "SIZE", value_parser = heap::bytes)]
    pub(crate) heap: Option<usize>,
}

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
}

/// The subcommands.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Load plan files, then evaluate forms; stop at the first unhandled condition
    Run {
        /// Files to load, in order; the values of their forms are not shown
        #[arg(value_name = "FILE", required_unless_present = "eval")]
        files: Vec<PathBuf>,
        /// Form to evaluate after loading the files; its values are shown
        #[arg(long, value_name = "FORM")]
        eval: Vec<String>,
        #[command(flatten)]
        watch: WatchArguments,
    },
    /// Show a recording in the browser until Ctrl-C
    View {
        /// MCAP file written by `run --record` or (record "…")
        #[arg(value_name = "MCAP")]
        file: PathBuf,
        /// Write the recording into an HTML file instead, which any browser shows without
        /// planwright
        #[arg(long, value_name = "HTML")]
        html: Option<PathBuf>,
    },
    /// Run transcripts, each in a fresh world, and compare their output
    Replay {
        /// Transcripts, or Markdown files with blocks marked `session`
        #[arg(value_name = "FILE", required = true)]
        files: Vec<PathBuf>,
        /// Rewrite the expected output where it differs, keeping wildcards that still match
        #[arg(long)]
        bless: bool,
        /// Stop after the N-th input of the transcript and open the prompt there
        #[arg(long, value_name = "N", conflicts_with_all = ["bless", "jobs"])]
        stop_at: Option<usize>,
        /// Number of files to run in parallel [default: the number of processors]
        #[arg(long, value_name = "N")]
        jobs: Option<NonZeroUsize>,
    },
    /// Load plan files, then draw the resulting world; without files, draw the initial one
    ///
    /// The picture is drawn even after an unhandled condition; the exit status is then 1.
    Picture(Box<PictureArguments>),
    /// Run a plan in many worlds that differ in a declared way: how often does it work?
    Sweep(Box<SweepOptions>),
    /// Serve a session to Emacs: SLIME connects to it by M-x slime-connect
    Swank(SwankOptions),
    /// Use planwright in notebooks of Jupyter
    #[command(subcommand)]
    Jupyter(JupyterCommand),
    /// Find mistakes in plan files without running them
    Check {
        /// Plan files
        #[arg(value_name = "FILE", required = true)]
        files: Vec<PathBuf>,
    },
    /// Print the reference manual in Markdown
    Reference,
    /// Print the manual page, as in `planwright man | man -l -`
    Man,
    /// Print a completion script for a shell
    Completions {
        /// The shell to complete for
        shell: Shell,
    },
}

/// Severity of log messages.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, ValueEnum)]
pub(crate) enum LogLevel {
    /// Everything
    Debug,
    /// Progress of plans
    Info,
    /// Possible problems
    Warn,
    /// Errors
    Error,
    /// Nothing
    None,
}

/// When to use colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum ColorWhen {
    /// If the output is a terminal
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

fn positive_factor(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(factor) if factor.is_finite() && factor > 0.0 => Ok(factor),
        _ => Err("expected a number greater than zero".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use crate::command::arguments::*;
    use clap::CommandFactory;

    fn parsed(arguments: &[&str]) -> Result<Arguments, clap::Error> {
        Arguments::try_parse_from([&["planwright"], arguments].concat())
    }

    #[test]
    fn the_description_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn the_factor_of_realtime_may_be_left_out() {
        let factor = |arguments: &[&str]| parsed(arguments).map(|a| a.options.realtime).ok();
        assert_eq!(factor(&["run", "a.plan"]), Some(None));
        assert_eq!(factor(&["--realtime", "run", "a.plan"]), Some(Some(1.0)));
        assert_eq!(
            factor(&["run", "--realtime=2.5", "a.plan"]),
            Some(Some(2.5))
        );
        assert_eq!(factor(&["--realtime=0"]), None);
        assert_eq!(factor(&["--realtime=nan"]), None);
    }

    #[test]
    fn the_view_may_be_asked_for_with_and_without_a_run() {
        assert!(parsed(&["--view"]).is_ok_and(|a| a.view));
        assert!(parsed(&["--view", "run", "a.plan"]).is_ok_and(|a| a.view));
        let run = parsed(&["run", "a.plan", "--view", "--record", "a.mcap"]);
        let Some(Command::Run { watch, .. }) = run.ok().and_then(|a| a.command) else {
            panic!("no run");
        };
        assert!(watch.view && watch.record.is_some());
        assert!(parsed(&["view", "a.mcap"]).is_ok() && parsed(&["view"]).is_err());
    }

    #[test]
    fn the_port_of_the_view_is_one_that_there_is() {
        let port = |text: &str| parsed(&["run", "a.plan", "--view-port", text]);
        assert!(port("8000").is_ok_and(|a| a.options.view_port == Some(8000)));
        for text in ["0", "65536", "-1", "http"] {
            assert!(port(text).is_err(), "{text}");
        }
    }

    #[test]
    fn run_needs_a_file_or_a_form() {
        assert!(parsed(&["run"]).is_err());
        assert!(parsed(&["run", "--eval", "1"]).is_ok());
        assert!(parsed(&["run", "a.plan", "--eval", "1", "--eval", "2"]).is_ok());
    }
}
