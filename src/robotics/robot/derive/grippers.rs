//! The grippers of a robot: two fingers that move apart.

use crate::robot::{JawGap, JawGapError, JointId, JointKind, KinematicTree, LinkId};

/// Joints that a finger may have, and a gripper.
const MOST_FINGER_JOINTS: usize = 4;
const MOST_GRIPPER_JOINTS: usize = 8;
/// Opening (m) that a gripper has at most, and at least.
const OPENING: [f64; 2] = [0.005, 0.5];
/// Two gaps are one if they differ by less (m).
const SAME_GAP: f64 = 1e-3;

/// A gripper.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivedGripper {
    /// What carries the fingers.
    pub palm: LinkId,
    /// The leading joint, then those that move with it but do not follow it by the URDF.
    pub joints: Vec<JointId>,
    /// The links of the left and of the right finger that have shapes.
    pub fingers: [Vec<LinkId>; 2],
    /// Its opening.
    pub jaw: JawGap,
    /// Force (N) by the URDF, if that gives one.
    pub effort: Option<f64>,
}

impl DerivedGripper {
    /// Pairs of links of the two fingers, which touch when the gripper is closed.
    pub(super) fn pad_pairs(&self) -> impl Iterator<Item = (LinkId, LinkId)> + '_ {
        let [left, right] = &self.fingers;
        left.iter().flat_map(|a| right.iter().map(|b| (*a, *b)))
    }
}

/// Finds the grippers, in the order of the file.
pub(super) fn find(tree: &KinematicTree, remarks: &mut Vec<String>) -> Vec<DerivedGripper> {
    let mut found: Vec<DerivedGripper> = Vec::new();
    for (palm, link) in tree.links() {
        let fingers: Vec<JointId> = (link.children.iter().copied())
            .filter(|joint| is_finger(tree, *joint))
            .collect();
        let below = moving_below(tree, palm);
        if fingers.len() < 2 {
            continue;
        }
        if below.len() > MOST_GRIPPER_JOINTS + 1 {
            continue;
        }
        let mut best: Option<DerivedGripper> = None;
        for (i, one) in fingers.iter().enumerate() {
            for other in fingers.iter().skip(i + 1) {
                match gripper(tree, palm, *one, *other) {
                    Ok(gripper) if is_better(&gripper, best.as_ref()) => best = Some(gripper),
                    Err(JawGapError::NoTravel { joint, position }) => remarks.push(format!(
                        "{} may be the palm of a gripper, but the limits of {joint} are both {position}: \
                         widen them in the URDF.",
                        link.name
                    )),
                    _ => {}
                }
            }
        }
        found.extend(best);
    }
    if found.is_empty() {
        remarks.push(
            "No gripper was found: two fingers that hang on one palm and move apart by one joint, by \
             followers, or by two joints with like limits."
                .to_owned(),
        );
    }
    found
}

fn is_better(gripper: &DerivedGripper, best: Option<&DerivedGripper>) -> bool {
    let opening = |gripper: &DerivedGripper| gripper.jaw.open().1 - gripper.jaw.closed().1;
    let own = opening(gripper);
    let is_possible = gripper.jaw.closed().1.abs() < 0.2 && (OPENING[0]..OPENING[1]).contains(&own);
    is_possible && best.is_none_or(|best| own > opening(best) + SAME_GAP)
}

/// The moving joints that a link carries.
fn moving_below(tree: &KinematicTree, link: LinkId) -> Vec<JointId> {
    let mut open = vec![link];
    let mut found = Vec::new();
    while let Some(link) = open.pop() {
        for id in &tree.link(link).children {
            let joint = tree.joint(*id);
            if joint.kind != JointKind::Fixed {
                found.push(*id);
            }
            open.push(joint.child);
        }
    }
    found
}

/// Whether a joint may carry a finger: it moves, and what it carries is solid and small.
fn is_finger(tree: &KinematicTree, joint: JointId) -> bool {
    let child = tree.joint(joint).child;
    let moves = matches!(
        tree.joint(joint).kind,
        JointKind::Revolute | JointKind::Prismatic
    );
    moves
        && moving_below(tree, child).len() < MOST_FINGER_JOINTS
        && !solid_below(tree, child).is_empty()
}

/// The solid links that a link carries, itself included.
fn solid_below(tree: &KinematicTree, link: LinkId) -> Vec<LinkId> {
    let all = tree
        .links()
        .filter(|(_, other)| !other.collisions.is_empty());
    all.map(|(id, _)| id)
        .filter(|id| tree.carries(link, *id))
        .collect()
}

fn gripper(
    tree: &KinematicTree,
    palm: LinkId,
    one: JointId,
    other: JointId,
) -> Result<DerivedGripper, JawGapError> {
    let leader = |joint: JointId| tree.joint(joint).mimic.map_or(joint, |mimic| mimic.joint);
    let mut joints = vec![leader(one)];
    if leader(other) != leader(one) {
        joints.push(leader(other));
    }
    let sides = [one, other].map(|joint| solid_below(tree, tree.joint(joint).child));
    let [left, right] = &sides;
    let jaw = JawGap::measure(tree, palm, &joints, [left, right])?;
    // The one towards which the axis from the right jaw to the left one points is the left one.
    let fingers = if jaw.is_mirrored() {
        [right.clone(), left.clone()]
    } else {
        sides
    };
    let [left, right] = &fingers;
    let jaw = JawGap::measure(tree, palm, &joints, [left, right])?;
    let efforts = joints
        .iter()
        .filter_map(|joint| tree.joint(*joint).max_effort);
    let effort = efforts.reduce(f64::min).filter(|effort| *effort > 0.0);
    Ok(DerivedGripper {
        palm,
        joints,
        fingers,
        jaw,
        effort,
    })
}
