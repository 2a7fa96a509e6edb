//! A layout of RoboCasa: groups of fixtures, each of which has a place of its own or stands beside another one.
//!
//! In a group, x goes to the right along the wall, y to the back, z up; the wall is at y = 0. Then the group is
//! turned and moved as a whole.

use std::collections::{BTreeMap, BTreeSet};

use closest_name::closest_name;

use super::LayoutError;
use super::fixture::{Fixture, Kind, snapped, turned};
use super::node::Node;
use crate::floor::Rectangle;

/// Types that hang on walls and are left out, with what several of them are called.
const LEFT_OUT: [(&str, &str); 5] = [
    ("window", "windows"),
    ("window_proc", "windows"),
    ("wall_accessory", "accessories"),
    ("utensil_rack", "racks"),
    ("accessory", "accessories"),
];
/// Lids and the like, which belong to other things.
const LIDS: [&str; 2] = ["blender_lid", "jar_lid"];
/// The keys of a group that place it.
const GROUP_KEYS: [&str; 3] = ["group_origin", "group_pos", "group_z_rot"];
/// The keys of fixtures that mean something here, or are known to be about looks.
const KEYS: [&str; 44] = [
    "name",
    "type",
    "size",
    "pos",
    "align_to",
    "side",
    "alignment",
    "offset",
    "levels",
    "percentages",
    "configs",
    "panel_config",
    "orientation",
    "handle_type",
    "num_levels",
    "interior_obj",
    "obj_x_percent",
    "obj_y_percent",
    "hollow",
    "half_top",
    "base_opening",
    "overhang",
    "padding",
    "interior_padding",
    "stack_height",
    "stack_fixtures",
    "stack_on",
    "z_rot",
    "placement",
    "attach_to",
    "enable",
    "wall_side",
    "enclosing_wall",
    "backing",
    "backing_extended",
    "open_top",
    "is_corner_cab",
    "is_clutter",
    "island_only",
    "has_free_joints",
    "default_config_name",
    "config_name",
    "aux_fixture_config",
    "handle_config",
];
/// Maximum number of fixtures.
const MAX_FIXTURES: usize = 1000;

/// All that stands in a layout.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    pub(super) fixtures: Vec<Fixture>,
    /// The floors of its rooms.
    pub(super) floors: Vec<Rectangle>,
    pub(super) remarks: Vec<String>,
}

/// Where a group is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Group {
    pub(super) origin: [f64; 2],
    pub(super) place: [f64; 2],
    pub(super) turn: f64,
}

/// What others refer to by its name.
#[derive(Clone, Copy, Debug)]
pub(super) struct Named {
    pub(super) size: [f64; 3],
    /// Where it is in its group; `None` as long as nothing has placed it.
    pub(super) at: Option<[f64; 3]>,
    /// Which fixture it is; `None` for a stack of several.
    pub(super) fixture: Option<usize>,
}

/// What has been read.
#[derive(Default)]
pub(super) struct Reader {
    pub(super) layout: Layout,
    /// What has a name to refer to, in the file's own characters.
    pub(super) named: BTreeMap<String, Named>,
    /// The names of all fixtures.
    pub(super) names: BTreeSet<String>,
    /// The groups of the fixtures.
    pub(super) groups: Vec<Group>,
    /// Whether each fixture has been placed.
    pub(super) is_placed: Vec<bool>,
    /// What is left out, and how many.
    left_out: BTreeMap<&'static str, usize>,
    /// Unknown keys, with their first lines.
    unknown: BTreeMap<String, usize>,
    /// What stands on counters, with the line on which it is: it is placed when all else is.
    on_counters: Vec<(String, Node)>,
}

impl Layout {
    /// Reads a layout.
    pub(super) fn read(root: &Node) -> Result<Self, LayoutError> {
        let mut reader = Reader::default();
        for (name, group) in root.entries("a layout")? {
            reader.group(name.text("the name of a group")?, group)?;
        }
        reader.finish()
    }

