//! Surfaces of the built-in kitchen, for random worlds.

/// A surface: the name of its link, the corners of its top, and its height (m).
pub(super) struct Surface {
    pub(super) name: &'static str,
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
    pub(super) height: f64,
}

/// Those on which things are taken and put in random worlds.
pub(super) const SURFACES: [Surface; 3] = [
    Surface {
        name: "table-area-main",
        low: [-2.2, -1.45],
        high: [-0.6, -0.65],
        height: 0.72,
    },
    Surface {
        name: "kitchen-island-surface",
        low: [-1.467, 0.494],
        high: [-0.667, 2.944],
        height: 0.861,
    },
    Surface {
        name: "sink-area-surface",
        low: [1.248, -0.285],
        high: [1.822, 1.315],
        height: 0.854,
    },
];
