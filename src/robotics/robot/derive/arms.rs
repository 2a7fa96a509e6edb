//! The arms of a robot: what is between its body and its grippers; and the torso that carries them.

use super::{DerivedGripper, rest_axis, rest_poses};
use crate::robot::arm_positions::{ArmPositions, MOST_ARM_JOINTS};
use crate::robot::{JointId, JointKind, KinematicTree, Limits, LinkId, NumericKinematics, Side};
use nalgebra::{Matrix3, Vector3};
use spatial::Pose;

/// Fewest joints of an arm that reaches poses of all kinds, and of what is taken as an arm without a
/// gripper.
const FEWEST_JOINTS: usize = 6;
const FEWEST_WITHOUT_GRIPPER: usize = 5;
/// From the middle of the pads to where grasps place the tool (m), or half of the pads' length if that is
/// less.
const AHEAD: f64 = 0.0185;
/// How far (m) a frame of the URDF may be from the middle of the pads to be that of the tool.
const AT_TOOL: f64 = 0.03;

/// An arm.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivedArm {
    /// Its name; the only arm is the right one.
    pub side: Side,
    /// What it is mounted on.
    pub base: LinkId,
    /// Its last link that moves.
    pub wrist: LinkId,
    /// The frame between the fingers, or the palm.
    pub tool: LinkId,
    /// From the wrist to where grasps place the tool (m), away from the palm.
    pub tool_offset: f64,
    /// The axes of a grasp in the frame of the wrist: across the palm, the third one, away from the palm.
    pub tool_axes: Matrix3<f64>,
    /// Its joints from the base to the wrist.
    pub joints: Vec<JointId>,
    /// Its gripper, if one was found.
    pub gripper: Option<DerivedGripper>,
    /// A posture in which it is close to the body.
    pub park: Option<ArmPositions>,
    /// Further named postures.
    pub postures: Vec<(String, ArmPositions)>,
}

/// Height after start-up of a torso with those limits.
pub(super) fn start_height(limits: Limits) -> f64 {
    // A round number near the middle of the lower half.
    let height = limits.lower + 0.4 * (limits.upper - limits.lower);
    limits.clamp((height * 100.0).round() / 100.0)
}

/// Finds torso and arms.
pub(super) fn find(
    tree: &KinematicTree,
    grippers: Vec<DerivedGripper>,
    remarks: &mut Vec<String>,
) -> (Option<JointId>, Vec<DerivedArm>) {
    let poses = rest_poses(tree);
    let path = |link: LinkId| -> Vec<JointId> {
        let mut above: Vec<JointId> = tree.ancestors(link).collect();
        above.reverse();
        above.retain(|joint| tree.joint(*joint).is_actuated());
        above
    };
    let mut hands: Vec<(LinkId, Option<DerivedGripper>)> = Vec::new();
    hands.extend(
        grippers
            .into_iter()
            .map(|gripper| (gripper.palm, Some(gripper))),
    );
    for end in long_chains(tree) {
        let has_hand =
            |(palm, _): &(LinkId, _)| tree.carries(end, *palm) || tree.carries(*palm, end);
        if !hands.iter().any(has_hand) {
            hands.push((end, None));
        }
    }
    let paths: Vec<Vec<JointId>> = hands.iter().map(|(palm, _)| path(*palm)).collect();
    let torso = torso(tree, &poses, &paths);
    let mut arms: Vec<(f64, DerivedArm)> = Vec::new();
    for ((palm_link, gripper), path) in hands.into_iter().zip(&paths) {
        // Behind the torso, and behind what other arms share.
        let shared = |joint: &JointId| paths.iter().filter(|path| path.contains(joint)).count() > 1;
        let is_body = |joint: &JointId| {
            let turns_the_body =
                tree.joint(*joint).kind == JointKind::Continuous && has_wheels_below(tree, *joint);
            Some(*joint) == torso || shared(joint) || turns_the_body
        };
        let from = path.iter().rposition(is_body).map_or(0, |place| place + 1);
        let joints: Vec<JointId> = path.get(from..).unwrap_or_default().to_vec();
        let palm = tree.link(palm_link).name.clone();
        let (Some(first), Some(last)) = (joints.first(), joints.last()) else {
            remarks.push(format!("Nothing moves the gripper at {palm}."));
            continue;
        };
        if joints.len() > MOST_ARM_JOINTS {
            remarks.push(format!(
                "The arm to {palm} has {} joints; an arm may have {MOST_ARM_JOINTS}.",
                joints.len()
            ));
            continue;
        }
        let (base, wrist) = (tree.joint(*first).parent, tree.joint(*last).child);
        if let Err(error) = NumericKinematics::new(tree, base, wrist) {
            remarks.push(format!("The gripper at {palm} has no arm: {error}."));
            continue;
        }
        if joints.len() < FEWEST_JOINTS {
            remarks.push(format!(
                "The arm to {palm} has {} joints: from where the base stands, it does not bring the hand \
                 into every orientation.",
                joints.len()
            ));
        }
        let placed = match &gripper {
            Some(gripper) => placement(tree, wrist, gripper, remarks),
            None => {
                remarks.push(format!(
                    "The arm to {palm} has no gripper that was found, and without one it cannot take anything: \
                     add to the URDF a palm, fixed to {palm}, and two fingers with prismatic joints on it, and \
                     describe the robot again. Or correct :tool-offset and :tool-axes, whose rows are, in the \
                     frame of {}, across the palm, the third axis, and away from the palm.",
                    tree.link(wrist).name
                ));
                Placement {
                    tool: palm_link,
                    offset: 0.0,
                    axes: Matrix3::identity(),
                }
            }
        };
        let y = poses.get(tree.joint(*first).child.index());
        let y = y.map_or(0.0, |pose| pose.translation.y);
        let arm = DerivedArm {
            side: Side::Right,
            base,
            wrist,
            tool: placed.tool,
            tool_offset: placed.offset,
            tool_axes: placed.axes,
            joints,
            gripper,
            park: None,
            postures: Vec::new(),
        };
        arms.push((y, arm));
    }
    arms.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    for (_, arm) in arms.iter().skip(2) {
        remarks.push(format!(
            "The arm to {} is left out: an arm is the left or the right one.",
            tree.link(arm.tool).name
        ));
    }
    arms.truncate(2);
    let mut arms: Vec<DerivedArm> = arms.into_iter().map(|(_, arm)| arm).collect();
    if let [left, _] = arms.as_mut_slice() {
        left.side = Side::Left;
    }
    (torso, arms)
}

