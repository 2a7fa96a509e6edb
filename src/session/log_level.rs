//! The severity of log lines.

/// Severity of a log line, or the threshold from which lines are shown.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum LogLevel {
    /// Details.
    Debug,
    /// Progress of plans.
    Info,
    /// Possible problems.
    Warn,
    /// Problems.
    Error,
    /// As a threshold: no lines at all.
    None,
}
