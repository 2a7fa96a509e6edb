//! Rays through the pixels of a camera, calculated by formulas for convex bodies: another way to what a
//! picture shows than drawing it.

use std::ops::Range;

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use robotics::world::PartKey;
use spatial::{Pose, Shape};

/// A convex body at a pose in the map frame.
pub(super) struct Body<'a> {
    code: PartKey,
    shape: &'a Shape,
    pose: Pose,
    /// Middle (map frame) and radius (m) of the ball around its origin.
    middle: [f64; 3],
    radius: f64,
    /// Outward normals and distances (m) of the planes of a hull.
    planes: Vec<(Vector3<f64>, f64)>,
}

impl<'a> Body<'a> {
    pub(super) fn new(code: PartKey, shape: &'a Shape, pose: Pose) -> Self {
        let planes = match shape {
            Shape::Box { size } => (0..3)
                .flat_map(|axis| {
                    let normal = Vector3::ith(axis, 1.0);
                    [(normal, size[axis] / 2.0), (-normal, size[axis] / 2.0)]
                })
                .collect(),
            Shape::Cylinder { length, .. } => {
                vec![(Vector3::z(), length / 2.0), (-Vector3::z(), length / 2.0)]
            }
            Shape::Hull(hull) => hull
                .triangles
                .iter()
                .filter_map(|corners| {
                    let [a, b, c] = corners.map(|i| Vector3::from(hull.corners[i as usize]));
                    let normal = (b - a).cross(&(c - a)).try_normalize(1e-12)?;
                    Some((normal, normal.dot(&a)))
                })
                .collect(),
            Shape::Sphere { .. } | Shape::Mesh(_) => Vec::new(),
        };
        Self {
            code,
            shape,
            pose,
            middle: pose.translation.vector.into(),
            radius: shape.bounding_radius(),
            planes,
        }
    }

    /// The distance (m) at which a ray (map frame, its direction of any length, which is the unit) comes into it.
    fn entered(&self, from: &Point3<f64>, along: &Vector3<f64>) -> Option<f64> {
        let start = self.pose.inverse_transform_point(from).coords;
        let way = self.pose.inverse_transform_vector(along);
        let (mut first, mut last) = (0.0, f64::INFINITY);
        for (normal, distance) in &self.planes {
            let (approach, room) = (normal.dot(&way), distance - normal.dot(&start));
            if approach.abs() < 1e-12 {
                if room < 0.0 {
                    return None;
                }
            } else if approach > 0.0 {
                last = f64::min(last, room / approach);
            } else {
                first = f64::max(first, room / approach);
            }
        }
        let round = match self.shape {
            Shape::Sphere { radius } => Some((way, start, *radius)),
            Shape::Cylinder { radius, .. } => {
                let flat = |v: Vector3<f64>| Vector3::new(v.x, v.y, 0.0);
                Some((flat(way), flat(start), *radius))
            }
            _ => None,
        };
        if let Some((way, start, radius)) = round {
            let (a, b, c) = (
                way.norm_squared(),
                way.dot(&start),
                start.norm_squared() - radius * radius,
            );
            if a < 1e-18 {
                if c > 0.0 {
                    return None;
                }
            } else {
                let root = b * b - a * c;
                if root < 0.0 {
                    return None;
                }
                first = f64::max(first, (-b - root.sqrt()) / a);
                last = f64::min(last, (-b + root.sqrt()) / a);
            }
        }
        (first <= last).then_some(first)
    }
}

/// A pinhole camera.
pub(super) struct Eye {
    /// Its optical frame in the map: z forward, x to the right, y down.
    pub(super) pose: Pose,
    /// Pixels across and down.
    pub(super) size: [usize; 2],
    /// Tangent of half the vertical field of view.
    pub(super) half_height: f64,
    /// Depths (m) between which something is seen.
    pub(super) range: [f64; 2],
}

