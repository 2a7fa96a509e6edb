//! What stands on the counters of a layout: appliances and the like, each in a region of its counter.

use super::LayoutError;
use super::fixture::{Counter, Fixture, Kind, snapped, turned};
use super::layout::{Reader, plain};
use super::node::Node;

impl Reader {
    /// Puts something onto a counter; `false` if there is no such counter, or no room on it.
    pub(super) fn put_on_counter(&mut self, group: &str, node: &Node) -> Result<bool, LayoutError> {
        let Some(placement) = node.get("placement") else {
            return Ok(false);
        };
        let name = node
            .get("name")
            .map_or(Ok(""), |name| name.text("a name"))?;
        let kind = node
            .get("type")
            .map_or(Ok(""), |kind| kind.text("a type"))?;
        let size = self.size(kind, group, node)?;
        let Some(below) = placement.get("fixture").filter(|below| !below.is_null()) else {
            return Ok(false);
        };
        let text = below.text("the fixture of a placement")?;
        let fixtures = self.layout.fixtures.iter();
        let mut counters = fixtures.filter(|one| matches!(one.kind, Kind::Counter(_)));
        let Some(counter) = counters.find(|counter| counter.name == plain(text)) else {
            return Ok(false);
        };
        let rotation = placement.get("rotation").filter(|one| !one.is_null());
        let rotation = match rotation.map(|one| one.items("a rotation")).transpose()? {
            Some([low, .., high]) => (low.number("a rotation")? + high.number("a rotation")?) / 2.0,
            _ => 0.0,
        };
        let name = format!("{name}_{group}");
        let mut fixture = Fixture::new(name, Kind::Solid, size, [0.0; 3], snapped(rotation));
        let own = fixture.footprint();
        let half = [0, 1].map(|axis| (own.high[axis] - own.low[axis]) / 2.0);
        let free = [0, 1].map(|axis| (counter.size[axis] / 2.0 - half[axis] - 0.01).max(0.0));
        // Beside what: the middle of that, seen from the counter.
        let beside = placement
            .get("sample_region_kwargs")
            .and_then(|region| region.get("ref"));
        let beside = match beside {
            Some(other) => {
                let text = other.text("a ref")?;
                let full = format!("{text}_{group}");
                let fixtures = self.layout.fixtures.iter();
                let mut found = fixtures.filter(|one| {
                    [plain(text), plain(&full), plain(&format!("{full}_1"))].contains(&one.name)
                });
                found.next().map(|other| {
                    let away = [0, 1].map(|axis| other.at[axis] - counter.at[axis]);
                    turned(away, -counter.turn)[0]
                })
            }
            None => None,
        };
        let positions = placement.get("pos").filter(|one| !one.is_null());
        let positions = positions.map_or(Ok(&[][..]), |one| one.items("a position"))?;
        let share = |axis: usize| {
            let given = positions.get(axis).filter(|one| !one.is_null());
            let number = given.filter(|one| one.text("").is_ok_and(|text| text != "ref"));
            number.map_or(Ok(None), |one| one.number("a position").map(Some))
        };
        let wanted = [
            match (share(0)?, beside) {
                (_, Some(beside)) => beside.clamp(-free[0], free[0]),
                (Some(share), None) => share.clamp(-1.0, 1.0) * free[0],
                (None, None) => 0.0,
            },
            share(1)?.unwrap_or(0.0).clamp(-1.0, 1.0) * free[1],
        ];
        let top = counter.size[2] / 2.0 + size[2] / 2.0;
        // The nearest place along the counter where nothing else is.
        let is_free = |local: [f64; 2]| {
            let low = [0, 1].map(|axis| local[axis] - half[axis]);
            let high = [0, 1].map(|axis| local[axis] + half[axis]);
            let is_over_hole = match &counter.kind {
                Kind::Counter(Counter {
                    hole: Some([from, to]),
                    ..
                }) => (0..2).all(|axis| low[axis] < to[axis] && from[axis] < high[axis]),
                _ => false,
            };
            let place = counter.area(low, high);
            let height = counter.span()[1];
            let mut others = self.layout.fixtures.iter();
            !is_over_hole
                && !others.any(|other| {
                    let [low, high] = other.span();
                    low < height + size[2]
                        && high > height + 1e-3
                        && other.footprint().overlaps(&place)
                })
        };
        let steps = (0..=60).flat_map(|step| [1.0, -1.0].map(|sign| sign * 0.05 * f64::from(step)));
        let mut places = steps
            .map(|step| [wanted[0] + step, wanted[1]])
            .filter(|place| place[0].abs() <= free[0] + 1e-9);
        let Some([x, y]) = places.find(|place| is_free(*place)) else {
            return Ok(false);
        };
        fixture.at = counter.point([x, y, top]);
        fixture.turn = snapped(fixture.turn + counter.turn);
        fixture.name = self.unique(&plain(&fixture.name));
        self.layout.fixtures.push(fixture);
        Ok(true)
    }
}
