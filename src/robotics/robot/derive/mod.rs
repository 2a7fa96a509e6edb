//! Deriving a description of a robot from its links and joints.
//!
//! What follows from the tree is found: the drive, the torso, the neck, the cameras, arms with their
//! grippers, wheels, joints of no use, and links that touch by construction. What does not follow, such as
//! speeds and fields of view, is assumed, and the text says so.

mod arms;
mod from_srdf;
mod grippers;
mod parking;
mod text;
mod wheels;

use super::arm_positions::ArmPositions;
use super::{JointId, JointKind, JointPositions, KinematicTree, LinkId, Srdf, TouchingPairs};
use nalgebra::Vector3;
use spatial::Pose;

pub use arms::DerivedArm;
pub use grippers::DerivedGripper;
pub use wheels::{DerivedDrive, DerivedWheels};

/// How high (m) above what the robot stands on its arm is parked, at least: paths must begin there.
const ABOVE: f64 = 0.03;
/// Pairs of links that a remark names.
const MOST_PAIRS: usize = 4;

/// What the links and joints of a robot seem to be for.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivedRobot {
    /// Name in the URDF.
    pub name: String,
    /// The frame on the floor.
    pub base_frame: LinkId,
    /// The body on the base.
    pub base_body: LinkId,
    /// The drive and what rolls.
    pub wheels: DerivedWheels,
    /// The joint that lifts arms and head.
    pub torso: Option<JointId>,
    /// The joints between torso and camera.
    pub neck: Vec<JointId>,
    /// Optical frames, the one in use first.
    pub cameras: Vec<LinkId>,
    /// The arms, the left one first if there are two.
    pub arms: Vec<DerivedArm>,
    /// Joints that could move but have no use.
    pub idle: Vec<JointId>,
    /// Groups of links that touch by construction.
    pub touching: Vec<Vec<LinkId>>,
    /// What is to be looked at, each a sentence.
    pub remarks: Vec<String>,
}

/// Whether links touch, which this room does not know.
pub trait TouchTest {
    /// The links that touch by construction and those that never do; `stands` selects joints that are
    /// idle.
    fn pairs(&self, stands: &dyn Fn(JointId) -> bool) -> TouchingPairs;

    /// The pairs of links that touch in a posture.
    fn touching(&self, q: &JointPositions) -> Vec<(LinkId, LinkId)>;
}