/// Where a gripper is in the frame of the wrist.
struct Placement {
    tool: LinkId,
    /// To where grasps place the tool (m), away from the palm.
    offset: f64,
    axes: Matrix3<f64>,
}

fn placement(
    tree: &KinematicTree,
    wrist: LinkId,
    gripper: &DerivedGripper,
    remarks: &mut Vec<String>,
) -> Placement {
    let palm = tree.relative_pose(wrist, gripper.palm, &tree.zero_positions());
    let grip = palm.unwrap_or_else(Pose::identity) * gripper.jaw.grip;
    let (away, across) = (grip.rotation * Vector3::x(), grip.rotation * Vector3::y());
    let ahead = AHEAD.min(gripper.jaw.pad_size[0] / 2.0);
    let along = grip.translation.vector.dot(&away);
    let aside = (grip.translation.vector - away * along).norm();
    if aside > 2e-3 {
        remarks.push(format!(
            "The pads at {} are {:.0} mm beside the axis through the wrist {}: :tool-offset is only \
             along it.",
            tree.link(gripper.palm).name,
            1000.0 * aside,
            tree.link(wrist).name
        ));
    }
    Placement {
        tool: tool(tree, gripper),
        offset: ((along + ahead) * 1e4).round() / 1e4,
        axes: Matrix3::from_rows(&[
            across.transpose(),
            away.cross(&across).transpose(),
            away.transpose(),
        ]),
    }
}

/// Where chains of many joints end that move one after the other, without branches between: the links
/// behind the last joint, or those from which several joints branch.
fn long_chains(tree: &KinematicTree) -> Vec<LinkId> {
    let mut ends = Vec::new();
    let mut open = vec![(tree.root(), 0)];
    while let Some((link, before)) = open.pop() {
        let mut branches = Vec::new();
        for at in super::rigid_links(tree, link) {
            let joints = tree.link(at).children.iter().copied();
            let moving = joints.filter(|joint| tree.joint(*joint).kind != JointKind::Fixed);
            branches.extend(moving.map(|joint| (at, joint)));
        }
        let behind = |joint: JointId| {
            let own = usize::from(tree.joint(joint).is_actuated());
            (tree.joint(joint).child, own)
        };
        match branches.as_slice() {
            [(_, only)] => {
                let (child, own) = behind(*only);
                open.push((child, before + own));
            }
            several if before >= FEWEST_WITHOUT_GRIPPER => {
                ends.push(several.first().map_or(link, |(at, _)| *at));
            }
            several => open.extend(several.iter().map(|(_, joint)| behind(*joint))),
        }
    }
    ends.sort();
    ends
}

/// Whether a joint carries something that turns without limits about a level axis: then it turns a body.
fn has_wheels_below(tree: &KinematicTree, joint: JointId) -> bool {
    let from = tree.joint(joint).child;
    tree.root() == tree.joint(joint).parent && tree.link(from).children.len() > 1
}

/// The joint that lifts several arms, or an arm and a camera beside it.
fn torso(tree: &KinematicTree, poses: &[Pose], paths: &[Vec<JointId>]) -> Option<JointId> {
    let path = paths.first()?;
    let lifts = |joint: JointId| {
        let slides = tree.joint(joint).kind == JointKind::Prismatic;
        slides && rest_axis(tree, poses, joint).z.abs() > 0.9
    };
    let eyes: Vec<LinkId> = (tree.links())
        .filter(|(_, link)| link.name.to_lowercase().contains("optical"))
        .map(|(id, _)| id)
        .collect();
    path.iter().enumerate().find_map(|(place, joint)| {
        let carries_two = paths.iter().filter(|path| path.contains(joint)).count() > 1;
        let next = path.get(place + 1).map(|next| tree.joint(*next).child);
        let child = tree.joint(*joint).child;
        let carries_eyes = eyes.iter().any(|eye| {
            tree.carries(child, *eye) && next.is_none_or(|next| !tree.carries(next, *eye))
        });
        (lifts(*joint) && (carries_two || carries_eyes)).then_some(*joint)
    })
}

/// A frame of the URDF between the fingers, or the palm.
fn tool(tree: &KinematicTree, gripper: &DerivedGripper) -> LinkId {
    let rigid = super::rigid_links(tree, gripper.palm);
    let zero = tree.zero_positions();
    let away = |link: &LinkId| {
        let pose = tree.relative_pose(gripper.palm, *link, &zero)?;
        Some((pose.translation.vector - gripper.jaw.grip.translation.vector).norm())
    };
    let near = rigid
        .into_iter()
        .filter_map(|link| Some((away(&link)?, link)));
    let near = near.filter(|(away, _)| *away < AT_TOOL);
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map_or(gripper.palm, |(_, link)| link)
}
