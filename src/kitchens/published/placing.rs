//! Where fixtures of a layout are: at places of their own, beside others, or inside of them.

use super::LayoutError;
use super::fixture::{Counter, Fixture, Kind, SIDES};
use super::layout::{Group, Named, Reader, plain};
use super::node::Node;

impl Reader {
    /// Where a fixture is in its group; `None` if something else places it.
    pub(super) fn position(
        &self,
        group: &str,
        size: [f64; 3],
        node: &Node,
    ) -> Result<Option<[f64; 3]>, LayoutError> {
        if let Some(other) = node.get("align_to").filter(|other| !other.is_null()) {
            return self.beside(group, size, other, node).map(Some);
        }
        let Some(given) = node.get("pos").filter(|given| !given.is_null()) else {
            return Ok(None);
        };
        let items = given.items("a position")?;
        let [x, y, z] = items else {
            return Err(given.error("a position has three numbers"));
        };
        let below = match node.get("stack_on").filter(|below| !below.is_null()) {
            Some(below) => {
                let named = self.named(below.text("stack_on")?, group, below)?;
                named.at.map(|at| (at, named.size))
            }
            None => None,
        };
        let coordinate = |node: &Node, axis: usize| match node.is_null() {
            true => Ok(below.map(|(at, _)| at[axis])),
            false => node.number("a position").map(Some),
        };
        let z = match (below, z.is_null()) {
            (Some((at, below)), _) => at[2] + below[2] / 2.0 + size[2] / 2.0,
            // On the floor.
            (None, true) => size[2] / 2.0,
            (None, false) => z.number("a position")?,
        };
        let missing =
            || given.error("null stands for a number only if something is placed on another one");
        Ok(Some([
            coordinate(x, 0)?.ok_or_else(missing)?,
            coordinate(y, 1)?.ok_or_else(missing)?,
            z,
        ]))
    }

    /// The place beside another fixture.
    pub(super) fn beside(
        &self,
        group: &str,
        size: [f64; 3],
        other: &Node,
        node: &Node,
    ) -> Result<[f64; 3], LayoutError> {
        let name = other.text("align_to")?;
        let reference = self.named(name, group, other)?;
        let at = reference
            .at
            .ok_or_else(|| other.error(format!("{name} has no place")))?;
        let side = node.get("side");
        let side = side.ok_or_else(|| node.error("align_to comes with a side"))?;
        let text = side.text("side")?.to_lowercase();
        let ends = SIDES.iter().enumerate();
        let found = ends
            .filter_map(|(axis, ends)| {
                let end = ends.iter().position(|end| *end == text)?;
                Some((axis, end))
            })
            .next();
        let (along, end) = found.ok_or_else(|| {
            side.error(format!(
                "a side is left, right, front, back, bottom or top, not {text}"
            ))
        })?;
        let mut place = at;
        let sign = |end: usize| if end == 1 { 1.0 } else { -1.0 };
        place[along] += sign(end) * (reference.size[along] + size[along]) / 2.0;
        let alignment = node.get("alignment");
        let alignment = alignment.map_or(Ok(""), |alignment| alignment.text("alignment"))?;
        let alignment = alignment.to_lowercase();
        for (axis, ends) in SIDES.iter().enumerate() {
            let Some(end) = ends.iter().position(|end| alignment.contains(end)) else {
                continue;
            };
            if axis == along {
                return Err(node.error(format!(
                    "what is at the {text} of another fixture cannot be aligned with its {}, too",
                    ends[end]
                )));
            }
            place[axis] = at[axis] + sign(end) * (reference.size[axis] - size[axis]) / 2.0;
        }
        if let Some(offset) = node.get("offset").filter(|offset| !offset.is_null()) {
            for (axis, length) in offset.items("an offset")?.iter().enumerate().take(3) {
                place[axis] += length.number("an offset")?;
            }
        }
        Ok(place)
    }

