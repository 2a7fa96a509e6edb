//! What CRAM uses from ROS: log lines, start-up, loading of systems.

use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::plan::Reply;
use crate::session::LogLevel;
use crate::session::host::call::{done, host};
use crate::session::simulation::Simulation;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `ROSLISP`.
pub(crate) static LOG_TABLE: &[Builtin] = &[
    control(
        "LOG-LINE",
        "level tags text",
        "Writes a log line.",
        &[],
        host!(log_line),
    ),
    control(
        "ROS-TIME",
        "",
        "Simulated time in seconds.",
        &[],
        host!(ros_time),
    ),
];

/// Builtins of package `ROSLISP-UTILITIES`.
pub(crate) static UTILITIES_TABLE: &[Builtin] = &[
    control(
        "STARTUP-ROS",
        "&rest options",
        "Nothing to start: the robot is here already. Takes the world back to its start.",
        &["(roslisp-utilities:startup-ros) => NIL"],
        host!(startup_ros),
    ),
    control(
        "SHUTDOWN-ROS",
        "",
        "Nothing to stop.",
        &[],
        host!(shutdown_ros),
    ),
];

/// Builtins of package `ROS-LOAD`.
pub(crate) static LOAD_TABLE: &[Builtin] = &[control(
    "LOAD-SYSTEM",
    "package &optional system",
    "Nothing to load: everything is built in.",
    &[],
    host!(load_system),
)];

impl Simulation {
    /// Writes a log line: `[(TAG …) LEVEL] seconds: text`.
    pub(in crate::session) fn log(
        &self,
        image: &mut Image,
        level: LogLevel,
        tags: &str,
        text: &str,
    ) {
        if level < self.log_level {
            return;
        }
        let level = match level {
            LogLevel::Debug => "DEBUG",
            LogLevel::Info => "INFO",
            LogLevel::Warn => "WARN",
            LogLevel::Error | LogLevel::None => "ERROR",
        };
        let text = text.trim_end_matches('\n');
        image.output.fresh_line();
        let line = format!("[{tags} {level}] {:.3}: {text}\n", self.now());
        image.output.write(&line);
    }
}

fn log_line(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let level = match args[0].as_symbol().map(|s| image.name(s)) {
        Some("DEBUG") => LogLevel::Debug,
        Some("WARN") => LogLevel::Warn,
        Some("ERROR" | "FATAL") => LogLevel::Error,
        _ => LogLevel::Info,
    };
    // Tags are printed without their packages.
    let names: Vec<String> = args[1]
        .iter_list()
        .map(|tag| match tag.as_symbol() {
            Some(sym) => image.name(sym).to_owned(),
            None => print::to_string(image, &tag, false),
        })
        .collect();
    let tags = format!("({})", names.join(" "));
    let text = args[2].as_text().unwrap_or_default();
    simulation.log(image, level, &tags, &text);
    done(Value::NIL)
}

fn ros_time(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    done(simulation.now())
}

fn startup_ros(simulation: &mut Simulation, image: &mut Image, _: &[Value]) -> Result<Reply> {
    simulation.restart();
    let text =
        "The robot and the kitchen are simulated in this process: there is nothing to start.";
    simulation.log(image, LogLevel::Info, "(ROSLISP TOP)", text);
    done(Value::NIL)
}

fn shutdown_ros(simulation: &mut Simulation, image: &mut Image, _: &[Value]) -> Result<Reply> {
    let text = "There is nothing to stop; (quit) leaves the shell.";
    simulation.log(image, LogLevel::Info, "(ROSLISP TOP)", text);
    done(Value::NIL)
}

fn load_system(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = print::to_string(image, &args[0], false);
    let text = format!("{name} is built in: there is nothing to load.");
    simulation.log(image, LogLevel::Info, "(ROS-LOAD LOAD-SYSTEM)", &text);
    done(Value::T)
}
