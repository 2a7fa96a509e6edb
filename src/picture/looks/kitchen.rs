//! What the kitchen's model omits: the rings of the stove. They are purely visual.

use super::look::Look;
use crate::picture::loft::Along;

/// Linear colour of the rings, which hardly stand out from the glass.
const RING: [f32; 4] = [0.16, 0.16, 0.165, 1.0];

/// Centre (m, in the stove's frame) and radius (m) of each ring; the glass ends at 2 mm.
const RINGS: [([f64; 2], f64); 4] = [
    ([-0.115, -0.14], 0.075),
    ([0.12, -0.14], 0.10),
    ([-0.115, 0.14], 0.10),
    ([0.12, 0.14], 0.075),
];
const TOP: f64 = 0.0023;
const WIDTH: f64 = 0.005;

/// What a link shows in addition to its model.
pub(crate) fn extras_of(link: &str) -> Vec<Look> {
    if link != "kitchen_island_stove" {
        return Vec::new();
    }
    let ring = |(middle, radius): ([f64; 2], f64)| {
        let line = [[radius, TOP], [radius - WIDTH, TOP]];
        Look::turned(Along::Z, &line, middle, RING)
    };
    RINGS.into_iter().map(ring).collect()
}
