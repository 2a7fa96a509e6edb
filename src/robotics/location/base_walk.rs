//! The base poses around a target that are tried, one after another: those of a lattice of points and
//! headings, then those between them.

use std::f64::consts::TAU;

use super::base_query::BaseQuery;
use super::draw::Draw;
use spatial::{Pose, pose, trig};

/// Number of headings that are tried at a place, besides the one to the target.
const HEADINGS: u32 = 24;

/// By what parts of a cell the points of the lattices are shifted along x and y, and by what parts of a
/// step their headings. The second lattice has its poses in the middle between those of the first.
const LATTICES: [(f64, f64); 4] = [(0.0, 0.0), (0.5, 0.5), (0.0, 0.5), (0.5, 0.0)];

/// The base poses of a lattice, in the order in which they are tried.
pub(super) struct Walk {
    /// Where the target is (m, map frame).
    target: [f64; 2],
    /// Which of the lattices.
    lattice: usize,
    /// The points (m), with how good they are.
    cells: Vec<([f64; 2], f64)>,
    /// The points in the order of this round, as indices.
    order: Vec<usize>,
    next: usize,
    /// Which heading is tried: 0 for the one to the target, then others, the nearest first.
    turn: u32,
}

impl Walk {
    /// Over the first lattice, with points (m) and how good they are.
    pub(super) fn first(query: &BaseQuery, cells: Vec<([f64; 2], f64)>, draw: &mut Draw) -> Self {
        let t = query.target.pose.translation;
        Self::over([t.x, t.y], 0, cells, draw)
    }

    /// Whether it goes over the first lattice.
    pub(super) fn is_first(&self) -> bool {
        self.lattice == 0
    }

    /// Over the next lattice, if there is one, whose points are those of the first shifted by a part of
    /// a cell.
    pub(super) fn between(
        &self,
        draw: &mut Draw,
        cells: impl Fn(f64) -> Vec<([f64; 2], f64)>,
    ) -> Option<Self> {
        let lattice = self.lattice + 1;
        let (shift, _) = LATTICES.get(lattice)?;
        Some(Self::over(self.target, lattice, cells(*shift), draw))
    }

    fn over(
        target: [f64; 2],
        lattice: usize,
        cells: Vec<([f64; 2], f64)>,
        draw: &mut Draw,
    ) -> Self {
        Self {
            target,
            lattice,
            order: draw.order(cells.iter().map(|(_, value)| *value)),
            cells,
            next: 0,
            turn: 0,
        }
    }

    /// The next pose, if any is left.
    pub(super) fn next(&mut self, draw: &mut Draw) -> Option<Pose> {
        while self.next == self.order.len() {
            if self.turn == HEADINGS || self.cells.is_empty() {
                return None;
            }
            self.turn += 1;
            self.order = draw.order(self.cells.iter().map(|(_, value)| *value));
            self.next = 0;
        }
        // The order consists of indices of this list.
        let (point, _) = self.cells[self.order[self.next]];
        self.next += 1;
        let (_, turned) = LATTICES[self.lattice];
        Some(heading_to(self.target, point, self.turn, turned))
    }
}

/// The base pose at a point (m) with one of the headings of a lattice, which are turned by a part of a
/// step.
fn heading_to(target: [f64; 2], [x, y]: [f64; 2], turn: u32, turned: f64) -> Pose {
    let ahead = trig::atan2(target[1] - y, target[0] - x);
    if turn == 0 {
        return pose::from_xy_yaw(x, y, ahead);
    }
    let step = TAU / f64::from(HEADINGS);
    let nearest = (ahead / step - turned).round() + turned;
    let side = if nearest * step > ahead { -1.0 } else { 1.0 };
    // 0, 1, -1, 2, -2 … steps, beginning on the side of the exact heading.
    let by = f64::from(turn / 2) * if turn.is_multiple_of(2) { side } else { -side };
    pose::from_xy_yaw(x, y, trig::wrap((nearest + by) * step))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_heading_of_the_lattices_is_tried_once() {
        for (turned, first) in [(0.0, [1, 2, 0]), (0.5, [1, 0, 2])] {
            let yaws = (1..=HEADINGS)
                .map(|turn| pose::yaw(&heading_to([1.0, 0.3], [0.0, 0.0], turn, turned)));
            let mut steps: Vec<i32> = yaws
                .map(|yaw| ((yaw / (TAU / 24.0) - turned).round() as i32).rem_euclid(24))
                .collect();
            assert_eq!(&steps[..3], first, "turned by {turned}");
            steps.sort_unstable();
            assert!(steps.into_iter().eq(0..24));
        }
    }

    #[test]
    fn all_lattices_are_walked_over() {
        let cells = |shift: f64| vec![([1.0 + shift, 2.0], 1.0), ([2.0, 2.0 + shift], 0.5)];
        let mut draw = Draw::new(1);
        let mut walk = Walk::over([0.0, 0.0], 0, cells(0.0), &mut draw);
        let mut counts = Vec::new();
        loop {
            let mut count = 0;
            while walk.next(&mut draw).is_some() {
                count += 1;
            }
            counts.push(count);
            match walk.between(&mut draw, cells) {
                Some(between) => walk = between,
                None => break,
            }
        }
        assert_eq!(counts, [2 * (HEADINGS + 1); 4]);
    }
}
