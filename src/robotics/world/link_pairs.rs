//! Pairs of the robot's solid links, in a form in which those near each other are found fast.
//!
//! Links with neighbouring numbers are close together on the robot. So they are taken in blocks,
//! and a link is compared with the bounds of a block before it is with the links of that block.

use std::ops::Range;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

/// Number of links of a block.
pub(super) const BLOCK: usize = 8;

/// Pairs of indices of solid links, the smaller one first, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinkPairs {
    pairs: Vec<(usize, usize)>,
    /// The pairs of one link with those of one block: the link, the block, and their places.
    runs: Vec<(usize, usize, Range<usize>)>,
}

impl LinkPairs {
    /// The pairs, which are in order.
    pub(crate) fn new(pairs: Vec<(usize, usize)>) -> Self {
        let mut runs: Vec<(usize, usize, Range<usize>)> = Vec::new();
        for (place, (a, b)) in pairs.iter().enumerate() {
            match runs.last_mut() {
                Some((link, block, run)) if link == a && *block == b / BLOCK => run.end += 1,
                _ => runs.push((*a, b / BLOCK, place..place + 1)),
            }
        }
        Self { pairs, runs }
    }

    /// The pairs for which the condition holds.
    pub(crate) fn filtered(&self, is_wanted: impl Fn(usize, usize) -> bool) -> Self {
        let wanted = self.pairs.iter().copied();
        Self::new(wanted.filter(|(a, b)| is_wanted(*a, *b)).collect())
    }

    /// Whether the pair, the smaller index first, is one of them.
    pub(crate) fn contains(&self, pair: (usize, usize)) -> bool {
        self.pairs.binary_search(&pair).is_ok()
    }

    /// Appends the pairs whose bounds (m) are no farther apart than the gap (m), in order, given
    /// the bounds of all links and of each of their blocks ([`blocks_of`]).
    pub(crate) fn near(
        &self,
        bounds: &[Aabb],
        blocks: &[Aabb],
        gap: f64,
        near: &mut Vec<(usize, usize)>,
    ) {
        for (a, block, run) in &self.runs {
            let (Some(one), Some(all)) = (bounds.get(*a), blocks.get(*block)) else {
                continue;
            };
            let one = one.loosened(gap);
            if !meet(&one, all) {
                continue;
            }
            // The runs are places in this list.
            for &(a, b) in &self.pairs[run.clone()] {
                if bounds.get(b).is_some_and(|other| meet(&one, other)) {
                    near.push((a, b));
                }
            }
        }
    }
}

/// The bounds of each block of links.
pub(crate) fn blocks_of(bounds: &[Aabb]) -> impl Iterator<Item = Aabb> {
    let blocks = bounds.chunks(BLOCK);
    blocks.filter_map(|block| block.iter().copied().reduce(|all, one| all.merged(&one)))
}

/// Whether the two have a point in common. One branch for all six comparisons: which of them fails
/// cannot be foreseen.
#[inline]
pub(crate) fn meet(one: &Aabb, other: &Aabb) -> bool {
    (one.mins.x <= other.maxs.x)
        & (one.maxs.x >= other.mins.x)
        & (one.mins.y <= other.maxs.y)
        & (one.maxs.y >= other.mins.y)
        & (one.mins.z <= other.maxs.z)
        & (one.maxs.z >= other.mins.z)
}

#[cfg(test)]
mod tests {
    use parry3d_f64::math::Vector;
    use proptest::prelude::*;

    use super::*;

    fn bounds() -> impl Strategy<Value = Aabb> {
        let number = || -1.0f64..1.0;
        let size = || 0.0f64..0.5;
        let place = (number(), number(), number());
        (place, (size(), size(), size())).prop_map(|((x, y, z), (a, b, c))| {
            let low = Vector::new(x, y, z);
            Aabb::new(low, low + Vector::new(a, b, c))
        })
    }

    proptest! {
        #[test]
        fn the_near_pairs_are_those_that_comparing_all_finds(
            bounds in proptest::collection::vec(bounds(), 2..40),
            gap in 0.0f64..0.3,
            kept in 1usize..4,
        ) {
            let all = (0..bounds.len()).flat_map(|a| (a + 1..bounds.len()).map(move |b| (a, b)));
            let all: Vec<_> = all.filter(|(a, b)| (a + b) % kept == 0).collect();
            let is_near = |(a, b): &(usize, usize)| meet(&bounds[*a].loosened(gap), &bounds[*b]);
            let expected: Vec<_> = all.iter().copied().filter(is_near).collect();
            let blocks: Vec<_> = blocks_of(&bounds).collect();
            let mut near = Vec::new();
            LinkPairs::new(all).near(&bounds, &blocks, gap, &mut near);
            prop_assert_eq!(near, expected);
        }
    }
}
