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
mod tests {
    use super::*;

    const PATIENCE: Patience = Patience {
        server: Duration::from_secs(10),
        queue: Duration::from_secs(90),
        result: Duration::from_secs(60),
    };

    fn ms(number: u64) -> Duration {
        Duration::from_millis(number)
    }

    fn nothing() -> Value {
        Value::record([])
    }

    /// A goal that was sent at 0 and accepted at 10 ms.
    fn accepted() -> ClientGoal {
        let mut goal = ClientGoal::new(PATIENCE, ms(0));
        goal.server(true, ms(0));
        assert_eq!(goal.next(ms(0)), [Ask::Goal]);
        goal.answered(true, ms(10));
        assert_eq!(goal.next(ms(11)), [Ask::Result]);
        goal
    }

    #[test]
    fn a_goal_is_sent_once_there_is_a_server_and_ends_with_its_result() {
        let mut goal = ClientGoal::new(PATIENCE, ms(0));
        assert_eq!(goal.next(ms(9_000)), []);
        goal.server(true, ms(9_500));
        assert_eq!(goal.next(ms(9_500)), [Ask::Goal]);
        assert_eq!(goal.next(ms(9_600)), []);
        goal.answered(true, ms(9_700));
        assert_eq!(goal.next(ms(9_700)), [Ask::Result]);
        assert_eq!(goal.next(ms(40_000)), []);
        goal.result(4, nothing(), ms(40_000));
        assert_eq!(goal.end(), Some(&ClientEnd::Succeeded(nothing())));
        assert_eq!(goal.oddities(), 0);
    }

    #[test]
    fn without_a_server_nothing_is_sent() {
        let mut goal = ClientGoal::new(PATIENCE, ms(0));
        assert_eq!(goal.next(ms(10_000)), []);
        let waited = ms(10_000);
        assert_eq!(goal.end(), Some(&ClientEnd::Unserved { waited }));
        // One that comes then gets nothing.
        goal.server(true, ms(10_001));
        assert_eq!(goal.next(ms(10_001)), []);
    }

    #[test]
    fn what_is_not_accepted_in_time_is_cancelled_also_when_it_is_accepted_later() {
        let mut goal = ClientGoal::new(PATIENCE, ms(0));
        goal.server(true, ms(0));
        goal.next(ms(0));
        assert_eq!(goal.next(ms(5_000)), [Ask::Cancel]);
        assert!(matches!(goal.end(), Some(ClientEnd::NoAnswer { .. })));
        assert_eq!(goal.next(ms(6_000)), []);
        goal.answered(true, ms(20_000));
        assert_eq!(goal.next(ms(20_001)), [Ask::Cancel]);
        assert_eq!(goal.next(ms(20_600)), [Ask::Cancel]);
        assert_eq!(goal.next(ms(23_000)), []);
        assert!(matches!(goal.end(), Some(ClientEnd::NoAnswer { .. })));
    }

    #[test]
    fn answers_before_they_were_asked_for_and_doubled_ones_count_for_nothing() {
        let mut goal = ClientGoal::new(PATIENCE, ms(0));
        goal.result(4, nothing(), ms(0));
        goal.answered(true, ms(0));
        // What is told of how far it is may come before its acceptance: another topic carries it.
        goal.feedback(ms(0));
        goal.server(true, ms(0));
        goal.next(ms(0));
        // It is not accepted yet.
        goal.result(4, nothing(), ms(1));
        assert_eq!((goal.end(), goal.oddities()), (None, 3));
        goal.answered(true, ms(2));
        goal.answered(false, ms(3));
        goal.answered(true, ms(3));
        assert_eq!((goal.end(), goal.oddities()), (None, 5));
        // A result that is none.
        goal.result(2, nothing(), ms(4));
        goal.result(99, nothing(), ms(4));
        assert_eq!(goal.end(), None);
        goal.result(6, nothing(), ms(5));
        goal.result(4, nothing(), ms(6));
        assert_eq!(goal.end(), Some(&ClientEnd::Aborted(nothing())));
        assert_eq!(goal.oddities(), 7);
    }

    #[test]
    fn without_a_result_in_time_a_goal_is_cancelled_and_ends_within_two_seconds() {
        for ends in [true, false] {
            let mut goal = accepted();
            assert_eq!(goal.next(ms(60_009)), []);
            assert!(goal.next(ms(60_010)).contains(&Ask::Cancel));
            if ends {
                goal.result(5, nothing(), ms(60_900));
            }
            let _asked = goal.next(ms(62_010));
            let has_ended = ends;
            let waited = PATIENCE.result;
            assert_eq!(goal.end(), Some(&ClientEnd::TimedOut { waited, has_ended }));
        }
        // One that is reached while it is cancelled is reached.
        let mut goal = accepted();
        goal.next(ms(60_010));
        goal.result(4, nothing(), ms(60_020));
        assert_eq!(goal.end(), Some(&ClientEnd::Succeeded(nothing())));
    }

    #[test]
    fn the_time_for_a_goal_begins_with_its_turn() {
        let mut goal = accepted();
        goal.status(1, ms(20));
        assert_eq!(goal.next(ms(80_000)), []);
        goal.status(2, ms(80_000));
        // What is told once more changes nothing.
        goal.status(2, ms(100_000));
        assert_eq!(goal.next(ms(139_999)), []);
        assert!(goal.next(ms(140_000)).contains(&Ask::Cancel));
        // One whose turn never comes is given up, too.
        let mut goal = accepted();
        goal.status(1, ms(20));
        assert!(goal.next(ms(90_020)).contains(&Ask::Cancel));
        goal.result(5, nothing(), ms(90_030));
        let (waited, has_ended) = (ms(90_000), true);
        assert_eq!(goal.end(), Some(&ClientEnd::NotBegun { waited, has_ended }));
    }

