//! Goals of FollowJointTrajectory: whose joints, when, where.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::goal::Ended;
use robotics::robot::Side;
use robotics::world::Models;
use ros::{SceneModel, SceneState, Value};
use session::Datum;

/// How long before now a trajectory may have been to begin, and how long after.
const MAX_LATE: f64 = 0.5;
const MAX_WAIT: f64 = 60.0;

/// The names of the joints of an arm, from the shoulder to the wrist, or of the torso.
pub(super) fn part_joints(arm: Option<Side>, models: &Models) -> Vec<String> {
    let body = &models.description;
    let joints = match arm {
        Some(side) => body.arm(side).joints().to_vec(),
        None => body.torso.joint.into_iter().collect(),
    };
    let names = joints
        .iter()
        .map(|joint| models.robot.joint(*joint).name.clone());
    names.collect()
}

/// Where joints are (rad or m).
pub(super) fn positions(joints: &[String], scene: &SceneModel, state: &SceneState) -> Vec<f64> {
    let position = |name: &String| {
        let at = scene.joints.iter().position(|joint| joint == name);
        let position = at.and_then(|at| state.positions.get(at));
        position.copied().unwrap_or_default()
    };
    joints.iter().map(position).collect()
}

/// A trajectory of all joints of a part, in their order.
pub(super) struct Trajectory {
    /// When (s) each point is to be reached.
    times: Vec<f64>,
    /// Positions (rad or m) at each.
    positions: Vec<Vec<f64>>,
    /// Velocities (rad/s or m/s), if all points have them.
    velocities: Option<Vec<Vec<f64>>>,
    /// Where the joints are at first.
    now: Vec<f64>,
}

impl Trajectory {
    /// That of a goal, with the times counted from when it is begun, a time since 1970. Joints that it does not name stay
    /// where they are.
    pub(super) fn of(
        goal: &Value,
        arm: Option<Side>,
        models: &Models,
        scene: &SceneModel,
        state: &SceneState,
        begun: Duration,
    ) -> Result<Trajectory, Ended> {
        let own = part_joints(arm, models);
        let now = positions(&own, scene, state);
        let named = texts(goal.at(&["trajectory", "joint_names"]));
        let places = places(&named, &own)?;
        if list(goal.at(&["multi_dof_trajectory", "points"]))
            .next()
            .is_some()
        {
            let why = "a trajectory of joints with several degrees of freedom is not understood";
            return Err(Ended::Refused(why.to_owned()));
        }
        let delay = delay(goal, begun)?;
        let row = |numbers: &[f64], rest: &[f64]| {
            let mut row = rest.to_vec();
            for (place, number) in places.iter().zip(numbers) {
                if let Some(slot) = row.get_mut(*place) {
                    *slot = *number;
                }
            }
            row
        };
        let mut all = Trajectory {
            times: Vec::new(),
            positions: Vec::new(),
            velocities: Some(Vec::new()),
            now: now.clone(),
        };
        let still = vec![0.0; own.len()];
        for (number, point) in list(goal.at(&["trajectory", "points"])).enumerate() {
            let floats = |name| floats(point.get(name));
            let (given, speeds) = (floats("positions"), floats("velocities"));
            if !given.iter().chain(&speeds).all(|number| number.is_finite()) {
                let why = format!("point {number} has a number that is not finite");
                return Err(Ended::Refused(why));
            }
            for (numbers, may_lack) in [(&given, false), (&speeds, true)] {
                if numbers.len() != named.len() && !(may_lack && numbers.is_empty()) {
                    let why = format!(
                        "point {number} has {} numbers for {} joints",
                        numbers.len(),
                        named.len()
                    );
                    return Err(Ended::Refused(why));
                }
            }
            all.times
                .push(delay + seconds(point.get("time_from_start")));
            all.positions.push(row(&given, &now));
            match (&mut all.velocities, speeds.is_empty()) {
                (Some(velocities), false) => velocities.push(row(&speeds, &still)),
                (velocities, _) => *velocities = None,
            }
        }
        match all.times.is_empty() {
            true => Err(Ended::Refused("the trajectory has no points".to_owned())),
            false => Ok(all),
        }
    }

    /// What the plan language's function takes.
    pub(super) fn arguments(self, arms: &[Side]) -> Vec<Datum> {
        let flat = |rows: Vec<Vec<f64>>| {
            let numbers = rows.into_iter().flatten().map(Datum::Float);
            Datum::List(numbers.collect())
        };
        vec![
            match arms.is_empty() {
                true => Datum::Nil,
                false => Datum::List(arms.iter().map(|arm| Datum::keyword(arm.name())).collect()),
            },
            Datum::List(self.times.into_iter().map(Datum::Float).collect()),
            flat(self.positions),
            self.velocities.map_or(Datum::Nil, flat),
        ]
    }

    /// The joints of this trajectory and of another one, at the times of the points of either.
    pub(super) fn beside(&self, other: &Self) -> Self {
        let mut times: Vec<f64> = self.times.iter().chain(&other.times).copied().collect();
        times.sort_by(f64::total_cmp);
        times.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
        let both = |time: f64| {
            let (mut at, mut fast) = self.sample(time);
            let (more, faster) = other.sample(time);
            at.extend(more);
            fast.extend(faster);
            (at, fast)
        };
        let (positions, velocities) = times.iter().map(|time| both(*time)).unzip();
        let have_velocities = self.velocities.is_some() && other.velocities.is_some();
        Self {
            velocities: have_velocities.then_some(velocities),
            positions,
            times,
            now: self.now.iter().chain(&other.now).copied().collect(),
        }
    }

