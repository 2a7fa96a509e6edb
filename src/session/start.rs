//! Where the robot is when a session starts, in a kitchen that it may not fit into.

use robotics::robot::description::DriveKind;
use robotics::world::{
    AllowedPairs, BodyName, CollisionChecker, Models, RobotConfiguration, World,
};
use spatial::pose::from_xy_yaw;

/// Overlaps up to this depth (m) are none.
const TOLERANCE: f64 = 2e-3;

/// How far (m) from the start a free place is looked for, and how far apart the places are.
const FARTHEST: i32 = 24;
const STEP: f64 = 0.25;

/// What is wrong with the place where the robot starts, if anything.
pub(super) fn remark(models: &Models, world: &World) -> Option<String> {
    let robot = world.robot_configuration();
    let [x, y] = [robot.base.translation.x, robot.base.translation.y];
    let mut checker = world.collision_checker();
    let in_furniture = within(&mut checker, robot);
    let problem = match in_furniture.first() {
        Some((name, depth)) => {
            let others = match in_furniture.len() - 1 {
                0 => String::new(),
                others => format!(" and in {others} more"),
            };
            format!(
                "the robot starts inside {name}, {:.0} mm deep{others}",
                1000.0 * depth
            )
        }
        None if !models.map.contains([x, y]) => {
            format!(
                "the robot starts outside the floor, which is {}",
                models.map
            )
        }
        None => return None,
    };
    if models.description.base.kind == DriveKind::Fixed {
        return Some(format!(
            "{problem}; its base does not drive: say in its description where it stands, \
             (base … :start ((x y z) (0 0 0 1)))"
        ));
    }
    let advice = match free_place(models, robot, &mut checker) {
        Some([x, y]) => format!(
            "put it elsewhere first; ({x:.2} {y:.2}) is free: (btr-utils:move-robot '(({x:.2} {y:.2} 0) (0 0 0 1)))"
        ),
        None => "no free place was found near it".to_owned(),
    };
    Some(format!("{problem}; {advice}"))
}

/// The furniture that the robot is in, deepest first, with the depths (m).
fn within(checker: &mut CollisionChecker<'_>, robot: &RobotConfiguration) -> Vec<(String, f64)> {
    let hits = checker.all_hits(robot, &AllowedPairs::default(), -TOLERANCE);
    let mut found: Vec<(String, f64)> = Vec::new();
    for hit in hits {
        if let BodyName::Furniture(name) = &hit.other
            && !found.iter().any(|(known, _)| *known == *name.name)
        {
            found.push((name.name.to_string(), hit.depth));
        }
    }
    found
}

/// The nearest place on the floor where the robot is in nothing.
fn free_place(
    models: &Models,
    robot: &RobotConfiguration,
    checker: &mut CollisionChecker<'_>,
) -> Option<[f64; 2]> {
    let start = [robot.base.translation.x, robot.base.translation.y];
    // The middle of the floor counts as near, wherever the robot is.
    let (min, max) = (models.map.min, models.map.max);
    let nearest = [0, 1].map(|axis| match (min[axis] + 0.5, max[axis] - 0.5) {
        (low, high) if low < high => start[axis].clamp(low, high),
        (low, high) => (low + high) / 2.0,
    });
    let mut places: Vec<[i32; 2]> = (-FARTHEST..=FARTHEST)
        .flat_map(|i| (-FARTHEST..=FARTHEST).map(move |j| [i, j]))
        .collect();
    places.sort_by_key(|[i, j]| i * i + j * j);
    let places = places.into_iter().map(|[i, j]| {
        [
            nearest[0] + STEP * f64::from(i),
            nearest[1] + STEP * f64::from(j),
        ]
    });
    let mut on_floor = places.filter(|place| models.map.contains(*place));
    on_floor.find(|[x, y]| {
        // What is told is what was looked at.
        let [x, y] = [x, y].map(|value| (value * 100.0).round() / 100.0);
        let mut moved = RobotConfiguration {
            base: from_xy_yaw(x, y, 0.0),
            joints: robot.joints.clone(),
        };
        moved.base.translation.z = robot.base.translation.z;
        checker.is_free(&moved, &AllowedPairs::default(), 0.0)
    })
}
