//! What collides with what.

use rapier3d_f64::geometry::{Group, InteractionGroups, InteractionTestMode};

use super::{BodyHandle, BodyKind, Physics, Surface};

const FURNITURE: Group = Group::GROUP_1;
const OBJECT: Group = Group::GROUP_2;
const ROBOT: Group = Group::GROUP_3;
const HANDS: [Group; 2] = [Group::GROUP_4, Group::GROUP_5];
/// What is being cut: solid for all but the tool that cuts it.
const BEING_CUT: Group = Group::GROUP_6;
/// Grains, which the robot does not touch: a finger beside the thin wall of a vessel would squeeze those in it.
const GRAIN: Group = Group::GROUP_7;

/// How much of the robot is solid for an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Robot {
    /// All of it.
    Whole,
    /// All but the hand with that number, 0 or 1.
    WithoutHand(usize),
    /// Nothing.
    Absent,
}

impl Physics {
    /// Sets what an object collides with, besides furniture and objects. What a hand holds cannot
    /// move against the hand, and contacts that nothing can change cost a quarter of a plan's
    /// time.
    pub(crate) fn collide(&mut self, object: BodyHandle, with: Robot) {
        let solid = solid_for_objects();
        let filter = match with {
            Robot::Whole => solid,
            Robot::WithoutHand(hand) => {
                let hand = HANDS.get(hand).copied();
                hand.map_or(solid, |hand| solid.difference(hand))
            }
            Robot::Absent => FURNITURE.union(OBJECT).union(BEING_CUT).union(GRAIN),
        };
        let groups = InteractionGroups::new(OBJECT, filter, InteractionTestMode::And);
        self.regroup(object, |own| *own = groups);
    }

    /// Lets an object pass through what is being cut, or no more.
    pub(crate) fn let_pass(&mut self, tool: BodyHandle, passes: bool) {
        self.regroup(tool, |groups| {
            groups.filter = match passes {
                true => groups.filter.difference(BEING_CUT),
                false => groups.filter.union(BEING_CUT),
            };
        });
    }

    /// Makes an object one that is being cut, or no more.
    pub(crate) fn be_cut(&mut self, food: BodyHandle, is_cut: bool) {
        self.regroup(food, |groups| {
            groups.memberships = if is_cut { BEING_CUT } else { OBJECT };
        });
    }

    fn regroup(&mut self, body: BodyHandle, change: impl Fn(&mut InteractionGroups)) {
        let s = self.edit();
        let Some(body) = s.bodies.get(body.0) else {
            return;
        };
        for collider in body.colliders() {
            if let Some(collider) = s.colliders.get_mut(*collider) {
                let mut groups = collider.collision_groups();
                change(&mut groups);
                collider.set_collision_groups(groups);
            }
        }
    }
}

/// Furniture never collides with furniture, and the robot only with objects: where a
/// kinematic body goes is checked geometrically before and during a motion.
pub(super) fn groups(kind: BodyKind, surface: Surface) -> InteractionGroups {
    let (own, others) = match kind {
        BodyKind::Static | BodyKind::MovingFurniture | BodyKind::Fixed { .. } => {
            (FURNITURE, OBJECT.union(BEING_CUT).union(GRAIN))
        }
        BodyKind::Robot => (robot_group(surface), OBJECT.union(BEING_CUT)),
        BodyKind::Object { .. } => (OBJECT, solid_for_objects()),
    };
    InteractionGroups::new(own, others, InteractionTestMode::And)
}

/// What grains collide with.
pub(super) fn groups_of_grains() -> InteractionGroups {
    let others = FURNITURE.union(OBJECT).union(BEING_CUT).union(GRAIN);
    InteractionGroups::new(GRAIN, others, InteractionTestMode::And)
}

fn robot_group(surface: Surface) -> Group {
    let hand = match surface {
        Surface::Plain => None,
        Surface::Hand(hand) | Surface::Pad(hand) => HANDS.get(hand).copied(),
    };
    hand.unwrap_or(ROBOT)
}

/// What objects collide with unless a hand holds them.
fn solid_for_objects() -> Group {
    let [left, right] = HANDS;
    FURNITURE
        .union(OBJECT)
        .union(BEING_CUT)
        .union(GRAIN)
        .union(ROBOT)
        .union(left)
        .union(right)
}