    /// Positions and velocities at a time (s): on cubic polynomials where there are velocities, else on lines.
    fn sample(&self, time: f64) -> (Vec<f64>, Vec<f64>) {
        let still = vec![0.0; self.now.len()];
        let next = self.times.iter().position(|t| *t > time);
        let next = next.unwrap_or(self.times.len());
        let point = |at: usize| {
            let velocity = self.velocities.as_ref().and_then(|all| all.get(at));
            let position = self.positions.get(at).unwrap_or(&self.now);
            (position.clone(), velocity.unwrap_or(&still).clone())
        };
        let begin = || (0.0, (self.now.clone(), still.clone()));
        let from = |at: usize| (self.times.get(at).copied().unwrap_or_default(), point(at));
        let (since, (a, u)) = next.checked_sub(1).map_or_else(begin, from);
        let Some(until) = self.times.get(next) else {
            return (a, u);
        };
        let (b, v) = point(next);
        let length = (until - since).max(1e-9);
        let part = ((time - since) / length).clamp(0.0, 1.0);
        if self.velocities.is_none() {
            let ends = a.iter().zip(&b);
            return (ends.map(|(a, b)| a + (b - a) * part).collect(), still);
        }
        let (square, cube) = (part * part, part * part * part);
        let ends = || a.iter().zip(&b).zip(u.iter().zip(&v));
        let position = |((a, b), (u, v)): ((&f64, &f64), (&f64, &f64))| {
            let slope = length * ((cube - 2.0 * square + part) * u + (cube - square) * v);
            a + (b - a) * (3.0 * square - 2.0 * cube) + slope
        };
        let velocity = |((a, b), (u, v)): ((&f64, &f64), (&f64, &f64))| {
            let slope = (3.0 * square - 4.0 * part + 1.0) * u + (3.0 * square - 2.0 * part) * v;
            6.0 * (part - square) * (b - a) / length + slope
        };
        (
            ends().map(position).collect(),
            ends().map(velocity).collect(),
        )
    }

    /// Where the joints should be after a time (s), if they began where they are `now`: on straight lines between
    /// points.
    pub(super) fn at(&self, time: f64, now: &[f64]) -> Vec<f64> {
        let next = self.times.iter().position(|t| *t > time);
        let point = |at: usize| self.positions.get(at).map_or(now, Vec::as_slice);
        match next {
            None => point(self.times.len().saturating_sub(1)).to_vec(),
            Some(0) => now.to_vec(),
            Some(at) => {
                let [from, to] = [at - 1, at].map(|at| self.times.get(at).copied().unwrap_or(time));
                let part = (time - from) / (to - from).max(1e-9);
                let ends = point(at - 1).iter().zip(point(at));
                ends.map(|(a, b)| a + (b - a) * part).collect()
            }
        }
    }
}

/// Where among the part's own joints each of the named ones is.
fn places(named: &[String], own: &[String]) -> Result<Vec<usize>, Ended> {
    let wrong = |why: String| Ended::WrongJoints(why);
    let mut places = Vec::new();
    for name in named {
        let place = own.iter().position(|joint| joint == name);
        let place = place.ok_or_else(|| {
            wrong(format!(
                "there is no joint {name:?} here, only {}",
                own.join(", ")
            ))
        })?;
        if places.contains(&place) {
            return Err(wrong(format!("the joint {name:?} is named twice")));
        }
        places.push(place);
    }
    match places.is_empty() {
        true => Err(wrong("no joint is named".to_owned())),
        false => Ok(places),
    }
}

/// The time since 1970.
pub(super) fn now() -> Duration {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    now.unwrap_or_default()
}

/// How long (s) after it is begun a trajectory starts: at once without a stamp.
fn delay(goal: &Value, begun: Duration) -> Result<f64, Ended> {
    let stamp = seconds(goal.at(&["trajectory", "header", "stamp"]));
    if stamp == 0.0 {
        return Ok(0.0);
    }
    let delay = stamp - begun.as_secs_f64();
    match delay {
        late if late < -MAX_LATE => Err(Ended::Late(format!(
            "the trajectory was to begin {:.1} s ago: a stamp of zero begins it at once",
            -late
        ))),
        wait if wait > MAX_WAIT => Err(Ended::Refused(format!(
            "the trajectory is to begin in {wait:.0} s: within {MAX_WAIT} s was expected"
        ))),
        delay => Ok(delay.max(0.0)),
    }
}

fn list(value: Option<&Value>) -> impl Iterator<Item = &Value> {
    value.and_then(Value::as_list).unwrap_or_default().iter()
}

fn floats(value: Option<&Value>) -> Vec<f64> {
    list(value).filter_map(Value::as_float).collect()
}

fn texts(value: Option<&Value>) -> Vec<String> {
    list(value)
        .filter_map(|text| Some(text.as_text()?.to_owned()))
        .collect()
}

/// The seconds of a time or a duration.
fn seconds(value: Option<&Value>) -> f64 {
    let part = |name| value.and_then(|value| value.get(name)?.as_float());
    part("sec").unwrap_or_default() + part("nanosec").unwrap_or_default() * 1e-9
}
