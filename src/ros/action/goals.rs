//! The goals of an action server: what becomes of them, who asks for their results.

use std::time::{Duration, Instant};

use indexmap::IndexMap;

use crate::message;
use crate::value::Value;

/// Identifies a goal.
pub type GoalId = [u8; 16];

/// How long the result of a goal is kept after its end.
const KEPT: Duration = Duration::from_secs(15 * 60);

/// Maximum number of goals that are kept.
const MAX_GOALS: usize = 256;

/// What has become of a goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoalState {
    /// It has been accepted and waits.
    Accepted = 1,
    /// It is carried out.
    Executing = 2,
    /// It is to end.
    Canceling = 3,
    /// It has been reached.
    Succeeded = 4,
    /// It has ended because somebody wanted that.
    Canceled = 5,
    /// It has not been reached.
    Aborted = 6,
}

/// How a goal ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoalEnd {
    /// It has been reached.
    Succeeded,
    /// It was to end.
    Canceled,
    /// It has not been reached.
    Aborted,
}

impl GoalState {
    fn has_ended(self) -> bool {
        self as u8 >= Self::Succeeded as u8
    }
}

/// What a request to cancel has led to.
#[derive(Clone, Debug, PartialEq)]
pub struct Canceling {
    /// The goals that are to end now, which they were not before.
    pub goals: Vec<GoalId>,
    /// What the client is answered.
    pub answer: Value,
}

/// What comes of a request for a result.
#[derive(Clone, Debug, PartialEq)]
pub enum ResultRequest {
    /// The answer.
    Answer(Value),
    /// The answer comes when the goal has ended.
    Later,
}

struct Goal {
    /// When it was accepted, since 1970.
    accepted: Duration,
    state: GoalState,
    /// The result, once it has ended, and when.
    ended: Option<(Value, Instant)>,
}

/// The goals of an action server.
#[derive(Default)]
pub struct Goals {
    goals: IndexMap<GoalId, Goal>,
}

/// The codes of answers to requests to cancel.
const CANCELING: i64 = 0;
const REJECTED: i64 = 1;
const UNKNOWN_GOAL: i64 = 2;
const HAS_ENDED: i64 = 3;

/// The state of a goal that is not known.
const UNKNOWN: i64 = 0;

impl Goals {
    /// Accepts a goal at a time since 1970; false if a goal has had that identity already, or if too many have not
    /// ended.
    pub fn accept(&mut self, id: GoalId, now: Duration) -> bool {
        self.forget(Instant::now());
        if self.goals.contains_key(&id) || self.goals.len() >= MAX_GOALS {
            return false;
        }
        let goal = Goal {
            accepted: now,
            state: GoalState::Accepted,
            ended: None,
        };
        self.goals.insert(id, goal);
        true
    }

    /// Forgets the goals whose results need not be kept any more; of too many, the oldest that have ended.
    fn forget(&mut self, now: Instant) {
        self.goals.retain(|_, goal| {
            let ended = goal.ended.as_ref();
            ended.is_none_or(|(_, at)| now.saturating_duration_since(*at) < KEPT)
        });
        while self.goals.len() >= MAX_GOALS {
            let oldest = self.goals.iter().position(|(_, goal)| goal.ended.is_some());
            match oldest {
                Some(oldest) => drop(self.goals.shift_remove_index(oldest)),
                None => return,
            }
        }
    }

    /// The goal is carried out from now on, unless it is to end already.
    pub fn begin(&mut self, id: &GoalId) {
        if let Some(goal) = self.goals.get_mut(id)
            && goal.state == GoalState::Accepted
        {
            goal.state = GoalState::Executing;
        }
    }

    /// What has become of a goal.
    pub fn state(&self, id: &GoalId) -> Option<GoalState> {
        self.goals.get(id).map(|goal| goal.state)
    }

