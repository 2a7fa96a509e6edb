//! The process in which a submission runs: it reads what to do, and tells what comes of each world. What a
//! submission prints does not get out of it.

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::lesson_file;
use crate::command::failure::{CommandError, Status, read};
use crate::command::open::open_session;
use crate::command::options::{LogLevel, Options};
use session::dialogue::Finding;
use session::grading::{Allowance, Grader};
use sweep::Mark;

/// Looks for an interrupt that a submission may take in a world: some seconds of pure calculation. One that
/// moves takes some thousands.
const MAX_LOOKS: u64 = 100_000;
/// Bytes that a submission may print in a world.
const MAX_OUTPUT: usize = 1 << 20;
/// Bytes of address space beside the heap: code, stacks, and what the system adds.
#[cfg(target_os = "linux")]
const BESIDE_HEAP: u64 = 4 << 30;

/// What a worker is to do.
#[derive(Serialize, Deserialize)]
pub(super) struct Work {
    pub(super) lesson: PathBuf,
    /// The submission's name in places.
    pub(super) file: String,
    pub(super) text: String,
    pub(super) seed: u64,
    pub(super) from: u64,
    pub(super) to: u64,
    pub(super) wall_clock: Duration,
    /// Whether to tell what `check` finds.
    pub(super) checks: bool,
    /// Where to write the run as a page.
    pub(super) keep: Option<PathBuf>,
}

/// What a worker says, on a line.
#[derive(Serialize, Deserialize)]
pub(super) enum Answer {
    /// What `check` finds.
    Style(Vec<String>),
    /// What came of the next world.
    Mark(Box<Mark>),
    /// That was all.
    Done,
}

/// Does what standard input says.
pub(super) fn work(options: &Options) -> Result<Status, CommandError> {
    let mut text = String::new();
    io::stdin().read_to_string(&mut text)?;
    let work: Work =
        serde_json::from_str(&text).map_err(|error| CommandError::Grade(error.to_string()))?;
    limit_address_space(options);
    let quiet = Options {
        log_level: LogLevel::None,
        ..options.clone()
    };
    let file = lesson_file(&work.lesson)?;
    let mut probe = open_session(&quiet)?;
    let plan = file.load(&mut probe).map_err(CommandError::Grade)?;
    drop(probe);
    let given = plan.given.iter().map(|name| given_file(&work.lesson, name));
    let given: Vec<(String, String)> = given.collect::<Result<_, _>>()?;
    let allowance = Allowance {
        wall_clock: work.wall_clock,
        looks: MAX_LOOKS,
        output: MAX_OUTPUT,
    };
    let session = open_session(&quiet)?;
    let grader = Grader::open(session, &file, &given, allowance).map_err(CommandError::Grade)?;
    if work.checks {
        let findings = grader.check(&work.file, &work.text);
        tell(&Answer::Style(findings.iter().map(said).collect()))?;
    }
    for world in work.from..work.to {
        let keep = work.keep.as_deref();
        let mark = grader.run(&work.file, &work.text, work.seed, world, keep);
        tell(&Answer::Mark(Box::new(mark)))?;
    }
    tell(&Answer::Done)?;
    Ok(Status::Good)
}

fn tell(answer: &Answer) -> Result<(), CommandError> {
    let line =
        serde_json::to_string(answer).map_err(|error| CommandError::Grade(error.to_string()))?;
    let mut out = io::stdout().lock();
    writeln!(out, "{line}")?;
    out.flush()?;
    Ok(())
}

/// A finding with its place, on one line.
fn said(finding: &Finding) -> String {
    let message = finding.message.trim().replace('\n', " ");
    match &finding.place {
        Some(place) => format!("line {}: {message}", place.line),
        None => message,
    }
}

/// A file that a lesson gives, beside the lesson or built in.
fn given_file(lesson: &Path, name: &str) -> Result<(String, String), CommandError> {
    let beside = lesson.parent().map(|folder| folder.join(name));
    let path = beside.filter(|path| path.is_file());
    let path = path.unwrap_or_else(|| PathBuf::from(name));
    Ok((path.display().to_string(), read(&path)?))
}

/// What grows in spite of the limit to the heap ends this process, not the machine's memory.
#[cfg(target_os = "linux")]
fn limit_address_space(options: &Options) {
    use rustix::process::{Resource, Rlimit, setrlimit};
    let bytes = options.heap.unwrap_or(0) as u64 + BESIDE_HEAP;
    let limit = Rlimit {
        current: Some(bytes),
        maximum: Some(bytes),
    };
    // Where that is not allowed, the limit to the heap must do.
    let _ = setrlimit(Resource::As, limit);
}

#[cfg(not(target_os = "linux"))]
fn limit_address_space(_: &Options) {}
