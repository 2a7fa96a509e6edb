//! The program's inner workings that the benches measure.
//!
//! A bench is a crate of its own and sees only the public face, so the work is set up here and
//! handed over piece by piece, each piece with a name.

mod clutter;
mod kinematics;
mod motion;
mod pictures;
mod world;

use std::sync::Arc;

pub use clutter::{PlannedMotion, cluttered_arms, cluttered_drives};
pub use kinematics::{kinematics, reading};
pub use motion::{arms, drives, trajectories};
pub use pictures::pictures;
pub use world::{collisions, sight, snapshots, steps};

use robotics::world::{Models, RobotConfiguration, World};
use spatial::Pose;
use spatial::pose::{from_xy_yaw, from_xyz_rpy};

/// Measures pieces of work.
pub trait Stopwatch {
    /// Measures work that can simply be repeated.
    fn repeated(&mut self, name: &str, work: &mut dyn FnMut());

    /// Measures work that needs fresh input each time; preparing it is not measured.
    fn prepared(&mut self, name: &str, prepare: &mut dyn FnMut() -> Box<dyn FnOnce()>);
}

/// The built-in robot in its kitchen.
pub(crate) fn models() -> Arc<Models> {
    Arc::new(Models::pr2_in_kitchen().expect("the built-in models are right"))
}

/// The robot at (m, m, degrees) with parked arms and its torso at the height (m).
pub(crate) fn parked(models: &Models, [x, y, degrees]: [f64; 3], torso: f64) -> RobotConfiguration {
    let mut joints = models.robot.zero_positions();
    models.description.torso.set_height(&mut joints, torso);
    for arm in &models.description.arms {
        arm.set_positions(
            &mut joints,
            arm.posture("park").expect("arms can be parked"),
        );
    }
    RobotConfiguration {
        base: from_xy_yaw(x, y, degrees.to_radians()),
        joints,
    }
}

/// Spawns an upright object from the library at a position (m, m, m).
fn spawn(world: &mut World, name: &str, type_name: &str, at: [f64; 3]) {
    let pose: Pose = from_xyz_rpy(at, [0.0; 3]);
    world
        .spawn(name, type_name, &pose, None, None)
        .expect("the place is free");
}

/// The robot in front of the table.
const AT_TABLE: [f64; 3] = [-1.447, -0.15, -90.0];
