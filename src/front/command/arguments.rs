//! The commands of the command line. The file of each command has its arguments, from which the help
//! is generated.

use clap::{Parser, Subcommand};

use super::ask::AskArguments;
use super::check::CheckArguments;
use super::completions::CompletionsArguments;
use super::describe_robot::DescribeRobotArguments;
use super::grade::GradeArguments;
use super::jupyter::JupyterCommand;
use super::mcp::McpArguments;
use super::options::Options;
use super::picture::PictureArguments;
use super::prompt::PromptOptions;
use super::replay::ReplayArguments;
use super::robot::RobotArguments;
use super::run::RunArguments;
use super::serve::ServeArguments;
use super::swank::SwankOptions;
use super::sweep::SweepOptions;
use super::view_recording::ViewArguments;

/// Program a simulated kitchen robot in a Common-Lisp-like plan language.
///
/// Without a command, starts the prompt. If the input is not a terminal, evaluates it and
/// prints what the prompt would print.
#[derive(Parser, Debug)]
#[command(
    name = "planwright",
    version,
    after_help = "Exit status: 0 success; 1 a condition was not handled, a transcript \
                  differs, or a check found a problem; 2 wrong usage, or a file cannot be read; \
                  of sweeps, 1 the goal is not met; 3 worlds are missing; 4 planwright could not \
                  run some worlds."
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
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

/// The subcommands.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Load plan files, then evaluate forms; stop at the first unhandled condition
    Run(RunArguments),
    /// Show a recording in the browser until Ctrl-C
    View(ViewArguments),
    /// Run transcripts, each in a fresh world, and compare their output
    Replay(ReplayArguments),
    /// Load plan files, then draw the resulting world; without files, draw the initial one
    ///
    /// The picture is drawn even after an unhandled condition; the exit status is then 1.
    Picture(Box<PictureArguments>),
    /// Run a plan in many worlds that differ in a declared way: how often does it work?
    Sweep(Box<SweepOptions>),
    /// Answer questions about many runs: which failures, where, how often
    Ask(AskArguments),
    /// Grade what students have handed in: each in closed worlds of its own, by what happened there
    Grade(Box<GradeArguments>),
    /// Serve a session to assistants that write plans (Model Context Protocol over standard input and output, or
    /// HTTP)
    Mcp(McpArguments),
    /// Serve the tools for assistants to editors and tests, as plain lines of JSON
    Serve(ServeArguments),
    /// Be a robot for others: carry out the goals that nodes of ROS 2 send, until Ctrl-C
    Robot(RobotArguments),
    /// Serve a session to Emacs: SLIME connects to it by M-x slime-connect
    Swank(SwankOptions),
    /// Use planwright in notebooks of Jupyter
    #[command(subcommand)]
    Jupyter(JupyterCommand),
    /// Find mistakes in plan files without running them
    Check(CheckArguments),
    /// Write a description of a robot for --robot-description: what follows from its URDF, with comments
    /// on what is assumed or missing
    DescribeRobot(DescribeRobotArguments),
    /// Print the reference manual in Markdown
    Reference,
    /// Print the manual page, as in `planwright man | man -l -`
    Man,
    /// Print a completion script for a shell
    Completions(CompletionsArguments),
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let Some(Command::Run(run)) = run.ok().and_then(|a| a.command) else {
            panic!("no run");
        };
        assert!(run.watch.view && run.watch.record.is_some());
        assert!(parsed(&["view", "a.mcap"]).is_ok() && parsed(&["view"]).is_err());
    }

    #[test]
    fn the_distribution_of_ros_may_be_left_out() {
        let before = parsed(&["--ros2=humble", "run", "a.plan"]);
        assert!(before.is_ok_and(|a| a.ros2.as_deref() == Some("humble")));
        let run = parsed(&["run", "--ros2", "a.plan"]);
        let Some(Command::Run(run)) = run.ok().and_then(|a| a.command) else {
            panic!("no run");
        };
        assert_eq!(run.watch.ros2.as_deref(), Some(""));
        assert_eq!(run.files.len(), 1);
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
