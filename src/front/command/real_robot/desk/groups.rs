//! Goals that belong together: none is sent before all servers are there, and none begins before all were accepted.

use std::time::Duration;

use super::super::goal_message::goal_message;
use super::{Desk, Running, Wanted, lock, seconds};
use robotics::motion::RobotTrouble;
use ros::action::Patience;
use session::outside::{PartGoal, RobotEnd};

/// How long a goal may wait for its turn, where its server says that it does.
const QUEUE: Duration = Duration::from_secs(60);
/// How long after they are sent goals of several parts begin, so that all servers have accepted them before.
const TOGETHER: Duration = Duration::from_millis(500);
/// How long before that it is decided whether they have: a cancellation takes its time, too.
const CANCELLING: Duration = Duration::from_millis(150);

/// How long one server has to be the only one before it gets a goal: others may be found after it.
const ALONE: Duration = Duration::from_secs(1);

/// Goals that wait for their servers.
pub(super) struct Waiting {
    pub(super) goals: Vec<Wanted>,
    pub(super) since: Duration,
}

impl Desk {
    /// Ends goals of which none was sent.
    pub(super) fn give_up(&self, waiting: Waiting, trouble: Option<RobotTrouble>) {
        for goal in waiting.goals {
            let end = RobotEnd {
                is_cancelled: trouble.is_none(),
                trouble: trouble.clone(),
                ..RobotEnd::default()
            };
            lock(&self.shared).ends.insert(goal.ticket, end);
        }
    }

    /// Sends goals whose servers are all there, each of them once.
    pub(super) fn send_waiting(&mut self, now: Duration) {
        for waiting in std::mem::take(&mut self.waiting) {
            let place = |goal: &Wanted| {
                let mut parts = self.ends.parts.iter();
                parts.position(|part| part.interface.part == goal.part)
            };
            let places: Option<Vec<usize>> = waiting.goals.iter().map(place).collect();
            let Some(places) = places else {
                let unknown = waiting.goals.iter().find(|goal| place(goal).is_none());
                let part = unknown.map_or("", |goal| goal.part.name());
                let text = format!("the robot has no action for the part {part}");
                self.give_up(waiting, Some(RobotTrouble::NotPossible(text)));
                continue;
            };
            let mut trouble = None;
            let mut is_alone = true;
            let waited = now.saturating_sub(waiting.since).as_secs_f64();
            for part in places
                .iter()
                .filter_map(|place| self.ends.parts.get(*place))
            {
                let name = part.interface.name.clone();
                let (servers, since) = part.client.counted();
                match servers {
                    1 => is_alone &= now.saturating_sub(since) >= ALONE,
                    0 => trouble = Some(RobotTrouble::Unserved { name, waited }),
                    _ => {
                        trouble = Some(RobotTrouble::Contested {
                            name,
                            servers,
                            waited,
                        });
                    }
                }
            }
            match trouble {
                None if !is_alone => self.waiting.push(waiting),
                None => self.send(waiting.goals, &places, now),
                Some(_) if waited < self.interface.server_time_out => self.waiting.push(waiting),
                trouble => self.give_up(waiting, trouble),
            }
        }
    }

    /// Sends goals. Trajectories of several parts have a stamp, so that these begin together after all were accepted.
    pub(super) fn send(&mut self, goals: Vec<Wanted>, places: &[usize], now: Duration) {
        let follows = |goal: &Wanted| matches!(goal.goal, PartGoal::Follow { .. });
        let is_group = goals.len() > 1 && goals.iter().all(follows);
        let is_free = self.running.is_empty();
        // A server that carries out one goal after the other would find the stamp out of date behind others.
        let ahead = self.ahead().filter(|_| is_group && is_free);
        let stamp = ahead.and_then(|ahead| {
            let stamp = (now + TOGETHER).as_secs_f64() + ahead;
            Duration::try_from_secs_f64(stamp).ok()
        });
        let first = goals.first().map_or(0, |goal| goal.ticket);
        let together = stamp.map(|_| (now + TOGETHER, first));
        for (wanted, place) in goals.into_iter().zip(places) {
            let Some(part) = self.ends.parts.get_mut(*place) else {
                continue;
            };
            let stamp = stamp.unwrap_or_default();
            let message = goal_message(&wanted.goal, &self.interface.map, &self.camera, stamp);
            let patience = Patience {
                server: seconds(self.interface.server_time_out),
                queue: QUEUE,
                result: wanted.time_out + stamp_time(together.is_some()),
            };
            let id = part.client.send(message, patience, now);
            self.running.push(Running {
                ticket: wanted.ticket,
                part: *place,
                id,
                together,
                verdict: None,
            });
        }
    }

    /// Gives up all goals that were to begin together if one of them was not accepted by then.
    pub(super) fn keep_together(&mut self, now: Duration) {
        let mut apart: Vec<(u64, RobotTrouble)> = Vec::new();
        for goal in &self.running {
            let (Some((begin, first)), Some(part)) =
                (goal.together, self.ends.parts.get(goal.part))
            else {
                continue;
            };
            let name = part.interface.name.clone();
            // A margin, so that what is cancelled has not begun.
            if now + CANCELLING >= begin && !part.client.is_accepted(&goal.id) {
                apart.push((first, RobotTrouble::Apart { name }));
            }
        }
        for goal in &mut self.running {
            let Some((begin, first)) = goal.together else {
                continue;
            };
            let trouble = apart.iter().find(|(known, _)| *known == first);
            if let (Some((_, trouble)), Some(part)) = (trouble, self.ends.parts.get_mut(goal.part))
            {
                goal.verdict = Some(trouble.clone());
                part.client.cancel(&goal.id, now);
            }
            if now + CANCELLING >= begin {
                goal.together = None;
            }
        }
    }
}

/// How much longer a goal takes that begins together with others.
fn stamp_time(is_together: bool) -> Duration {
    if is_together {
        TOGETHER
    } else {
        Duration::ZERO
    }
}
