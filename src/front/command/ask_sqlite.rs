//! Writes the facts of a source into one SQLite file. What is read may be larger than memory: it is read line by line.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::process;

use super::failure::{CommandError, Status};
use super::outputs::Outputs;
use super::watching::INTERRUPTED;
use sweep::relations::Relations;
use sweep::sqlite::{Sqlite, SqliteError};
use view::watch::recording::{Wanted, read_episode_of_file};

/// Maximum length (bytes) of a line.
const MAX_LINE: u64 = 1 << 28;

/// Files of an episode, beside the records of a sweep.
const RELATIONS: &[&str] = &[
    "contact", "event", "failure", "log", "object", "param", "robot", "task",
];

/// Writes the facts of a source into a file, and prints what is there.
pub(super) fn write(source: &Path, file: &PathBuf) -> Result<Status, CommandError> {
    let inputs = files(source)?;
    Outputs::reading(&inputs)
        .file("--sqlite", Some(file))
        .check()?;
    permit(file)?;
    let unfinished = beside(file, ".part");
    remove_at_interrupt(unfinished.clone());
    let refused = |error: io::Error| CommandError::Rewrite {
        path: file.clone(),
        error,
    };
    let written = write_into(&unfinished, &inputs).and_then(|counts| {
        fs::rename(&unfinished, file).map_err(refused)?;
        Ok(counts)
    });
    let counts = written.inspect_err(|_| {
        // An error has been reported; what is left of the file is of no use.
        let _ = fs::remove_file(&unfinished);
    })?;
    let width = counts.iter().map(|(name, _)| name.len()).max();
    let mut out = io::stdout().lock();
    for (name, rows) in counts.iter().filter(|(_, rows)| *rows > 0) {
        writeln!(out, "{name:width$}  {rows:>8}", width = width.unwrap_or(0))?;
    }
    Ok(Status::Good)
}

/// Lets Ctrl-C end the program without a file that is half written.
fn remove_at_interrupt(unfinished: PathBuf) {
    // Without a handler the file stays, and its name tells what it is.
    let _ = ctrlc::set_handler(move || {
        let _ = fs::remove_file(&unfinished);
        process::exit(INTERRUPTED);
    });
}

/// A file whose name is that of another one, and an end.
fn beside(file: &Path, end: &str) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(end);
    PathBuf::from(name)
}

/// An error if there is a file already, or what SQLite has left of one, which it would apply to the new one.
fn permit(file: &Path) -> Result<(), CommandError> {
    let is_there = |path: &Path| fs::metadata(path).is_ok_and(|found| found.len() > 0);
    let ends = ["", ".part", "-journal", "-wal"].map(|end| beside(file, end));
    match ends.iter().find(|path| is_there(path)) {
        None => Ok(()),
        Some(path) => Err(CommandError::Ask(format!(
            "{} is there already: delete it, or name another file",
            path.display()
        ))),
    }
}

fn wrong(path: &Path, what: impl std::fmt::Display) -> CommandError {
    CommandError::Ask(format!("{}, {what}", path.display()))
}

/// The files of a source: a file, or those of the folder of a sweep or an episode.
fn files(source: &Path) -> Result<Vec<PathBuf>, CommandError> {
    let found = fs::metadata(source).map_err(|_| {
        CommandError::Ask(format!("There is no file or folder {}.", source.display()))
    })?;
    if !found.is_dir() {
        return Ok(vec![source.to_owned()]);
    }
    let unreadable = |error| CommandError::Read {
        path: source.to_owned(),
        error,
    };
    let mut all = Vec::new();
    for entry in fs::read_dir(source).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|end| end == "jsonl") {
            all.push(path);
        }
    }
    all.sort();
    let named = |test: &dyn Fn(&str) -> bool| -> Vec<PathBuf> {
        let files = all.iter().filter(|path| test(&stem(path)));
        files.cloned().collect()
    };
    let mut records = named(&|name| name == "records");
    if records.is_empty() {
        records = named(&|name| name.starts_with("shard-"));
    }
    records.extend(named(&|name| RELATIONS.contains(&name)));
    match (records.is_empty(), all.is_empty()) {
        (false, _) => Ok(records),
        (true, false) => Ok(all),
        (true, true) => Err(CommandError::Ask(format!(
            "There are no facts in {}: files *.jsonl, as of a sweep's --into or --episodes or of export-episode, were expected.",
            source.display()
        ))),
    }
}

fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

fn write_into(path: &Path, inputs: &[PathBuf]) -> Result<Vec<(String, u64)>, CommandError> {
    let refused = |error: io::Error| CommandError::Rewrite {
        path: path.to_owned(),
        error,
    };
    let file = File::create(path).map_err(refused)?;
    let mut facts = Sqlite::begin(BufWriter::with_capacity(1 << 20, file))
        .map_err(|error| of_facts(path, path, None, error))?;
    for input in inputs {
        match input
            .extension()
            .is_some_and(|end| end.eq_ignore_ascii_case("mcap"))
        {
            true => add_recording(&mut facts, path, input)?,
            false => add_lines(&mut facts, path, input)?,
        }
    }
    let (file, counts) = facts
        .finish()
        .map_err(|error| of_facts(path, path, None, error))?;
    let file = file
        .into_inner()
        .map_err(|error| refused(error.into_error()))?;
    file.sync_all().map_err(refused)?;
    Ok(counts)
}

/// What is wrong: with facts of an input, in a line of it if it has lines, or with the file that is written.
fn of_facts(output: &Path, input: &Path, line: Option<usize>, error: SqliteError) -> CommandError {
    match error {
        SqliteError::Write(error) => CommandError::Rewrite {
            path: output.to_owned(),
            error,
        },
        other => wrong(
            input,
            match line {
                Some(line) => format!("line {line}: {other}"),
                None => other.to_string(),
            },
        ),
    }
}

type Facts = Sqlite<BufWriter<File>>;

fn add_lines(facts: &mut Facts, output: &Path, input: &Path) -> Result<(), CommandError> {
    let unreadable = |error| CommandError::Read {
        path: input.to_owned(),
        error,
    };
    let mut reader = BufReader::with_capacity(1 << 16, File::open(input).map_err(unreadable)?);
    let relation = stem(input);
    let mut bytes = Vec::new();
    for number in 1.. {
        bytes.clear();
        let read = reader.by_ref().take(MAX_LINE).read_until(b'\n', &mut bytes);
        match read.map_err(unreadable)? as u64 {
            0 => break,
            MAX_LINE => {
                let what = format!("line {number} has more than {MAX_LINE} bytes");
                return Err(wrong(input, what));
            }
            _ => {}
        }
        let Ok(line) = std::str::from_utf8(&bytes) else {
            return Err(wrong(
                input,
                format!("line {number}: it is no text in UTF-8"),
            ));
        };
        if !line.trim().is_empty() {
            facts
                .add_line(&relation, line)
                .map_err(|error| of_facts(output, input, Some(number), error))?;
        }
    }
    Ok(())
}

fn add_recording(facts: &mut Facts, output: &Path, input: &Path) -> Result<(), CommandError> {
    let file = File::open(input).map_err(|error| CommandError::Read {
        path: input.to_owned(),
        error,
    })?;
    let episode = read_episode_of_file(BufReader::new(file), Wanted::ALL)
        .map_err(|error| wrong(input, error))?;
    if episode.is_cut_off {
        let text = "WARNING: {} ends abruptly: what came after that is not known.";
        // If standard error is closed, nobody wants to know.
        let _ = writeln!(
            io::stderr(),
            "{}",
            text.replace("{}", &input.display().to_string())
        );
    }
    let mut relations = Relations::default();
    session::functions::add_episode(&mut relations, episode);
    facts
        .add_relations(&relations)
        .map_err(|error| of_facts(output, input, None, error))
}
