//! The views from which the world can be drawn.

use std::fmt;

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use thiserror::Error;

use super::obstruction::Obstruction;
use robotics::perception::camera::Camera;
use robotics::world::World;
use spatial::{Pose, trig};

/// Vertical field of view (rad) by default.
pub const FIELD_OF_VIEW: f64 = 0.72;

/// Distance (m) from the eye before which nothing is seen.
const NEAR: f64 = 0.05;

/// A viewpoint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// The whole kitchen, from its open corner.
    Kitchen,
    /// Straight down, x to the right.
    Top,
    /// Straight down without perspective, x to the right: equal lengths on the floor are equal
    /// in the picture.
    Map,
    /// Through the robot's camera.
    Robot,
    /// The table; the kitchen's description says which furniture that is.
    Table,
    /// The kitchen island; the same.
    Island,
    /// The robot, from the open side of the kitchen.
    Follow,
    /// From anywhere.
    Free {
        /// Position of the eye (m, map frame).
        from: Point3<f64>,
        /// The point in the middle of the picture (m, map frame).
        at: Point3<f64>,
        /// Vertical field of view (rad).
        vertical_fov: f64,
    },
}

/// Why there is no such view.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ViewError {
    /// The kitchen lacks what the view looks at.
    #[error(
        "the view {view} looks at {link}, which this kitchen lacks; use --from and --at instead"
    )]
    NothingThere {
        /// The view.
        view: View,
        /// The link that it looks at.
        link: String,
    },
    /// The description of the kitchen does not say where the view is.
    #[error(
        "the view {0} is not in this kitchen's description, as (view {0} …); use --from and --at instead"
    )]
    Undescribed(View),
    /// The eye and the point that it looks at coincide.
    #[error("the view is from and at the same place, ({}, {}, {})", .0.x, .0.y, .0.z)]
    NoDirection(Point3<f64>),
    /// A coordinate is not finite or far too large, or the field of view is not an angle that a
    /// picture can have.
    #[error("{0} is out of range for a view")]
    Impossible(f64),
}

/// Position of the eye of [`View::Follow`], and of the point it looks at (m, relative to the
/// robot's base but along the axes of the map): it never turns.
pub(crate) const FOLLOW_FROM: [f64; 3] = [-2.05, -1.7, 2.0];
pub(crate) const FOLLOW_AT: [f64; 3] = [0.0, 0.05, 0.82];

/// Height (m) of the eye of [`View::Map`]: from so far away, nothing looks nearer than the
/// floor.
const MAP_EYE: f64 = 400.0;

/// The point in the middle of [`View::Map`], and its distance to the upper border (m).
const MAP_MIDDLE: [f64; 2] = [-1.0, 0.55];
const MAP_HALF: f64 = 2.94;

/// Coordinates (m) beyond which there is nothing to see.
const REACH: f64 = 1000.0;

impl View {
    /// All named views.
    pub const NAMED: [Self; 7] = [
        Self::Kitchen,
        Self::Top,
        Self::Map,
        Self::Robot,
        Self::Table,
        Self::Island,
        Self::Follow,
    ];

