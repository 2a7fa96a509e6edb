//! Runs sweeps: one plan in many worlds, on all processors or on many machines.

mod compare;
mod engine;
mod episodes;
mod file;
mod heat_map;
mod interrupt;
mod job;
mod kept;
mod options;
pub(super) mod pool;
mod progress;
mod replay;
mod shrink;
pub(super) mod worker;
mod worlds;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::command::failure::{CommandError, Status};
use crate::command::options::Options;
use crate::command::outputs::Outputs;
use crate::sweep_report;
use compare::compare;
use descriptions::ROBOTS;
use episodes::Episodes;
use file::sweep_file;
use heat_map::HeatMap;
#[cfg(any(test, fuzzing))]
pub(crate) use job::texts;
use job::{Job, lines, write_whole};
use kept::Kept;
use kitchens::KitchenTable;
use lisp::visible::visible;
pub(crate) use options::SweepOptions;
use progress::Progress;
use session::sweeping::{Known, SweepFile};
use sweep::influence::Influence;
use sweep::paired::{error_at_look, is_narrow};
use sweep::summary::{CONFIDENCE, Summary, Title};
use sweep::{Ending, Record};
use worlds::{Worlds, sound};

/// Runs the sweep, one of its worlds or one of its shards, or tells how far it has got.
pub(crate) fn sweep(options: Options, wanted: &SweepOptions) -> Result<Status, CommandError> {
    if options.closed {
        return Err(CommandError::Sweep(
            "a sweep draws its worlds, which --closed would refuse".to_owned(),
        ));
    }
    let threads = wanted.threads.map_or_else(worker::threads, usize::from);
    check_outputs(&options, wanted)?;
    if let Some(folder) = &wanted.status {
        return status(&Job::open(folder)?);
    }
    if let Some(folder) = &wanted.report {
        let job = Job::open(folder)?;
        tell_damage(&job)?;
        if let Some(world) = wanted.shrink {
            shrink_of_job(&options, &job, world, threads)?;
            return Ok(Status::Good);
        }
        return report_job(&job, wanted, None);
    }
    if let Some(folder) = &wanted.resume {
        let job = Job::open(folder)?;
        tell_damage(&job)?;
        if let Some(engine) = wanted.engine {
            return submit(engine, &job, threads, wanted);
        }
        interrupt::expect();
        // Whether this is the same program is checked before anything is begun.
        job.file()?;
        worker::apart(&job, threads)?;
        return report_job(&job, wanted, None);
    }
    match (&wanted.file, &wanted.into) {
        (Some(path), into) => {
            let file = sweep_file(path)?;
            if let Some(world) = wanted.replay {
                return replay::replay(options, wanted, &file, world);
            }
            match into {
                None => in_memory(&options, wanted, file, threads),
                Some(folder) => into_folder(&options, wanted, file, folder, threads),
            }
        }
        (None, Some(folder)) => work(&options, wanted, folder, threads),
        (None, None) => Err(no_file()),
    }
}

fn no_file() -> CommandError {
    CommandError::Sweep("a file was expected".to_owned())
}

/// The options of what is compared with: another robot, if one is wanted.
fn other_options(options: &Options, wanted: &SweepOptions) -> Options {
    let mut others = options.clone();
    if let Some(robot) = &wanted.compare_robot {
        others.robot = Some(robot.clone());
        others.robot_description = wanted.compare_robot_description.clone();
    }
    others
}

/// What reports call the two that are compared: their files if these are two, and their robots if those
/// are.
fn names_of_compared(
    options: [&Options; 2],
    wanted: &SweepOptions,
    files: [&str; 2],
) -> [String; 2] {
    let robots = options.map(|options| match &options.robot {
        Some(robot) => robot.display().to_string(),
        None => ROBOTS[0].name.to_owned(),
    });
    let [first, second] = files;
    match (&wanted.compare, &wanted.compare_robot) {
        (_, None) => [first.to_owned(), second.to_owned()],
        (None, Some(_)) => robots,
        (Some(_), Some(_)) => {
            let [one, other] = &robots;
            [
                format!("{first} with {one}"),
                format!("{second} with {other}"),
            ]
        }
    }
}

