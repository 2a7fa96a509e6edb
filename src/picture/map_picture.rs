//! The kitchen from above, with the floor in two colours: where the base can stand, and where
//! something is in the way.
//!
//! The robot is taken in its current configuration, including what its hands hold; only its
//! base is moved and turned. A place counts as free if the robot touches nothing there in at
//! least one direction.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use super::image::Image;
use super::lettering::Line;
use super::looks::Looks;
use super::scene::{Body, Finish, Kind, Owner, Scene};
use super::surface::{Corner, Surface};
use crate::spatial::{Pose, pose};
use crate::world::{AllowedPairs, BodyName, World};

/// Edge length (m) of the squares that are checked.
const SQUARE: f64 = 0.05;

/// Number of directions of the base that are tried at a place.
const TURNS: usize = 8;

/// Height (m) of the coloured areas above the floor.
const HEIGHT: f64 = 0.004;

/// Linear colours of free and of blocked floor.
pub(crate) const FREE: [f32; 4] = [0.10, 0.46, 0.16, 0.62];
pub(crate) const BLOCKED: [f32; 4] = [0.70, 0.07, 0.05, 0.62];

/// Name of the area that is free, as a body of a scene.
pub(crate) const FREE_NAME: &str = "free";
/// Name of the area that is blocked.
pub(crate) const BLOCKED_NAME: &str = "blocked";

/// A grid of squares where the base can stand or cannot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FloorMap {
    columns: usize,
    rows: usize,
    /// The corner with the least x and y (squares).
    first: [i32; 2],
    /// The squares row by row, from the least y.
    free: Vec<bool>,
}

impl FloorMap {
    /// Checks the floor between two corners (m, map frame).
    pub(crate) fn of(world: &World, from: [f64; 2], to: [f64; 2]) -> Self {
        let square = |value: f64| (value / SQUARE).floor() as i32;
        let first = from.map(square);
        let size = [0, 1].map(|i| (square(to[i]) - first[i]).clamp(0, 400) as usize);
        let mut checker = BaseChecker::new(world);
        let middle =
            |axis: usize, place: usize| (f64::from(first[axis]) + place as f64 + 0.5) * SQUARE;
        let mut free = Vec::with_capacity(size[0] * size[1]);
        for row in 0..size[1] {
            for column in 0..size[0] {
                free.push(checker.is_free(middle(0, column), middle(1, row)));
            }
        }
        Self {
            columns: size[0],
            rows: size[1],
            first,
            free,
        }
    }

    /// Whether the base can stand at the place (m, map frame); `None` for a place that was not
    /// checked.
    #[cfg(test)]
    pub(crate) fn is_free(&self, x: f64, y: f64) -> Option<bool> {
        let place = |value: f64, first: i32| {
            usize::try_from((value / SQUARE).floor() as i64 - i64::from(first)).ok()
        };
        let (column, row) = (place(x, self.first[0])?, place(y, self.first[1])?);
        if column >= self.columns {
            return None;
        }
        self.free.get(row * self.columns + column).copied()
    }

    /// The squares of one kind as a surface; neighbours in a row form one rectangle.
    fn surface(&self, free: bool) -> Surface {
        let mut surface = Surface::default();
        for row in 0..self.rows {
            // The rows are ranges of the squares.
            let squares = &self.free[row * self.columns..(row + 1) * self.columns];
            let mut start = 0;
            for run in squares.chunk_by(|a, b| a == b) {
                let end = start + run.len();
                if run.first() == Some(&free) {
                    self.add(&mut surface, row, [start, end]);
                }
                start = end;
            }
        }
        surface
    }

    fn add(&self, surface: &mut Surface, row: usize, [start, end]: [usize; 2]) {
        let first = surface.corners.len() as u32;
        for (column, row) in [(start, row), (end, row), (end, row + 1), (start, row + 1)] {
            let at = |place: usize, first: i32| (f64::from(first) + place as f64) * SQUARE;
            surface.corners.push(Corner {
                point: Point3::new(at(column, self.first[0]), at(row, self.first[1]), HEIGHT),
                normal: Vector3::z(),
            });
        }
        surface.triangles.push([first, first + 1, first + 2]);
        surface.triangles.push([first, first + 2, first + 3]);
    }
}

/// The world with the floor coloured, as seen from above.
pub(crate) fn map_scene(world: &World, looks: &Looks, map: &FloorMap) -> Scene {
    let mut scene = looks.scene(world);
    for (free, name, color) in [(true, FREE_NAME, FREE), (false, BLOCKED_NAME, BLOCKED)] {
        scene.bodies.push(Body {
            owner: Owner::new(Kind::Sign, name),
            surface: Arc::new(map.surface(free)),
            pose: Pose::identity(),
            color,
            finish: Finish::Matt,
        });
    }
    scene
}

/// Writes the meaning of the colours below the picture.
pub(crate) fn add_legend(image: &mut Image) {
    let scale = 1 + image.width() / 800;
    let entries = [
        ([96, 150, 82], "The base may stand"),
        ([186, 90, 74], "Something is in the way"),
    ];
    let mut left = 0;
    for (color, text) in entries {
        let line = Line { text, scale, color };
        let size = line.height() + 4 * scale;
        if left + size + line.width() > image.width() || size > image.height() / 4 {
            return;
        }
        let top = image.height() - size;
        image.fill([left, top], [size; 2], color);
        let white = Line {
            color: [226, 228, 232],
            ..line
        };
        white.draw_on_plate(image, left + size, top);
        left += size + line.width() + 12 * scale;
    }
}

/// Checks where the base can stand.
struct BaseChecker<'w> {
    checker: crate::world::CollisionChecker<'w>,
    robot: crate::world::RobotConfiguration,
    /// Pairs of bodies that belong to the robot and move with it.
    own: AllowedPairs,
    /// The direction that was free last, which is likely to be free at the next place, too.
    last: usize,
}

impl<'w> BaseChecker<'w> {
    fn new(world: &'w World) -> Self {
        let mut checker = world.collision_checker();
        let robot = world.robot_configuration().clone();
        let rides = |body: &BodyName| match body {
            BodyName::Robot(_) => true,
            BodyName::Object(name) => world.object(name).is_ok_and(|o| o.attachment().is_some()),
            BodyName::Furniture(_) | BodyName::Floor => false,
        };
        let own = checker
            .all_hits(&robot, &AllowedPairs::none(), 0.0)
            .into_iter()
            .filter(|hit| rides(&hit.other))
            .fold(AllowedPairs::none(), |all, hit| {
                all.and(hit.moving, hit.other)
            });
        Self {
            checker,
            robot,
            own,
            last: 0,
        }
    }

    fn is_free(&mut self, x: f64, y: f64) -> bool {
        let height = self.robot.base.translation.z;
        for turn in 0..TURNS {
            let turn = (self.last + turn) % TURNS;
            self.robot.base = pose::from_xy_yaw(x, y, TAU * turn as f64 / TURNS as f64);
            self.robot.base.translation.z = height;
            if self.checker.is_free(&self.robot, &self.own, 0.0) {
                self.last = turn;
                return true;
            }
        }
        false
    }
}
