//! The lines of a journal.
//!
//! A line is `WORD CHECKSUM TEXT`; in the text `\n` stands for a line break, `\r` for a carriage
//! return and `\\` for a backslash. The checksum is the CRC-32 of the file up to there, without
//! the checksums: each line is fed as `WORD TEXT` and a line break.

use std::path::Path;

use super::{Beginning, Loaded};

/// First line of a journal.
pub(super) const FIRST_LINE: &str = "planwright journal 2";
/// First line of a journal without checksums and without ends of inputs.
pub(super) const OLD_FIRST_LINE: &str = "planwright journal 1";
/// What first lines of journals begin with.
pub(super) const ANY_FIRST_LINE: &str = "planwright journal ";

/// The hash of an end without one.
const NO_HASH: &str = "-";

/// A record.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Record {
    Seed(u64),
    World(String),
    WorldDescription(String),
    Robot(String),
    RobotDescription(String),
    Objects(String),
    Noise(String),
    Faithful,
    PackagePath(String),
    Systems(String),
    Setup(String),
    Closed,
    /// The evaluation of an input begins.
    Input {
        text: String,
        stops: bool,
    },
    /// Where it was interrupted.
    Interrupted(u64),
    /// It has ended; the hash of the world and how it ended, if they are known.
    Ended(Option<u64>, Option<String>),
    /// A file that it has loaded, or with which the session began.
    Loaded(Loaded),
    /// The evaluation of the input with that number, from one, begins again.
    Again(usize),
    /// The input with that number is left out.
    Skipped(usize),
}

impl Record {
    /// How a session began.
    pub(super) fn of_beginning(beginning: &Beginning) -> Vec<Record> {
        let files = [
            (&beginning.world, Record::World as fn(String) -> Record),
            (&beginning.world_description, Record::WorldDescription),
            (&beginning.robot, Record::Robot),
            (&beginning.robot_description, Record::RobotDescription),
            (&beginning.objects, Record::Objects),
        ];
        let given = files.into_iter().filter_map(|(file, record)| {
            let file = file.as_ref()?;
            Some(record(absolute(file)))
        });
        let packages = beginning.package_path.iter();
        let packages = packages.map(|folder| Record::PackagePath(absolute(folder)));
        let systems = beginning.systems.iter();
        let systems = systems.map(|folder| Record::Systems(absolute(folder)));
        let setup = beginning.setup.iter();
        let setup = setup.map(|file| Record::Setup(absolute(file)));
        let noise = beginning.noise.clone().map(Record::Noise);
        std::iter::once(Record::Seed(beginning.seed))
            .chain(given)
            .chain(noise)
            .chain(beginning.is_faithful.then_some(Record::Faithful))
            .chain(packages)
            .chain(systems)
            .chain(setup)
            .chain(beginning.is_closed.then_some(Record::Closed))
            .chain(beginning.digests.iter().cloned().map(Record::Loaded))
            .collect()
    }

    /// The word and the text of the record.
    pub(super) fn parts(&self) -> (&'static str, String) {
        match self {
            Record::Seed(seed) => ("seed", seed.to_string()),
            Record::World(file) => ("world", escaped(file)),
            Record::WorldDescription(file) => ("world-description", escaped(file)),
            Record::Robot(file) => ("robot", escaped(file)),
            Record::RobotDescription(file) => ("robot-description", escaped(file)),
            Record::Objects(file) => ("objects", escaped(file)),
            Record::Noise(settings) => ("noise", escaped(settings)),
            Record::Faithful => ("faithful", "yes".to_owned()),
            Record::PackagePath(folder) => ("package-path", escaped(folder)),
            Record::Systems(folder) => ("systems", escaped(folder)),
            Record::Setup(file) => ("setup", escaped(file)),
            Record::Closed => ("closed", "yes".to_owned()),
            Record::Input { text, stops: true } => ("input", escaped(text)),
            Record::Input { text, stops: false } => ("pasted", escaped(text)),
            Record::Interrupted(at) => ("interrupted", at.to_string()),
            Record::Ended(hash, ending) => {
                let hash = hash.map_or(NO_HASH.to_owned(), |hash| format!("{hash:016x}"));
                let ending = ending.as_deref().unwrap_or_default();
                (
                    "ended",
                    format!("{hash} {}", escaped(ending)).trim_end().to_owned(),
                )
            }
            Record::Loaded(Loaded { file, digest }) => {
                ("loaded", format!("{digest} {}", escaped(file)))
            }
            Record::Again(number) => ("again", number.to_string()),
            Record::Skipped(number) => ("skipped", number.to_string()),
        }
    }

