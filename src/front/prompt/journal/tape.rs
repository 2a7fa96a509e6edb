//! The tape beside a journal: what the world answered to each input, so that a session is resumed
//! without the physics.
//!
//! A tape is a help, never a need. It may be missing, damaged, of another build of the program or
//! of another session: what fits is used, and the rest is evaluated as if there were no tape. What
//! cannot be written is not on it.
//!
//! A tape is a line, a fingerprint and records. A record is its length, a checksum and the bytes of
//! a [`Record`]. States of the world that nothing needs any more are dropped when the file is
//! written anew, which happens when they are the greater part of it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::UNIX_EPOCH;

use serde::{Deserialize, Serialize};

use super::Recorded;
use session::tape::{Frame, Part};

const FIRST_LINE: &[u8] = b"planwright tape 1\n";

/// Greatest size (bytes) of a tape; beyond it, nothing more is recorded.
const MOST_BYTES: u64 = 1 << 28;

/// How many bytes may be superfluous before the file is written anew, besides as many as are
/// needed.
const SLACK: u64 = 1 << 22;

/// What is on a tape of one input, without the states.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
pub(crate) struct Taped {
    /// A checksum of all inputs up to this one.
    lineage: u32,
    /// The answers; `None` if the input cannot be played.
    answers: Option<Vec<u8>>,
    /// The frame of the state in which it left the world at rest, if it did.
    pub(crate) end: Option<u64>,
    /// The frames that snapshots refer to.
    needed: Vec<u64>,
}

impl Taped {
    /// What was recorded of an input.
    pub(crate) fn of(lineage: Lineage, part: Part) -> Taped {
        Taped {
            lineage: lineage.0,
            answers: part.answers,
            end: part.end,
            needed: part.needed,
        }
    }

    /// What is played, if it can be.
    pub(crate) fn part(&self) -> Option<Part> {
        Some(Part {
            answers: Some(self.answers.clone()?),
            frames: Vec::new(),
            end: self.end,
            needed: Vec::new(),
        })
    }

    pub(crate) fn is_playable(&self) -> bool {
        self.answers.is_some()
    }
}

/// A record.
#[derive(Serialize, Deserialize)]
enum Record {
    Input(Taped),
    State(Rc<Frame>),
}

/// The checksum of all inputs up to one, which tells whether a part belongs to it.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug)]
pub(crate) struct Lineage(u32);

impl Lineage {
    /// After one more input.
    pub(crate) fn after(self, text: &str, stops: bool, interrupted_at: Option<u64>) -> Lineage {
        let mut sum = crc32fast::Hasher::new_with_initial(self.0);
        sum.update(&text.len().to_le_bytes());
        sum.update(text.as_bytes());
        sum.update(&[u8::from(stops), u8::from(interrupted_at.is_some())]);
        sum.update(&interrupted_at.unwrap_or_default().to_le_bytes());
        Lineage(sum.finalize())
    }

    /// After an input of an earlier session.
    pub(crate) fn after_recorded(self, input: &Recorded) -> Lineage {
        self.after(&input.text, input.stops, input.interrupted_at)
    }
}

/// A tape that is being written.
#[derive(Debug)]
pub(crate) struct Tape {
    file: File,
    path: PathBuf,
    fingerprint: u64,
    /// Bytes in the file.
    length: u64,
    inputs: Vec<Kept>,
    states: BTreeMap<u64, Rc<Frame>>,
}

/// An input on a tape that is being written.
#[derive(Clone, Debug)]
struct Kept {
    is_playable: bool,
    end: Option<u64>,
    needed: Vec<u64>,
    /// The bytes of its record.
    place: Range<u64>,
}

impl Kept {
    fn of(input: &Taped, place: Range<u64>) -> Kept {
        Kept {
            is_playable: input.is_playable(),
            end: input.end,
            needed: input.needed.clone(),
            place,
        }
    }
}

/// The tape beside a journal.
pub(crate) fn path_beside(journal: &Path) -> PathBuf {
    let mut name = journal.as_os_str().to_owned();
    name.push(".tape");
    PathBuf::from(name)
}

/// A fingerprint of this build of the program and of how a session begins.
pub(crate) fn fingerprint(session: u32) -> u64 {
    let mut sum = crc32fast::Hasher::new();
    sum.update(env!("CARGO_PKG_VERSION").as_bytes());
    // Another build may write states in another way.
    let program = std::env::current_exe().and_then(fs::metadata);
    if let Ok(program) = program {
        sum.update(&program.len().to_le_bytes());
        let changed = program.modified().ok();
        let since = changed.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
        sum.update(&since.unwrap_or_default().as_nanos().to_le_bytes());
    }
    u64::from(sum.finalize()) << 32 | u64::from(session)
}

