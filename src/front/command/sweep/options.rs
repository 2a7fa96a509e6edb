//! The arguments of `planwright sweep`.

use std::num::{NonZeroU64, NonZeroUsize};
use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::engine::Engine;
use super::heat_map::HeatMap;
use crate::command::options::seconds;

/// How to run a sweep.
#[derive(Args, Debug)]
#[command(group(ArgGroup::new("compared").args(["compare", "compare_robot"]).multiple(true)))]
#[command(group(ArgGroup::new("folder").args(["into", "resume"]).multiple(true)))]
#[command(group(ArgGroup::new("shrinkable").args(["file", "report"]).multiple(true)))]
pub(crate) struct SweepOptions {
    /// File with plans and a sweep
    #[arg(value_name = "FILE", required_unless_present_any = ["into", "status", "resume", "report"])]
    pub(crate) file: Option<PathBuf>,
    /// Which sweep, if the file defines several [default: the last one]
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// How many worlds [default: as many as the sweep says]
    #[arg(long, value_name = "N")]
    pub(crate) worlds: Option<NonZeroU64>,
    /// Real time that each world may take; one that takes longer is given up and counted as
    /// timeout
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) time_limit: Option<f64>,
    /// How many worlds to run at the same time [default: the number of processors]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
    /// Print the records, one line of JSON for each world, instead of the summary
    #[arg(long)]
    pub(crate) json: bool,
    /// Stop at 200, 400, 800 … worlds if the interval of the rate is at most WIDTH wide
    #[arg(long, value_name = "WIDTH", conflicts_with = "into")]
    pub(crate) until_width: Option<f64>,

    /// Open the prompt in world I, where (run-sweep-world) runs the plan
    #[arg(long, value_name = "I", requires = "file")]
    pub(crate) replay: Option<u64>,
    /// With --replay: run the plan there instead, and show what it prints
    #[arg(long, requires = "replay")]
    pub(crate) run: bool,
    /// Find the simplest world, in the simplest kitchen, in which the plan fails as in world I; with
    /// --report FOLDER, as in world I of the sweep there
    #[arg(long, value_name = "I", requires = "shrinkable", conflicts_with_all = ["replay", "into"])]
    pub(crate) shrink: Option<u64>,
    /// Run the sweep of another file in the same worlds: which plan is better?
    #[arg(long, value_name = "OTHER", requires = "file", conflicts_with_all = ["into", "until_width"])]
    pub(crate) compare: Option<PathBuf>,
    /// Run the sweep with another robot in the same worlds, one that comes with planwright or a URDF:
    /// which robot succeeds more often? With --compare, the other plan runs with it
    #[arg(long, value_name = "ROBOT", requires = "file", conflicts_with_all = ["into", "until_width"])]
    pub(crate) compare_robot: Option<PathBuf>,
    /// With --compare-robot: what the links and joints of a robot of one's own are for
    #[arg(long, value_name = "FILE", requires = "compare_robot")]
    pub(crate) compare_robot_description: Option<PathBuf>,
    /// With --compare: stop at 200, 400, 800 … worlds if it is decided which plan is better
    #[arg(long, requires = "compared")]
    pub(crate) until_decided: bool,
    /// Record worlds that fail into MCAP files in a folder
    #[arg(long, value_name = "FOLDER", requires = "file")]
    pub(crate) record_failures: Option<PathBuf>,
    /// How many failing worlds to record at most
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub(crate) most: usize,

    /// Write the records, and what was performed in each world, into a folder of which `planwright ask` answers
    /// questions
    #[arg(long, value_name = "FOLDER", requires = "file", conflicts_with_all = ["into", "compared", "replay", "shrink", "until_width"])]
    pub(crate) episodes: Option<PathBuf>,
    /// Write the records as a table
    #[arg(long, value_name = "CSV")]
    pub(crate) csv: Option<PathBuf>,
    /// Write a test report
    #[arg(long, value_name = "XML")]
    pub(crate) junit: Option<PathBuf>,
    /// Write a page with the summary and the worlds that failed
    #[arg(long, value_name = "HTML")]
    pub(crate) html: Option<PathBuf>,
    /// Draw where the plan works, over two draws: bottle.x,bottle.y=map.png
    #[arg(long, value_name = "X,Y=PNG")]
    pub(crate) heat_map: Option<HeatMap>,

    /// Folder for the records. What is there already is not done again; without FILE: does a shard of the
    /// sweep that is there
    #[arg(long, value_name = "FOLDER")]
    pub(crate) into: Option<PathBuf>,
    /// Into how many shards to divide the worlds [default: one for 20 worlds]
    #[arg(long, value_name = "K", requires = "into")]
    pub(crate) shards: Option<NonZeroU64>,
    /// Do only shard I of K [default without FILE: the index that Slurm, HyperQueue or Kubernetes tells]
    #[arg(long, value_name = "I/K", requires = "into")]
    pub(crate) shard: Option<String>,
    /// What to add to the index that the engine tells
    #[arg(long, value_name = "N", hide = true, default_value_t = 0)]
    pub(crate) shard_offset: u64,
    /// Run one world and print its record
    #[arg(long, value_name = "I", hide = true, requires = "into")]
    pub(crate) world_of_shard: Option<u64>,
    /// Have an engine do the missing shards, as a job array
    #[arg(long, value_name = "ENGINE", requires = "folder")]
    pub(crate) engine: Option<Engine>,
    /// Tell which shards of the sweep in the folder are there
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["file", "into"])]
    pub(crate) status: Option<PathBuf>,
    /// Do what is missing of the sweep in the folder
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["file", "into", "status"])]
    pub(crate) resume: Option<PathBuf>,
    /// Tell what the sweep in the folder says so far
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["file", "into", "status", "resume"])]
    pub(crate) report: Option<PathBuf>,
    /// With --engine: arguments for the engine, such as --partition=short
    #[arg(last = true, value_name = "ENGINE-ARGUMENTS", requires = "engine")]
    pub(crate) engine_arguments: Vec<String>,
}

impl SweepOptions {
    /// Whether another plan or another robot runs in the same worlds.
    pub(crate) fn is_comparison(&self) -> bool {
        self.compare.is_some() || self.compare_robot.is_some()
    }
}
