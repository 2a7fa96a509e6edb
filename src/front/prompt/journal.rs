//! The journal: every input is on disk before it is evaluated, so that a session can be resumed
//! however it ended.
//!
//! Each record is a line: a word, a blank, and a text in which `\n` stands for a line break and
//! `\\` for a backslash. `seed`, `world`, `robot` and `robot-description` say how the session
//! began; `input` is an input, `pasted` an input that conditions do not stop, and `interrupted`
//! says where the input before it was interrupted. Replaying a journal leads to the same state,
//! because nothing else has an effect.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use thiserror::Error;

use super::history::state_directory;

/// Number of journals of earlier sessions that are kept.
const MOST_JOURNALS: usize = 20;
const FIRST_LINE: &str = "planwright journal 1";
const EXTENSION: &str = "journal";

/// How a session began.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(crate) struct Beginning {
    /// Seed for everything random.
    pub(crate) seed: u64,
    /// The kitchen used instead of the built-in one.
    pub(crate) world: Option<PathBuf>,
    /// The robot used instead of the built-in one.
    pub(crate) robot: Option<PathBuf>,
    /// What that robot's links and joints are for.
    pub(crate) robot_description: Option<PathBuf>,
}

/// An input of an earlier session.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Recorded {
    /// What was typed.
    pub(crate) text: String,
    /// Where its evaluation was interrupted.
    pub(crate) interrupted_at: Option<u64>,
    /// Whether conditions stop its evaluation rather than end it.
    pub(crate) stops: bool,
}

/// Why a journal cannot be read.
#[derive(Debug, Error)]
pub(crate) enum JournalError {
    /// There is no journal.
    #[error("there is no journal of an earlier session{}", .0.as_ref().map(|d| format!(" in {}", d.display())).unwrap_or_default())]
    None(Option<PathBuf>),
    /// It cannot be read.
    #[error("cannot read the journal {}: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// It is not a journal.
    #[error("{} is not a journal", .0.display())]
    Format(PathBuf),
}

/// A journal that was read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Earlier {
    /// The file.
    pub(crate) path: PathBuf,
    /// How the session began.
    pub(crate) beginning: Beginning,
    /// The inputs, in order.
    pub(crate) inputs: Vec<Recorded>,
}

impl Earlier {
    /// Reads a journal, by default the newest one.
    pub(crate) fn read(path: Option<&Path>) -> Result<Earlier, JournalError> {
        let path = match path {
            Some(path) => path.to_owned(),
            None => newest().ok_or_else(|| JournalError::None(directory()))?,
        };
        let text = fs::read_to_string(&path).map_err(|error| JournalError::Read {
            path: path.clone(),
            error,
        })?;
        Earlier::parse(&path, &text).ok_or(JournalError::Format(path))
    }

    fn parse(path: &Path, text: &str) -> Option<Earlier> {
        let (first, rest) = text.split_once('\n')?;
        if first != FIRST_LINE {
            return None;
        }
        let mut earlier = Earlier {
            path: path.to_owned(),
            beginning: Beginning::default(),
            inputs: Vec::new(),
        };
        // Writing the last line may have been cut short.
        let whole = rest
            .split_inclusive('\n')
            .filter_map(|line| line.strip_suffix('\n'));
        for line in whole {
            let (word, value) = line.split_once(' ')?;
            let value = unescaped(value);
            match word {
                "seed" => earlier.beginning.seed = value.parse().ok()?,
                "world" => earlier.beginning.world = Some(value.into()),
                "robot" => earlier.beginning.robot = Some(value.into()),
                "robot-description" => {
                    earlier.beginning.robot_description = Some(value.into());
                }
                "input" | "pasted" => earlier.inputs.push(Recorded {
                    text: value,
                    interrupted_at: None,
                    stops: word == "input",
                }),
                "interrupted" => {
                    let at = value.parse().ok()?;
                    earlier.inputs.last_mut()?.interrupted_at = Some(at);
                }
                _ => return None,
            }
        }
        Some(earlier)
    }
}

/// A journal that is being written.
#[derive(Debug)]
pub(crate) struct Journal {
    file: File,
}

impl Journal {
    /// A new journal in the state directory; `None` if there is no place for it.
    pub(crate) fn begin(beginning: &Beginning) -> Option<Journal> {
        let directory = directory()?;
        fs::create_dir_all(&directory).ok()?;
        forget_old(&directory);
        let seconds = SystemTime::now().duration_since(UNIX_EPOCH).ok()?.as_secs();
        let name = format!("{seconds}-{}.{EXTENSION}", std::process::id());
        Journal::create(&directory.join(name), beginning).ok()
    }