    /// Name of the view.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Kitchen => "kitchen",
            Self::Top => "top",
            Self::Map => "map",
            Self::Robot => "robot",
            Self::Table => "table",
            Self::Island => "island",
            Self::Follow => "follow",
            Self::Free { .. } => "free",
        }
    }

    /// Corners (m, map frame) of the floor area that [`View::Map`] shows in a picture of this
    /// size.
    pub fn map_area(width: usize, height: usize) -> [[f64; 2]; 2] {
        let half = [MAP_HALF * width as f64 / height.max(1) as f64, MAP_HALF];
        [-1.0, 1.0].map(|sign| [0, 1].map(|i| MAP_MIDDLE[i] + sign * half[i]))
    }

    /// The camera of the view, for a picture of this size (pixels).
    pub fn camera(&self, world: &World, width: usize, height: usize) -> Result<Camera, ViewError> {
        let camera = |pose: Pose, vertical_fov: f64| Camera {
            pose,
            width,
            height,
            vertical_fov,
            near: NEAR,
            far: f64::INFINITY,
        };
        let look = |from: [f64; 3], at: [f64; 3], fov: f64| {
            looking(from.into(), at.into(), Vector3::z()).map(|pose| camera(pose, fov))
        };
        match *self {
            Self::Kitchen => look([-4.25, -3.0, 2.75], [-0.5, 0.55, 0.55], 0.78),
            Self::Top => {
                let (from, at) = ([-1.0, 0.55, 9.5], [-1.0, 0.55, 0.0]);
                looking(from.into(), at.into(), Vector3::y()).map(|pose| camera(pose, 0.6))
            }
            Self::Map => {
                let [x, y] = MAP_MIDDLE;
                let (from, at) = ([x, y, MAP_EYE], [x, y, 0.0]);
                let fov = 2.0 * trig::atan2(MAP_HALF, MAP_EYE);
                looking(from.into(), at.into(), Vector3::y()).map(|pose| camera(pose, fov))
            }
            Self::Robot => {
                let through = world.models().description.camera();
                Ok(camera(
                    world.link_pose(through.frame),
                    through.vertical_view,
                ))
            }
            Self::Table | Self::Island => {
                let (eye, at) = self.close_up(world)?;
                look(eye, at.into(), FIELD_OF_VIEW)
            }
            Self::Follow => {
                let [from, at] = Self::followed(world);
                looking(from, at, Vector3::z()).map(|pose| camera(pose, FIELD_OF_VIEW))
            }
            Self::Free {
                from,
                at,
                vertical_fov,
            } => {
                let is_angle = vertical_fov > 0.0 && vertical_fov < 3.0;
                let is_place = |v: &&f64| !(-REACH..=REACH).contains(*v);
                let wrong = from.iter().chain(at.iter()).find(is_place);
                if let Some(value) = wrong.or((!is_angle).then_some(&vertical_fov)) {
                    return Err(ViewError::Impossible(*value));
                }
                looking(from, at, Vector3::z()).map(|pose| camera(pose, vertical_fov))
            }
        }
    }

    /// The point (map frame) that the view is meant to show, if that depends on the user or on
    /// the robot.
    fn target(self, world: &World) -> Option<Point3<f64>> {
        match self {
            Self::Free { at, .. } => Some(at),
            Self::Follow => Some(Self::followed(world)[1]),
            _ => None,
        }
    }

    /// What keeps the camera, which is this view's, from showing what it is meant to show.
    pub fn obstruction(self, world: &World, camera: &Camera) -> Option<Obstruction> {
        Obstruction::of(world, camera, &self.target(world)?)
    }

    /// The eye of [`View::Follow`] and the point that it looks at (m, map frame).
    fn followed(world: &World) -> [Point3<f64>; 2] {
        let base = world.robot_configuration().base.translation.vector;
        [FOLLOW_FROM, FOLLOW_AT].map(|from| Point3::from(base) + Vector3::from(from))
    }

    /// The eye of a view of furniture, and the point that it looks at (m, map frame).
    fn close_up(self, world: &World) -> Result<([f64; 3], Point3<f64>), ViewError> {
        let models = world.models();
        let Some(found) = models.kitchen_description.close_up(self.name()) else {
            return Err(ViewError::Undescribed(self));
        };
        let Some(link) = models.kitchen.link_named(&found.link) else {
            return Err(ViewError::NothingThere {
                view: self,
                link: found.link.clone(),
            });
        };
        let at = world.furniture_pose(link) * Point3::from(found.at);
        let [x, y, z] = found.eye;
        Ok(([at.x + x, at.y + y, z], at))
    }
}

impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The optical frame of an eye that looks from one point to the other (m, map frame), with `up`
/// as far up in the picture as possible.
fn looking(from: Point3<f64>, at: Point3<f64>, up: Vector3<f64>) -> Result<Pose, ViewError> {
    let forward = (at - from)
        .try_normalize(1e-6)
        .ok_or(ViewError::NoDirection(from))?;
    let right = forward
        .cross(&up)
        .try_normalize(1e-6)
        .unwrap_or_else(Vector3::x);
    let axes = Matrix3::from_columns(&[right, forward.cross(&right), forward]);
    Ok(Pose::from_parts(from.into(), rotation(&axes)))
}

/// The rotation with these axes, which are orthogonal; the same bits on every platform.
fn rotation(axes: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*axes))
}
