//! Fuzzing: whatever the parts of the program that read get to read ends in a value or an error,
//! never in a panic, an abort or a hang.
//!
//! Inputs are made of the project's own files, by a seeded generator: an input depends only on
//! its target, the seed and its number, so each can be made again. The short run is part of the
//! usual tests. The long one is
//!
//! ```text
//! FUZZ_EXECUTIONS=10000000 cargo test --lib -- fuzz::long_run --ignored --nocapture
//! ```
//!
//! `tests/fuzz/coverage/run` chooses inputs by the code that they reach, instead.
//! `FUZZ_TARGET` selects one target, `FUZZ_SEED` other inputs and `FUZZ_FROM` the number of the
//! first one. The number under way is in `target/fuzz/position`, in case an input ends the
//! process; inputs that fail are saved beside it.

mod corpus;
mod files;
#[cfg(test)]
mod found;
mod language;
mod models;
mod mutation;
mod notebooks;
mod requests;
mod robots;
#[cfg(test)]
mod run;
#[cfg(test)]
mod seeds;
mod simulators;
mod sweeps;
mod target;

#[cfg(not(test))]
pub use mutation::Mutation;
#[cfg(not(test))]
pub use target::{Taken, Taker, attempt};
pub use target::{Target, with_large_stack};

/// All targets. Shares are of a thousand executions.
pub fn targets() -> Vec<Target> {
    [
        language::targets(),
        files::targets(),
        models::targets(),
        sweeps::targets(),
        notebooks::targets(),
        requests::targets(),
        robots::targets(),
        simulators::targets(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

#[test]
fn the_shares_of_all_targets_are_the_whole() {
    let sum: u64 = targets().iter().map(|target| target.share).sum();
    assert_eq!(sum, 1000);
}

#[test]
fn short_run() {
    let found = with_large_stack(|| {
        let plan = run::Plan {
            // Enough to notice a target that does not work any more.
            executions: 8_000,
            ..run::Plan::default()
        };
        run::all(&targets(), &plan, &mut |_| {})
    });
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
#[ignore = "runs as long as it is asked to"]
fn long_run() {
    defect::keep_caught_panics_quiet();
    run::abort_when_stuck();
    let found = with_large_stack(|| {
        run::all(&targets(), &run::Plan::of_environment(), &mut |line| {
            println!("{line}");
        })
    });
    assert!(found.is_empty(), "{found:#?}");
}
