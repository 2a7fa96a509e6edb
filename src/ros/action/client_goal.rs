//! A goal as its client sees it: what has been asked, what was answered, and what is to be asked next.
//!
//! Nothing here knows the network. Servers may lie: they answer late, twice, before they were asked, or never. So only
//! what answers a question of this goal counts, each question is asked again or given up after a time, and a goal that
//! is given up is cancelled, also if it is accepted only later.

use std::time::Duration;

use super::goals::GoalState;
use crate::value::Value;

/// How long a client waits for what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// For a server.
    pub server: Duration,
    /// For the begin of a goal that was accepted, as long as the server says that it waits for its turn.
    pub queue: Duration,
    /// For the result, since the goal was accepted, or since its turn has come.
    pub result: Duration,
}

/// How long a server may take to say whether it accepts a goal.
const ANSWER: Duration = Duration::from_secs(5);
/// How long a goal that was to end may take for that.
const ENDING: Duration = Duration::from_secs(2);
/// How long to wait before something is asked once more: a request may be lost with a server.
const AGAIN: Duration = Duration::from_millis(500);
/// For how long a goal that was given up is still cancelled if it turns out to be accepted.
const REMEMBERED: Duration = Duration::from_secs(60);
/// A server that has told how far it is at least this often, and at least every so often, is gone once it does not for
/// the last time.
const TOLD: u32 = 3;
const TELLS: Duration = Duration::from_millis(500);
const SILENT: Duration = Duration::from_secs(2);

/// What is to be asked of the server.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ask {
    /// To carry the goal out.
    Goal,
    /// For the result.
    Result,
    /// To let the goal end.
    Cancel,
}

/// How a goal has ended for its client.
#[derive(Clone, Debug, PartialEq)]
pub enum ClientEnd {
    /// Nobody serves the action. Nothing was sent.
    Unserved {
        /// How long that was waited for.
        waited: Duration,
    },
    /// The server has not said whether it accepts the goal.
    NoAnswer {
        /// How long that was waited for.
        waited: Duration,
    },
    /// The server has rejected the goal.
    Rejected,
    /// The goal was accepted, and its turn has not come in time.
    NotBegun {
        /// How long that was waited for.
        waited: Duration,
        /// Whether the goal has ended then, since it was cancelled.
        has_ended: bool,
    },
    /// The goal was reached, as the server says.
    Succeeded(Value),
    /// The server has given up.
    Aborted(Value),
    /// The goal has been cancelled.
    Canceled {
        /// Whether this client wanted that.
        by_us: bool,
    },
    /// There was no result in time.
    TimedOut {
        /// How long it was waited for.
        waited: Duration,
        /// Whether the goal has ended then, since it was cancelled.
        has_ended: bool,
    },
    /// It was to end, and nothing says that it has.
    NotEnding,
    /// The server is gone.
    Gone,
    /// The server does not know the goal, which it had accepted: it may have begun anew.
    Forgotten,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// Waits for a server.
    Waiting,
    /// The goal has been sent.
    Sent,
    /// It was accepted.
    Accepted,
    /// Nothing is expected any more.
    Over,
}

/// A goal of a client. Times are those of a clock that never jumps.
#[derive(Clone, Debug)]
pub struct ClientGoal {
    patience: Patience,
    stage: Stage,
    /// Since when it has been in that stage.
    since: Duration,
    server_is_there: bool,
    /// When the result was asked for last; when the goal was to end, and when that was asked for last.
    asked_result: Option<Duration>,
    wanted_end: Option<Duration>,
    asked_end: Option<Duration>,
    /// Whether it was to end since there was no result in time.
    is_late: bool,
    /// Since when the server says that the goal waits for its turn, if it does.
    queued: Option<Duration>,
    /// Whether the server says that it has ended: a result that is not there yet may be lost.
    has_ended: bool,
    /// How often, since when, and when last the server has told how far it is.
    told: u32,
    told_first: Duration,
    told_last: Duration,
    end: Option<ClientEnd>,
    ended_at: Duration,
    /// Answers that answer nothing.
    oddities: u64,
}