    /// The record of a word and a text; `None` if it is malformed.
    pub(super) fn of_parts((word, value): (&str, &str)) -> Option<Record> {
        Some(match word {
            "seed" => Record::Seed(value.parse().ok()?),
            "world" => Record::World(unescaped(value)),
            "world-description" => Record::WorldDescription(unescaped(value)),
            "robot" => Record::Robot(unescaped(value)),
            "robot-description" => Record::RobotDescription(unescaped(value)),
            "objects" => Record::Objects(unescaped(value)),
            "noise" => Record::Noise(unescaped(value)),
            "faithful" => Record::Faithful,
            "package-path" => Record::PackagePath(unescaped(value)),
            "systems" => Record::Systems(unescaped(value)),
            "setup" => Record::Setup(unescaped(value)),
            "closed" => Record::Closed,
            "input" | "pasted" => Record::Input {
                text: unescaped(value),
                stops: word == "input",
            },
            "interrupted" => Record::Interrupted(value.parse().ok()?),
            "ended" => {
                let (hash, ending) = match value.split_once(' ') {
                    Some((hash, ending)) => (hash, Some(unescaped(ending))),
                    None => (value, None),
                };
                let hash = match hash {
                    NO_HASH => None,
                    hash => Some(u64::from_str_radix(hash, 16).ok()?),
                };
                Record::Ended(hash, ending)
            }
            "loaded" => {
                let (digest, file) = value.split_once(' ')?;
                Record::Loaded(Loaded {
                    file: unescaped(file),
                    digest: digest.to_owned(),
                })
            }
            "again" => Record::Again(value.parse().ok()?),
            "skipped" => Record::Skipped(value.parse().ok()?),
            _ => return None,
        })
    }
}

/// The name of a file. It keeps its meaning when the session is resumed in another directory.
fn absolute(file: &Path) -> String {
    if session::is_built_in(file) {
        return file.to_string_lossy().into_owned();
    }
    let absolute = std::path::absolute(file);
    let file = absolute.as_deref().unwrap_or(file);
    file.to_string_lossy().into_owned()
}

/// The checksum of the lines so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Checksum(crc32fast::Hasher);

impl Checksum {
    /// Of a file that begins with the first line.
    pub(super) fn of_first_line() -> Checksum {
        let mut checksum = Checksum::default();
        checksum.add(FIRST_LINE);
        checksum
    }

    fn add(&mut self, line: &str) -> u32 {
        self.0.update(line.as_bytes());
        self.0.update(b"\n");
        self.0.clone().finalize()
    }

    /// The line of a record, with its checksum and a line break.
    pub(super) fn sealed(&mut self, record: &Record) -> String {
        let (word, text) = record.parts();
        format!(
            "{word} {:08x} {text}\n",
            self.add(&format!("{word} {text}"))
        )
    }

    /// The word and the text on a line, if its checksum is right.
    pub(super) fn opened<'a>(&mut self, line: &'a str) -> Option<(&'a str, &'a str)> {
        let (word, rest) = line.split_once(' ')?;
        let (sum, text) = rest.split_once(' ')?;
        let expected = u32::from_str_radix(sum, 16).ok()?;
        (self.add(&format!("{word} {text}")) == expected).then_some((word, text))
    }
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\")
        .replace('\n', "\\n")
        .replace('\r', "\\r")
}

fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut characters = text.chars();
    while let Some(c) = characters.next() {
        match c {
            '\\' => match characters.next() {
                Some('n') => plain.push('\n'),
                Some('r') => plain.push('\r'),
                Some(other) => plain.push(other),
                None => {}
            },
            other => plain.push(other),
        }
    }
    plain
}
