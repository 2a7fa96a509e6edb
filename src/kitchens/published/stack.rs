//! Stacks of a layout: columns of drawers and cabinets on a base.

use super::LayoutError;
use super::fixture::Fixture;
use super::kinds::level_kind;
use super::layout::{Group, Named, Reader};
use super::node::{Data, Node};

/// Height (m) of the base of a stack.
const BASE: f64 = 0.05;
/// Maximum number of levels.
const MAX_LEVELS: usize = 20;

impl Reader {
    /// A column of fixtures, on a base.
    pub(super) fn stack(
        &mut self,
        name: &str,
        group_name: &str,
        group: &Group,
        node: &Node,
    ) -> Result<(), LayoutError> {
        let given = node.get("size");
        let given = given.ok_or_else(|| node.error("a stack has a size"))?;
        let size = match given.items("a size")? {
            [a, b, c] => [a, b, c].map(|one| one.number("the size of a stack")),
            _ => return Err(given.error("a size has three numbers: width, depth, height")),
        };
        let [width, depth, height] = size;
        let size = self.checked([width?, depth?, height?], given)?;
        let [width, depth, height] = size;
        let at = self.position(group_name, size, node)?;
        let at = at.ok_or_else(|| node.error("this stack has no place: pos or align_to"))?;
        let list = |key: &str| {
            let list = node.get(key);
            list.ok_or_else(|| node.error(format!("a stack has {key}")))?
                .items(key)
        };
        let (levels, shares) = (list("levels")?, list("percentages")?);
        if levels.len() != shares.len() {
            return Err(node.error(format!(
                "a stack has as many percentages ({}) as levels ({})",
                shares.len(),
                levels.len()
            )));
        }
        if levels.len() > MAX_LEVELS {
            return Err(node.error(format!("a stack has at most {MAX_LEVELS} levels")));
        }
        let turn = self.own_turn(node)?;
        let is_open = node
            .get("open_top")
            .map_or(Ok(false), |open| open.flag("open_top"))?;
        let is_island = group_name.starts_with("island");
        let low = at[2] - height / 2.0;
        let (mut from, mut count) = (low, 0);
        for (number, (level, share)) in levels.iter().zip(shares).enumerate() {
            let tall = height * share.number("a percentage")?;
            let parts: Vec<(&Node, f64, f64)> = match &level.data {
                Data::List(halves) => match halves.as_slice() {
                    [left, right] => vec![
                        (left, -width / 4.0, width / 2.0),
                        (right, width / 4.0, width / 2.0),
                    ],
                    _ => return Err(level.error("a level has one fixture or two")),
                },
                _ => vec![(level, 0.0, width)],
            };
            for (part, across, width) in parts {
                let text = part.text("a level")?;
                let config = node.get("configs").and_then(|configs| {
                    let numbered = format!("{text}_{}", number + 1);
                    configs.get(text).or_else(|| configs.get(&numbered))
                });
                count += 1;
                let size = self.checked([width, depth, tall], node)?;
                let kind = level_kind(text, config, part)?;
                let place = [at[0] + across, at[1], from + tall / 2.0];
                let fixture = Fixture {
                    is_island,
                    is_covered: is_open || number + 1 < levels.len(),
                    base: if number == 0 { BASE } else { 0.0 },
                    ..Fixture::new(format!("{name}_{count}"), kind, size, place, turn)
                };
                self.add(fixture, group, true);
            }
            from += tall;
        }
        let named = Named {
            size,
            at: Some(at),
            fixture: None,
        };
        self.named.insert(name.to_owned(), named);
        Ok(())
    }
}