impl ClientGoal {
    /// A goal that is to be sent as soon as there is a server.
    pub fn new(patience: Patience, now: Duration) -> Self {
        Self {
            patience,
            stage: Stage::Waiting,
            since: now,
            server_is_there: false,
            asked_result: None,
            wanted_end: None,
            asked_end: None,
            is_late: false,
            queued: None,
            has_ended: false,
            told: 0,
            told_first: now,
            told_last: now,
            end: None,
            ended_at: now,
            oddities: 0,
        }
    }

    /// How it has ended, if it has.
    pub fn end(&self) -> Option<&ClientEnd> {
        self.end.as_ref()
    }

    /// Whether it may be forgotten: it has ended, and no late answer matters any more.
    pub fn is_over(&self, now: Duration) -> bool {
        self.end.is_some() && now.saturating_sub(self.ended_at) > REMEMBERED
    }

    /// Whether the server has accepted it, or it has ended.
    pub fn is_accepted(&self) -> bool {
        self.end.is_some() || self.stage == Stage::Accepted
    }

    /// Whether the server may be carrying it out.
    pub fn may_run(&self) -> bool {
        self.end.is_none() && matches!(self.stage, Stage::Sent | Stage::Accepted)
    }

    /// How many answers were none: for other goals, doubled, or before anything was asked.
    pub fn oddities(&self) -> u64 {
        self.oddities
    }

    /// Whether a server is there now, with all that a goal needs.
    pub fn server(&mut self, is_there: bool, now: Duration) {
        let was_there = std::mem::replace(&mut self.server_is_there, is_there);
        if was_there && !is_there && matches!(self.stage, Stage::Sent | Stage::Accepted) {
            self.finish(ClientEnd::Gone, now);
        }
        // It was only out of sight, and may still carry the goal out.
        if !was_there && is_there && self.end == Some(ClientEnd::Gone) {
            self.wanted_end = Some(now);
            self.asked_end = None;
        }
    }

    /// The server has said whether it accepts the goal.
    pub fn answered(&mut self, is_accepted: bool, now: Duration) {
        match self.stage {
            Stage::Sent if is_accepted => {
                self.stage = Stage::Accepted;
                self.since = now;
                // Only that says whether it has ended.
                self.asked_end = None;
            }
            Stage::Sent => self.finish(ClientEnd::Rejected, now),
            // What was given up must not begin.
            Stage::Over if is_accepted && self.is_given_up() => {
                self.oddities += 1;
                self.wanted_end = Some(now);
                self.asked_end = None;
            }
            _ => self.oddities += 1,
        }
    }

    /// The server has told a result, which this goal has asked for.
    pub fn result(&mut self, status: i64, result: Value, now: Duration) {
        if self.stage != Stage::Accepted {
            // A question that was asked again may be answered again.
            self.oddities += u64::from(self.stage != Stage::Over);
            return;
        }
        let end = match status {
            s if s == GoalState::Succeeded as i64 => ClientEnd::Succeeded(result),
            s if s == GoalState::Aborted as i64 => ClientEnd::Aborted(result),
            s if s == GoalState::Canceled as i64 => ClientEnd::Canceled {
                by_us: self.wanted_end.is_some(),
            },
            0 => ClientEnd::Forgotten,
            _ => {
                self.oddities += 1;
                return;
            }
        };
        let is_end = !matches!(end, ClientEnd::Succeeded(_) | ClientEnd::Forgotten);
        match self.is_late && is_end {
            true => {
                let end = self.late(true);
                self.finish(end, now);
            }
            false => self.finish(end, now),
        }
    }

    /// The server has told in what state the goal is. That is no result: those are asked for.
    pub fn status(&mut self, status: i64, now: Duration) {
        if self.stage != Stage::Accepted {
            return;
        }
        let ends = [
            GoalState::Succeeded,
            GoalState::Aborted,
            GoalState::Canceled,
        ];
        self.has_ended |= ends.map(|end| end as i64).contains(&status);
        match (status == GoalState::Accepted as i64, self.queued) {
            (true, None) => self.queued = Some(now),
            (false, Some(_)) => {
                self.queued = None;
                self.since = now;
            }
            _ => {}
        }
    }

    /// The server has told how far it is.
    pub fn feedback(&mut self, now: Duration) {
        if self.stage == Stage::Accepted {
            if self.told == 0 {
                self.told_first = now;
            }
            self.told += 1;
            self.told_last = now;
            // Its turn has come, whatever became of the message about that.
            if self.queued.take().is_some() {
                self.since = now;
            }
        }
    }

