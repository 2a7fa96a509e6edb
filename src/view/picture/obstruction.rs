//! Whether a picture shows what it is meant to: its eye may be inside something, under the
//! floor, or behind a wall.

use std::fmt;

use nalgebra::Point3;

use robotics::perception::{Camera, Sight};
use robotics::world::{BodyName, PartKey, World};
use spatial::Shape;

/// Size (pixels) of the picture by which that is judged.
const SIZE: [usize; 2] = [48, 36];

/// Bodies hide the view if they fill more than this share of the middle of the picture, and are
/// nearer than this share of the distance to what the eye looks at.
const MIN_SHARE: f64 = 0.6;
const NEAR: f64 = 0.7;

/// What keeps a picture from showing what it is meant to show.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstruction {
    /// The eye is below the floor.
    UnderFloor,
    /// The eye is inside the body.
    Inside(BodyName),
    /// Bodies are between the eye and the point that it looks at.
    Behind {
        /// The body that hides most.
        body: BodyName,
        /// The share of the middle of the picture that they hide, 0..1.
        share: f64,
        /// Distance of that body from the eye (m).
        distance: f64,
    },
}

impl Obstruction {
    /// What is in the way of the camera's view at a point (map frame).
    pub fn of(world: &World, camera: &Camera, at: &Point3<f64>) -> Option<Self> {
        let eye = Point3::from(camera.pose.translation.vector);
        if eye.z < 0.0 {
            return Some(Self::UnderFloor);
        }
        let shapes = world.shapes();
        let around = shapes.iter().find(|shape| {
            let eye = shape.pose.inverse_transform_point(&eye);
            contains(shape.shape, &eye)
        });
        if let Some(body) = around.and_then(|shape| world.body_name(shape.key)) {
            return Some(Self::Inside(body));
        }
        let [width, height] = SIZE;
        let coarse = Camera {
            width,
            height,
            far: NEAR * (at - eye).norm(),
            ..*camera
        };
        let sight = Sight::take(world, coarse, 1.0);
        let picture = sight.picture();
        let rows = height / 4..height * 3 / 4;
        let middle = rows.flat_map(|row| (width / 4..width * 3 / 4).map(move |c| (c, row)));
        // Rows and columns are those of the picture.
        let seen = middle.map(|(column, row)| (column, row, picture.keys()[row * width + column]));
        let seen: Vec<_> = seen.collect();
        let mut counts: Vec<(PartKey, usize)> = Vec::new();
        for key in seen.iter().filter_map(|(.., key)| *key) {
            match counts.iter_mut().find(|(known, _)| *known == key) {
                Some((_, count)) => *count += 1,
                None => counts.push((key, 1)),
            }
        }
        let hidden: usize = counts.iter().map(|(_, count)| count).sum();
        let share = hidden as f64 / seen.len() as f64;
        let (key, _) = counts.into_iter().max_by_key(|(_, count)| *count)?;
        if share < MIN_SHARE {
            return None;
        }
        let shown = seen.iter().filter(|(.., k)| *k == Some(key));
        let depths = shown.filter_map(|(column, row, _)| picture.depth(*column, *row));
        Some(Self::Behind {
            body: world.body_name(key)?,
            share,
            distance: depths.fold(f64::INFINITY, f64::min),
        })
    }
}

impl fmt::Display for Obstruction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnderFloor => f.write_str("the eye is under the floor"),
            Self::Inside(body) => write!(f, "the eye is inside {body}"),
            Self::Behind {
                body,
                share,
                distance,
            } => {
                let percent = (share * 100.0).floor();
                write!(
                    f,
                    "{percent} % of the view is behind {body}, {distance:.2} m from the eye, or what is beside it"
                )
            }
        }
    }
}

/// Whether a point in the shape's frame is inside the shape.
fn contains(shape: &Shape, point: &Point3<f64>) -> bool {
    match shape {
        Shape::Box { size } => (0..3).all(|axis| point[axis].abs() < size[axis] / 2.0),
        Shape::Cylinder { radius, length } => {
            libm::hypot(point.x, point.y) < *radius && point.z.abs() < length / 2.0
        }
        Shape::Sphere { radius } => point.coords.norm() < *radius,
        Shape::Hull(body) => body.convex_contains(point.coords.into()),
        Shape::Mesh(_) => false,
    }
}
