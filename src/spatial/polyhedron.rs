//! Bodies and surfaces made of triangles.

/// Triangles with shared corners; seen from outside, the corners of each are in counter-clockwise
/// order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyhedron {
    /// Corners (m), all finite.
    pub corners: Vec<[f64; 3]>,
    /// Triangles as indices into `corners`, all in range.
    pub triangles: Vec<[u32; 3]>,
}

impl Polyhedron {
    /// Smallest and largest coordinates (m) along x, y, z; `None` without corners.
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        let first = *self.corners.first()?;
        let mut bounds = [first, first];
        for corner in &self.corners {
            for axis in 0..3 {
                bounds[0][axis] = bounds[0][axis].min(corner[axis]);
                bounds[1][axis] = bounds[1][axis].max(corner[axis]);
            }
        }
        Some(bounds)
    }

    /// The corners of a triangle.
    pub fn triangle(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|i| self.corners.get(i as usize).copied().unwrap_or_default())
    }

    /// Radius (m) of the ball around the origin that holds all corners.
    pub fn bounding_radius(&self) -> f64 {
        let squares = self.corners.iter().map(|c| c.iter().map(|x| x * x).sum());
        squares.fold(0.0, f64::max).sqrt()
    }

    /// Whether the point (m) is in a convex body: behind all of its faces.
    pub fn convex_contains(&self, point: [f64; 3]) -> bool {
        self.triangles.iter().all(|triangle| {
            let [a, b, c] = self.triangle(*triangle);
            let [u, v, w] = [minus(b, a), minus(c, a), minus(point, a)];
            dot(cross(u, v), w) < 0.0
        })
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