/// An error if anything that is written would destroy what is read, or cannot be written.
fn check_outputs(options: &Options, wanted: &SweepOptions) -> Result<(), CommandError> {
    let jobs = [&wanted.into, &wanted.resume, &wanted.report, &wanted.status];
    let jobs = jobs.into_iter().flatten();
    let of_jobs: Vec<PathBuf> = jobs.flat_map(|folder| job::files(folder)).collect();
    let files = [
        &wanted.file,
        &wanted.compare,
        &wanted.compare_robot,
        &wanted.compare_robot_description,
    ];
    let files = files.into_iter().flatten();
    let heat_map = wanted.heat_map.as_ref().map(|heat_map| &heat_map.path);
    Outputs::reading(files.chain(options.files()).chain(&of_jobs))
        .file("--csv", wanted.csv.as_ref())
        .file("--junit", wanted.junit.as_ref())
        .file("--html", wanted.html.as_ref())
        .file("--heat-map", heat_map)
        .folder("--record-failures", wanted.record_failures.as_ref())
        .folder("--episodes", wanted.episodes.as_ref())
        .check()
}

fn title(options: &Options, known: &Known) -> Title {
    Title {
        name: known.name.clone(),
        seed: options.seed,
        goal: known.goal,
    }
}

/// Runs the sweep and keeps nothing but what is asked for.
fn in_memory(
    options: &Options,
    wanted: &SweepOptions,
    file: SweepFile,
    threads: usize,
) -> Result<Status, CommandError> {
    let file_name = file.name.clone();
    let (worlds, known) = Worlds::open(options, file, wanted.name.as_deref())?;
    let worlds = worlds.within(wanted.time_limit);
    let title = title(options, &known);
    if let Some(world) = wanted.shrink {
        shrink::shrink(&worlds, &known.name, options.seed, world, threads)?;
        return Ok(Status::Good);
    }
    interrupt::expect();
    let count = wanted.worlds.map_or(known.worlds, |count| count.get());
    if wanted.is_comparison() {
        let path = wanted.compare.as_ref().or(wanted.file.as_ref());
        let other = sweep_file(path.ok_or_else(no_file)?)?;
        let other_options = other_options(options, wanted);
        let files = [file_name.as_str(), &other.name];
        let [first, second] = names_of_compared([options, &other_options], wanted, files);
        let (others, known) = Worlds::open(&other_options, other, wanted.name.as_deref())?;
        let others = others.within(wanted.time_limit);
        let plans = [
            (&worlds, first, title),
            (&others, second, self::title(options, &known)),
        ];
        let compared = compare(plans, count, threads, wanted.until_decided);
        compared.tell()?;
        let [first, second] = &compared.sides;
        write_all(wanted, &first.title, &first.records, Some(&worlds))?;
        let summary = Summary::new(&second.title, &second.records);
        let defects = Summary::new(&first.title, &first.records).defects();
        return Ok(match ending(&summary, compared.wanted(count)) {
            Status::Good | Status::Bad if defects > 0 => Status::Defective,
            status => status,
        });
    }
    let records = match &wanted.episodes {
        Some(folder) => run_into_episodes(&worlds, &title, count, threads, folder)?,
        None => run(&worlds, &title, count, threads, wanted.until_width),
    };
    let records = sound(records)?;
    let count = match wanted.until_width {
        Some(_) if !interrupt::has_come() => records.len() as u64,
        _ => count,
    };
    report(wanted, &title, &records, count, Some(&worlds))
}

