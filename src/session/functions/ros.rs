//! What CRAM uses from ROS: log lines, start-up, loading of systems.

use crate::log_level::LogLevel;
use crate::plans::{DEMO_SYSTEMS, demo_text};
use crate::simulation::Simulation;
use cram::designator::names::{name_text, rosify};
use cram::package_table::{PACKAGES, STAND_INS};
use cram::packages;
use lisp::builtin::Builtin;
use lisp::builtins::loading::load_text;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::visible::visible;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `ROSLISP`.
pub(crate) static LOG_TABLE: &[Builtin] = builtins![log_line, ros_time];

/// Builtins of package `ROSLISP-UTILITIES`.
pub(crate) static UTILITIES_TABLE: &[Builtin] = builtins![startup_ros, shutdown_ros];

/// What the loader of systems, which is written in Lisp, asks: builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    load_built_in_system,
    built_in_system_p,
    without_files_p,
    built_in_systems,
    built_in_files,
    load_built_in_file
];

/// Systems that are built in and have no package of their name.
const OTHER_SYSTEMS: [&str; 19] = [
    "alexandria",
    "cl_tf",
    "cl_tf2",
    "cl_urdf",
    "closer_mop",
    // Locations are sampled and tested in the world itself, without costmaps.
    "cram_btr_spatial_relations_costmap",
    "cram_btr_visibility_costmap",
    "cram_common_failures",
    "cram_fetch_deliver_plans",
    "cram_language",
    "cram_occupancy_grid_costmap",
    "cram_pr2_description",
    "cram_pr2_environment_manipulation",
    "cram_pr2_projection_reasoning",
    "cram_robot_pose_gaussian_costmap",
    "cram_urdf_environment_manipulation",
    "lisp_unit",
    "trivial_garbage",
    "trivial_gray_streams",
];

/// Systems of which only the packages are built in. Their files may be in a folder of the user.
const WITHOUT_FILES: [&str; 2] = ["cram_beginner_tutorial", "cram_bullet_world_tutorial"];

/// Packages that stand for no system that is built in.
const NO_SYSTEMS: [&str; 5] = [
    "ASDF-USER",
    "CRAM-PR2-ENVIRONMENT-MANIPULATION",
    "PLANWRIGHT",
    "QUICKLISP-CLIENT",
    "SWANK",
];

/// The names of the systems that are built in, as ROS writes them.
///
/// `(first (system:built-in-systems))` => `"alexandria"`
#[builtin]
fn built_in_systems() -> Vec<String> {
    let names = PACKAGES.iter().map(|package| package.name);
    let mut systems: Vec<String> = names
        .filter(|name| !NO_SYSTEMS.contains(name) && !STAND_INS.contains(name))
        .map(rosify)
        .chain(OTHER_SYSTEMS.map(str::to_owned))
        .chain(DEMO_SYSTEMS.iter().map(|(name, _)| (*name).to_owned()))
        .collect();
    systems.sort_unstable();
    systems
}

/// Puts folders at the front of those in which systems are looked for.
pub(crate) fn name_system_folders(image: &mut Image, folders: &[String]) {
    let registry = packages::symbol(image, "ASDF", "*CENTRAL-REGISTRY*");
    let folders = folders.iter().map(|folder| Value::string(folder.as_str()));
    image.set_special(registry, Value::list(folders));
}

impl Simulation {
    /// Writes a log line: `[(TAG …) LEVEL] seconds: text`.
    pub(crate) fn log(&self, image: &mut Image, level: LogLevel, tags: &str, text: &str) {
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
        // Several lines are one message to who follows the session.
        image.output.begin_piece();
        image.output.write(&visible(&line));
        image.output.begin_piece();
    }
}

