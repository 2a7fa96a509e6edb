//! Limits of one evaluation.

use std::fmt;
use std::time::Duration;

/// Limits of one evaluation. Without any, it may take for ever.
///
/// What reaches a limit ends as [`Failure::LimitReached`](crate::Failure::LimitReached): the plan is
/// unwound, with its cleanup forms. These have the [`grace`](Limits::grace) and ten seconds of
/// simulated time (2,400 steps); then they are ended, too.
///
/// Simulated time, steps and looks depend on the program alone: it ends at the same place in every
/// run. The wall clock does not.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    /// Simulated time (s) that may pass.
    pub simulated_time: Option<f64>,
    /// Steps that the world may take, of 1/240 s each. A world at rest takes none while time passes.
    pub steps: Option<u64>,
    /// Real time that may pass. A thread watches it; if none can be started, the limit is reached at
    /// once.
    pub wall_clock: Option<Duration>,
    /// Looks for an interrupt, which the evaluator does every few hundred calls: a measure of what a
    /// program calculates. A million take about a minute. A tenth of them is added for cleanup forms.
    pub looks: Option<u64>,
    /// Real time that cleanup forms have after a limit or an interrupt.
    pub grace: Duration,
}

impl Limits {
    /// The grace by default.
    pub const GRACE: Duration = Duration::from_secs(2);

    /// No limits.
    pub const NONE: Limits = Limits {
        simulated_time: None,
        steps: None,
        wall_clock: None,
        looks: None,
        grace: Limits::GRACE,
    };
}

impl Default for Limits {
    fn default() -> Limits {
        Limits::NONE
    }
}

/// A limit that an evaluation has reached.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Limit {
    /// [`Limits::simulated_time`].
    SimulatedTime,
    /// [`Limits::steps`].
    Steps,
    /// [`Limits::wall_clock`].
    WallClock,
    /// [`Limits::looks`].
    Looks,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Limit::SimulatedTime => "the limit of simulated time",
            Limit::Steps => "the limit of steps",
            Limit::WallClock => "the limit of real time",
            Limit::Looks => "the limit of looks for an interrupt",
        })
    }
}