    /// A new journal in the given file.
    pub(crate) fn create(path: &Path, beginning: &Beginning) -> io::Result<Journal> {
        let mut text = format!("{FIRST_LINE}\n");
        text.push_str(&record("seed", &beginning.seed.to_string()));
        for (word, file) in [
            ("world", &beginning.world),
            ("robot", &beginning.robot),
            ("robot-description", &beginning.robot_description),
        ] {
            if let Some(file) = file {
                text.push_str(&record(word, &file.to_string_lossy()));
            }
        }
        let mut journal = Journal {
            file: File::create(path)?,
        };
        journal.write(&text)?;
        Ok(journal)
    }

    /// Continues an earlier journal.
    pub(crate) fn go_on(path: &Path) -> io::Result<Journal> {
        let text = fs::read_to_string(path)?;
        let mut journal = Journal {
            file: fs::OpenOptions::new().append(true).open(path)?,
        };
        if !text.ends_with('\n') {
            // An incomplete record was never evaluated.
            let end = text.rfind('\n').map_or(0, |at| at + 1);
            journal.file.set_len(end as u64)?;
        }
        journal.write("")?;
        Ok(journal)
    }

    /// Records an input; it is on disk when this returns.
    pub(crate) fn input(&mut self, text: &str, stops: bool) -> io::Result<()> {
        let word = if stops { "input" } else { "pasted" };
        self.write(&record(word, text))
    }

    /// Records where the last input was interrupted.
    pub(crate) fn interrupted(&mut self, at: u64) -> io::Result<()> {
        self.write(&record("interrupted", &at.to_string()))
    }

    fn write(&mut self, text: &str) -> io::Result<()> {
        self.file.write_all(text.as_bytes())?;
        self.file.sync_data()
    }
}

fn record(word: &str, value: &str) -> String {
    let value = value
        .replace('\\', "\\\\")
        .replace('\n', "\\n")
        .replace('\r', "\\r");
    format!("{word} {value}\n")
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

fn directory() -> Option<PathBuf> {
    Some(state_directory()?.join("journals"))
}

/// The journals in a directory, oldest first.
fn journals(directory: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(directory).into_iter().flatten().flatten();
    let mut found: Vec<(SystemTime, PathBuf)> = entries
        .filter(|entry| entry.path().extension().is_some_and(|e| e == EXTENSION))
        .filter_map(|entry| Some((entry.metadata().ok()?.modified().ok()?, entry.path())))
        .collect();
    found.sort();
    found.into_iter().map(|(_, path)| path).collect()
}

fn newest() -> Option<PathBuf> {
    journals(&directory()?).pop()
}

fn forget_old(directory: &Path) {
    let known = journals(directory);
    let too_many = (known.len() + 1).saturating_sub(MOST_JOURNALS);
    for path in known.iter().take(too_many) {
        // A journal that cannot be removed does no harm.
        let _ = fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use crate::front::prompt::journal::*;

    #[test]
    fn what_is_written_is_read_again() {
        let path = std::env::temp_dir().join(format!("planwright-{}.journal", std::process::id()));
        let beginning = Beginning {
            seed: 7,
            world: Some("a b.urdf".into()),
            robot: None,
            robot_description: None,
        };
        let mut journal = Journal::create(&path, &beginning).unwrap();
        journal.input("(a\n \"\\n\")", true).unwrap();
        journal.interrupted(12).unwrap();
        drop(journal);
        let mut journal = Journal::go_on(&path).unwrap();
        journal.input("(b)", false).unwrap();
        let earlier = Earlier::read(Some(&path)).unwrap();
        fs::remove_file(&path).unwrap();
        let recorded = |text: &str, interrupted_at, stops| Recorded {
            text: text.to_owned(),
            interrupted_at,
            stops,
        };
        assert_eq!(earlier.beginning, beginning);
        assert_eq!(
            earlier.inputs,
            [
                recorded("(a\n \"\\n\")", Some(12), true),
                recorded("(b)", None, false)
            ]
        );
    }

    #[test]
    fn a_record_that_was_cut_off_does_not_count() {
        let parse = |text| Earlier::parse(Path::new("j"), text).map(|e| e.inputs.len());
        assert_eq!(
            parse("planwright journal 1\nseed 0\ninput (a)\ninput (b"),
            Some(1)
        );
        assert_eq!(parse("something\n"), None);
    }
}
