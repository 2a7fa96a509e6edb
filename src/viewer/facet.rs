//! The scene as one list of triangles in the map frame.

use nalgebra::Vector3;

use super::scene::{Finish, Scene};

/// A triangle of a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    /// Corners (m, map frame), counter-clockwise seen from outside.
    pub(super) points: [Vector3<f64>; 3],
    /// Unit normals at the corners.
    pub(super) normals: [Vector3<f64>; 3],
    /// Place of its body in the scene.
    pub(super) body: usize,
}

impl Facet {
    /// Away from the solid, not of unit length.
    pub(super) fn outward(&self) -> Vector3<f64> {
        let [a, b, c] = self.points;
        (b - a).cross(&(c - a))
    }
}

/// All triangles, in the order of the scene, and how many of them, at the front, are floor.
pub(super) struct Facets {
    pub(super) all: Vec<Facet>,
    floor: usize,
}

impl Facets {
    pub(super) fn of(scene: &Scene) -> Self {
        let bodies = || scene.bodies.iter().enumerate();
        let is_floor = |finish: Finish| finish == Finish::Boards;
        let mut all = Vec::new();
        let mut points = Vec::new();
        let mut add = |(place, body): (usize, &super::scene::Body)| {
            points.clear();
            points.extend(body.surface.corners.iter().map(|corner| {
                let point = body.pose.transform_point(&corner.point).coords;
                (point, body.pose.rotation * corner.normal)
            }));
            all.extend(body.surface.triangles.iter().filter_map(|triangle| {
                // A triangle that names a corner that there is not is left out.
                let [a, b, c] = triangle.map(|i| points.get(i as usize).copied());
                let (a, b, c) = (a?, b?, c?);
                Some(Facet {
                    points: [a.0, b.0, c.0],
                    normals: [a.1, b.1, c.1],
                    body: place,
                })
            }));
            all.len()
        };
        let mut floor = 0;
        for found in bodies().filter(|(_, b)| is_floor(b.finish)) {
            floor = add(found);
        }
        for found in bodies().filter(|(_, b)| !is_floor(b.finish)) {
            add(found);
        }
        Self { all, floor }
    }

    /// The triangles that cast shadows.
    pub(super) fn solid(&self) -> &[Facet] {
        // The floor is a part of all.
        &self.all[self.floor..]
    }
}
