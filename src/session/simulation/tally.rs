//! What a run of a plan costs: counted for sweeps.

use indexmap::IndexMap;

/// What has happened since a plan was begun.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// Simulated time (s) at which it was begun.
    pub began: f64,
    /// How long (s) it took, once it has ended.
    pub took: Option<f64>,
    /// How far (m) the base has moved.
    pub distance: f64,
    /// How many motions have failed, by class.
    pub failures: IndexMap<&'static str, u64>,
    /// The base's last position (m) in the map.
    at: Option<[f64; 2]>,
}

impl Tally {
    /// A plan begins at that time (s).
    pub(crate) fn beginning(now: f64) -> Self {
        Self {
            began: now,
            ..Self::default()
        }
    }

    /// The base is at a place (m).
    pub(crate) fn base_at(&mut self, [x, y]: [f64; 2]) {
        if let Some([x0, y0]) = self.at.replace([x, y])
            && self.took.is_none()
        {
            self.distance += ((x - x0) * (x - x0) + (y - y0) * (y - y0)).sqrt();
        }
    }

    /// A motion has failed with a failure of that class.
    pub(crate) fn failed(&mut self, class: &'static str) {
        if self.took.is_none() {
            *self.failures.entry(class).or_default() += 1;
        }
    }
}
