//! The kitchen: surfaces at their heights, drawers and doors that open outwards.

use descriptions::KITCHEN_URDF;
use nalgebra::Vector3;

use crate::robot::KinematicTree;
use spatial::{Pose, Shape};

fn kitchen() -> KinematicTree {
    KinematicTree::from_urdf(KITCHEN_URDF, "kitchen.urdf").expect("the kitchen is right")
}

/// Height of the highest box of the link.
fn top(tree: &KinematicTree, link: &str) -> f64 {
    let link = tree.link_named(link).expect("the link exists");
    let pose = tree.link_pose(link, &Pose::identity(), &tree.zero_positions());
    let tops = tree
        .link(link)
        .collisions
        .iter()
        .map(|solid| match solid.shape {
            Shape::Box { size } => {
                let at = pose * solid.pose;
                let up = at.rotation.inverse() * Vector3::z();
                at.translation.z + up.abs().dot(&Vector3::from(size)) / 2.0
            }
            _ => f64::NEG_INFINITY,
        });
    tops.fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn surfaces_are_at_their_heights() {
    let tree = kitchen();
    for (link, height) in [
        ("table_area_main", 0.72),
        ("kitchen_island_surface", 0.86),
        ("sink_area_surface", 0.852),
        ("sink_area_sink", 0.856),
    ] {
        let found = top(&tree, link);
        assert!((found - height).abs() < 1e-9, "{link}: {found}");
    }
}

#[test]
fn fifteen_drawers_slide_three_doors_turn_and_five_knobs_too() {
    let tree = kitchen();
    let moving = |end: &str| {
        let joints = tree.joints().filter(|(_, j)| j.is_actuated());
        joints.filter(|(_, j)| j.name.contains(end)).count()
    };
    assert_eq!(moving("drawer"), 15);
    assert_eq!(moving("door"), 3);
    assert_eq!(moving("knob"), 5);
    assert_eq!(moving(""), 23);
}

#[test]
fn handles_move_into_the_room_when_something_opens() {
    let tree = kitchen();
    // The aisle in front of all units is around x = 0.25.
    let aisle = 0.25;
    for (joint_id, joint) in tree.joints() {
        let Some(limits) = joint.limits.filter(|_| !joint.name.contains("knob")) else {
            continue;
        };
        let carried = tree.link(joint.child).children.last();
        let carried = carried.expect("what opens has a handle");
        let handle = tree.joint(*carried).child;
        assert!(tree.link(handle).name.ends_with("_handle"));
        let mut q = tree.zero_positions();
        let closed = tree.link_pose(handle, &Pose::identity(), &q);
        q.set(joint_id, limits.upper / 4.0);
        let open = tree.link_pose(handle, &Pose::identity(), &q);
        let nearer = (closed.translation.x - aisle).abs() - (open.translation.x - aisle).abs();
        assert!(nearer > 0.05, "{}: {nearer}", joint.name);
    }
}