/// Writes a log line.
#[builtin]
fn log_line(
    simulation: &mut Simulation,
    image: &mut Image,
    level: &Value,
    tags: &Value,
    text: &Value,
) {
    let level = match level.as_symbol().map(|s| image.name(s)) {
        Some("DEBUG") => LogLevel::Debug,
        Some("WARN") => LogLevel::Warn,
        Some("ERROR" | "FATAL") => LogLevel::Error,
        _ => LogLevel::Info,
    };
    // Tags are printed without their packages.
    let names: Vec<String> = tags
        .iter_list()
        .map(|tag| match tag.as_symbol() {
            Some(sym) => image.name(sym).to_owned(),
            None => print::to_string(image, &tag, false),
        })
        .collect();
    let tags = format!("({})", names.join(" "));
    let text = text.as_text().unwrap_or_default();
    simulation.log(image, level, &tags, &text);
}

/// Simulated time in seconds.
#[builtin]
fn ros_time(simulation: &mut Simulation) -> f64 {
    simulation.now()
}

/// Nothing to start: the robot is here already. Takes the world back to its start.
///
/// `(roslisp-utilities::%startup-ros)` => `NIL`
#[builtin("%STARTUP-ROS", edit)]
fn startup_ros(simulation: &mut Simulation, image: &mut Image) {
    simulation.restart();
    let text =
        "The robot and the kitchen are simulated in this process: there is nothing to start.";
    simulation.log(image, LogLevel::Info, "(ROSLISP TOP)", text);
}

/// Nothing to stop.
#[builtin("%SHUTDOWN-ROS")]
fn shutdown_ros(simulation: &mut Simulation, image: &mut Image) {
    let text = "There is nothing to stop; (quit) leaves the shell.";
    simulation.log(image, LogLevel::Info, "(ROSLISP TOP)", text);
}

/// Is a system of this name built in?
///
/// `(system:built-in-system-p :cram-language)` => `T`
#[builtin]
fn built_in_system_p(image: &Image, system: &Value) -> bool {
    // The name may be written as in ROS or as in Lisp.
    name_text(image, system).is_some_and(|name| built_in_systems().contains(&rosify(&name)))
}

/// Is only the package of a system built in?
///
/// `(system:without-files-p :cram-language)` => `NIL`
#[builtin]
fn without_files_p(image: &Image, system: &Value) -> bool {
    name_text(image, system).is_some_and(|name| WITHOUT_FILES.contains(&rosify(&name).as_str()))
}

/// The names of the files of plans that a system consists of which is built in.
///
/// `(system:built-in-files :cram-language)` => `NIL`
#[builtin]
fn built_in_files(image: &Image, system: &Value) -> Value {
    let name = name_text(image, system).map(|name| rosify(&name));
    let files = DEMO_SYSTEMS
        .iter()
        .find(|(system, _)| name.as_deref() == Some(system))
        .map_or(&[][..], |(_, files)| files);
    Value::list(files.iter().map(|file| Value::from(*file)))
}

/// Says that there is nothing to load, if a system is built in; else `NIL`.
///
/// `(system:load-built-in-system "cram_language")` => `T`
#[builtin]
fn load_built_in_system(simulation: &mut Simulation, image: &mut Image, system: &Value) -> bool {
    let is_built_in = built_in_system_p(image, system);
    if is_built_in {
        let shown = print::to_string(image, system, false);
        let (level, text) = match without_files_p(image, system) {
            true => (
                LogLevel::Warn,
                format!(
                    "{shown}: of this tutorial only the package is here, not its files. --systems FOLDER or (push \"FOLDER/\" asdf:*central-registry*) loads them from CRAM's sources."
                ),
            ),
            false => (
                LogLevel::Info,
                format!("{shown} is built in: there is nothing to load."),
            ),
        };
        simulation.log(image, level, "(ROS-LOAD LOAD-SYSTEM)", &text);
    }
    is_built_in
}

/// Evaluates all forms of a file of plans that is built in.
#[builtin]
fn load_built_in_file(machine: &mut Machine<'_>, file: &Value) -> Result<Step> {
    let name = file.as_text().unwrap_or_default();
    match demo_text(&name) {
        Some(text) => load_text(machine, &name, text),
        None => Err(Raise::simple(format!("No file {name:?} is built in."))),
    }
}