    /// An answer that answers nothing.
    pub fn oddity(&mut self) {
        self.oddities += 1;
    }

    /// The goal is to end.
    pub fn cancel(&mut self, now: Duration) {
        match self.stage {
            Stage::Waiting => self.finish(ClientEnd::Canceled { by_us: true }, now),
            Stage::Sent | Stage::Accepted if self.wanted_end.is_none() => {
                self.wanted_end = Some(now);
            }
            _ => {}
        }
    }

    /// What is to be asked now.
    pub fn next(&mut self, now: Duration) -> Vec<Ask> {
        let waited = now.saturating_sub(self.since);
        match self.stage {
            Stage::Waiting if self.server_is_there => {
                self.stage = Stage::Sent;
                self.since = now;
                return vec![Ask::Goal];
            }
            Stage::Waiting if waited >= self.patience.server => {
                self.finish(ClientEnd::Unserved { waited }, now);
            }
            Stage::Sent if waited >= ANSWER => {
                self.finish(ClientEnd::NoAnswer { waited }, now);
                // It may have been accepted.
                return vec![Ask::Cancel];
            }
            Stage::Accepted => {
                if self.wanted_end.is_none() && self.is_silent(now) {
                    self.finish(ClientEnd::Gone, now);
                    // It may be there after all.
                    return vec![Ask::Cancel];
                }
                let is_late = match self.queued {
                    Some(queued) => now.saturating_sub(queued) >= self.patience.queue,
                    None => waited >= self.patience.result,
                };
                if self.wanted_end.is_none() && is_late {
                    self.is_late = true;
                    self.wanted_end = Some(now);
                }
            }
            _ => {}
        }
        self.asks(now)
    }

    fn asks(&mut self, now: Duration) -> Vec<Ask> {
        let mut asks = Vec::new();
        let is_due =
            |asked: Option<Duration>| asked.is_none_or(|at| now.saturating_sub(at) >= AGAIN);
        // A server answers a request for a result when the goal has ended; asked again, it answers again.
        let asks_again = (self.wanted_end.is_some() || self.has_ended) && is_due(self.asked_result);
        if self.stage == Stage::Accepted && (self.asked_result.is_none() || asks_again) {
            self.asked_result = Some(now);
            asks.push(Ask::Result);
        }
        if let Some(wanted) = self.wanted_end {
            if now.saturating_sub(wanted) >= ENDING {
                if self.stage != Stage::Over {
                    let end = match self.is_late {
                        true => self.late(false),
                        false => ClientEnd::NotEnding,
                    };
                    self.finish(end, now);
                    asks.push(Ask::Cancel);
                }
                self.wanted_end = None;
            } else if is_due(self.asked_end) {
                self.asked_end = Some(now);
                asks.push(Ask::Cancel);
            }
        }
        asks
    }

    /// The end of a goal that was cancelled since nothing came of it in time.
    fn late(&self, has_ended: bool) -> ClientEnd {
        match self.queued {
            Some(_) => ClientEnd::NotBegun {
                waited: self.patience.queue,
                has_ended,
            },
            None => ClientEnd::TimedOut {
                waited: self.patience.result,
                has_ended,
            },
        }
    }

    /// Whether a server that used to tell how far it is does not any more.
    fn is_silent(&self, now: Duration) -> bool {
        let spread = self.told_last.saturating_sub(self.told_first);
        let is_steady = self.told >= TOLD && spread <= TELLS * (self.told - 1);
        is_steady && now.saturating_sub(self.told_last) >= SILENT
    }

    /// Whether it has ended in a way after which the server must not carry it out.
    fn is_given_up(&self) -> bool {
        matches!(
            self.end,
            Some(
                ClientEnd::NoAnswer { .. }
                    | ClientEnd::Canceled { .. }
                    | ClientEnd::NotEnding
                    | ClientEnd::Gone
                    | ClientEnd::TimedOut { .. }
                    | ClientEnd::NotBegun { .. }
            )
        )
    }

    fn finish(&mut self, end: ClientEnd, now: Duration) {
        self.stage = Stage::Over;
        self.end = Some(end);
        self.ended_at = now;
        self.wanted_end = None;
    }
}

#[cfg(test)]
mod tests;
