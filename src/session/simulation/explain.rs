//! The long form of a failure: what is known about it, and what would work.
//!
//! A copy of the world at the time of the failure is kept, so that the answer does not
//! depend on what has happened since.

use std::collections::BTreeMap;
use std::fmt::Write;

use nalgebra::{Point3, Vector3};

use super::Simulation;
use super::grasp_search::Wanted;
use lisp::image::Image;
use robotics::motion::BasePlace;
use robotics::motion::{
    CollisionMode, MotionFailure, UnreachablePose, UnreachableReason, can_reach, can_stand,
    neck_positions, touching_at,
};
use robotics::perception::{Sight, Visibility};
use robotics::robot::Side;
use robotics::world::World;
use spatial::{Pose, pose};

/// A hand goal closer to an object than this (m) is taken to be meant for that object.
const AT_THE_OBJECT: f64 = 0.4;
/// A distance (m) from an object that is worth telling.
const MIN_MISS: f64 = 0.001;
/// Number of headings tried where the robot cannot stand.
const HEADINGS: u32 = 8;
/// Maximum number of pairs of bodies listed.
const MAX_PAIRS: usize = 6;

/// A failure with the world in which it occurred.
pub(crate) struct Remembered {
    pub failure: MotionFailure,
    /// Simulated time (s).
    pub time: f64,
    pub world: World,
}

impl Simulation {
    /// Keeps a failure, to be explained on demand.
    pub(crate) fn remember(&mut self, failure: &MotionFailure) {
        self.last_account = None;
        self.last_failure = Some(Box::new(Remembered {
            failure: failure.clone(),
            time: self.now,
            world: self.world.clone(),
        }));
    }

    /// The long form of the last failure, if there was one: what an action has told of its
    /// attempts, or what is known of the failure of a motion.
    pub(crate) fn explain_last(&mut self, image: &mut Image) -> Option<String> {
        if let Some(account) = &self.last_account {
            return Some(account.clone());
        }
        let mut last = self.last_failure.take()?;
        std::mem::swap(&mut self.world, &mut last.world);
        let text = self.explanation(image, &last.failure, last.time);
        std::mem::swap(&mut self.world, &mut last.world);
        self.last_failure = Some(last);
        Some(text)
    }

    /// The nearest free place, if a report is of the motion that has failed last and whose goal is occupied.
    pub(crate) fn free_place_instead(&self, report: &str) -> Option<BasePlace> {
        let failure = &self.last_failure.as_ref()?.failure;
        match failure {
            MotionFailure::GoalOccupied {
                nearest_free: Some(place),
                ..
            } if report.contains(&failure.to_string()) && can_stand(&self.world, place) => {
                Some(*place)
            }
            _ => None,
        }
    }

    fn explanation(&self, image: &mut Image, failure: &MotionFailure, time: f64) -> String {
        let mut text = format!("{} at {time:.3} s\n", failure.class_name());
        section(&mut text, "What happened", failure.to_string().lines());
        section(&mut text, "What is known", self.facts(failure));
        let remedies = match self.remedies(image, failure) {
            none if none.is_empty() => vec!["nothing was found".to_owned()],
            some => some,
        };
        section(&mut text, "What would work", remedies);
        text
    }

    fn facts(&self, failure: &MotionFailure) -> Vec<String> {
        let base = self.base();
        let t = base.translation;
        let heading = pose::yaw(&base).to_degrees();
        let mut facts = vec![format!(
            "the robot stands at x {:.3}, y {:.3}, heading {heading:.1} degrees",
            t.x, t.y
        )];
        match failure {
            MotionFailure::GoalOccupied { goal, .. } | MotionFailure::Enclosed { goal, .. } => {
                facts.extend(self.touching(goal));
            }
            MotionFailure::ObjectNotFound { candidates, .. } => {
                facts.extend(candidates.iter().filter_map(|c| self.whereabouts(c)));
            }
            MotionFailure::PoseUnreachable(pose) => facts.extend(self.about_hand(pose)),
            MotionFailure::NoGrasp(nothing) => facts.extend(nothing.table()),
            MotionFailure::NothingGripped { side } => {
                facts.extend(self.missed(*side).unwrap_or_default());
            }
            _ => {}
        }
        facts
    }

    /// The pairs that would touch with the base at a pose, each with its deepest contact.
    fn touching(&self, place: &BasePlace) -> Vec<String> {
        let mut deepest: BTreeMap<String, f64> = BTreeMap::new();
        for hit in touching_at(&self.world, place) {
            let pair = format!("{} and {}", hit.moving, hit.other);
            let depth = deepest.entry(pair).or_insert(hit.depth);
            *depth = depth.max(hit.depth);
        }
        let mut pairs: Vec<(String, f64)> = deepest.into_iter().collect();
        pairs.sort_by(|a, b| b.1.total_cmp(&a.1));
        let lines = pairs.iter().take(MAX_PAIRS);
        lines
            .map(|(pair, depth)| format!("{pair} would overlap by {:.1} mm", depth * 1e3))
            .collect()
    }

