//! Planned trajectories as polylines.

use super::frame::Path;
use robotics::motion::{PlannedTrajectory, TrajectoryAxes};
use robotics::robot::Side;
use robotics::world::World;
use spatial::Pose;

/// Time (s) between two points of a line, and greatest number of points.
const EVERY: f64 = 0.08;
const MAX_POINTS: usize = 90;

/// Height (m) of the base's line above the floor.
const ABOVE_FLOOR: f32 = 0.015;

/// A planned trajectory as polylines.
pub(crate) struct TrajectoryLines {
    number: u64,
    duration: f64,
    end: Vec<f64>,
    pub lines: Vec<Path>,
}

impl TrajectoryLines {
    /// The lines of the trajectory; `base` is the node of the robot's base.
    pub(super) fn new(
        world: &World,
        base: u32,
        number: u64,
        planned: &PlannedTrajectory<'_>,
    ) -> Self {
        let lines = match planned.axes {
            TrajectoryAxes::Base => vec![Path {
                what: Path::WHAT[0],
                frame: None,
                points: points(planned, |at| match at {
                    [x, y, ..] => Some([*x as f32, *y as f32, ABOVE_FLOOR]),
                    _ => None,
                }),
            }],
            TrajectoryAxes::Joints(joints) => {
                let description = &world.models().description;
                let moved = |side: &Side| {
                    let own = description.arm(*side).joints();
                    own.iter().any(|joint| joints.contains(joint))
                };
                let sides = description.sides().filter(moved);
                sides
                    .map(|side| Path {
                        what: Path::WHAT[1 + side.index()],
                        frame: Some(base),
                        points: points(planned, |at| {
                            let mut q = world.robot_configuration().joints.clone();
                            for (joint, position) in joints.iter().zip(at) {
                                q.set(*joint, *position);
                            }
                            let hand = description.arm(side).gripper.palm;
                            let tree = &world.models().robot;
                            let pose = tree.link_pose(hand, &Pose::identity(), &q);
                            let at = pose.translation.vector;
                            Some([at.x as f32, at.y as f32, at.z as f32])
                        }),
                    })
                    .collect()
            }
        };
        Self {
            number,
            duration: planned.trajectory.duration(),
            end: planned.trajectory.last().to_vec(),
            lines,
        }
    }

    /// Whether these lines belong to this trajectory.
    pub(super) fn is(&self, number: u64, planned: &PlannedTrajectory<'_>) -> bool {
        self.number == number
            && self.duration == planned.trajectory.duration()
            && self.end == planned.trajectory.last()
    }
}

fn points(
    planned: &PlannedTrajectory<'_>,
    mut point: impl FnMut(&[f64]) -> Option<[f32; 3]>,
) -> Vec<[f32; 3]> {
    let duration = planned.trajectory.duration();
    // The cast saturates.
    let count = ((duration / EVERY).ceil() as usize).clamp(1, MAX_POINTS);
    (0..=count)
        .filter_map(|i| {
            point(
                &planned
                    .trajectory
                    .position(duration * i as f64 / count as f64),
            )
        })
        .collect()
}
