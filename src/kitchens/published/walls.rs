//! Walls and floors of a layout, which have half sizes.

use std::f64::consts::FRAC_PI_2;

use super::LayoutError;
use super::fixture::{Fixture, Kind};
use super::layout::{Group, Reader};
use super::node::Node;
use crate::floor::Rectangle;

impl Reader {
    /// A wall: half its length, height and thickness, and its middle.
    pub(super) fn wall(&mut self, name: String, node: &Node) -> Result<(), LayoutError> {
        // A second, thicker wall behind each is for looks.
        if node
            .get("backing")
            .map_or(Ok(false), |backing| backing.flag("backing"))?
        {
            return Ok(());
        }
        let [half, high, thick] = three(node, "size")?;
        let mut at = three(node, "pos")?;
        let side = node.get("wall_side").filter(|side| !side.is_null());
        let side = side.map_or(Ok("back"), |side| side.text("wall_side"))?;
        let (axis, sign, turn) = match side {
            "left" => (0, -1.0, FRAC_PI_2),
            "right" => (0, 1.0, FRAC_PI_2),
            "front" => (1, -1.0, 0.0),
            "back" => (1, 1.0, 0.0),
            other => {
                return Err(node.error(format!(
                    "a wall is at the left, right, front or back of its room, not {other}"
                )));
            }
        };
        // Its surface is where it is said to be.
        at[axis] += sign * thick;
        let size = [half, thick, high].map(|half| 2.0 * half);
        let size = self.checked(size, node)?;
        let fixture = Fixture::new(name, Kind::Wall { is_foot: false }, size, at, turn);
        self.add(fixture, &Group::default(), true);
        Ok(())
    }

    pub(super) fn floor(&mut self, node: &Node) -> Result<(), LayoutError> {
        if node
            .get("backing")
            .map_or(Ok(false), |backing| backing.flag("backing"))?
        {
            return Ok(());
        }
        let [width, depth, _] = three(node, "size")?;
        let [x, y, _] = three(node, "pos")?;
        let floor = Rectangle::of([x - width, y - depth], [x + width, y + depth]);
        self.layout.floors.push(floor);
        Ok(())
    }
}

/// Three numbers under a key.
fn three(node: &Node, key: &str) -> Result<[f64; 3], LayoutError> {
    let given = node.get(key);
    let given = given.ok_or_else(|| node.error(format!("this has no {key}")))?;
    match given.items(key)? {
        [a, b, c] => Ok([a.number(key)?, b.number(key)?, c.number(key)?]),
        _ => Err(given.error(format!("{key} has three numbers"))),
    }
}
