//! Makes inputs of those that have reached something new.

use std::collections::BTreeSet;
use std::env;
use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use planwright::fuzz::{Mutation, Taken, Target, attempt, targets, with_large_stack};

use defect::keep_caught_panics_quiet;

use crate::counters::Coverage;

/// How often the state is told.
const NEWS: Duration = Duration::from_secs(60);
/// An input that takes longer is a finding.
const SLOW: Duration = Duration::from_secs(30);
/// An input that takes this long ends the process, which has no other way out.
const STUCK: Duration = Duration::from_secs(300);
/// Of the inputs that are kept, those that came last are taken for every second one.
const LATE: usize = 32;

/// Number of inputs that have been taken.
static TAKEN: AtomicU64 = AtomicU64::new(0);

/// Searches as the command line says.
pub(crate) fn main() {
    let mut arguments = env::args().skip(1);
    let wanted = arguments.next();
    let seconds = arguments.next().map_or(60, |text| {
        text.parse().expect("a number of seconds is expected")
    });
    let all = targets();
    let mut found = all.iter();
    let Some(target) = found.find(|target| Some(target.name) == wanted.as_deref()) else {
        let names: Vec<&str> = all.iter().map(|target| target.name).collect();
        println!("targets: {}", names.join(" "));
        std::process::exit(i32::from(wanted.is_some()) * 2);
    };
    keep_caught_panics_quiet();
    let position = under_way(target);
    thread::spawn(move || {
        loop {
            let before = TAKEN.load(Ordering::Relaxed);
            thread::sleep(STUCK);
            if TAKEN.load(Ordering::Relaxed) == before {
                println!("stuck: see {}", position.display());
                std::process::abort();
            }
        }
    });
    let problems = with_large_stack(|| Search::new(target).run(Duration::from_secs(seconds)));
    std::process::exit(i32::from(problems > 0));
}

/// Where the inputs that have reached something are kept.
fn folder(target: &Target) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../target/fuzz/coverage")
        .join(target.name)
}

/// The file with the input under way, in case that it ends the process.
fn under_way(target: &Target) -> PathBuf {
    folder(target).with_extension("under-way")
}

struct Search<'t> {
    target: &'t Target,
    coverage: Coverage,
    /// Inputs that have reached something that none before them had.
    kept: Vec<Vec<u8>>,
    folder: PathBuf,
    /// The file with the input under way.
    position: File,
    problems: BTreeSet<String>,
    read: u64,
}

impl<'t> Search<'t> {
    fn new(target: &'t Target) -> Self {
        let folder = folder(target);
        fs::create_dir_all(&folder).expect("a folder can be made");
        Self {
            target,
            coverage: Coverage::new(),
            kept: Vec::new(),
            position: File::create(under_way(target)).expect("a file can be made"),
            folder,
            problems: BTreeSet::new(),
            read: 0,
        }
    }

    /// Searches for some time; returns how many different problems there are.
    fn run(&mut self, time: Duration) -> usize {
        let mut take = (self.target.open)();
        let mut corpus = (self.target.corpus)();
        let mut earlier: Vec<PathBuf> = fs::read_dir(&self.folder)
            .into_iter()
            .flatten()
            .flatten()
            .map(|entry| entry.path())
            .collect();
        earlier.sort();
        for input in &corpus {
            self.take(&mut take, input);
        }
        let (seeds, read) = (corpus.len(), self.read);
        assert!(read > 0, "no seed is read");
        corpus.extend(earlier.into_iter().filter_map(|path| fs::read(path).ok()));
        for input in &corpus[seeds..] {
            self.take(&mut take, input);
        }
        println!(
            "{}: {read} of {seeds} seeds are read; they and {} inputs of earlier runs reach {} of {} edges",
            self.target.name,
            corpus.len() - seeds,
            self.coverage.edges(),
            self.coverage.len(),
        );
        let begin = Instant::now();
        let mut told = Instant::now();
        let begun = TAKEN.load(Ordering::Relaxed);
        // Another time, other inputs.
        let seed = corpus.len() as u64;
        for number in 0.. {
            let mut mutation = Mutation::new(seed, self.target.name, number);
            let late = self.kept.len().saturating_sub(LATE);
            let base = match number % 2 {
                0 => &self.kept[late..],
                _ => &self.kept,
            };
            let input = mutation.input(base, self.target.words);
            self.take(&mut take, &input);
            let is_over = begin.elapsed() >= time;
            if is_over || told.elapsed() >= NEWS {
                told = Instant::now();
                let count = TAKEN.load(Ordering::Relaxed) - begun;
                let seconds = begin.elapsed().as_secs_f64();
                println!(
                    "{}: {count} inputs in {seconds:.0} s ({:.0}/s), {} % read, {} edges, {} kept, {} problems",
                    self.target.name,
                    count as f64 / seconds,
                    100 * self.read / TAKEN.load(Ordering::Relaxed).max(1),
                    self.coverage.edges(),
                    self.kept.len(),
                    self.problems.len(),
                );
            }
            if is_over {
                break;
            }
        }
        self.problems.len()
    }

    /// Writes down the input that comes next.
    fn note(&mut self, input: &[u8]) -> io::Result<()> {
        self.position.set_len(0)?;
        self.position.seek(SeekFrom::Start(0))?;
        self.position.write_all(input)
    }

    /// Has an input taken; keeps it if it reaches something new.
    fn take(&mut self, take: &mut planwright::fuzz::Taker, input: &[u8]) {
        // If that fails, only the input that ends the process is lost.
        let _ = self.note(input);
        let begin = Instant::now();
        let taken = attempt(take, input);
        let is_new = self.coverage.note();
        TAKEN.fetch_add(1, Ordering::Relaxed);
        self.read += u64::from(taken == Ok(Taken::Read));
        if is_new {
            let file = self.folder.join(format!("{:06}", self.kept.len()));
            let _ = fs::write(file, input);
            self.kept.push(input.to_vec());
        }
        let problem = match taken {
            Ok(_) if begin.elapsed() < SLOW => return,
            Ok(_) => "it takes too long".to_owned(),
            Err(problem) => problem,
        };
        *take = (self.target.open)();
        if self.problems.insert(problem.clone()) {
            let name = format!("{}-{}.input", self.target.name, self.problems.len());
            let file = self.folder.with_file_name(name);
            let _ = fs::write(&file, input);
            println!("{}: {problem}", file.display());
        }
    }
}
