//! The options that all commands share.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::heap;
use super::paint::ColorWhen;
use session::is_built_in;

/// Options of all commands.
#[derive(Args, Clone, Debug)]
pub(crate) struct Options {
    /// Seed for everything random
    #[arg(long, global = true, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Kitchen to load (a URDF file, a layout of RoboCasa, or a house of ProcTHOR) instead of the
    /// built-in one, or generated:SEED for one that is drawn from a seed
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) world: Option<PathBuf>,
    /// What the kitchen's furniture is for (in the form of world/kitchen.sexp) [default: with
    /// --world FILE.urdf, a file FILE.sexp beside it]
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) world_description: Option<PathBuf>,
    /// Robot to load instead of the PR2: fetch, or a URDF file
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) robot: Option<PathBuf>,
    /// What the robot's links and joints are for (in the form of world/pr2.sexp), for a robot
    /// whose names are not those of the built-in PR2
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) robot_description: Option<PathBuf>,
    /// Further types of objects (in the form of world/objects.sexp; shapes may be meshes)
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) objects: Option<PathBuf>,
    /// Folder with the packages that a URDF names in package://NAME/…, besides those around the file and
    /// in ROS_PACKAGE_PATH; may be given several times
    #[arg(long, global = true, value_name = "FOLDER")]
    pub(crate) package_path: Vec<PathBuf>,
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
    /// Let no joint move faster than its URDF says: the PR2's torso then takes 23 s for 0.3 m
    #[arg(long, global = true)]
    pub(crate) faithful: bool,
    /// Let what is evaluated use no files and open no ports, and refuse edits of the world, such as
    /// spawn-object: plans can only move the robot, calculate and print
    #[arg(long, global = true)]
    pub(crate) closed: bool,
    /// File to load before the session closes, which may edit the world; may be given several times
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) setup: Vec<PathBuf>,
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

impl Options {
    /// The files that these options name, all of which are read.
    pub(super) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        let files = [
            &self.world,
            &self.world_description,
            &self.robot,
            &self.robot_description,
            &self.objects,
        ];
        let files = files.into_iter().flatten();
        let files = files.filter(|file| !is_built_in(file));
        files.chain(&self.setup)
    }
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

/// A real time (s) that something may take.
pub(super) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.001..=MAX_SECONDS).contains(&seconds) => Ok(seconds),
        _ => Err(format!(
            "expected a time in seconds, from 0.001 to {MAX_SECONDS}"
        )),
    }
}

/// Ten years.
const MAX_SECONDS: f64 = 3.2e8;

fn positive_factor(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(factor) if factor.is_finite() && factor > 0.0 => Ok(factor),
        _ => Err("expected a number greater than zero".to_owned()),
    }
}
