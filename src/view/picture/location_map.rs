//! The map of a symbolic location as signs in the scene: coloured cells where it may be, arrows for
//! the poses that have been offered.

use std::sync::Arc;

use nalgebra::Point3;

use super::scene::{Body, Finish, Kind, Owner, Scene};
use super::surface::Surface;
use spatial::Pose;

/// Height (m) of the cells and of the arrows above what they are on.
const CELL_HEIGHT: f64 = 0.004;
const ARROW_HEIGHT: f64 = 0.008;

/// Linear colours of the cells, from the least value to the greatest.
const COLORS: [[f32; 4]; 6] = [
    [0.02, 0.05, 0.55, 0.65],
    [0.02, 0.30, 0.55, 0.65],
    [0.03, 0.45, 0.12, 0.65],
    [0.55, 0.50, 0.03, 0.65],
    [0.70, 0.22, 0.02, 0.65],
    [0.70, 0.03, 0.02, 0.65],
];
/// Linear colours of the poses offered before, and of the one offered last.
const OFFERED: [f32; 4] = [0.85, 0.85, 0.85, 1.0];
const CHOSEN: [f32; 4] = [0.65, 0.02, 0.55, 1.0];

/// Where a location may be, and which poses have been offered.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LocationMap {
    /// Edge length (m) of a cell.
    pub resolution: f64,
    /// Centres (m) of the cells in the map frame, with their values in 0..1.
    pub cells: Vec<([f64; 2], f64)>,
    /// Height (m) of the cells.
    pub height: f64,
    /// The poses offered, the last one last.
    pub offered: Vec<Pose>,
    /// Length (m) of the arrows.
    pub arrow: f64,
}

impl Scene {
    /// Adds the map of a location.
    pub fn add_location_map(&mut self, map: &LocationMap) {
        let most = map.cells.iter().map(|(_, v)| *v).fold(0.0, f64::max);
        for (i, color) in COLORS.iter().enumerate() {
            let mut surface = Surface::default();
            for ([x, y], value) in &map.cells {
                if rank(*value, most) == i {
                    let half = map.resolution / 2.0;
                    let at = |dx: f64, dy: f64| [x + dx * half, y + dy * half];
                    let corners = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
                    surface.add_flat(&corners, map.height + CELL_HEIGHT);
                }
            }
            self.add_sign("location map", surface, *color);
        }
        let (mut before, mut last) = (Surface::default(), Surface::default());
        for (i, pose) in map.offered.iter().enumerate() {
            let is_last = i + 1 == map.offered.len();
            let surface = if is_last { &mut last } else { &mut before };
            let corners = [[-0.5, 0.25], [-0.3, 0.0], [-0.5, -0.25], [0.5, 0.0]];
            let corners = corners.map(|[x, y]| {
                let p = pose * Point3::new(x * map.arrow, y * map.arrow, 0.0);
                [p.x, p.y]
            });
            // Seen from above, the corners are to be passed counter-clockwise.
            let [a, b, c, d] = corners;
            surface.add_flat(&[b, c, d, a], map.height + ARROW_HEIGHT);
        }
        self.add_sign("offered poses", before, OFFERED);
        self.add_sign("chosen pose", last, CHOSEN);
    }

    fn add_sign(&mut self, name: &str, surface: Surface, color: [f32; 4]) {
        if surface.triangles.is_empty() {
            return;
        }
        self.bodies.push(Body {
            owner: Owner::new(Kind::Sign, name),
            surface: Arc::new(surface),
            pose: Pose::identity(),
            color,
            finish: Finish::Matt,
        });
    }
}

/// The place of a value among the colours.
fn rank(value: f64, most: f64) -> usize {
    let share = if most > 0.0 { value / most } else { 0.0 };
    // The cast saturates.
    ((share * COLORS.len() as f64) as usize).min(COLORS.len() - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use spatial::pose::from_xy_yaw;

    #[test]
    fn cells_get_colours_by_value_and_the_last_pose_its_own() {
        let map = LocationMap {
            resolution: 0.1,
            cells: vec![([0.0, 0.0], 0.01), ([0.1, 0.0], 0.5), ([0.2, 0.0], 0.5)],
            height: 0.7,
            offered: vec![from_xy_yaw(0.0, 0.0, 0.0), from_xy_yaw(0.1, 0.0, 1.0)],
            arrow: 0.1,
        };
        let mut scene = Scene::default();
        scene.add_location_map(&map);
        let colors: Vec<_> = scene.bodies.iter().map(|b| b.color).collect();
        assert_eq!(colors, [COLORS[0], COLORS[5], OFFERED, CHOSEN]);
        assert_eq!(scene.bodies[1].surface.triangles.len(), 4);
        for body in &scene.bodies {
            for triangle in &body.surface.triangles {
                let [a, b, c] = triangle.map(|i| body.surface.corners[i as usize].point);
                assert!((b - a).cross(&(c - a)).z > 0.0, "seen from above");
            }
        }
    }
}