/// The inputs and states on a tape with that fingerprint, up to the first damage.
pub(crate) fn read(journal: &Path, fingerprint: u64) -> (Vec<Taped>, Vec<Rc<Frame>>) {
    let path = path_beside(journal);
    let is_file = fs::metadata(&path).is_ok_and(|found| found.is_file());
    let bytes = is_file.then(|| fs::read(&path).ok()).flatten();
    let (mut inputs, mut states) = (Vec::new(), Vec::new());
    let header = header(fingerprint);
    let Some(mut rest) = bytes.as_deref().and_then(|b| b.strip_prefix(&*header)) else {
        return (inputs, states);
    };
    while let Some((record, after)) = next(rest) {
        match record {
            Record::Input(input) => inputs.push(input),
            Record::State(frame) => states.push(frame),
        }
        rest = after;
    }
    (inputs, states)
}

fn header(fingerprint: u64) -> Vec<u8> {
    [FIRST_LINE, &fingerprint.to_le_bytes()].concat()
}

/// The first record and the bytes after it; `None` if there is none, or a damaged one.
fn next(bytes: &[u8]) -> Option<(Record, &[u8])> {
    let (length, rest) = bytes.split_first_chunk::<4>()?;
    let (sum, rest) = rest.split_first_chunk::<4>()?;
    let length = usize::try_from(u32::from_le_bytes(*length)).ok()?;
    let (payload, after) = rest.split_at_checked(length)?;
    let is_intact = crc32fast::hash(payload) == u32::from_le_bytes(*sum);
    let record = postcard::from_bytes(is_intact.then_some(payload)?).ok()?;
    Some((record, after))
}

fn sealed(record: &Record) -> Option<Vec<u8>> {
    let payload = postcard::to_allocvec(record).ok()?;
    let length = u32::try_from(payload.len()).ok()?;
    let sum = crc32fast::hash(&payload);
    Some([&length.to_le_bytes(), &sum.to_le_bytes(), &*payload].concat())
}

/// The inputs among those on a tape that belong to a session's inputs, one for each; later ones
/// count, since they are of a later resume.
pub(crate) fn matched(taped: Vec<Taped>, lineages: &[Lineage]) -> Vec<Option<Taped>> {
    let by_lineage: BTreeMap<u32, Taped> = taped.into_iter().map(|t| (t.lineage, t)).collect();
    let all = lineages.iter();
    all.map(|lineage| by_lineage.get(&lineage.0).cloned())
        .collect()
}

/// Inputs after which the world was at rest, with those before them after which it was not.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Stretch {
    /// Indices of its inputs.
    pub(crate) inputs: Range<usize>,
    /// The frame of the state before it; `None` at the beginning.
    pub(crate) start: Option<u64>,
    /// The frame of the state after it, if it can be played; otherwise it has to be evaluated with
    /// the physics.
    pub(crate) end: Option<u64>,
}

/// Divides the inputs of a session into stretches; `inputs` says of each whether it can be played,
/// and in which frame it left the world at rest.
pub(crate) fn stretches(inputs: impl Iterator<Item = (bool, Option<u64>)>) -> Vec<Stretch> {
    let mut stretches = Vec::new();
    let (mut first, mut start, mut is_playable) = (0, None, true);
    let mut count = 0;
    for (at, (can_be_played, end)) in inputs.enumerate() {
        count = at + 1;
        is_playable &= can_be_played;
        if end.is_some() {
            stretches.push(Stretch {
                inputs: first..count,
                start,
                end: end.filter(|_| is_playable),
            });
            (first, start, is_playable) = (count, end, true);
        }
    }
    if first < count {
        stretches.push(Stretch {
            inputs: first..count,
            start,
            end: None,
        });
    }
    stretches
}

impl Tape {
    /// A new tape beside the journal, with inputs of an earlier session and the states that they
    /// need.
    pub(crate) fn create(
        journal: &Path,
        fingerprint: u64,
        inputs: Vec<Taped>,
        states: impl IntoIterator<Item = Rc<Frame>>,
    ) -> io::Result<Tape> {
        let path = path_beside(journal);
        if !is_ours(&path) {
            return Err(io::ErrorKind::AlreadyExists.into());
        }
        let states = states.into_iter().map(|frame| (frame.number, frame));
        let mut tape = Tape {
            file: begun_anew(&path)?,
            path,
            fingerprint,
            length: 0,
            inputs: Vec::new(),
            states: states.collect(),
        };
        let kept = inputs.iter().map(|input| Kept::of(input, 0..0));
        let needed = needed(&kept.collect::<Vec<_>>());
        tape.states.retain(|number, _| needed.contains(number));
        tape.fill(
            inputs
                .iter()
                .map(|input| sealed(&Record::Input(input.clone()))),
        )?;
        tape.inputs = std::mem::take(&mut tape.inputs)
            .into_iter()
            .zip(&inputs)
            .map(|(kept, input)| Kept::of(input, kept.place))
            .collect();
        Ok(tape)
    }

