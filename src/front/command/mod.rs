//! The command line: what `planwright` and its subcommands do.
//!
//! Exit statuses: 0 success; 1 a condition was not handled, a transcript differs, or a check
//! found a problem; 2 the command line is wrong, a file cannot be read, or the robot and its
//! world cannot be set up; 3 and 4 a sweep lacks worlds, or could not run them. It is no error if a
//! reader closes our output early. `(quit n)` exits with its own status.
//!
//! Only this folder and the prompt write to the terminal.

mod arguments;
mod ask;
mod ask_sqlite;
mod cache;
mod check;
mod completions;
mod describe_robot;
mod failure;
mod grade;
mod heap;
mod jupyter;
mod man;
mod mcp;
mod open;
mod options;
mod outputs;
mod paint;
mod picture;
mod pipe;
mod prompt;
mod real_robot;
mod reference;
mod replay;
mod robot;
mod ros2;
mod run;
mod serve;
mod stack;
mod stop_at;
mod swank;
mod sweep;
mod view_recording;
mod watching;

use std::io::{self, Write};
use std::process::ExitCode;
use std::thread;

use clap::{CommandFactory, Parser};

use crate::precompiled;
use arguments::{Arguments, Command};
use failure::{CommandError, Status};
use lisp::visible::visible;
use paint::Paint;
use stack::THREAD_STACK;
use watching::WatchArguments;

#[cfg(test)]
pub(crate) use open::open_default;
#[cfg(any(test, fuzzing))]
pub(crate) use sweep::texts as sweep_texts;

/// Runs the command line of this process. `in_use` tells how many bytes its allocator has given
/// out.
pub fn main(in_use: fn() -> usize) -> ExitCode {
    heap::count_by(in_use);
    defect::keep_caught_panics_quiet();
    let thread = thread::Builder::new()
        .stack_size(THREAD_STACK)
        .spawn(run_command_line);
    match thread.map(thread::JoinHandle::join) {
        Ok(Ok(code)) => code,
        _ => ExitCode::from(Status::Unusable.code()),
    }
}

fn run_command_line() -> ExitCode {
    let arguments = Arguments::parse();
    precompiled::use_compiled_library();
    let errors = Paint::new(arguments.options.color, &io::stderr());
    match dispatch(arguments) {
        Ok(status) => ExitCode::from(status.code()),
        Err(error) if error.is_broken_pipe() => ExitCode::SUCCESS,
        Err(error) => {
            // If standard error is closed, the message is lost.
            let error = error.to_string();
            let _ = writeln!(io::stderr(), "{} {}", errors.bad("error:"), visible(&error));
            ExitCode::from(Status::Unusable.code())
        }
    }
}

fn dispatch(arguments: Arguments) -> Result<Status, CommandError> {
    if arguments.real_robot.is_some() && arguments.prompt.resume.is_some() {
        return Err(CommandError::Open(
            "--resume would let the robot do again what it has done: leave out --real-robot"
                .to_owned(),
        ));
    }
    let mut arguments = arguments;
    let real_robot = match &arguments.command {
        Some(Command::Run(wanted)) => wanted.watch.real_robot.clone(),
        _ => None,
    };
    let real_robot = arguments.real_robot.take().or(real_robot);
    let can_drive = matches!(
        &arguments.command,
        None | Some(Command::Run(_) | Command::Swank(_))
    );
    if real_robot.is_some() && !can_drive {
        return Err(CommandError::Open(
            "--real-robot is for the prompt, for run and for swank: nothing else drives a robot"
                .to_owned(),
        ));
    }
    // A robot's controllers refuse what is faster.
    arguments.options.faithful |= real_robot.is_some();
    let options = &arguments.options;
    let watch = WatchArguments {
        real_robot: real_robot.clone(),
        view: arguments.view,
        ros2: arguments.ros2.clone(),
        ..WatchArguments::default()
    };
    match arguments.command {
        None if io::IsTerminal::is_terminal(&io::stdin()) => {
            prompt::prompt(arguments.options, &arguments.prompt, &watch)
        }
        None => pipe::evaluate_standard_input(arguments.options, &arguments.prompt, &watch),
        Some(Command::Run(mut wanted)) => {
            wanted.watch.view |= arguments.view;
            wanted.watch.ros2 = wanted.watch.ros2.or(arguments.ros2);
            wanted.watch.real_robot = real_robot;
            run::run(options, &wanted)
        }
        Some(Command::View(wanted)) => view_recording::view(options, &wanted),
        Some(Command::Replay(wanted)) => replay::replay(options, &wanted),
        Some(Command::Picture(wanted)) => picture::picture(options, &wanted),
        Some(Command::Sweep(wanted)) => sweep::sweep(arguments.options, &wanted),
        Some(Command::Ask(wanted)) => ask::ask(options, &wanted),
        Some(Command::Grade(wanted)) => grade::grade(options, &wanted),
        Some(Command::Mcp(wanted)) => mcp::mcp(options, &wanted),
        Some(Command::Serve(wanted)) => serve::serve(options, &wanted),
        Some(Command::Robot(wanted)) => robot::robot(options, &wanted),
        Some(Command::Swank(wanted)) => swank::swank(options, &wanted, &watch),
        Some(Command::Jupyter(wanted)) => jupyter::jupyter(options, &wanted),
        Some(Command::Check(wanted)) => check::check(options, &wanted),
        Some(Command::DescribeRobot(wanted)) => describe_robot::describe(options, &wanted),
        Some(Command::Reference) => reference::print(),
        Some(Command::Man) => man::print(Arguments::command()),
        Some(Command::Completions(wanted)) => completions::print(Arguments::command(), &wanted),
    }
}
