//! What overlaps in a layout as it was published.

use super::fixture::{Fixture, Kind};

/// How many pairs are named.
const NAMED: usize = 4;

/// A solid box of a fixture, seen in the room.
pub(super) struct Solid {
    /// The number of the fixture.
    pub(super) fixture: usize,
    /// Its corners (m).
    pub(super) low: [f64; 3],
    pub(super) high: [f64; 3],
}

/// Which fixtures overlap by more than a millimetre, in words.
pub(super) fn overlaps(solids: &[Solid], fixtures: &[Fixture]) -> Option<String> {
    let mut of_each: Vec<Vec<&Solid>> = vec![Vec::new(); fixtures.len()];
    for solid in solids {
        of_each[solid.fixture].push(solid);
    }
    let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
    for one in 0..fixtures.len() {
        for other in one + 1..fixtures.len() {
            let both = of_each[one]
                .iter()
                .flat_map(|a| of_each[other].iter().map(move |b| (a, b)));
            let depths = both.map(|(a, b)| {
                let depths = [0, 1, 2].map(|i| a.high[i].min(b.high[i]) - a.low[i].max(b.low[i]));
                depths.into_iter().fold(f64::INFINITY, f64::min)
            });
            let deepest = depths.fold(0.0, f64::max);
            if deepest > 1e-3 {
                pairs.push((deepest, [one, other]));
            }
        }
    }
    let is_wall = |number: usize| matches!(fixtures[number].kind, Kind::Wall { .. });
    pairs.retain(|(_, pair)| !pair.iter().all(|number| is_wall(*number)));
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let named = pairs.iter().take(NAMED).map(|(depth, [one, other])| {
        let [one, other] = [*one, *other].map(|number| fixtures[number].name.as_str());
        format!("{one} and {other} by {:.0} mm", depth * 1e3)
    });
    let named: Vec<String> = named.collect();
    let rest = pairs.len().saturating_sub(NAMED);
    match (pairs.len(), rest) {
        (0, _) => None,
        (_, 0) => Some(format!(
            "as published, furniture overlaps: {}",
            named.join(", ")
        )),
        _ => Some(format!(
            "as published, furniture overlaps: {}, and {rest} other pairs",
            named.join(", ")
        )),
    }
}
