//! The scene as one list of triangles in the map frame.

use nalgebra::Vector3;

use super::scene::{Body, Finish, Kind, Scene};

/// A corner of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    /// Position (m, map frame).
    pub point: Vector3<f64>,
    /// Unit vector away from the solid, for shading.
    pub normal: Vector3<f64>,
}

/// A triangle of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    /// Indices of its corners, counter-clockwise seen from outside.
    pub corners: [u32; 3],
    /// Index of its body in the scene.
    pub body: usize,
}

/// Bodies that are shorter (m) than this, or thin, do not block light from the sky.
const SHORT: f64 = 0.08;
const THIN: f64 = 0.03;

/// The same for the robot's parts, which are many and close together.
const SHORT_PART: f64 = 0.17;

/// Triangles and their corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mesh<'a> {
    /// The corners.
    pub corners: &'a [Corner],
    /// The triangles, whose corners are all among these.
    pub(crate) facets: &'a [Facet],
    /// Index of the first corner that belongs to them; those before it are others'.
    pub first: usize,
}

/// All triangles, sorted by how they block light: those of the floor, which blocks none, of
/// small bodies, and of the others, each group in the order of the scene.
pub(crate) struct Facets {
    corners: Vec<Corner>,
    facets: Vec<Facet>,
    /// Indices of the corner and the triangle at which each group starts.
    starts: [[usize; 2]; 3],
}

impl Facets {
    pub(crate) fn of(scene: &Scene) -> Self {
        let rank = |body: &Body| match body.finish {
            Finish::Boards => 0,
            _ if is_small(body) => 1,
            _ => 2,
        };
        let ranks: Vec<_> = scene.bodies.iter().map(rank).collect();
        let surfaces = || scene.bodies.iter().map(|body| &body.surface);
        let mut corners = Vec::with_capacity(surfaces().map(|s| s.corners.len()).sum());
        let mut facets = Vec::with_capacity(surfaces().map(|s| s.triangles.len()).sum());
        let starts = [0, 1, 2].map(|rank| {
            let start = [corners.len(), facets.len()];
            let bodies = scene.bodies.iter().zip(&ranks).enumerate();
            for (place, (body, _)) in bodies.filter(|(_, (_, r))| **r == rank) {
                add(body, place, &mut corners, &mut facets);
            }
            start
        });
        Self {
            corners,
            facets,
            starts,
        }
    }

    /// All triangles.
    pub(crate) fn all(&self) -> Mesh<'_> {
        self.from(0)
    }

    /// The triangles that cast shadows.
    pub(crate) fn solid(&self) -> Mesh<'_> {
        self.from(1)
    }

    /// The triangles that block light from the sky.
    pub(crate) fn large(&self) -> Mesh<'_> {
        self.from(2)
    }

    /// The triangles of a group and those after it.
    fn from(&self, group: usize) -> Mesh<'_> {
        let [first, facet] = self.starts[group];
        Mesh {
            corners: &self.corners,
            // The start is a valid index.
            facets: &self.facets[facet..],
            first,
        }
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

/// Adds a body's corners and triangles.
fn add(body: &Body, place: usize, corners: &mut Vec<Corner>, facets: &mut Vec<Facet>) {
    // A scene of four billion corners does not fit into memory.
    let first = u32::try_from(corners.len()).unwrap_or(u32::MAX);
    let count = u32::try_from(body.surface.corners.len()).unwrap_or(0);
    let rotation = body.pose.rotation.to_rotation_matrix();
    let offset = body.pose.translation.vector;
    corners.extend(body.surface.corners.iter().map(|corner| Corner {
        point: rotation * corner.point.coords + offset,
        normal: rotation * corner.normal,
    }));
    // A triangle with an index that is out of range is omitted.
    let triangles = body.surface.triangles.iter();
    let triangles = triangles.filter(|triangle| triangle.iter().all(|i| *i < count));
    facets.extend(triangles.map(|triangle| Facet {
        corners: triangle.map(|i| first.saturating_add(i)),
        body: place,
    }));
}
