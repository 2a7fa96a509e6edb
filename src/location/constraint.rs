//! What a description demands of a point on a support, as functions of x and y in 0..1.

use crate::spatial::trig;
use crate::world::Extent;

/// A direction in the frame of a link: front is -x, back +x, left +y, right -y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    /// -x.
    Front,
    /// +x.
    Back,
    /// +y.
    Left,
    /// -y.
    Right,
}

impl Direction {
    /// All directions.
    pub(crate) const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Front, Self::Back];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// The unit vector in the frame of the link.
    pub(super) fn vector(self) -> [f64; 2] {
        match self {
            Self::Front => [-1.0, 0.0],
            Self::Back => [1.0, 0.0],
            Self::Left => [0.0, 1.0],
            Self::Right => [0.0, -1.0],
        }
    }
}

/// One demand.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Relation {
    /// The point is on that side of the link's origin.
    Side(Direction),
    /// It is no farther from the link's origin (m).
    Within(f64),
    /// It is no nearer to the link's origin (m).
    Beyond(f64),
    /// It is at least so far (m) from all edges.
    Padding(f64),
}

/// A demand as it was written, such as `(side left)`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Constraint {
    /// The property as users write it.
    pub(crate) key: String,
    /// What it means.
    pub(crate) relation: Relation,
}

impl Constraint {
    /// Cheap and selective demands are evaluated first, as in CRAM.
    pub(super) fn score(&self) -> u32 {
        match self.relation {
            Relation::Within(_) | Relation::Beyond(_) => 2,
            Relation::Side(_) => 3,
            Relation::Padding(_) => 5,
        }
    }

    /// How well the point (m, map frame) fulfils the demand on that support.
    pub(super) fn value(&self, extent: &Extent, point: [f64; 2]) -> f64 {
        let t = extent.frame.translation;
        let distance = || libm::hypot(point[0] - t.x, point[1] - t.y);
        let is_fulfilled = match &self.relation {
            Relation::Side(direction) => {
                let [x, y] = extent.local(point);
                let [dx, dy] = direction.vector();
                x * dx + y * dy >= 0.0
            }
            Relation::Within(range) => distance() <= *range,
            Relation::Beyond(range) => distance() >= *range,
            Relation::Padding(padding) => inset(extent, extent.local(point)) >= *padding,
        };
        f64::from(u8::from(is_fulfilled))
    }
}

/// How far (m) the point in the frame of the extent is inside its edges; negative outside.
pub(super) fn inset(extent: &Extent, [x, y]: [f64; 2]) -> f64 {
    let gaps = [
        x - extent.min[0],
        extent.max[0] - x,
        y - extent.min[1],
        extent.max[1] - y,
    ];
    gaps.into_iter().fold(f64::INFINITY, f64::min)
}

/// The heading (rad) in the map perpendicular to the edge that is nearest to the point (m): for the
/// front edge that of the support itself, for the back edge the opposite.
pub(super) fn edge_heading(extent: &Extent, point: [f64; 2]) -> f64 {
    use std::f64::consts::{FRAC_PI_2, PI};
    let [x, y] = extent.local(point);
    let gaps = [
        (x - extent.min[0], 0.0),
        (extent.max[0] - x, PI),
        (extent.max[1] - y, -FRAC_PI_2),
        (y - extent.min[1], FRAC_PI_2),
    ];
    let nearest = gaps.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    let turn = nearest.map_or(0.0, |(_, turn)| turn);
    trig::wrap(crate::spatial::pose::yaw(&extent.frame) + turn)
}
