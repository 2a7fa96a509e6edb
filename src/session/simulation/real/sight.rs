//! What the robot's camera sees becomes what is believed of the world.

use crate::outside::SeenObject;
use lisp::visible::visible;
use robotics::motion::{DetectQuery, DetectedObject, MotionFailure, MotionOutcome, MotionStatus};
use robotics::world::World;
use spatial::Pose;

/// An object without a name that is seen this near (m) to where one of its type was is that one.
const SAME_PLACE: f64 = 0.15;
/// An object that is seen less than this (m, and rad) from where it was has not moved.
const UNMOVED: [f64; 2] = [0.003, 0.02];
/// How far (m) beside where it is seen an object may be put, so that it stands on something and overlaps nothing.
const MOVED: f64 = 0.03;
/// What is farther (m) from the middle of the map is no place.
const FARTHEST: f64 = 1e4;

/// Puts what is seen into the world, and returns how the motion that has looked ends.
pub(super) fn believe(
    world: &mut World,
    query: &DetectQuery,
    seen: Vec<SeenObject>,
) -> MotionStatus {
    let mut found: Vec<DetectedObject> = Vec::new();
    let mut strange: Vec<String> = Vec::new();
    for object in once(seen, &mut strange) {
        let kind = object.type_name.to_lowercase();
        if world.models().objects.get(&kind).is_none() {
            strange.push(format!("{:?} (a type that is not known)", object.type_name));
            continue;
        }
        let taken: Vec<&str> = found.iter().map(|found| found.name.as_str()).collect();
        let name = name_of(world, &object.name, &kind, &object.pose, &taken);
        let pose = match place(world, &name, &kind, &object.pose) {
            Ok(pose) => pose,
            Err(error) => {
                strange.push(format!("{name} ({error})"));
                continue;
            }
        };
        let base = world.robot_configuration().base;
        found.push(DetectedObject {
            name,
            type_name: kind,
            pose_in_base: base.inverse() * pose,
            pose_in_map: pose,
        });
    }
    let types = &world.models().objects;
    found.retain(|object| {
        let same = |wanted: &String| wanted.eq_ignore_ascii_case(&object.name);
        let of_kind = |wanted: &String| types.is_kind_of(&object.type_name, &wanted.to_lowercase());
        query.name.as_ref().is_none_or(same)
            && (query.types.is_empty() || query.types.iter().any(of_kind))
    });
    if !found.is_empty() {
        return MotionStatus::Done(MotionOutcome::Detected(found));
    }
    let mut wanted = query.description.clone();
    if !strange.is_empty() {
        wanted.push_str(&format!(
            " (seen was also what cannot be believed: {})",
            strange.join(", ")
        ));
    }
    MotionStatus::Failed(Box::new(MotionFailure::ObjectNotFound {
        wanted,
        candidates: Vec::new(),
        meant: None,
        may_err: true,
    }))
}

/// The objects that can be, each once: what is told twice is one, and one at two places is nowhere. What cannot be is added to
/// `strange`.
fn once(seen: Vec<SeenObject>, strange: &mut Vec<String>) -> Vec<SeenObject> {
    let called = |object: &SeenObject| {
        let name = match object.name.is_empty() {
            true => format!("a {}", object.type_name),
            false => object.name.to_uppercase(),
        };
        visible(&name).to_string()
    };
    let mut single: Vec<SeenObject> = Vec::new();
    let mut doubtful: Vec<String> = Vec::new();
    for object in seen {
        let at = &object.pose;
        let mut numbers = at
            .translation
            .vector
            .iter()
            .chain(at.rotation.coords.iter());
        if !numbers.all(|number| number.is_finite() && number.abs() < FARTHEST) {
            strange.push(format!("{} (its pose is none)", called(&object)));
            continue;
        }
        let is_near = |other: &SeenObject| {
            let way = (other.pose.translation.vector - at.translation.vector).norm();
            way <= UNMOVED[0]
        };
        let is_it = |other: &&SeenObject| match object.name.is_empty() && other.name.is_empty() {
            true => other.type_name.eq_ignore_ascii_case(&object.type_name) && is_near(other),
            false => other.name.eq_ignore_ascii_case(&object.name),
        };
        match single.iter().find(is_it) {
            None => single.push(object),
            Some(other) if is_near(other) => {}
            Some(_) => doubtful.push(object.name.to_uppercase()),
        }
    }
    doubtful.dedup();
    single.retain(|object| !doubtful.contains(&object.name.to_uppercase()));
    let doubtful = doubtful
        .iter()
        .map(|name| format!("{} (at two places)", visible(name)));
    strange.extend(doubtful);
    single
}

/// By which name the world knows an object that is seen.
fn name_of(world: &World, given: &str, kind: &str, pose: &Pose, taken: &[&str]) -> String {
    let given = given.to_uppercase();
    let is_of = |name: &str| {
        let known = world.object(name);
        known.is_ok_and(|known| known.type_name() == kind)
    };
    if !given.is_empty() && (is_of(&given) || world.object(&given).is_err()) {
        return given;
    }
    let near = world.objects().filter(|known| {
        given.is_empty() && known.type_name() == kind && !taken.contains(&known.name())
    });
    let near = near.filter_map(|known| {
        let there = world.object_pose(known.name()).ok()?;
        let way = (there.translation.vector - pose.translation.vector).norm();
        (way <= SAME_PLACE).then(|| (way, known.name().to_owned()))
    });
    if let Some((_, name)) = near.min_by(|a, b| a.0.total_cmp(&b.0)) {
        return name;
    }
    let fresh = (1u32..).map(|number| format!("{}-{number}", kind.to_uppercase()));
    let mut fresh = fresh.filter(|name| world.object(name).is_err());
    fresh.next().unwrap_or(given)
}

/// Puts an object where it is seen, unless it is there already, or in a hand. Returns where it is believed to be.
fn place(world: &mut World, name: &str, kind: &str, pose: &Pose) -> Result<Pose, String> {
    if let Ok(known) = world.object(name) {
        let is_held = known.attachment().is_some();
        let there = world.object_pose(name).map_err(|error| error.to_string())?;
        let way = (there.translation.vector - pose.translation.vector).norm();
        let turn = there.rotation.angle_to(&pose.rotation);
        let [near, alike] = UNMOVED;
        if is_held || (way <= near && turn <= alike) {
            return Ok(there);
        }
    }
    if pose.translation.z < -MOVED {
        return Err("it would be below the floor".to_owned());
    }
    let before = world.clone();
    let placed = world.spawn(name, kind, pose, None, None);
    let placed = placed.map_err(|error| error.to_string())?;
    let moved = placed.lifted.abs().max(placed.shifted);
    if moved > MOVED {
        let what = placed.blocked_by.map_or_else(
            || "nothing carries it there".to_owned(),
            |body| format!("it would be in {body}"),
        );
        // It is nowhere else either, and what was known of it before still is.
        *world = before;
        return Err(format!("{what}; there is room {moved:.2} m off"));
    }
    Ok(placed.pose)
}