    #[test]
    fn who_cancels_is_told_apart() {
        let mut goal = accepted();
        goal.result(5, nothing(), ms(100));
        assert_eq!(goal.end(), Some(&ClientEnd::Canceled { by_us: false }));
        let mut goal = accepted();
        goal.cancel(ms(100));
        assert!(goal.next(ms(100)).contains(&Ask::Cancel));
        goal.result(5, nothing(), ms(200));
        assert_eq!(goal.end(), Some(&ClientEnd::Canceled { by_us: true }));
        // One that is not sent yet is never sent.
        let mut goal = ClientGoal::new(PATIENCE, ms(0));
        goal.cancel(ms(1));
        goal.server(true, ms(2));
        assert_eq!(goal.next(ms(2)), []);
        assert_eq!(goal.end(), Some(&ClientEnd::Canceled { by_us: true }));
    }

    #[test]
    fn a_goal_that_does_not_end_is_asked_to_again_and_then_told_of() {
        let mut goal = accepted();
        goal.cancel(ms(100));
        let asked = (1..40).map(|i| goal.next(ms(100 + 60 * i)));
        let asked: Vec<Ask> = asked.flatten().collect();
        assert_eq!(goal.end(), Some(&ClientEnd::NotEnding));
        let cancels = asked.iter().filter(|ask| **ask == Ask::Cancel).count();
        assert!((4..=6).contains(&cancels), "{asked:?}");
    }

    #[test]
    fn a_goal_that_is_cancelled_before_its_acceptance_is_cancelled_after_it() {
        let mut goal = ClientGoal::new(PATIENCE, ms(0));
        goal.server(true, ms(0));
        goal.next(ms(0));
        goal.cancel(ms(1));
        assert_eq!(goal.next(ms(1)), [Ask::Cancel]);
        goal.answered(true, ms(3));
        assert_eq!(goal.next(ms(4)), [Ask::Result, Ask::Cancel]);
    }

    #[test]
    fn a_server_that_was_out_of_sight_is_told_to_let_the_goal_end() {
        let mut goal = accepted();
        goal.server(false, ms(1000));
        assert_eq!(goal.next(ms(1000)), []);
        goal.server(true, ms(3000));
        assert_eq!(goal.next(ms(3000)), [Ask::Cancel]);
        goal.server(true, ms(3400));
        assert_eq!(goal.next(ms(3400)), []);
        assert_eq!(goal.next(ms(3500)), [Ask::Cancel]);
        assert_eq!(goal.next(ms(9000)), []);
        assert_eq!(goal.end(), Some(&ClientEnd::Gone));
    }

    #[test]
    fn a_server_is_gone_if_it_is_not_there_or_falls_silent() {
        let mut goal = accepted();
        goal.server(false, ms(100));
        assert_eq!(goal.end(), Some(&ClientEnd::Gone));
        // When it returns, the goal is not sent again, but is to end.
        goal.server(true, ms(200));
        assert_eq!(goal.next(ms(200)), [Ask::Cancel]);

        let mut goal = accepted();
        for i in 1..=10 {
            goal.feedback(ms(100 * i));
        }
        assert_eq!(goal.next(ms(2_900)), []);
        assert_eq!(goal.next(ms(3_000)), [Ask::Cancel]);
        assert_eq!(goal.end(), Some(&ClientEnd::Gone));
        // Who has told nothing so far may go on so.
        let mut goal = accepted();
        goal.feedback(ms(100));
        assert_eq!(goal.next(ms(30_000)), []);
        assert_eq!(goal.end(), None);
    }

    #[test]
    fn a_server_that_does_not_know_the_goal_has_forgotten_it() {
        let mut goal = accepted();
        goal.result(0, nothing(), ms(100));
        assert_eq!(goal.end(), Some(&ClientEnd::Forgotten));
    }

    #[test]
    fn a_result_that_is_lost_is_asked_for_again_once_the_server_says_that_the_goal_has_ended() {
        let mut goal = accepted();
        goal.status(GoalState::Executing as i64, ms(20));
        assert_eq!(goal.next(ms(3_000)), []);
        goal.status(GoalState::Succeeded as i64, ms(3_100));
        assert_eq!(goal.next(ms(3_100)), [Ask::Result]);
        assert_eq!(goal.next(ms(3_200)), []);
        assert_eq!(goal.next(ms(3_700)), [Ask::Result]);
        goal.result(GoalState::Succeeded as i64, nothing(), ms(3_800));
        assert_eq!(goal.end(), Some(&ClientEnd::Succeeded(nothing())));
    }

    #[test]
    fn a_goal_that_reports_how_far_it_is_waits_for_its_turn_no_longer() {
        let mut goal = accepted();
        goal.status(GoalState::Accepted as i64, ms(20));
        goal.feedback(ms(30_000));
        // A minute from then on.
        assert_eq!(goal.next(ms(89_000)), []);
        assert_eq!(goal.next(ms(90_100)), [Ask::Result, Ask::Cancel]);
    }
}