impl DerivedRobot {
    /// Looks at the tree of a robot, and at what an SRDF says of it.
    pub fn of(tree: &KinematicTree, touch: &dyn TouchTest, srdf: &Srdf) -> Self {
        let mut remarks = Vec::new();
        let wheels = wheels::find(tree, &mut remarks);
        let grippers = grippers::find(tree, &mut remarks);
        let (torso, mut arms) = arms::find(tree, grippers, &mut remarks);
        let cameras = cameras(tree, &arms, &mut remarks);
        let neck = neck(tree, torso, &arms, &cameras);
        let base_frame = tree.root();
        let is_body = |link: &LinkId| !tree.link(*link).collisions.is_empty();
        let base_body = rigid_links(tree, base_frame).into_iter().find(is_body);
        let used = |joint: JointId| {
            let grips = |gripper: &DerivedGripper| gripper.joints.contains(&joint);
            let arm = |arm: &DerivedArm| {
                arm.joints.contains(&joint) || arm.gripper.as_ref().is_some_and(grips)
            };
            Some(joint) == torso || neck.contains(&joint) || arms.iter().any(arm)
        };
        let moving = tree.joints().filter(|(_, joint)| joint.is_actuated());
        let idle: Vec<JointId> = moving.map(|(id, _)| id).filter(|id| !used(*id)).collect();
        let pairs = touch.pairs(&|joint| idle.contains(&joint));
        for (one, other, share) in &pairs.almost_always {
            remarks.push(format!(
                "{} and {} touch in {:.0} % of random postures: they are taken as touching by \
                 construction, which may hide real collisions.",
                tree.link(*one).name,
                tree.link(*other).name,
                100.0 * share
            ));
        }
        let rolls = |link: &LinkId| wheels.links.contains(link);
        let grippers = arms.iter().filter_map(|arm| arm.gripper.as_ref());
        let built: Vec<_> = pairs
            .by_construction()
            .filter(|(a, b)| !rolls(a) && !rolls(b))
            .chain(grippers.flat_map(DerivedGripper::pad_pairs))
            .chain(from_srdf::pairs(tree, srdf, &pairs, &mut remarks))
            .collect();
        // A parked arm stays where it is while the torso moves: nothing may touch at any height of it.
        let mut q = tree.zero_positions();
        let mut heights: Vec<(JointId, f64)> = Vec::new();
        if let Some((joint, limits)) = torso.and_then(|t| Some((t, tree.joint(t).limits?))) {
            q.set(joint, limits.lower);
            let some = [limits.lower, arms::start_height(limits), limits.upper];
            heights.extend(some.map(|height| (joint, height)));
        }
        for arm in &mut arms {
            arm.postures = from_srdf::postures(tree, arm, srdf);
            let is_expected = |pair: &(LinkId, LinkId)| {
                let is_built = built.contains(pair) || built.contains(&(pair.1, pair.0));
                is_built || rolls(&pair.0) || rolls(&pair.1)
            };
            // What else of the robot touches is no fault of the arm.
            let first = arm.joints.first().map(|joint| tree.joint(*joint).child);
            let is_of_arm = |link: LinkId| first.is_some_and(|first| tree.carries(first, link));
            let hits = |q: &JointPositions| {
                let mut pairs = touch.touching(q);
                let mut q = q.clone();
                for (torso, height) in heights.iter().skip(1) {
                    q.set(*torso, *height);
                    pairs.extend(touch.touching(&q));
                }
                pairs.retain(|pair| !is_expected(pair) && (is_of_arm(pair.0) || is_of_arm(pair.1)));
                pairs.sort();
                pairs.dedup();
                pairs
            };
            let is_free = |posture: &ArmPositions| {
                let is_above = parking::is_above(tree, arm, &q, posture, ABOVE);
                let mut q = q.clone();
                parking::set(arm, &mut q, posture);
                is_above && hits(&q).is_empty()
            };
            let found = match from_srdf::parks(arm).find(is_free) {
                Some(park) => Some((park, Vec::new())),
                None => parking::find(tree, arm, &q, ABOVE, hits),
            };
            let Some((park, touching)) = found else {
                continue;
            };
            for (joint, position) in arm.joints.iter().zip(&park) {
                q.set(*joint, *position);
            }
            arm.park = Some(park);
            if !touching.is_empty() {
                let pairs = touching.iter().take(MOST_PAIRS);
                let names = pairs
                    .map(|(a, b)| format!("{} and {}", tree.link(*a).name, tree.link(*b).name));
                let names: Vec<String> = names.collect();
                remarks.push(format!(
                    "No posture of the {} arm was found in which nothing touches; in the best one {} do. \
                     If they overlap by construction, add (touching …) records.",
                    arm.side,
                    names.join(", ")
                ));
            }
        }
        Self {
            name: tree.name().to_owned(),
            base_frame,
            base_body: base_body.unwrap_or(base_frame),
            touching: groups(&built),
            wheels,
            torso,
            neck,
            cameras,
            arms,
            idle,
            remarks,
        }
    }

    /// The description as text; what is assumed or missing is said in comments.
    pub fn text(&self, tree: &KinematicTree) -> String {
        text::written(self, tree)
    }
}