    /// By how much a fixture is turned in its group (rad).
    pub(super) fn own_turn(&self, node: &Node) -> Result<f64, LayoutError> {
        let turn = node.get("z_rot").filter(|turn| !turn.is_null());
        turn.map_or(Ok(0.0), |turn| turn.number("z_rot"))
    }

    /// A name that no other fixture has; says so if that is not the one that is wanted.
    pub(super) fn unique(&mut self, name: &str) -> String {
        let mut unique = name.to_owned();
        let mut copies = 1;
        while !self.names.insert(unique.clone()) {
            copies += 1;
            unique = format!("{name}_{copies}");
        }
        if copies > 1 {
            let remark = format!("there are two of the name {name}, one is {unique}");
            self.layout.remarks.push(remark);
        }
        unique
    }

    /// Adds a fixture. Returns its number.
    pub(super) fn add(&mut self, mut fixture: Fixture, group: &Group, is_placed: bool) -> usize {
        let number = self.layout.fixtures.len();
        let name = fixture.name.clone();
        fixture.name = self.unique(&plain(&name));
        let named = Named {
            size: fixture.size,
            at: is_placed.then_some(fixture.at),
            fixture: Some(number),
        };
        self.named.insert(name, named);
        self.layout.fixtures.push(fixture);
        self.groups.push(*group);
        self.is_placed.push(is_placed);
        number
    }

    /// Adds a fixture, with what is inside of it.
    pub(super) fn place(
        &mut self,
        [name, group_name]: [&str; 2],
        group: &Group,
        kind: Kind,
        size: [f64; 3],
        node: &Node,
    ) -> Result<(), LayoutError> {
        // What is let into a counter is placed by that.
        let at = match kind {
            Kind::Sink | Kind::Stovetop => None,
            _ => self.position(group_name, size, node)?,
        };
        let inner = match kind {
            Kind::Counter(_) | Kind::Housing(_) => self.interior(group_name, node)?,
            _ => None,
        };
        let turn = self.own_turn(node)?;
        let fixture = Fixture {
            is_island: group_name.starts_with("island"),
            ..Fixture::new(name.to_owned(), kind, size, at.unwrap_or_default(), turn)
        };
        let number = self.add(fixture, group, at.is_some());
        if let (Some(inner), true) = (inner, at.is_some()) {
            self.put_inside(number, inner);
        }
        Ok(())
    }

    /// Puts a fixture into the hole of a counter, or into its housing.
    pub(super) fn put_inside(&mut self, outer: usize, inner: Named) {
        let Some(number) = inner.fixture else {
            return;
        };
        let around = &self.layout.fixtures[outer];
        let mut size = inner.size;
        let shift = match &around.kind {
            Kind::Counter(Counter {
                hole: Some([low, high]),
                ..
            }) => {
                let middle = [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0);
                for axis in 0..2 {
                    size[axis] = high[axis] - low[axis];
                }
                [middle[0], middle[1], (around.size[2] - size[2]) / 2.0]
            }
            Kind::Housing(frame) => [0, 1, 2].map(|axis| (frame[axis][0] - frame[axis][1]) / 2.0),
            _ => return,
        };
        let at = [0, 1, 2].map(|axis| around.at[axis] + shift[axis]);
        // A hob is flush with its counter: what stands on it stands on the counter.
        if self.layout.fixtures[number].kind == Kind::Stovetop
            && let Kind::Counter(counter) = &mut self.layout.fixtures[outer].kind
        {
            counter.hole = None;
        }
        let around = &self.layout.fixtures[outer];
        let (turn, is_island) = (around.turn, around.is_island);
        let fixture = &mut self.layout.fixtures[number];
        (fixture.at, fixture.size) = (at, size);
        (fixture.turn, fixture.is_island) = (turn, is_island);
        self.is_placed[number] = true;
        let mut named = self.named.values_mut();
        if let Some(named) = named.find(|named| named.fixture == Some(number)) {
            named.at = Some(at);
        }
    }
}