    /// Of walls that would hide the room from people, only the foot is to be shown: those that are nearer to the viewer, who
    /// looks from the left and the front, than the middle of the room.
    pub(super) fn lower_walls(&mut self) {
        let floors = self.floors.iter().copied();
        let Some(around) = floors.reduce(|around, one| around.with(&one)) else {
            return;
        };
        let middle = [0, 1].map(|axis| (around.low[axis] + around.high[axis]) / 2.0);
        for fixture in &mut self.fixtures {
            let across = if fixture.turn == 0.0 { 1 } else { 0 };
            if let Kind::Wall { is_foot } = &mut fixture.kind {
                *is_foot = fixture.at[across] < middle[across];
            }
        }
    }
}

impl Reader {
    /// Reads a group.
    fn group(&mut self, name: &str, config: &Node) -> Result<(), LayoutError> {
        let entries = config.entries(&format!("the group {name}"))?;
        let pair = |key: &str| -> Result<[f64; 2], LayoutError> {
            let Some(node) = config.get(key) else {
                return Ok([0.0; 2]);
            };
            let items = node.items(key)?;
            match items {
                [x, y, ..] => Ok([x.number(key)?, y.number(key)?]),
                _ => Err(node.error(format!("{key} has two numbers"))),
            }
        };
        let turn = config.get("group_z_rot");
        let group = Group {
            origin: pair("group_origin")?,
            place: pair("group_pos")?,
            turn: snapped(turn.map_or(Ok(0.0), |turn| turn.number("group_z_rot"))?),
        };
        let rows = entries.iter().filter_map(|(key, row)| {
            let key = key.text("the name of a row").unwrap_or_default();
            (!GROUP_KEYS.contains(&key)).then_some((key, row))
        });
        for (row_name, row) in rows {
            if row.is_null() {
                continue;
            }
            for fixture in row.items(&format!("{row_name} of {name}"))? {
                self.fixture(name, &group, fixture)?;
            }
        }
        Ok(())
    }

    /// Reads a fixture; what is on a counter is kept for the end.
    fn fixture(&mut self, group_name: &str, group: &Group, node: &Node) -> Result<(), LayoutError> {
        let entries = node.entries("a fixture")?;
        let want = |key: &str| {
            let value = node.get(key);
            value.ok_or_else(|| node.error(format!("this fixture has no {key}")))
        };
        let short = want("name")?.text("the name of a fixture")?;
        let name = format!("{short}_{group_name}");
        let kind = want("type")?.text("the type of a fixture")?;
        if let Some(enable) = node.get("enable")
            && !enable.flag("enable")?
        {
            return Ok(());
        }
        for (key, _) in entries {
            let text = key.text("a key")?;
            if !KEYS.contains(&text) {
                self.unknown.entry(text.to_owned()).or_insert(key.line);
            }
        }
        if let Some((_, words)) = LEFT_OUT.iter().find(|(left_out, _)| *left_out == kind) {
            *self.left_out.entry(words).or_default() += 1;
            return Ok(());
        }
        if LIDS.contains(&kind) {
            return Ok(());
        }
        if self.layout.fixtures.len() + self.on_counters.len() >= MAX_FIXTURES {
            return Err(node.error(format!("a layout has at most {MAX_FIXTURES} fixtures")));
        }
        match kind {
            "wall" => self.wall(name, node),
            "floor" => self.floor(node),
            "stack" => self.stack(&name, group_name, group, node),
            _ if node.get("placement").is_some() => {
                self.usual_size(kind, node)?;
                self.on_counters.push((group_name.to_owned(), node.clone()));
                Ok(())
            }
            _ => {
                let size = self.size(kind, group_name, node)?;
                let kind = self.kind(kind, group_name, size, node)?;
                self.place([&name, group_name], group, kind, size, node)
            }
        }
    }

    /// What a fixture has inside, which comes before it in the file.
    pub(super) fn interior(&self, group: &str, node: &Node) -> Result<Option<Named>, LayoutError> {
        let Some(inner) = node.get("interior_obj").filter(|inner| !inner.is_null()) else {
            return Ok(None);
        };
        self.named(inner.text("interior_obj")?, group, inner)
            .map(Some)
    }