/// The optical frames, those on the body first.
fn cameras(tree: &KinematicTree, arms: &[DerivedArm], remarks: &mut Vec<String>) -> Vec<LinkId> {
    let has = |name: &str, words: &[&str]| words.iter().any(|word| name.contains(word));
    let is_optical = |name: &str| name.ends_with("optical_frame") || name.ends_with("optical_link");
    let is_named = |name: &str| has(name, &["camera", "rgb", "stereo", "xtion", "realsense"]);
    let poses = rest_poses(tree);
    // The axes of a picture: x to the right, y down.
    let looks_level = |link: LinkId| {
        let pose = poses.get(link.index());
        pose.is_some_and(|pose| (pose.rotation * Vector3::y()).z < -0.7)
    };
    let some = tree
        .links()
        .any(|(_, link)| is_optical(&link.name.to_lowercase()));
    let mut found: Vec<(usize, LinkId)> = Vec::new();
    for (id, link) in tree.links() {
        let name = link.name.to_lowercase();
        let is_one = is_optical(&name) || !some && is_named(&name) && looks_level(id);
        let others = ["depth", "infra", "_ir_", "thermal", "accel", "gyro", "imu"];
        if !is_one || has(&name, &others) {
            continue;
        }
        let on_arm = arms.iter().any(|arm| {
            let last = arm.joints.last();
            last.is_some_and(|joint| tree.ancestors(id).any(|above| above == *joint))
        });
        let in_colour = has(&name, &["rgb", "color", "colour"]);
        let on_head = has(&name, &["head", "xtion", "realsense"]);
        let rank = usize::from(on_arm) * 4 + usize::from(!in_colour) * 2 + usize::from(!on_head);
        found.push((rank, id));
    }
    found.sort();
    if found.is_empty() {
        remarks.push(
            "No frame is named …optical_frame (z forward, x to the right): say where the camera is in a \
             (camera …) record, as below; without a camera, the robot finds nothing."
                .to_owned(),
        );
    } else if !some {
        remarks.push(
            "No frame is named …optical_frame: the cameras are frames whose y axis points down, as that \
             of a picture does. See that their z axis looks forward."
                .to_owned(),
        );
    }
    found.into_iter().map(|(_, link)| link).collect()
}

/// The joints between the torso, or the base, and the first camera.
fn neck(
    tree: &KinematicTree,
    torso: Option<JointId>,
    arms: &[DerivedArm],
    cameras: &[LinkId],
) -> Vec<JointId> {
    let Some(camera) = cameras.first() else {
        return Vec::new();
    };
    let of_arm = |joint: &JointId| arms.iter().any(|arm| arm.joints.contains(joint));
    let above = tree
        .ancestors(*camera)
        .take_while(|joint| Some(*joint) != torso);
    let mut neck: Vec<JointId> = above
        .filter(|joint| tree.joint(*joint).is_actuated() && !of_arm(joint))
        .filter(|joint| tree.joint(*joint).limits.is_some_and(|l| l.lower < l.upper))
        .collect();
    neck.reverse();
    neck
}

/// The links that never move against a link, that one first, then those it carries.
fn rigid_links(tree: &KinematicTree, link: LinkId) -> Vec<LinkId> {
    let mut found = vec![link];
    let mut next = 0;
    while let Some(&at) = found.get(next) {
        next += 1;
        let children = tree
            .link(at)
            .children
            .iter()
            .map(|joint| tree.joint(*joint));
        let fixed = children.filter(|joint| joint.kind == JointKind::Fixed);
        found.extend(fixed.map(|joint| joint.child));
    }
    found
}

/// Poses of all links in the frame of the root, all joints at 0 or as near as their limits let them.
fn rest_poses(tree: &KinematicTree) -> Vec<Pose> {
    let mut q = tree.zero_positions();
    for (id, joint) in tree.joints() {
        q.set(id, joint.limits.map_or(0.0, |limits| limits.clamp(0.0)));
    }
    let mut poses = Vec::new();
    tree.forward_kinematics(&Pose::identity(), &q, &mut poses);
    poses
}

/// The axis of a joint in the frame of the root, at rest.
fn rest_axis(tree: &KinematicTree, poses: &[Pose], joint: JointId) -> Vector3<f64> {
    let joint = tree.joint(joint);
    let pose = poses.get(joint.child.index());
    pose.map_or(Vector3::zeros(), |pose| {
        pose.rotation * joint.axis.into_inner()
    })
}

/// Groups of links all of whose pairs are among the given ones, so that every pair is in a group.
fn groups(pairs: &[(LinkId, LinkId)]) -> Vec<Vec<LinkId>> {
    let has = |a: LinkId, b: LinkId| pairs.contains(&(a, b)) || pairs.contains(&(b, a));
    let mut links: Vec<LinkId> = pairs.iter().flat_map(|(a, b)| [*a, *b]).collect();
    links.sort();
    links.dedup();
    let mut groups: Vec<Vec<LinkId>> = Vec::new();
    for (a, b) in pairs {
        if groups
            .iter()
            .any(|group| group.contains(a) && group.contains(b))
        {
            continue;
        }
        let mut group = vec![*a, *b];
        for link in &links {
            if !group.contains(link) && group.iter().all(|other| has(*link, *other)) {
                group.push(*link);
            }
        }
        group.sort();
        groups.push(group);
    }
    groups
}
