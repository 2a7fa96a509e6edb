//! The poses that have been offered, so that none is offered again.

use std::collections::BTreeMap;

use spatial::Pose;
use spatial::pose::angle_between;

/// Two poses that are no farther apart than this (m) and no more turned than this (rad) count as
/// the same.
const SAME_PLACE: f64 = 0.05;
const SAME_TURN: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// The poses by where on the floor they are.
#[derive(Clone, Debug, Default)]
pub(super) struct Offered {
    cells: BTreeMap<[i64; 2], Vec<Pose>>,
    count: usize,
}

impl Offered {
    /// Number of poses.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// All poses, cell by cell.
    pub(super) fn all(&self) -> impl Iterator<Item = &Pose> {
        self.cells.values().flatten()
    }

    fn cell(pose: &Pose) -> [i64; 2] {
        let t = pose.translation;
        // The cast saturates.
        [t.x, t.y].map(|v| (v / SAME_PLACE).floor() as i64)
    }

    /// Whether such a pose has been offered.
    pub(super) fn has(&self, pose: &Pose) -> bool {
        let [i, j] = Self::cell(pose);
        let around = (-1..=1).flat_map(|di| (-1..=1).map(move |dj| (di, dj)));
        let mut near = around.filter_map(|(di, dj)| {
            let cell = [i.saturating_add(di), j.saturating_add(dj)];
            self.cells.get(&cell)
        });
        near.any(|poses| {
            poses.iter().any(|other| {
                let way = (other.translation.vector - pose.translation.vector).xy();
                way.norm() <= SAME_PLACE + 1e-9 && angle_between(other, pose) <= SAME_TURN + 1e-9
            })
        })
    }

    /// Remembers a pose.
    pub(super) fn add(&mut self, pose: Pose) {
        self.cells.entry(Self::cell(&pose)).or_default().push(pose);
        self.count += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spatial::pose::from_xy_yaw;

    #[test]
    fn a_pose_near_an_offered_one_counts_as_offered() {
        let mut offered = Offered::default();
        offered.add(from_xy_yaw(1.0, 1.0, 3.1));
        assert!(offered.has(&from_xy_yaw(1.04, 0.98, -3.1)));
        assert!(!offered.has(&from_xy_yaw(1.06, 1.0, 3.1)));
        assert!(!offered.has(&from_xy_yaw(1.0, 1.0, 2.9)));
    }
}