    /// A fixture of a name in a group.
    pub(super) fn named(
        &self,
        short: &str,
        group: &str,
        node: &Node,
    ) -> Result<Named, LayoutError> {
        let name = format!("{short}_{group}");
        let found = self.named.get(&name).copied();
        found.ok_or_else(|| {
            let ending = format!("_{group}");
            let others = self
                .named
                .keys()
                .filter_map(|name| name.strip_suffix(&ending));
            let near = closest_name(short, others);
            let hint = near.map_or_else(String::new, |near| format!("; did you mean {near}?"));
            node.error(format!("there is no {short} before this in {group}{hint}"))
        })
    }

    /// The layout, when all groups have been read.
    fn finish(mut self) -> Result<Layout, LayoutError> {
        let mut remarks = std::mem::take(&mut self.layout.remarks);
        if !self.unknown.is_empty() {
            let keys = self.unknown.iter();
            let keys: Vec<String> = keys
                .map(|(key, line)| format!("{key} (line {line})"))
                .collect();
            remarks.push(format!("unknown keys mean nothing: {}", keys.join(", ")));
        }
        if !self.left_out.is_empty() {
            let kinds = self.left_out.iter();
            let kinds: Vec<String> = kinds
                .map(|(words, count)| format!("{words} ({count})"))
                .collect();
            remarks.push(format!(
                "what hangs on walls is left out: {}",
                kinds.join(", ")
            ));
        }
        let fixtures = std::mem::take(&mut self.layout.fixtures);
        let all = fixtures.into_iter().zip(&self.groups).zip(&self.is_placed);
        for ((mut fixture, group), is_placed) in all {
            if !is_placed {
                remarks.push(format!("{} has no place and is left out", fixture.name));
                continue;
            }
            let from = [0, 1].map(|axis| fixture.at[axis] - group.origin[axis]);
            let moved = turned(from, group.turn);
            let [x, y] = [0, 1].map(|axis| moved[axis] + group.place[axis]);
            fixture.at = [x, y, fixture.at[2]];
            fixture.turn = snapped(fixture.turn + group.turn);
            self.layout.fixtures.push(fixture);
        }
        self.cover();
        self.layout.lower_walls();
        let mut on_nothing = Vec::new();
        for (group, node) in std::mem::take(&mut self.on_counters) {
            if !self.put_on_counter(&group, &node)? {
                let name = node
                    .get("name")
                    .map_or(Ok(""), |name| name.text("a name"))?;
                on_nothing.push(name.to_owned());
            }
        }
        remarks.append(&mut self.layout.remarks);
        if !on_nothing.is_empty() {
            let names = on_nothing.join(", ");
            remarks.push(format!(
                "what is on no counter, or has no room there, is left out: {names}"
            ));
        }
        self.layout.remarks = remarks;
        Ok(self.layout)
    }

    /// Finds out what a counter closes at the top, and which counters have something below them.
    fn cover(&mut self) {
        let places = self.layout.fixtures.iter();
        let places: Vec<([f64; 2], Rectangle, bool)> = places
            .map(|one| {
                (
                    one.span(),
                    one.footprint(),
                    matches!(one.kind, Kind::Counter(_)),
                )
            })
            .collect();
        for (number, fixture) in self.layout.fixtures.iter_mut().enumerate() {
            let (span, place) = (fixture.span(), fixture.footprint());
            let mut others = places
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != number);
            match &mut fixture.kind {
                Kind::Counter(counter) => {
                    counter.is_filled = others.any(|(_, ([low, high], other, is_counter))| {
                        !is_counter
                            && *low < span[1] - 0.1
                            && *high > span[0] + 0.1
                            && other.overlaps(&place)
                    });
                }
                _ => {
                    fixture.is_covered |= others.any(|(_, ([_, high], other, is_counter))| {
                        *is_counter
                            && (0.0..0.08).contains(&(high - span[1]))
                            && other.overlaps(&place)
                    });
                }
            }
        }
    }
}

/// A name as it may stand in a URDF and as a symbol: with `_` for what is no letter, digit, `_` or `-`, and before what might
/// be a number.
pub(super) fn plain(name: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "_-".contains(letter);
    let begins_well = name.starts_with(|letter: char| letter.is_ascii_alphabetic());
    let before = (!begins_well).then_some('_');
    let letters = name.chars().take(100);
    let letters = letters.map(|one| if is_plain(one) { one } else { '_' });
    before.into_iter().chain(letters).collect()
}