impl Eye {
    /// The share (0 to 1) of a body, of all pixels that would show it if it were alone and in the middle.
    pub(super) fn share_in_sight(&self, bodies: &[Body<'_>], code: PartKey, middle: &Pose) -> f64 {
        let own: Vec<&Body<'_>> = bodies.iter().filter(|body| body.code == code).collect();
        let middle = Point3::from(middle.translation.vector);
        let all = self.turned_to(&middle).rays_that_hit(&own, &own, code);
        if all == 0 {
            return 0.0;
        }
        let near: Vec<&Body<'_>> = bodies
            .iter()
            .filter(|body| own.iter().any(|own| self.overlap(own, body)))
            .collect();
        f64::from(self.rays_that_hit(&own, &near, code)) / f64::from(all)
    }

    /// The number of pixels, within what the own bodies may take of the picture, that show the code.
    fn rays_that_hit(&self, own: &[&Body<'_>], bodies: &[&Body<'_>], code: PartKey) -> u32 {
        let [width, height] = self.size.map(|pixels| pixels as f64);
        let pixel = 2.0 * self.half_height / height;
        let from = Point3::from(self.pose.translation.vector);
        let mut count = 0;
        let [columns, rows] = self.window(own, pixel);
        for row in rows {
            for column in columns.clone() {
                let x = (column as f64 + 0.5 - width / 2.0) * pixel;
                let y = (row as f64 + 0.5 - height / 2.0) * pixel;
                let ray = Vector3::new(x, y, 1.0);
                let along = self.pose * ray;
                if !own.iter().any(|body| near_ray(body, &from, &along)) {
                    continue;
                }
                let mut nearest = (f64::INFINITY, None);
                for body in bodies.iter().filter(|body| near_ray(body, &from, &along)) {
                    if let Some(depth) = body.entered(&from, &along)
                        && (self.range[0]..=self.range[1]).contains(&depth)
                        && depth < nearest.0
                    {
                        nearest = (depth, Some(body.code));
                    }
                }
                count += u32::from(nearest.1 == Some(code));
            }
        }
        count
    }

    /// The columns and rows in which the balls around bodies are.
    fn window(&self, bodies: &[&Body<'_>], pixel: f64) -> [Range<usize>; 2] {
        [0, 1].map(|axis| {
            let middle = self.size[axis] as f64 / 2.0;
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for body in bodies {
                let at = self.pose.inverse() * Point3::from(body.pose.translation.vector);
                if at.z <= body.radius {
                    return 0..self.size[axis];
                }
                for side in [at[axis] - body.radius, at[axis] + body.radius] {
                    for depth in [at.z - body.radius, at.z + body.radius] {
                        least = f64::min(least, middle + side / depth / pixel);
                        most = f64::max(most, middle + side / depth / pixel);
                    }
                }
            }
            let within = |at: f64| at.clamp(0.0, self.size[axis] as f64) as usize;
            within(least)..within(most.ceil())
        })
    }

    /// Whether two bodies may be in the same direction.
    fn overlap(&self, a: &Body<'_>, b: &Body<'_>) -> bool {
        let eye = self.pose.translation.vector;
        let [to_a, to_b] = [a, b].map(|body| body.pose.translation.vector - eye);
        let half = |body: &Body<'_>, to: &Vector3<f64>| {
            let share = body.radius / to.norm();
            (share < 1.0).then(|| share.asin())
        };
        match (half(a, &to_a), half(b, &to_b)) {
            (Some(first), Some(second)) => to_a.angle(&to_b) <= first + second,
            _ => true,
        }
    }

    /// The same eye at the same place with a point in the middle of a picture whose horizon is level.
    fn turned_to(&self, point: &Point3<f64>) -> Self {
        let from = Point3::from(self.pose.translation.vector);
        let forward = (point - from).normalize();
        let right = forward.cross(&Vector3::z()).normalize();
        let axes = Matrix3::from_columns(&[right, forward.cross(&right), forward]);
        let rotation = Rotation3::from_matrix_unchecked(axes);
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        Self {
            pose: Pose::from_parts(self.pose.translation, rotation),
            ..*self
        }
    }
}

/// Whether a ray comes into the ball around a body. Most of the time goes here, so it is written out.
fn near_ray(body: &Body<'_>, from: &Point3<f64>, along: &Vector3<f64>) -> bool {
    let to = [0, 1, 2].map(|i| body.middle[i] - from[i]);
    let way = [along[0], along[1], along[2]];
    let dot = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let ahead = dot(&to, &way);
    // By Pythagoras, both sides times the square of the direction's length.
    dot(&to, &to) * dot(&way, &way) - ahead * ahead <= body.radius * body.radius * dot(&way, &way)
}