/// Runs worlds until all are done or an interrupt comes, and writes what was performed, world by world.
fn run_into_episodes(
    worlds: &Worlds,
    title: &Title,
    count: u64,
    threads: usize,
    folder: &Path,
) -> Result<Vec<Record>, CommandError> {
    let mut episodes = Episodes::begin(folder)?;
    let mut progress = Progress::new(title, count);
    let mut kept = Kept::default();
    let mut failed = None;
    let runs = pool::in_order(
        threads,
        0..count,
        || worlds.telling_runner(),
        |(record, performed)| {
            progress.record(record);
            if let Err(error) = episodes.add(record, performed) {
                failed = Some(error);
            }
            let is_sound = record.outcome != Ending::Mistake;
            kept.keep(record) && is_sound && failed.is_none() && !interrupt::has_come()
        },
    );
    progress.end();
    kept.tell_if_full();
    match failed {
        Some(error) => Err(error),
        None => Ok(runs.into_iter().map(|(record, _)| record).collect()),
    }
}

/// Runs worlds until all are done, an interrupt comes, or the interval of the rate is narrow enough.
fn run(
    worlds: &Worlds,
    title: &Title,
    count: u64,
    threads: usize,
    width: Option<f64>,
) -> Vec<Record> {
    let mut progress = Progress::new(title, count);
    let mut kept = Kept::default();
    let (mut tried, mut worked) = (0, 0);
    let records = pool::in_order(
        threads,
        0..count,
        || worlds.runner(),
        |record| {
            tried += usize::from(record.outcome.counts());
            worked += usize::from(record.is_success());
            let error = error_at_look(record.world + 1, 1.0 - CONFIDENCE);
            let is_enough = width
                .zip(error)
                .is_some_and(|(width, error)| is_narrow(worked, tried, error, width));
            let is_sound = record.outcome != Ending::Mistake;
            progress.record(record);
            kept.keep(record) && is_sound && !is_enough && !interrupt::has_come()
        },
    );
    progress.end();
    kept.tell_if_full();
    records
}

/// Runs the sweep, or a shard of it, into a folder.
fn into_folder(
    options: &Options,
    wanted: &SweepOptions,
    file: SweepFile,
    folder: &Path,
    threads: usize,
) -> Result<Status, CommandError> {
    let is_special = options.world.is_some()
        || options.world_description.is_some()
        || options.robot.is_some()
        || options.robot_description.is_some()
        || options.objects.is_some()
        || options.noise.is_some()
        || options.faithful
        || !options.systems.is_empty()
        || !options.setup.is_empty();
    if is_special {
        return Err(CommandError::Sweep(
            "--into keeps the file and the seed of a sweep, but not --world, --robot, --objects, \
             --noise, --faithful, --systems or --setup: leave them out, or leave out --into"
                .to_owned(),
        ));
    }
    let (worlds, known) = Worlds::open(options, file.clone(), wanted.name.as_deref())?;
    let worlds = worlds.within(wanted.time_limit);
    let title = title(options, &known);
    let count = wanted.worlds.map_or(known.worlds, |count| count.get());
    let shard = wanted.shard.as_deref().map(shard_of).transpose()?;
    let shards = shard.map(|(_, of)| of).or(wanted.shards.map(|of| of.get()));
    let job = Job::prepare(folder, &file, &title, count, shards, wanted.time_limit)?;
    if let Some((shard, _)) = shard {
        return worker::shard(options, &job, shard, threads);
    }
    if let Some(engine) = wanted.engine {
        return submit(engine, &job, threads, wanted);
    }
    interrupt::expect();
    tell_damage(&job)?;
    worker::all(&job, &worlds, threads)?;
    report_job(&job, wanted, Some(&worlds))
}

/// Finds the simplest world that fails as one of a sweep in a folder.
fn shrink_of_job(
    options: &Options,
    job: &Job,
    world: u64,
    threads: usize,
) -> Result<(), CommandError> {
    if world >= job.plan.worlds {
        return Err(CommandError::Sweep(format!(
            "the sweep in {} has worlds 0 to {}, not {world}",
            job.folder.display(),
            job.plan.worlds.saturating_sub(1)
        )));
    }
    let records = job.records();
    // Whether a world works is known without running it again.
    if let Some(record) = records.iter().find(|record| record.world == world) {
        shrink::check_failure(record)?;
    }
    let worlds = worker::open(options, job)?;
    shrink::shrink(&worlds, &job.plan.name, job.plan.seed, world, threads)
}

