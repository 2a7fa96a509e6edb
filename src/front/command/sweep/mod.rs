//! Runs sweeps: one plan in many worlds, on all processors.

mod file;
mod options;
mod pool;
mod progress;
mod replay;
mod worlds;

use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::thread;

use super::arguments::Options;
use super::failure::{CommandError, Status};
use crate::sweep::Record;
use crate::sweep::influence::Influence;
use crate::sweep::summary::{Summary, Title};
use file::SweepFile;
pub(crate) use options::SweepOptions;
use progress::Progress;
use worlds::Worlds;

/// Runs the sweep, or one of its worlds.
pub(crate) fn sweep(options: Options, wanted: &SweepOptions) -> Result<Status, CommandError> {
    let file = SweepFile::read(&wanted.file)?;
    if let Some(world) = wanted.replay {
        return replay::replay(options, wanted, &file, world);
    }
    let (worlds, known) = Worlds::open(&options, file, wanted.name.as_deref())?;
    let count = wanted.worlds.map_or(known.worlds, |count| count.get());
    let title = Title {
        name: known.name,
        seed: options.seed,
        goal: known.goal,
    };
    let threads = wanted
        .threads
        .or_else(|| thread::available_parallelism().ok());
    let threads = threads.map_or(1, |threads| threads.get());
    let mut progress = Progress::new(&title, count);
    let numbers: Vec<u64> = (0..count).collect();
    let records = pool::in_order(
        threads,
        &numbers,
        |world| worlds.run(*world, &[]),
        |record| progress.record(record),
    );
    progress.end();
    if let Some(folder) = &wanted.into {
        write_records(folder, &records)?;
    }
    let mut out = io::BufWriter::new(io::stdout());
    if wanted.json {
        for record in &records {
            writeln!(out, "{}", record.line())?;
        }
        out.flush()?;
    }
    let summary = Summary::new(&title, &records);
    if !wanted.json {
        write!(out, "{summary}{}", Influence::of(&records))?;
        out.flush()?;
    }
    Ok(match summary.meets_goal() {
        true => Status::Good,
        false => Status::Bad,
    })
}

/// Writes the records into a folder, which is made if necessary: all of them or none.
fn write_records(folder: &Path, records: &[Record]) -> Result<(), CommandError> {
    let mut text = String::new();
    for record in records {
        text.push_str(&record.line());
        text.push('\n');
    }
    let path = folder.join("records.jsonl");
    let unfinished = folder.join("records.jsonl.tmp");
    fs::create_dir_all(folder)
        .and_then(|()| fs::write(&unfinished, text))
        .and_then(|()| fs::rename(&unfinished, &path))
        .map_err(|error| CommandError::Rewrite { path, error })
}
