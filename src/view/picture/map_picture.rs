//! The kitchen from above, with the floor in two colours: where the base can stand, and where
//! something is in the way.
//!
//! The robot is taken in its current configuration, including what its hands hold; only its
//! base is moved and turned. A place counts as free if the robot touches nothing there in at
//! least one direction.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::image::Image;
use super::lettering::Line;
use super::looks::Looks;
use super::scene::{Body, Finish, Kind, Owner, Scene};
use super::surface::Surface;
use robotics::world::{AllowedPairs, BodyName, World};
use spatial::{Pose, pose};

/// Edge length (m) of the squares that are checked.
const SQUARE: f64 = 0.05;

/// Number of directions of the base that are tried at a place.
const TURNS: usize = 8;

/// Height (m) of the coloured areas above the floor.
const HEIGHT: f64 = 0.004;

/// Linear colours of free and of blocked floor.
pub const FREE: [f32; 4] = [0.10, 0.46, 0.16, 0.62];
pub const BLOCKED: [f32; 4] = [0.70, 0.07, 0.05, 0.62];

/// Name of the area that is free, as a body of a scene.
pub(crate) const FREE_NAME: &str = "free";
/// Name of the area that is blocked.
pub(crate) const BLOCKED_NAME: &str = "blocked";

/// A grid of squares where the base can stand or cannot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FloorMap {
    columns: usize,
    rows: usize,
    /// The corner with the least x and y (squares).
    first: [i32; 2],
    /// The squares row by row, from the least y.
    free: Vec<bool>,
}

impl FloorMap {
    /// Checks the floor between two corners (m, map frame).
    pub fn of(world: &World, from: [f64; 2], to: [f64; 2]) -> Self {
        let square = |value: f64| (value / SQUARE).floor() as i32;
        // One square more on each side: the areas end in the middles of the outermost squares.
        let first = from.map(|value| square(value) - 1);
        let size = [0, 1].map(|i| (square(to[i]) + 2 - first[i]).clamp(1, 400) as usize);
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
    pub fn is_free(&self, x: f64, y: f64) -> Option<bool> {
        let place = |value: f64, first: i32| {
            usize::try_from((value / SQUARE).floor() as i64 - i64::from(first)).ok()
        };
        let (column, row) = (place(x, self.first[0])?, place(y, self.first[1])?);
        if column >= self.columns {
            return None;
        }
        self.free.get(row * self.columns + column).copied()
    }

    /// The area of one kind as a surface. Its border runs where the squares around, weighted by
    /// their nearness, are half free and half blocked; so it is smooth, and at most half a
    /// square away from those of the squares.
    fn surface(&self, free: bool) -> Surface {
        let mut surface = Surface::default();
        let shares = self.shares();
        let is_inside = |share: f64| (share >= HALF) == free;
        let place = |column: usize, row: usize| {
            let at = |place: usize, first: i32| (f64::from(first) + place as f64 + 0.5) * SQUARE;
            [at(column, self.first[0]), at(row, self.first[1])]
        };
        // Between the middles of four squares, the share is linear in each of two triangles.
        for row in 1..self.rows {
            let corner = |column: usize, row: usize| {
                // Rows and columns are those of the map.
                (place(column, row), shares[row * self.columns + column])
            };
            let quads = (1..self.columns).map(|column| {
                [
                    corner(column - 1, row - 1),
                    corner(column, row - 1),
                    corner(column, row),
                    corner(column - 1, row),
                ]
            });
            let quads: Vec<_> = quads.collect();
            let is_whole = |quad: &[Share; 4]| quad.iter().all(|(_, share)| is_inside(*share));
            // Neighbours that are wholly inside form one rectangle.
            for run in quads.chunk_by(|a, b| is_whole(a) && is_whole(b)) {
                if let ([first, ..], [.., last]) = (run, run)
                    && is_whole(first)
                {
                    let [a, _, _, d] = first.map(|(at, _)| at);
                    let [_, b, c, _] = last.map(|(at, _)| at);
                    surface.add_flat(&[a, b, c, d], HEIGHT);
                    continue;
                }
                for [a, b, c, d] in run {
                    for triangle in [[*a, *b, *c], [*a, *c, *d]] {
                        let part = part_of(triangle, is_inside);
                        surface.add_flat(&part, HEIGHT);
                    }
                }
            }
        }
        surface
    }

    /// For each square, how much (0..1) of it and of the eight around it is free; the nearer
    /// ones count more.
    fn shares(&self) -> Vec<f64> {
        let is_free = &|column: usize, row: usize| {
            let (column, row) = (column.min(self.columns - 1), row.min(self.rows - 1));
            // Clipped to the map.
            f64::from(u8::from(self.free[row * self.columns + column]))
        };
        let around = |place: usize| [place.saturating_sub(1), place, place, place + 1];
        let squares = (0..self.rows).flat_map(|row| (0..self.columns).map(move |c| (c, row)));
        squares
            .map(|(column, row)| {
                let rows = around(row).into_iter();
                let sum: f64 = rows
                    .flat_map(|row| around(column).map(move |column| is_free(column, row)))
                    .sum();
                sum / 16.0
            })
            .collect()
    }
}

/// A place (m) and how much of what is around it is free.
type Share = ([f64; 2], f64);

/// The share at the border of an area.
const HALF: f64 = 0.5;

/// The part of a triangle that is inside an area, a polygon with the same orientation.
fn part_of(triangle: [Share; 3], is_inside: impl Fn(f64) -> bool) -> Vec<[f64; 2]> {
    let mut part = Vec::with_capacity(4);
    for (i, (from, here)) in triangle.iter().enumerate() {
        let (to, there) = triangle[(i + 1) % 3];
        if is_inside(*here) {
            part.push(*from);
        }
        if is_inside(*here) != is_inside(there) {
            let way = (HALF - here) / (there - here);
            part.push([0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * way));
        }
    }
    part
}

/// The world with the floor coloured, as seen from above.
pub fn map_scene(world: &World, looks: &Looks, map: &FloorMap) -> Scene {
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
pub fn add_legend(image: &mut Image) {
    let size = image.width() / 36;
    let entries = [
        ([96, 150, 82], "The base may stand"),
        ([186, 90, 74], "Something is in the way"),
    ];
    let mut left = 0;
    for (color, text) in entries {
        let line = Line {
            text,
            size,
            color: [226, 228, 232],
        };
        let [width, height] = line.plate();
        if left + height + width > image.width() || height > image.height() / 4 {
            return;
        }
        let top = image.height() - height;
        image.fill([left, top], [height; 2], color);
        line.draw_on_plate(image, left + height, top);
        left += height + width + height / 2;
    }
}

/// Checks where the base can stand.
struct BaseChecker<'w> {
    checker: robotics::world::CollisionChecker<'w>,
    robot: robotics::world::RobotConfiguration,
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