/// Does a shard of the sweep that is in the folder.
fn work(
    options: &Options,
    wanted: &SweepOptions,
    folder: &Path,
    threads: usize,
) -> Result<Status, CommandError> {
    let job = Job::open(folder)?;
    if let Some(world) = wanted.world_of_shard {
        let record = worker::one_world(options, &job, world)?;
        writeln!(io::stdout(), "{}", record.line())?;
        return Ok(Status::Good);
    }
    let shard = match &wanted.shard {
        Some(text) => {
            let (shard, of) = shard_of(text)?;
            if of != job.plan.shards {
                return Err(CommandError::Sweep(format!(
                    "the sweep in {} has {} shards, not {of}",
                    folder.display(),
                    job.plan.shards
                )));
            }
            shard
        }
        None => worker::index_of_engine()
            .and_then(|index| index.checked_add(wanted.shard_offset))
            .ok_or_else(|| {
                CommandError::Sweep(format!(
                    "which shard? --shard I/{} says, or an engine; --resume {} does all that are \
                     missing",
                    job.plan.shards,
                    folder.display()
                ))
            })?,
    };
    worker::shard(options, &job, shard, threads)
}

/// The two numbers of `I/K`.
fn shard_of(text: &str) -> Result<(u64, u64), CommandError> {
    let numbers = text.split_once('/');
    let numbers = numbers.and_then(|(i, k)| Some((i.parse().ok()?, k.parse().ok()?)));
    numbers.filter(|(i, k)| i < k).ok_or_else(|| {
        CommandError::Sweep(format!(
            "{text:?} is no shard: I/K was expected, as in 3/50, with I from 0 to K - 1"
        ))
    })
}

fn submit(
    engine: engine::Engine,
    job: &Job,
    threads: usize,
    wanted: &SweepOptions,
) -> Result<Status, CommandError> {
    let said = engine.submit(job, threads, &wanted.engine_arguments)?;
    write!(io::stdout(), "{said}")?;
    Ok(Status::Good)
}

/// Tells which shards are there.
fn status(job: &Job) -> Result<Status, CommandError> {
    let missing = job.missing();
    let shards = job.plan.shards;
    let lacking: u64 = missing.iter().map(|shard| job.count_of(*shard)).sum();
    let mut out = io::stdout();
    writeln!(
        out,
        "{}: {} of {shards} shards are there, {} worlds of {}",
        visible(&job.plan.name),
        shards - missing.len() as u64,
        job.plan.worlds - lacking,
        job.plan.worlds
    )?;
    if missing.is_empty() {
        return Ok(Status::Good);
    }
    for line in job.damaged(&missing) {
        writeln!(out, "{}", visible(&line))?;
    }
    writeln!(out, "missing: {}", engine::ranges(&missing))?;
    Ok(Status::Incomplete)
}

/// Tells on standard error which shards are damaged; they count as missing.
fn tell_damage(job: &Job) -> io::Result<()> {
    for line in job.damaged(&job.missing()) {
        writeln!(io::stderr(), "{}", visible(&line))?;
    }
    Ok(())
}

/// Merges what is there and tells what it says.
fn report_job(
    job: &Job,
    wanted: &SweepOptions,
    worlds: Option<&Worlds>,
) -> Result<Status, CommandError> {
    let records = job.merge()?;
    report(wanted, &job.title(), &records, job.plan.worlds, worlds)
}

