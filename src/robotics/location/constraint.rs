//! What a description demands of a point on a support, as functions of x and y in 0..1.

use crate::world::Extent;
use spatial::trig;

/// A direction in the frame of a link: front is -x, back +x, left +y, right -y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
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
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Front, Self::Back];

    /// Its name.
    pub fn name(self) -> &'static str {
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

/// A direction from something on a support, as seen by who stands at the edge that is nearest to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    /// To its left.
    LeftOf,
    /// To its right.
    RightOf,
    /// Nearer to the edge.
    InFrontOf,
    /// Farther from the edge.
    Behind,
}

impl Beside {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::LeftOf, Self::RightOf, Self::InFrontOf, Self::Behind];

    /// Its key.
    pub fn key(self) -> &'static str {
        match self {
            Self::LeftOf => "LEFT-OF",
            Self::RightOf => "RIGHT-OF",
            Self::InFrontOf => "IN-FRONT-OF",
            Self::Behind => "BEHIND",
        }
    }

    /// The unit vector in the frame of the extent for something at a point (m) of that frame. The
    /// long edges count as nearer in proportion to the lengths, as in CRAM.
    fn axis(self, extent: &Extent, [x, y]: [f64; 2]) -> [f64; 2] {
        let [length, width, _] = extent.size();
        let (along_x, along_y) = if width >= length {
            (1.0, width / length)
        } else {
            (length / width, 1.0)
        };
        // Gap, and what is behind something at that edge.
        let edges = [
            ((x - extent.min[0]) * along_x, [1.0, 0.0]),
            ((extent.max[0] - x) * along_x, [-1.0, 0.0]),
            ((extent.max[1] - y) * along_y, [0.0, -1.0]),
            ((y - extent.min[1]) * along_y, [0.0, 1.0]),
        ];
        let nearest = edges.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        let [bx, by] = nearest.map_or([1.0, 0.0], |(_, behind)| behind);
        match self {
            Self::Behind => [bx, by],
            Self::InFrontOf => [-bx, -by],
            Self::LeftOf => [-by, bx],
            Self::RightOf => [by, -bx],
        }
    }
}

/// One demand.
#[derive(Clone, Debug, PartialEq)]
pub enum Relation {
    /// The point is on that side of the link's origin.
    Side(Direction),
    /// It is no farther from the link's origin (m).
    Within(f64),
    /// It is no nearer to the link's origin (m).
    Beyond(f64),
    /// It is at least so far (m) from all edges.
    Padding(f64),
    /// It is beside something.
    Beside {
        /// Where that is (m, map frame).
        of: [f64; 2],
        /// On which side.
        side: Beside,
        /// Least cosine of the angle to that direction.
        threshold: f64,
    },
    /// It is around something, preferably near.
    Ring {
        /// Where that is (m, map frame).
        of: [f64; 2],
        /// Least and greatest distance (m).
        distances: [f64; 2],
    },
    /// It is in one of the slots around these points (m, frame of the link).
    Slots(Vec<[f64; 2]>),
}

/// Distance (m) from the middle of a slot up to which a point is in it.
const SLOT: f64 = 0.08;
/// Variance (m²) of the preference for what is near.
const NEARNESS: f64 = 1.0;

/// A demand as it was written, such as `(side left)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// The property as users write it.
    pub key: String,
    /// What it means.
    pub relation: Relation,
}

impl Constraint {
    /// Cheap and selective demands are evaluated first, as in CRAM.
    pub(super) fn score(&self) -> u32 {
        match self.relation {
            Relation::Within(_) | Relation::Beyond(_) => 2,
            Relation::Side(_) => 3,
            Relation::Padding(_) => 5,
            Relation::Slots(_) => 6,
            Relation::Ring { .. } => 7,
            Relation::Beside { .. } => 15,
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
            Relation::Slots(slots) => {
                let [x, y] = extent.local(point);
                let mut slots = slots.iter();
                slots.any(|slot| libm::hypot(x - slot[0], y - slot[1]) <= SLOT)
            }
            Relation::Ring { of, distances } => {
                let away = libm::hypot(point[0] - of[0], point[1] - of[1]);
                if !(distances[0]..=distances[1]).contains(&away) {
                    return 0.0;
                }
                return libm::exp(-away * away / (2.0 * NEARNESS));
            }
            Relation::Beside {
                of,
                side,
                threshold,
            } => {
                let (here, there) = (extent.local(point), extent.local(*of));
                let [x, y] = [here[0] - there[0], here[1] - there[1]];
                let [ax, ay] = side.axis(extent, there);
                let away = libm::hypot(x, y);
                let cosine = if away > 0.0 {
                    (x * ax + y * ay) / away
                } else {
                    0.0
                };
                return if cosine >= *threshold && cosine > 0.0 {
                    cosine
                } else {
                    0.0
                };
            }
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
    trig::wrap(spatial::pose::yaw(&extent.frame) + turn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use spatial::pose::from_xy_yaw;

    /// A board of 1 m by 2 m, turned by half a turn.
    fn board() -> Extent {
        Extent {
            frame: from_xy_yaw(0.0, 0.0, std::f64::consts::PI),
            min: [-0.5, -1.0, 0.0],
            max: [0.5, 1.0, 0.1],
        }
    }

    #[test]
    fn beside_is_as_seen_from_the_nearest_long_edge() {
        // In the frame of the board the thing is at (-0.4 0.9): near its front edge, which is long.
        let of = [0.4, -0.9];
        let value = |side, point| {
            let relation = Relation::Beside {
                of,
                side,
                threshold: 0.2,
            };
            let key = String::new();
            Constraint { key, relation }.value(&board(), point)
        };
        // For the front edge left is +y of the board, which is -y of the map, and behind is +x.
        assert_eq!(value(Beside::LeftOf, [0.4, -1.0]), 1.0);
        assert_eq!(value(Beside::RightOf, [0.4, -1.0]), 0.0);
        assert_eq!(value(Beside::RightOf, [0.4, 0.0]), 1.0);
        assert_eq!(value(Beside::Behind, [0.0, -0.9]), 1.0);
        assert_eq!(value(Beside::InFrontOf, [0.49, -0.9]), 1.0);
        let aslant = value(Beside::Behind, [0.3, -0.8]);
        assert!((aslant - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-9);
    }
}
