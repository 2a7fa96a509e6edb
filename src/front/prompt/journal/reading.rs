//! Reading a journal.

use std::path::{Path, PathBuf};

use super::record::{ANY_FIRST_LINE, Checksum, FIRST_LINE, OLD_FIRST_LINE, Record};
use super::{Beginning, End, JournalError, Recorded};

/// A journal that was read.
#[derive(Clone, Debug)]
pub(crate) struct Earlier {
    /// The file.
    pub(crate) path: PathBuf,
    /// How the session began.
    pub(crate) beginning: Beginning,
    /// The inputs, in order.
    pub(crate) inputs: Vec<Recorded>,
    /// What the journal can be continued with.
    pub(super) tail: Tail,
}

/// The end of a journal.
#[derive(Clone, Debug)]
pub(super) enum Tail {
    /// It is in order up to that byte; a record after it was cut short.
    Whole { length: u64, checksum: Checksum },
    /// It is in the format without checksums, to which nothing can be appended.
    Old,
    /// That line, counted from one, is damaged.
    Damaged { line: usize },
}

/// A line with its number, from one, and the byte after its end.
struct Line<'a> {
    number: usize,
    bytes: &'a [u8],
    end: usize,
}

impl Earlier {
    /// The journal in a file with these bytes. What comes after a damaged record is left out;
    /// so is a last line without a line break, since writing it was cut short.
    pub(crate) fn parse(path: &Path, bytes: &[u8]) -> Result<Earlier, JournalError> {
        let mut lines = whole_lines(bytes);
        let first = lines.next();
        let has_checksums = match first.as_ref().map(|line| line.bytes) {
            Some(line) if line == FIRST_LINE.as_bytes() => true,
            Some(line) if line == OLD_FIRST_LINE.as_bytes() => false,
            Some(line) if line.starts_with(ANY_FIRST_LINE.as_bytes()) => {
                return Err(JournalError::Newer(path.to_owned()));
            }
            _ => return Err(JournalError::Format(path.to_owned())),
        };
        let mut earlier = Earlier {
            path: path.to_owned(),
            beginning: Beginning::default(),
            inputs: Vec::new(),
            tail: Tail::Old,
        };
        let mut checksum = Checksum::of_first_line();
        let mut length = first.map_or(0, |line| line.end);
        let mut current = None;
        for line in lines {
            let text = std::str::from_utf8(line.bytes).ok();
            let parts = text.and_then(|text| {
                if has_checksums {
                    checksum.opened(text)
                } else {
                    text.split_once(' ')
                }
            });
            let record = parts.and_then(Record::of_parts);
            let taken = record.and_then(|record| earlier.take(record, &mut current));
            if taken.is_none() {
                // Something was written after the last input, so the program survived it.
                if let Some(input) = current.and_then(|at: usize| earlier.inputs.get_mut(at))
                    && input.end == End::Unknown
                {
                    input.end = End::Ended(None);
                }
                earlier.tail = Tail::Damaged { line: line.number };
                return Ok(earlier);
            }
            length = line.end;
        }
        if has_checksums {
            earlier.tail = Tail::Whole {
                length: length as u64,
                checksum,
            };
        } else {
            earlier.assume_ends();
        }
        Ok(earlier)
    }

    /// Whether it is in order and nothing was typed.
    pub(super) fn is_blank(&self) -> bool {
        self.inputs.is_empty() && matches!(self.tail, Tail::Whole { .. })
    }

    /// Takes a record; `current` is the index of the input that began last. `None` if the
    /// record does not fit those before it.
    fn take(&mut self, record: Record, current: &mut Option<usize>) -> Option<()> {
        match record {
            Record::Seed(seed) => self.beginning.seed = seed,
            Record::World(file) => self.beginning.world = Some(file.into()),
            Record::WorldDescription(file) => {
                self.beginning.world_description = Some(file.into());
            }
            Record::Robot(file) => self.beginning.robot = Some(file.into()),
            Record::RobotDescription(file) => {
                self.beginning.robot_description = Some(file.into());
            }
            Record::Objects(file) => self.beginning.objects = Some(file.into()),
            Record::Noise(settings) => self.beginning.noise = Some(settings),
            Record::Faithful => self.beginning.is_faithful = true,
            Record::PackagePath(folder) => self.beginning.package_path.push(folder.into()),
            Record::Systems(folder) => self.beginning.systems.push(folder.into()),
            Record::Setup(file) => self.beginning.setup.push(file.into()),
            Record::Closed => self.beginning.is_closed = true,
            Record::Input { text, stops } => {
                *current = Some(self.inputs.len());
                self.inputs.push(Recorded {
                    text,
                    interrupted_at: None,
                    stops,
                    end: End::Unknown,
                    ending: None,
                    loaded: Vec::new(),
                });
            }
            Record::Interrupted(at) => {
                let input = self.inputs.get_mut((*current)?)?;
                input.interrupted_at = Some(at);
                input.end = End::Ended(None);
            }
            Record::Ended(hash, ending) => {
                let input = self.inputs.get_mut((*current)?)?;
                input.end = End::Ended(hash);
                input.ending = ending;
            }
            Record::Loaded(loaded) => match *current {
                Some(at) => self.inputs.get_mut(at)?.loaded.push(loaded),
                None => self.beginning.digests.push(loaded),
            },
            Record::Again(number) => {
                let index = number.checked_sub(1)?;
                let input = self.inputs.get_mut(index)?;
                input.end = End::Unknown;
                input.loaded.clear();
                *current = Some(index);
            }
            Record::Skipped(number) => {
                self.inputs.get_mut(number.checked_sub(1)?)?.end = End::Skipped;
            }
        }
        Some(())
    }

    /// In the format that does not record ends, all inputs but the last have ended, and the
    /// last one if it was interrupted.
    fn assume_ends(&mut self) {
        let count = self.inputs.len();
        for (at, input) in self.inputs.iter_mut().enumerate() {
            if at + 1 < count || input.interrupted_at.is_some() {
                input.end = End::Ended(None);
            }
        }
    }
}

/// The lines that end in a line break.
fn whole_lines(bytes: &[u8]) -> impl Iterator<Item = Line<'_>> {
    let mut end = 0;
    bytes
        .split_inclusive(|byte| *byte == b'\n')
        .enumerate()
        .filter_map(move |(index, line)| {
            end += line.len();
            Some(Line {
                number: index + 1,
                bytes: line.strip_suffix(b"\n")?,
                end,
            })
        })
}
