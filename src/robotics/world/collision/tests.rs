use std::sync::Arc;

use parry3d_f64::query;
use proptest::prelude::*;

use super::*;
use crate::robot::Side;
use crate::world::solid::to_parry;
use crate::world::{Models, World};
use spatial::pose::from_xy_yaw;

fn world() -> World {
    let models = Arc::new(Models::pr2_in_kitchen().unwrap());
    let joints = models.description.start_positions(&models.robot);
    let base = Pose::identity();
    World::new(models, RobotConfiguration { base, joints })
}

/// The smallest distance (m) between the robot and the furniture, from all pairs.
fn distance_by_brute_force(world: &World, robot: &RobotConfiguration) -> f64 {
    let models = world.models();
    let mut poses = Vec::new();
    models
        .robot
        .forward_kinematics(&robot.base, &robot.joints, &mut poses);
    let mut nearest = f64::INFINITY;
    for link in &models.robot_geometry.solid_links {
        let link_pose = to_parry(&poses[link.link.index()]);
        for solid in &link.solids {
            let pose = link_pose * solid.pose;
            for other in world.state.furniture.all() {
                // The library's own distance of two boxes is off by centimetres.
                let (one, two) = (&*solid.shape, &*other.solid.shape);
                let near = query::contact(&pose, one, &other.placed.pose, two, 1.0).unwrap();
                nearest = near.map_or(nearest, |c| nearest.min(c.dist));
            }
        }
    }
    nearest
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn the_search_finds_what_looking_at_all_pairs_finds(
        x in -3.5f64..1.5,
        y in -1.8f64..2.9,
        yaw in -3.1f64..3.1,
        torso in 0.0f64..0.33,
        pan in -0.7f64..0.7,
        elbow in -2.1f64..0.0,
    ) {
        let world = world();
        let models = world.models();
        let mut robot = world.robot_configuration().clone();
        robot.base = from_xy_yaw(x, y, yaw);
        (models.description.torso).set_height(&mut robot.joints, torso);
        let arm = models.description.arm(Side::Right);
        robot.joints.set(arm.joints()[0], pan);
        robot.joints.set(arm.joints()[3], elbow);

        let floor = models.robot.links().map(|(link, _)| models.robot_body(link));
        let allowed = AllowedPairs::none().and_all(floor, &BodyName::Floor);
        let expected = distance_by_brute_force(&world, &robot);
        let mut checker = world.collision_checker();
        let found = checker.clearance(&robot, &allowed, 0.5);
        match &found {
            None => prop_assert!(expected >= 0.5),
            Some(near) => prop_assert!(
                (near.distance - expected).abs() < 1e-6,
                "{near:?} instead of {expected}"
            ),
        }
        if expected < 0.0 {
            prop_assert!(!checker.is_free(&robot, &allowed, 0.0));
            prop_assert!(checker.first_hit(&robot, &allowed, 0.0).is_some());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn one_checker_finds_what_new_ones_find_and_no_pair_is_missing(
        x in -3.5f64..1.5,
        y in -1.8f64..2.9,
        pans in proptest::array::uniform3(-2.1f64..0.5),
        elbows in proptest::array::uniform3(-2.1f64..0.0),
    ) {
        let world = world();
        let models = world.models();
        let mut robot = world.robot_configuration().clone();
        robot.base = from_xy_yaw(x, y, 0.3);
        let arm = models.description.arm(Side::Right);
        let joints = [arm.joints()[0], arm.joints()[3]];
        let moving = || MovingParts::of_joints(&models.robot, &joints);
        let mut reused = world.collision_checker();
        let mut quick = [(); 3].map(|()| world.collision_checker());
        let mut changing = world.collision_checker();
        changing.expect(moving(), Pairs::Changing);
        let none = AllowedPairs::none();
        for (pan, elbow) in pans.into_iter().zip(elbows) {
            robot.joints.set(joints[0], pan);
            robot.joints.set(joints[1], elbow);
            let all = world.collision_checker().all_hits(&robot, &none, 0.05);
            prop_assert_eq!(&reused.all_hits(&robot, &none, 0.05), &all);
            // It looks first at what was in the way before.
            for (margin, quick) in [0.0, 0.02, 0.05].into_iter().zip(&mut quick) {
                let free = world.collision_checker().is_free(&robot, &none, margin);
                prop_assert_eq!(quick.is_free(&robot, &none, margin), free);
            }
            let mut found = changing.all_hits(&robot, &none, 0.05);
            let mut constant = world.collision_checker();
            constant.expect(moving(), Pairs::Constant);
            found.extend(constant.all_hits(&robot, &none, 0.05));
            found.sort_by(|a, b| b.depth.total_cmp(&a.depth));
            let depths = |hits: &[CollisionHit]| -> Vec<f64> {
                hits.iter().map(|hit| hit.depth).collect()
            };
            prop_assert_eq!(depths(&found), depths(&all));
        }
    }
}

#[test]
fn a_world_can_be_handed_to_another_thread() {
    fn needs_send<T: Send + Sync>(_: &T) {}
    needs_send(&world());
    needs_send(&world().snapshot());
}