    /// Adds what was recorded of an input. After an error, nothing more can be added.
    pub(crate) fn add(&mut self, lineage: Lineage, part: Part) -> io::Result<()> {
        for frame in &part.frames {
            self.write(sealed(&Record::State(Rc::clone(frame))))?;
            self.states.insert(frame.number, Rc::clone(frame));
        }
        let record = Record::Input(Taped::of(lineage, part));
        let place = self.write(sealed(&record))?;
        if let Record::Input(input) = &record {
            self.inputs.push(Kept::of(input, place));
        }
        self.shrink()
    }

    /// Writes a record; returns where it is.
    fn write(&mut self, record: Option<Vec<u8>>) -> io::Result<Range<u64>> {
        let bytes = record.ok_or(io::ErrorKind::InvalidData)?;
        let begin = self.length;
        self.file.write_all(&bytes)?;
        self.length += bytes.len() as u64;
        Ok(begin..self.length)
    }

    /// Drops the states that nothing needs, and writes the file anew if they are the greater part
    /// of it.
    fn shrink(&mut self) -> io::Result<()> {
        let needed = needed(&self.inputs);
        self.states.retain(|number, _| needed.contains(number));
        let states: usize = self.states.values().map(|frame| frame.size()).sum();
        let inputs: u64 = self
            .inputs
            .iter()
            .map(|i| i.place.end - i.place.start)
            .sum();
        let live = states as u64 + inputs;
        if live > MOST_BYTES {
            return Err(io::ErrorKind::FileTooLarge.into());
        }
        if self.length <= 2 * live + SLACK {
            return Ok(());
        }
        let old = fs::read(&self.path)?;
        let places: Vec<Range<u64>> = self.inputs.iter().map(|i| i.place.clone()).collect();
        let records = places.into_iter().map(|place| {
            let begin = usize::try_from(place.start).ok()?;
            let end = usize::try_from(place.end).ok()?;
            old.get(begin..end).map(<[u8]>::to_vec)
        });
        let kept = std::mem::take(&mut self.inputs);
        self.file = begun_anew(&self.path)?;
        self.fill(records)?;
        for (input, kept) in self.inputs.iter_mut().zip(kept) {
            *input = Kept {
                place: input.place.clone(),
                ..kept
            };
        }
        Ok(())
    }

    /// Writes the states and the records of inputs into the file, which has just been begun, and
    /// puts it in its place.
    fn fill(&mut self, inputs: impl Iterator<Item = Option<Vec<u8>>>) -> io::Result<()> {
        let filled = self.try_to_fill(inputs);
        if filled.is_err() {
            // What is left of it does no harm.
            let _ = fs::remove_file(path_of_new(&self.path));
        }
        filled
    }

    fn try_to_fill(&mut self, inputs: impl Iterator<Item = Option<Vec<u8>>>) -> io::Result<()> {
        self.length = 0;
        self.inputs.clear();
        self.write(Some(header(self.fingerprint)))?;
        for frame in self.states.values().cloned().collect::<Vec<_>>() {
            self.write(sealed(&Record::State(frame)))?;
        }
        for record in inputs {
            let place = self.write(record)?;
            self.inputs.push(Kept {
                is_playable: false,
                end: None,
                needed: Vec::new(),
                place,
            });
        }
        fs::rename(path_of_new(&self.path), &self.path)
    }
}

/// The states that a resume needs: the last one, those that its snapshots refer to, and those
/// before inputs that cannot be played.
fn needed(inputs: &[Kept]) -> BTreeSet<u64> {
    let all = inputs.iter().map(|input| (input.is_playable, input.end));
    let mut settled: Vec<usize> = Vec::new();
    for stretch in stretches(all) {
        if stretch.end.is_none() {
            settled.extend(stretch.inputs.start.checked_sub(1));
        }
    }
    settled.extend(inputs.iter().rposition(|input| input.end.is_some()));
    let settled = settled.into_iter().filter_map(|at| inputs.get(at));
    settled
        .flat_map(|input| input.end.iter().chain(&input.needed))
        .copied()
        .collect()
}

/// Whether there is no file, or a tape, which may be replaced.
fn is_ours(path: &Path) -> bool {
    match fs::metadata(path) {
        Err(error) => error.kind() == io::ErrorKind::NotFound,
        Ok(found) if !found.is_file() => false,
        Ok(_) => File::open(path).is_ok_and(|file| {
            let mut begin = Vec::new();
            let read = file.take(FIRST_LINE.len() as u64).read_to_end(&mut begin);
            read.is_ok() && FIRST_LINE.starts_with(&begin)
        }),
    }
}

/// Begins a file beside a tape that will take its place.
fn begun_anew(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options
        .write(true)
        .create(true)
        .truncate(true)
        .open(path_of_new(path))
}

fn path_of_new(path: &Path) -> PathBuf {
    let mut new = path.as_os_str().to_owned();
    new.push(".new");
    PathBuf::from(new)
}