    fn whereabouts(&self, seen: &Visibility) -> Option<String> {
        let at = self.world.object_pose(&seen.object).ok()?;
        let camera = &self.world.models().description.camera();
        let eye = self.world.link_pose(camera.frame);
        let distance = (at.translation.vector - eye.translation.vector).norm();
        Some(format!(
            "{} is at {}, {distance:.2} m from the camera; {:.0} % of it must be in sight",
            seen.object,
            point(&at.translation.vector),
            seen.needed_share * 100.0
        ))
    }

    fn about_hand(&self, unreachable: &UnreachablePose) -> Vec<String> {
        let in_map = self.base() * unreachable.tool;
        let from_base = unreachable.tool.translation.vector;
        let mut facts = vec![
            format!(
                "the {} hand was to be at {} of the map",
                unreachable.side,
                point(&in_map.translation.vector)
            ),
            format!(
                "that is {:.2} m from the axis of the base, at a height of {:.2} m",
                from_base.xy().norm(),
                from_base.z
            ),
        ];
        if let UnreachableReason::Collisions { hit, .. } = &unreachable.reason {
            facts.push(format!(
                "{} would be {:.1} mm deep in {} at {}",
                hit.moving,
                hit.depth * 1e3,
                hit.other,
                point(&hit.point.coords)
            ));
        }
        facts
    }

    /// By how much the fingers of a hand have missed the nearest object, and where they are.
    fn missed(&self, side: Side) -> Option<Vec<String>> {
        let frame = self.models.description.arm(side).tool;
        let tips = self.world.link_pose(frame).translation.vector;
        let miss = |name: &str| {
            let extent = self.world.object_extent(name).ok()?;
            let [x, y] = extent.local([tips.x, tips.y]);
            let beside = libm::hypot(
                outside(x, extent.min[0], extent.max[0]),
                outside(y, extent.min[1], extent.max[1]),
            );
            let bottom = extent.frame.translation.z + extent.min[2];
            Some((beside, outside(tips.z, bottom, extent.top()), extent))
        };
        let names = self.world.objects().map(|object| object.name().to_owned());
        let (name, (beside, higher, extent)) = names
            .filter_map(|name| miss(&name).map(|found| (name, found)))
            .filter(|(_, (beside, higher, _))| libm::hypot(*beside, *higher) < AT_THE_OBJECT)
            .min_by(|(_, a), (_, b)| libm::hypot(a.0, a.1).total_cmp(&libm::hypot(b.0, b.1)))?;
        let mut places = Vec::new();
        let mm = |distance: f64| format!("{:.0} mm", distance.abs() * 1e3);
        if higher > MIN_MISS {
            places.push(format!("{} above its top", mm(higher)));
        } else if higher < -MIN_MISS {
            places.push(format!("{} below its bottom", mm(higher)));
        }
        if beside > MIN_MISS {
            places.push(format!("{} beside it", mm(beside)));
        }
        let [x, y] = extent.local([tips.x, tips.y]);
        if places.is_empty() {
            let depth = (extent.top() - tips.z) * 1e3;
            places.push(format!("{depth:.0} mm below its top, but not around it"));
        }
        let aside = [x, y].map(|off| off * 1e3);
        Some(vec![
            format!(
                "the fingertips of the {side} hand are at {} of the map",
                point(&tips)
            ),
            format!(
                "the nearest object is {name}: the fingertips are {}",
                places.join(" and ")
            ),
            format!(
                "in the frame of {name}, turned about the vertical only, they are {:.0} mm along x and {:.0} mm along y from its origin",
                aside[0], aside[1]
            ),
        ])
    }

    fn remedies(&self, image: &mut Image, failure: &MotionFailure) -> Vec<String> {
        match failure {
            MotionFailure::GoalOccupied {
                goal, nearest_free, ..
            } => self.places(goal, nearest_free.as_ref()),
            MotionFailure::Enclosed { blockers, .. } => {
                let name = |body: &robotics::world::BodyName| format!("move {body} out of the way");
                blockers.iter().map(name).collect()
            }
            MotionFailure::TorsoGoalOutOfLimits { lower, upper, .. } => {
                vec![format!("a joint angle from {lower} to {upper}")]
            }
            MotionFailure::ObjectNotFound { candidates, .. } => {
                candidates.iter().map(|c| self.where_to_look(c)).collect()
            }
            MotionFailure::PoseUnreachable(pose) => self.other_reach(image, pose),
            MotionFailure::NoGrasp(nothing) => self.elsewhere(image, &nothing.object),
            _ => Vec::new(),
        }
    }

    fn places(&self, goal: &BasePlace, nearest: Option<&BasePlace>) -> Vec<String> {
        let [x, y, heading] = *goal;
        let step = std::f64::consts::TAU / f64::from(HEADINGS);
        let turned = (1..HEADINGS).map(|i| heading + step * f64::from(i));
        let free: Vec<String> = turned
            .filter(|yaw| can_stand(&self.world, &[x, y, *yaw]))
            .map(|yaw| format!("{:.0}", spatial::trig::wrap(yaw).to_degrees()))
            .collect();
        let mut lines = Vec::new();
        if let Some(place) = nearest {
            lines.push(format!("standing at {}", place_form(place)));
        }
        if !free.is_empty() {
            lines.push(format!(
                "standing at the same place with a heading of {} degrees",
                free.join(" or ")
            ));
        }
        lines
    }

