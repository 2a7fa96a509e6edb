//! Runs targets on inputs, and keeps what fails.

use std::env;
use std::fs::{self, File};
use std::io::{Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::mutation::Mutation;
use super::target::{Target, attempt};

/// How much is to be done.
#[derive(Default)]
pub(super) struct Plan {
    pub(super) executions: u64,
    pub(super) seed: u64,
    /// Number of the first input.
    pub(super) from: u64,
    /// The only target, if not all of them.
    pub(super) target: Option<String>,
}

impl Plan {
    /// As the environment says.
    pub(super) fn of_environment() -> Self {
        let number = |name, usual| {
            let text = env::var(name).ok();
            text.map_or(usual, |text| text.parse().expect("a number is expected"))
        };
        Self {
            executions: number("FUZZ_EXECUTIONS", 1_000_000),
            seed: number("FUZZ_SEED", 1),
            from: number("FUZZ_FROM", 0),
            target: env::var("FUZZ_TARGET").ok(),
        }
    }
}

/// An input that fails.
#[derive(Debug)]
pub(super) struct Found {
    #[expect(dead_code, reason = "for whoever reads the report")]
    target: &'static str,
    #[expect(dead_code, reason = "for whoever reads the report")]
    number: u64,
    problem: String,
    #[expect(dead_code, reason = "for whoever reads the report")]
    input: String,
}

/// Maximum number of inputs that are kept for each target.
const MAX_FOUND: usize = 20;

/// An input that takes longer is a finding, too: nothing that is read is large.
const SLOW: Duration = Duration::from_secs(30);

/// Counts executions, for the watch over them.
static EXECUTED: AtomicU64 = AtomicU64::new(0);

/// Runs the targets, one after the other.
pub(super) fn all(targets: &[Target], plan: &Plan, tell: &mut dyn FnMut(String)) -> Vec<Found> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("target/fuzz");
    fs::create_dir_all(&folder).expect("a folder can be made");
    let mut found = Vec::new();
    let (begin, mut executed) = (Instant::now(), 0);
    for target in targets {
        let share = if plan.target.is_some() {
            1000
        } else {
            target.share
        };
        if plan.target.as_ref().is_some_and(|name| name != target.name) {
            continue;
        }
        let count = plan.executions * share / 1000;
        let begin = Instant::now();
        let before = EXECUTED.load(Ordering::Relaxed);
        found.extend(one(target, plan, count, &folder));
        let count = EXECUTED.load(Ordering::Relaxed) - before;
        executed += count;
        let seconds = begin.elapsed().as_secs_f64();
        let rate = count as f64 / seconds;
        tell(format!(
            "{:12} {count:9} executions in {seconds:6.0} s ({rate:6.0}/s), {} found",
            target.name,
            found.len()
        ));
    }
    let seconds = begin.elapsed().as_secs_f64();
    tell(format!(
        "all          {executed:9} executions in {seconds:6.0} s"
    ));
    found
}

fn one(target: &Target, plan: &Plan, count: u64, folder: &std::path::Path) -> Vec<Found> {
    let mut position = File::create(folder.join("position")).expect("a file can be made");
    let corpus = (target.corpus)();
    assert!(!corpus.is_empty(), "{} has no corpus", target.name);
    let mut take = (target.open)();
    let mut found: Vec<Found> = Vec::new();
    for number in plan.from..plan.from + count {
        let input = Mutation::new(plan.seed, target.name, number).input(&corpus, target.words);
        // If that fails, only the number of an input that ends the process is lost.
        let _ = position.seek(SeekFrom::Start(0));
        let _ = position.write_all(format!("{} {number:12}\n", target.name).as_bytes());
        let mut timed = || {
            let begin = Instant::now();
            let outcome = attempt(&mut take, &input);
            (outcome, begin.elapsed() >= SLOW)
        };
        let (mut outcome, mut is_slow) = timed();
        if is_slow {
            // Other processes may have slowed it down.
            (outcome, is_slow) = timed();
        }
        let problem = match outcome {
            Ok(_) => is_slow.then(|| "it takes too long".to_owned()),
            Err(problem) => Some(problem),
        };
        EXECUTED.fetch_add(1, Ordering::Relaxed);
        let Some(problem) = problem else { continue };
        take = (target.open)();
        if found.iter().any(|known| known.problem == problem) {
            continue;
        }
        let file = folder.join(format!("{}-{number}.input", target.name));
        // The report has the input, too.
        let _ = fs::write(file, &input);
        found.push(Found {
            target: target.name,
            number,
            problem,
            input: String::from_utf8_lossy(&input).into_owned(),
        });
        if found.len() == MAX_FOUND {
            break;
        }
    }
    found
}

/// Ends the process if a single execution takes minutes.
pub(super) fn abort_when_stuck() {
    thread::spawn(|| {
        loop {
            let before = EXECUTED.load(Ordering::Relaxed);
            thread::sleep(Duration::from_secs(300));
            if EXECUTED.load(Ordering::Relaxed) == before {
                println!("stuck: see target/fuzz/position");
                std::process::abort();
            }
        }
    });
}
