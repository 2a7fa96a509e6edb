//! Makes inputs of those that have reached something new.

use std::collections::BTreeSet;
use std::env;
use std::fs::{self, File};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use planwright::fuzz::{Mutation, Taken, Taker, Target, attempt, targets, with_large_stack};

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
/// The name that stands for all targets.
const ALL: &str = "all";

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
    let is_wanted = |target: &&Target| {
        let wanted = wanted.as_deref();
        wanted == Some(ALL) || wanted == Some(target.name)
    };
    let chosen: Vec<&Target> = all.iter().filter(is_wanted).collect();
    if chosen.is_empty() {
        let names: Vec<&str> = all.iter().map(|target| target.name).collect();
        println!("targets: {}; or {ALL}", names.join(" "));
        std::process::exit(i32::from(wanted.is_some()) * 2);
    }
    fs::create_dir_all(folder()).expect("a folder can be made");
    keep_caught_panics_quiet();
    abort_when_stuck();
    let time = Duration::from_secs(seconds) / chosen.len() as u32;
    let mut problems = 0;
    for target in &chosen {
        problems += with_large_stack(|| Search::new(target).run(time));
    }
    if chosen.len() > 1 {
        let counts = all.iter().map(|target| inputs_of_earlier_runs(target));
        println!(
            "{} inputs in all runs, {problems} problems",
            counts.sum::<u64>()
        );
    }
    std::process::exit(i32::from(problems > 0));
}

fn abort_when_stuck() {
    thread::spawn(|| {
        loop {
            let before = TAKEN.load(Ordering::Relaxed);
            thread::sleep(STUCK);
            if TAKEN.load(Ordering::Relaxed) == before {
                println!("stuck: see {}/*.under-way", folder().display());
                std::process::abort();
            }
        }
    });
}

/// Where everything is kept.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../target/fuzz/coverage")
}

/// The file of a target with that ending.
fn file(target: &Target, ending: &str) -> PathBuf {
    folder().join(format!("{}.{ending}", target.name))
}

/// How many inputs the target has taken in earlier runs.
fn inputs_of_earlier_runs(target: &Target) -> u64 {
    let text = fs::read_to_string(file(target, "inputs")).unwrap_or_default();
    text.trim().parse().unwrap_or(0)
}

struct Search<'t> {
    target: &'t Target,
    coverage: Coverage,
    /// Inputs that have reached something that none before them had.
    kept: Vec<Vec<u8>>,
    /// Where those are kept that are no seeds, under names made of what is in them.
    folder: PathBuf,
    /// The file with the input under way, in case that it ends the process.
    under_way: File,
    problems: BTreeSet<String>,
    taken: u64,
    read: u64,
}

impl<'t> Search<'t> {
    fn new(target: &'t Target) -> Self {
        let kept = folder().join(target.name);
        fs::create_dir_all(&kept).expect("a folder can be made");
        Self {
            target,
            coverage: Coverage::new(),
            kept: Vec::new(),
            folder: kept,
            under_way: File::create(file(target, "under-way")).expect("a file can be made"),
            problems: BTreeSet::new(),
            taken: 0,
            read: 0,
        }
    }

    /// Searches for some time; returns how many different problems there are.
    fn run(&mut self, time: Duration) -> usize {
        // What code that has run before in this process has reached.
        self.coverage.note();
        self.coverage.forget();
        let mut take = (self.target.open)();
        let seeds = (self.target.corpus)();
        for input in &seeds {
            self.take(&mut take, input);
        }
        let read = self.read;
        assert!(read > 0, "no seed is read");
        let mut earlier: Vec<PathBuf> = fs::read_dir(&self.folder)
            .into_iter()
            .flatten()
            .flatten()
            .map(|entry| entry.path())
            .collect();
        earlier.sort();
        for path in &earlier {
            let is_needed = fs::read(path).is_ok_and(|input| self.take(&mut take, &input));
            if !is_needed {
                // Others reach the same by now.
                let _ = fs::remove_file(path);
            }
        }
        println!(
            "{}: {read} of {} seeds are read; they and {} inputs of earlier runs reach {} of {} edges",
            self.target.name,
            seeds.len(),
            earlier.len(),
            self.coverage.edges(),
            self.coverage.len(),
        );
        let before = inputs_of_earlier_runs(self.target);
        let begin = Instant::now();
        let mut told = Instant::now();
        (self.taken, self.read) = (0, 0);
        for number in 0.. {
            // Another time, other inputs.
            let mut mutation = Mutation::new(before, self.target.name, number);
            let late = self.kept.len().saturating_sub(LATE);
            let base = match number % 2 {
                0 => &self.kept[late..],
                _ => &self.kept,
            };
            let input = mutation.input(base, self.target.words);
            if self.take(&mut take, &input) {
                let mut hasher = DefaultHasher::new();
                input.hash(&mut hasher);
                let file = self.folder.join(format!("{:016x}", hasher.finish()));
                let _ = fs::write(file, &input);
            }
            let is_over = begin.elapsed() >= time;
            if is_over || told.elapsed() >= NEWS {
                told = Instant::now();
                self.tell(begin.elapsed());
                let count = before + self.taken;
                let _ = fs::write(file(self.target, "inputs"), format!("{count}\n"));
            }
            if is_over {
                break;
            }
        }
        self.problems.len()
    }

    fn tell(&self, time: Duration) {
        let seconds = time.as_secs_f64();
        println!(
            "{}: {} inputs in {seconds:.0} s ({:.0}/s), {} % read, {} edges, {} kept, {} problems",
            self.target.name,
            self.taken,
            self.taken as f64 / seconds,
            100 * self.read / self.taken.max(1),
            self.coverage.edges(),
            self.kept.len(),
            self.problems.len(),
        );
    }

    /// Writes down the input that comes next.
    fn note(&mut self, input: &[u8]) -> io::Result<()> {
        self.under_way.set_len(0)?;
        self.under_way.seek(SeekFrom::Start(0))?;
        self.under_way.write_all(input)
    }

    /// Has an input taken; returns whether it reaches something new.
    fn take(&mut self, take: &mut Taker, input: &[u8]) -> bool {
        // If that fails, only the input that ends the process is lost.
        let _ = self.note(input);
        let begin = Instant::now();
        let taken = attempt(take, input);
        let is_new = self.coverage.note();
        TAKEN.fetch_add(1, Ordering::Relaxed);
        self.taken += 1;
        self.read += u64::from(taken == Ok(Taken::Read));
        if is_new {
            self.kept.push(input.to_vec());
        }
        let problem = match taken {
            Ok(_) if begin.elapsed() < SLOW => return is_new,
            Ok(_) => "it takes too long".to_owned(),
            Err(problem) => problem,
        };
        *take = (self.target.open)();
        if self.problems.insert(problem.clone()) {
            let file = file(self.target, &format!("{}.input", self.problems.len()));
            let _ = fs::write(&file, input);
            println!("{}: {problem}", file.display());
        }
        is_new
    }
}