    /// A goal has ended, with a result. Only the first end counts; false for others, and for a goal that nobody asked
    /// to cancel, which cannot be cancelled.
    pub fn end(&mut self, id: &GoalId, end: GoalEnd, result: Value) -> bool {
        let Some(goal) = self.goals.get_mut(id) else {
            return false;
        };
        let is_wrong = end == GoalEnd::Canceled && goal.state != GoalState::Canceling;
        if goal.state.has_ended() || is_wrong {
            return false;
        }
        goal.state = match end {
            GoalEnd::Succeeded => GoalState::Succeeded,
            GoalEnd::Canceled => GoalState::Canceled,
            GoalEnd::Aborted => GoalState::Aborted,
        };
        goal.ended = Some((result, Instant::now()));
        true
    }

    /// Answers the request for a result.
    pub fn result(&self, id: &GoalId) -> ResultRequest {
        match self.goals.get(id) {
            None => ResultRequest::Answer(Value::record([("status", UNKNOWN.into())])),
            Some(goal) => match &goal.ended {
                None => ResultRequest::Later,
                Some((result, _)) => ResultRequest::Answer(Value::record([
                    ("status", (goal.state as i64).into()),
                    ("result", result.clone()),
                ])),
            },
        }
    }

    /// Lets goals end: that of an identity, and those that were accepted up to a time. An identity of zeros is none;
    /// with the time zero, too, all goals are meant.
    pub fn cancel(&mut self, id: GoalId, up_to: Duration) -> Canceling {
        let has_id = id != [0; 16];
        let has_time = !up_to.is_zero();
        let is_meant = |known: &GoalId, goal: &Goal| {
            let by_id = has_id && *known == id;
            let by_time = has_time && goal.accepted <= up_to;
            by_id || by_time || (!has_id && !has_time)
        };
        let named = has_id.then(|| self.goals.get(&id).map(|goal| goal.state));
        let mut fresh = Vec::new();
        let mut ending = Vec::new();
        for (known, goal) in &mut self.goals {
            if !is_meant(known, goal) || goal.state.has_ended() {
                continue;
            }
            if goal.state != GoalState::Canceling {
                goal.state = GoalState::Canceling;
                fresh.push(*known);
            }
            ending.push(info(known, goal));
        }
        let code = match (ending.is_empty(), named) {
            (false, _) => CANCELING,
            (true, Some(None)) => UNKNOWN_GOAL,
            (true, Some(Some(state))) if state.has_ended() => HAS_ENDED,
            (true, _) => REJECTED,
        };
        // A request for all goals is no mistake if there are none.
        let code = if !has_id && !has_time {
            CANCELING
        } else {
            code
        };
        Canceling {
            goals: fresh,
            answer: Value::record([
                ("return_code", code.into()),
                ("goals_canceling", Value::List(ending)),
            ]),
        }
    }

    /// What has become of all goals, as a message.
    pub fn status(&self) -> Value {
        let goals = self.goals.iter().map(|(id, goal)| {
            Value::record([
                ("goal_info", info(id, goal)),
                ("status", (goal.state as i64).into()),
            ])
        });
        Value::record([("status_list", Value::list(goals))])
    }
}

/// A goal with the time at which it was accepted.
fn info(id: &GoalId, goal: &Goal) -> Value {
    let uuid = Value::record([("uuid", Value::Bytes(id.to_vec()))]);
    Value::record([("goal_id", uuid), ("stamp", message::time(goal.accepted))])
}

#[cfg(test)]
mod tests {
    use crate::action::goals::*;

    fn id(number: u8) -> GoalId {
        [number; 16]
    }

    fn seconds(number: u64) -> Duration {
        Duration::from_secs(number)
    }

    /// Goals 1, 2 and 3, accepted at 10, 20 and 30 s; 1 has ended.
    fn three() -> Goals {
        let mut goals = Goals::default();
        for number in 1..=3 {
            assert!(goals.accept(id(number), seconds(10 * u64::from(number))));
            goals.begin(&id(number));
        }
        assert!(goals.end(&id(1), GoalEnd::Succeeded, Value::record([])));
        goals
    }

