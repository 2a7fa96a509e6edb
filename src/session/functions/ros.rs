//! What CRAM uses from ROS: log lines, start-up, loading of systems.

use crate::closest_name::closest_name;
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::plan::Reply;
use crate::plan::designator::names::{name_text, rosify};
use crate::plan::packages::PACKAGES;
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
    "Nothing to load: the systems that there are, are built in. An error names them if there is no such system.",
    &["(ros-load:load-system \"cram_pick_place_tutorial\") => T"],
    host!(load_system),
)];

/// Builtins of package `ASDF`.
pub(crate) static ASDF_TABLE: &[Builtin] = &[control(
    "LOAD-SYSTEM",
    "system &rest options",
    "The same as ROS-LOAD:LOAD-SYSTEM.",
    &["(asdf:load-system :cram-language) => T"],
    host!(load_system),
)];

/// Builtins of package `QUICKLISP-CLIENT`.
pub(crate) static QUICKLISP_TABLE: &[Builtin] = &[control(
    "QUICKLOAD",
    "systems &rest options",
    "The same as ROS-LOAD:LOAD-SYSTEM, for a system or a list of them.",
    &["(ql:quickload '(:cram-language :alexandria)) => T"],
    host!(load_system),
)];

/// Systems that are built in and have no package of their name.
const OTHER_SYSTEMS: [&str; 4] = [
    "alexandria",
    "cram_common_failures",
    "cram_language",
    "cram_pr2_description",
];

/// Packages that stand for no system that is built in.
const NO_SYSTEMS: [&str; 6] = [
    "ASDF",
    "CRAM-PR2-ENVIRONMENT-MANIPULATION",
    "CRAM-PR2-PICK-PLACE-DEMO",
    "PLANWRIGHT",
    "QUICKLISP-CLIENT",
    "SWANK",
];

/// The names of the systems that are built in, as ROS writes them.
fn systems() -> Vec<String> {
    let names = PACKAGES.iter().map(|package| package.name);
    let mut systems: Vec<String> = names
        .filter(|name| !NO_SYSTEMS.contains(name))
        .map(rosify)
        .chain(OTHER_SYSTEMS.map(str::to_owned))
        .collect();
    systems.sort_unstable();
    systems
}

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
    let systems = systems();
    let wanted: Vec<Value> = match &args[0] {
        Value::Cons(_) => args[0].iter_list().collect(),
        single => vec![single.clone()],
    };
    for system in wanted {
        let Some(name) = name_text(image, &system) else {
            return Err(Raise::type_error(&system, known::SYMBOL));
        };
        let name = rosify(&name);
        if !systems.contains(&name) {
            return Err(Raise::simple(format!(
                "There is no system {}{} These are built in: {}. A file of your own is loaded by (load \"file.plan\").",
                print::to_string(image, &system, true),
                match closest_name(&name, systems.iter().map(String::as_str)) {
                    Some(near) => format!("; did you mean {near}?"),
                    None => ".".to_owned(),
                },
                systems.join(", ")
            )));
        }
        let shown = print::to_string(image, &system, false);
        let text = format!("{shown} is built in: there is nothing to load.");
        simulation.log(image, LogLevel::Info, "(ROS-LOAD LOAD-SYSTEM)", &text);
    }
    done(Value::T)
}