/// Tells what the records say, and writes what is asked for; `count` is how many there should be.
/// Failures are recorded in `worlds`.
fn report(
    wanted: &SweepOptions,
    title: &Title,
    records: &[Record],
    count: u64,
    worlds: Option<&Worlds>,
) -> Result<Status, CommandError> {
    let summary = Summary::new(title, records);
    let mut out = io::BufWriter::new(io::stdout());
    if wanted.json {
        write!(out, "{}", lines(records))?;
    } else {
        let kitchens = KitchenTable::of(records).map(|table| table.to_string());
        let text = format!(
            "{summary}{}{}",
            Influence::of(records),
            kitchens.unwrap_or_default()
        );
        out.write_all(visible(&text).as_bytes())?;
        if (records.len() as u64) < count {
            writeln!(
                out,
                "{} of {count} worlds are missing",
                count - records.len() as u64
            )?;
        }
    }
    out.flush()?;
    write_all(wanted, title, records, worlds)?;
    Ok(ending(&summary, count))
}

fn ending(summary: &Summary<'_>, count: u64) -> Status {
    if summary.count() < count {
        return Status::Incomplete;
    }
    if summary.defects() > 0 {
        return Status::Defective;
    }
    match summary.meets_goal() {
        true => Status::Good,
        false => Status::Bad,
    }
}

/// Writes all that is asked for. What cannot be written is told at the end.
fn write_all(
    wanted: &SweepOptions,
    title: &Title,
    records: &[Record],
    worlds: Option<&Worlds>,
) -> Result<(), CommandError> {
    let mut unwritten = Vec::new();
    let mut write = |path: &Option<PathBuf>, text: &dyn Fn() -> String| {
        let written = path
            .as_ref()
            .map(|path| write_whole(path, text().as_bytes()));
        unwritten.extend(written.and_then(Result::err));
    };
    write(&wanted.csv, &|| sweep_report::csv(records));
    write(&wanted.junit, &|| sweep_report::junit(title, records));
    let file = wanted.file.as_ref();
    let file = file.map_or_else(|| "…".to_owned(), |file| file.display().to_string());
    write(&wanted.html, &|| sweep_report::html(title, records, &file));
    unwritten.extend(write_heat_map(wanted, records).err());
    if let (Some(folder), Some(worlds)) = (&wanted.record_failures, worlds) {
        unwritten.extend(record_failures(worlds, records, folder, wanted.most).err());
    }
    match unwritten.len() {
        0 => Ok(()),
        _ => Err(CommandError::Unwritten(unwritten)),
    }
}

fn write_heat_map(wanted: &SweepOptions, records: &[Record]) -> Result<(), CommandError> {
    let Some(HeatMap { axes, path }) = &wanted.heat_map else {
        return Ok(());
    };
    let [x, y] = axes;
    let Some(image) = sweep_report::heat_map(records, [x, y]) else {
        return Err(CommandError::Sweep(format!(
            "{x} and {y} are not two draws whose numbers differ between worlds"
        )));
    };
    write_whole(path, &image.to_png()?)
}

/// Runs failing worlds again and records them.
fn record_failures(
    worlds: &Worlds,
    records: &[Record],
    folder: &Path,
    most: usize,
) -> Result<(), CommandError> {
    fs::create_dir_all(folder).map_err(|error| CommandError::Rewrite {
        path: folder.to_owned(),
        error,
    })?;
    let is_failure = |r: &&Record| r.outcome.counts() && !r.is_success();
    let failed = records
        .iter()
        .filter(is_failure)
        .map(|r| r.world)
        .take(most);
    let failed: Vec<u64> = failed.collect();
    for (at, world) in failed.iter().enumerate() {
        let path: PathBuf = folder.join(format!("world-{world}.mcap"));
        worlds.run_recorded(*world, &path).map_err(|error| {
            let numbers: Vec<String> = failed.iter().skip(at).map(u64::to_string).collect();
            CommandError::Sweep(format!(
                "{error} [not recorded: {} of {} worlds that failed: {}]",
                numbers.len(),
                failed.len(),
                numbers.join(" ")
            ))
        })?;
    }
    Ok(())
}