    /// Whether the camera would see the object with the head turned to it.
    fn where_to_look(&self, seen: &Visibility) -> String {
        let name = &seen.object;
        let Ok(at) = self.world.object_pose(name) else {
            return format!("{name} is not there any more");
        };
        let target = Point3::from(at.translation.vector);
        let neck = &self.world.models().description.neck;
        let mut world = self.world.clone();
        let mut robot = world.robot_configuration().clone();
        let angles = neck_positions(&world, &target);
        for (&joint, angle) in neck.joints.iter().zip(angles) {
            let limits = world.models().robot.joint(joint).limits;
            if limits.is_some_and(|l| angle < l.lower || angle > l.upper) {
                return format!("driving elsewhere: the neck cannot turn to {name} from here");
            }
            robot.joints.set(joint, angle);
        }
        world.teleport_robot(&robot);
        let there = point(&(self.base().inverse() * at).translation.vector);
        let base = self.base_frame();
        match Sight::of_robot(&world).visibility(name) {
            Ok(seen) if seen.is_seen() => format!(
                "looking at {there} of {base} first: {:.0} % of {name} would be in sight",
                seen.fraction() * 100.0
            ),
            Ok(seen) => format!("not looking at {there} of {base}: even then, {seen}"),
            Err(error) => error.to_string(),
        }
    }

    fn other_reach(&self, image: &mut Image, unreachable: &UnreachablePose) -> Vec<String> {
        let mut lines = Vec::new();
        let other = unreachable.side.other();
        let mode = CollisionMode::AllowHand;
        if can_reach(&self.world, other, &unreachable.tool, mode, None) {
            lines.push(format!("the {other} hand at the same pose"));
        }
        let Some((name, wanted)) = self.meant(unreachable) else {
            return lines;
        };
        for (arm, grasp) in self.grasps_from_here(image, &wanted, None) {
            lines.push(format!(
                "picking {name} up with (arm {arm}) (grasp {})",
                grasp.to_lowercase()
            ));
        }
        let place = self.place_to_grasp(image, &wanted);
        lines.extend(place.map(|place| place_to_grasp_line(&name, &place)));
        lines
    }

    /// From where an object could be grasped.
    fn elsewhere(&self, image: &mut Image, name: &str) -> Vec<String> {
        let object = self
            .world
            .object(name)
            .ok()
            .zip(self.world.object_pose(name).ok());
        let Some((object, in_map)) = object else {
            return Vec::new();
        };
        let wanted = Wanted {
            name: name.to_owned(),
            kind: object.type_name().to_owned(),
            in_map,
            arm: None,
            grasp: None,
        };
        let place = self.place_to_grasp(image, &wanted);
        place
            .map(|place| place_to_grasp_line(name, &place))
            .into_iter()
            .collect()
    }

    /// The free object that the hand was meant for.
    fn meant(&self, unreachable: &UnreachablePose) -> Option<(String, Wanted)> {
        let tool = self.base() * unreachable.tool;
        let distance = |at: &Pose| (at.translation.vector - tool.translation.vector).norm();
        let free = self.world.objects().filter(|o| o.attachment().is_none());
        let near = free
            .filter_map(|object| Some((object, self.world.object_pose(object.name()).ok()?)))
            .filter(|(_, at)| distance(at) < AT_THE_OBJECT)
            .min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)));
        near.map(|(object, in_map)| {
            let wanted = Wanted {
                name: object.name().to_owned(),
                kind: object.type_name().to_owned(),
                in_map,
                arm: Some(unreachable.side),
                grasp: None,
            };
            (object.name().to_owned(), wanted)
        })
    }
}

/// How far (m) a coordinate is beyond the greater or, then negative, below the smaller of two others;
/// 0 between them.
fn outside(at: f64, least: f64, greatest: f64) -> f64 {
    (at - greatest).max(0.0) + (at - least).min(0.0)
}

fn place_to_grasp_line(name: &str, (base, arm, grasp): &(Pose, Side, String)) -> String {
    let t = base.translation;
    let place = place_form(&[t.x, t.y, pose::yaw(base)]);
    format!(
        "picking {name} up with (arm {arm}) (grasp {}), standing at {place}",
        grasp.to_lowercase()
    )
}

fn section(text: &mut String, title: &str, lines: impl IntoIterator<Item = impl AsRef<str>>) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{title}:");
    for line in lines {
        let _ = writeln!(text, "  {}", line.as_ref());
    }
}

fn point(p: &Vector3<f64>) -> String {
    format!("({:.3} {:.3} {:.3})", p.x, p.y, p.z)
}

/// A pose of the base as a form that can be typed.
fn place_form(&[x, y, yaw]: &BasePlace) -> String {
    let q = pose::from_xy_yaw(x, y, yaw).rotation;
    format!(
        "(make-pose \"map\" '(({x:.3} {y:.3} 0) (0 0 {:.5} {:.5})))",
        q.k, q.w
    )
}