    fn code(canceling: &Canceling) -> Option<i64> {
        canceling
            .answer
            .get("return_code")
            .and_then(Value::as_integer)
    }

    #[test]
    fn a_request_to_cancel_means_what_the_protocol_says() {
        for (given, up_to, wanted, answer) in [
            // All of them.
            (0, 0, &[2, 3][..], 0),
            // All up to a time.
            (0, 20, &[2], 0),
            (0, 5, &[], 1),
            // One.
            (3, 0, &[3], 0),
            // One, and all up to a time.
            (3, 20, &[2, 3], 0),
            // One that has ended, and one that never was.
            (1, 0, &[], 3),
            (9, 0, &[], 2),
        ] {
            let mut goals = three();
            let canceling = goals.cancel(id(given), seconds(up_to));
            let wanted: Vec<GoalId> = wanted.iter().map(|number| id(*number)).collect();
            assert_eq!(canceling.goals, wanted, "{given} {up_to}");
            assert_eq!(code(&canceling), Some(answer), "{given} {up_to}");
        }
        assert_eq!(code(&Goals::default().cancel(id(0), seconds(0))), Some(0));
    }

    #[test]
    fn a_second_request_to_cancel_is_answered_and_has_no_effect() {
        let mut goals = three();
        goals.cancel(id(2), seconds(0));
        let again = goals.cancel(id(2), seconds(0));
        assert_eq!((again.goals.len(), code(&again)), (0, Some(0)));
        let ending = again.answer.get("goals_canceling").and_then(Value::as_list);
        assert_eq!(ending.map(<[_]>::len), Some(1));
    }

    #[test]
    fn a_goal_ends_once_and_is_only_cancelled_where_somebody_asked() {
        let mut goals = three();
        let nothing = || Value::record([]);
        assert!(!goals.end(&id(1), GoalEnd::Aborted, nothing()));
        assert!(!goals.end(&id(2), GoalEnd::Canceled, nothing()));
        goals.cancel(id(2), seconds(0));
        // What was too far on to be stopped may succeed.
        assert!(goals.end(&id(2), GoalEnd::Succeeded, nothing()));
        goals.cancel(id(3), seconds(0));
        assert!(goals.end(&id(3), GoalEnd::Canceled, nothing()));
        assert!(!goals.end(&id(9), GoalEnd::Aborted, nothing()));
        let states = [1, 2, 3].map(|number| goals.state(&id(number)));
        let wanted = [
            GoalState::Succeeded,
            GoalState::Succeeded,
            GoalState::Canceled,
        ];
        assert_eq!(states, wanted.map(Some));
    }

    #[test]
    fn a_goal_that_is_cancelled_before_it_begins_does_not_begin() {
        let mut goals = Goals::default();
        assert!(goals.accept(id(1), seconds(1)));
        goals.cancel(id(1), seconds(0));
        goals.begin(&id(1));
        assert_eq!(goals.state(&id(1)), Some(GoalState::Canceling));
    }

    #[test]
    fn results_are_answered_after_the_end_and_unknown_for_others() {
        let goals = three();
        let status = |number: u8| match goals.result(&id(number)) {
            ResultRequest::Answer(answer) => answer.get("status").and_then(Value::as_integer),
            ResultRequest::Later => None,
        };
        assert_eq!([status(1), status(2), status(9)], [Some(4), None, Some(0)]);
    }

    #[test]
    fn an_identity_is_accepted_once_and_goals_do_not_pile_up() {
        let mut goals = three();
        assert!(!goals.accept(id(1), seconds(40)) && !goals.accept(id(2), seconds(40)));
        for number in 0..2000u32 {
            let mut id = [7; 16];
            id[..4].copy_from_slice(&number.to_le_bytes());
            assert!(goals.accept(id, seconds(50)));
            assert!(goals.end(&id, GoalEnd::Aborted, Value::record([])));
        }
        assert!(goals.goals.len() <= MAX_GOALS);
        // Those under way are never forgotten.
        assert_eq!(goals.state(&id(2)), Some(GoalState::Executing));
    }
}
