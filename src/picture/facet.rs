//! The scene as one list of triangles in the map frame.

use nalgebra::Vector3;

use super::scene::{Body, Finish, Kind, Scene};

/// A triangle of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    /// Corners (m, map frame), counter-clockwise seen from outside.
    pub(crate) points: [Vector3<f64>; 3],
    /// Unit normals at the corners.
    pub(crate) normals: [Vector3<f64>; 3],
    /// Unit vector away from the solid.
    pub(crate) outward: Vector3<f64>,
    /// Index of its body in the scene.
    pub(crate) body: usize,
}

impl Facet {
    /// A triangle; `None` if it has no area.
    pub(crate) fn new(
        points: [Vector3<f64>; 3],
        normals: [Vector3<f64>; 3],
        body: usize,
    ) -> Option<Self> {
        let [a, b, c] = points;
        Some(Self {
            points,
            normals,
            outward: (b - a).cross(&(c - a)).try_normalize(1e-15)?,
            body,
        })
    }
}

/// Bodies that are shorter (m) than this, or thin, do not block light from the sky.
const SHORT: f64 = 0.08;
const THIN: f64 = 0.03;

/// The same for the robot's parts, which are many and close together.
const SHORT_PART: f64 = 0.17;

/// All triangles, sorted by how they block light: those of the floor, which blocks none, of
/// small bodies, and of the others, each group in the order of the scene.
pub(crate) struct Facets {
    pub(crate) all: Vec<Facet>,
    /// Indices at which small and large bodies start.
    starts: [usize; 2],
}

impl Facets {
    pub(crate) fn of(scene: &Scene) -> Self {
        let rank = |body: &Body| match body.finish {
            Finish::Boards => 0,
            _ if is_small(body) => 1,
            _ => 2,
        };
        let ranks: Vec<_> = scene.bodies.iter().map(rank).collect();
        let count = scene.bodies.iter().map(|b| b.surface.triangles.len()).sum();
        let mut all = Vec::with_capacity(count);
        let mut points = Vec::new();
        let starts = [0, 1, 2].map(|rank| {
            let start = all.len();
            let bodies = scene.bodies.iter().zip(&ranks).enumerate();
            for (place, (body, _)) in bodies.filter(|(_, (_, r))| **r == rank) {
                add(body, place, &mut points, &mut all);
            }
            start
        });
        Self {
            all,
            starts: [starts[1], starts[2]],
        }
    }

    /// The triangles that cast shadows.
    pub(crate) fn solid(&self) -> &[Facet] {
        // The start is a valid index.
        &self.all[self.starts[0]..]
    }

    /// The triangles that block light from the sky.
    pub(crate) fn large(&self) -> &[Facet] {
        // The start is a valid index.
        &self.all[self.starts[1]..]
    }
}

/// Whether a body blocks hardly any light from the sky.
fn is_small(body: &Body) -> bool {
    let points = || {
        body.surface
            .corners
            .iter()
            .map(|corner| corner.point.coords)
    };
    let Some(first) = points().next() else {
        return true;
    };
    let low = points().fold(first, |low, point| low.inf(&point));
    let high = points().fold(first, |high, point| high.sup(&point));
    let mut sizes = <[f64; 3]>::from(high - low);
    sizes.sort_by(f64::total_cmp);
    let short = match body.owner.kind {
        Kind::Robot => SHORT_PART,
        _ => SHORT,
    };
    sizes[2] < short || sizes[1] < THIN
}

fn add(
    body: &Body,
    place: usize,
    points: &mut Vec<(Vector3<f64>, Vector3<f64>)>,
    all: &mut Vec<Facet>,
) {
    points.clear();
    points.extend(body.surface.corners.iter().map(|corner| {
        let point = body.pose.transform_point(&corner.point).coords;
        (point, body.pose.rotation * corner.normal)
    }));
    all.extend(body.surface.triangles.iter().filter_map(|triangle| {
        // A triangle with an index that is out of range is omitted.
        let [a, b, c] = triangle.map(|i| points.get(i as usize).copied());
        let (a, b, c) = (a?, b?, c?);
        Facet::new([a.0, b.0, c.0], [a.1, b.1, c.1], place)
    }));
}
