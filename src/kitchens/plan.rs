//! The floor plan of a kitchen: its room, its rows of modules, and what stands free.

use std::cell::Cell;

use crate::arrangement::Arrangement;
use crate::draws::{Numbers, rounded};
use crate::floor::{Floor, Rectangle};
use crate::modules::{Module, Unit, fill};
use crate::settings::Setting;

/// A row of modules.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) name: &'static str,
    /// The end at the right of somebody who looks at its fronts from the room, at its back.
    pub(crate) origin: [f64; 2],
    /// The direction in which its fronts look, in quarter turns from +x.
    pub(crate) turns: u8,
    pub(crate) modules: Vec<Module>,
    /// Whether cabinets hang above.
    pub(crate) has_wall: bool,
}

impl Row {
    /// A point of the room, from one in front of the row's back (m) and along it.
    pub(crate) fn point(&self, [ahead, along]: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.origin;
        match self.turns % 4 {
            0 => [x + ahead, y + along],
            1 => [x - along, y + ahead],
            2 => [x - ahead, y - along],
            _ => [x + along, y - ahead],
        }
    }

    /// A rectangle of the room, likewise.
    pub(crate) fn rectangle(&self, from: [f64; 2], to: [f64; 2]) -> Rectangle {
        Rectangle::of(self.point(from), self.point(to))
    }

    /// Its length (m).
    pub(crate) fn length(&self) -> f64 {
        self.modules.last().map_or(0.0, |last| last.at + last.width)
    }
}

/// Numbers that hold for the whole kitchen (m).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Style {
    pub(crate) height: f64,
    pub(crate) depth: f64,
    pub(crate) top: f64,
    pub(crate) plinth: f64,
    pub(crate) front: f64,
    /// Thickness of the bars of handles, and their distance from the front.
    pub(crate) bar: f64,
    pub(crate) ahead: f64,
    pub(crate) ceiling: f64,
    pub(crate) fridge: f64,
    /// Bottom of wall cabinets above the counter, their height and depth.
    pub(crate) hanging: [f64; 3],
    pub(crate) travel: f64,
    pub(crate) color: usize,
}

/// A table on four legs, or a stool.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    pub(crate) place: Rectangle,
    pub(crate) height: f64,
}

/// The floor plan of a kitchen. The room's corner is at 0 0.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub(crate) arrangement: Arrangement,
    pub(crate) style: Style,
    pub(crate) room: Rectangle,
    /// Where the doorway in the front wall begins and ends along x.
    pub(crate) doorway: [f64; 2],
    pub(crate) rows: Vec<Row>,
    pub(crate) table: Option<Standing>,
    pub(crate) stools: Vec<Standing>,
    /// Whether cabinets hang on walls.
    pub(crate) has_wall_cabinets: bool,
    /// Where the robot starts.
    pub(crate) start: [f64; 2],
    /// The narrowest way between rows that face each other (m).
    pub(crate) aisle: f64,
}

/// Why an attempt gives no kitchen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rejection {
    /// There is not enough room to turn.
    Narrow,
    /// A front, the doorway or the table cannot be reached.
    CutOff,
    /// It lacks something that every kitchen has.
    Incomplete,
    /// What is to be there has no room, or does not go with the arrangement.
    NoPlace,
}

impl Rejection {
    /// What is wrong, in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Narrow => "there is not enough room",
            Self::CutOff => "the robot would not get to a front, the doorway or the table",
            Self::Incomplete => {
                "it would lack a sink, a fridge that opens, or three drawers that open"
            }
            Self::NoPlace => "there is no place for the island or the table",
        }
    }
}

/// Room (m) that the robot needs to all sides on its way: 0.8 m altogether.
const WAY: f64 = 0.4;
/// Room (m) around the place where it starts.
const START: f64 = 0.5;
/// Free strip (m) in front of a front, and how far from it the robot's middle is in it.
const STAND: [f64; 2] = [0.42, 1.1];
/// Room (m) that a row keeps to one around the corner, for its handles.
const CORNER: f64 = 0.08;

/// How far (m) the handle of an open door is beside its hinge.
pub(crate) const ASIDE: f64 = 0.08;

impl Plan {
    /// Draws a plan.
    pub(crate) fn draw(numbers: &Numbers<'_>) -> Result<Self, Rejection> {
        use Arrangement::{Galley, Island, L, LWithIsland, OneWall, Peninsula, U};
        let settings = numbers.settings();
        let drawn = settings
            .arrangement()
            .or_else(|| numbers.choice("arrangement", &Arrangement::SHARES))
            .unwrap_or(OneWall);
        let arrangement = match settings.flag("island") {
            None => drawn,
            Some(true) => drawn.with_island().ok_or(Rejection::NoPlace)?,
            Some(false) => drawn.without_island(),
        };
        numbers.note("arrangement", Setting::Name(arrangement.name().to_owned()));
        if matches!(arrangement, Island | LWithIsland) {
            numbers.note("island", Setting::Flag(true));
        }
        // Without its island, a kitchen keeps its room.
        let sized = match settings.flag("island") {
            Some(false) => drawn,
            _ => arrangement,
        };
        let between = |name: &str, low, high| numbers.between(name, low, high);
        let style = Style {
            height: between("counter.height", 0.85, 0.95),
            depth: between("counter.depth", 0.58, 0.65),
            top: between("counter.thickness", 0.022, 0.04),
            plinth: between("plinth", 0.08, 0.15),
            front: between("front.thickness", 0.016, 0.022),
            bar: between("handle.thickness", 0.011, 0.016),
            ahead: between("handle.ahead", 0.03, 0.045),
            ceiling: between("ceiling", 2.4, 3.0),
            fridge: between("fridge.height", 1.4, 2.0),
            hanging: [
                between("hanging.bottom", 0.45, 0.6),
                between("hanging.height", 0.4, 0.9),
                between("hanging.depth", 0.3, 0.4),
            ],
            travel: between("drawer.travel", 0.4, 0.48),
            color: numbers.below("color", 5),
        };
        let depth = style.depth;
        let aisle = match arrangement {
            Galley | Island | LWithIsland => between("aisle", 1.0, 1.6),
            _ => 0.0,
        };
        let width = match sized {
            OneWall => between("room.width", 3.0, 5.0),
            Galley => rounded(2.0 * depth + aisle),
            L | LWithIsland => between("room.width", 3.0, 5.2),
            U => numbers.between_after("room.width", 2.0 * depth, 1.4, 2.8),
            Island => between("room.width", 3.4, 5.6),
            Peninsula => numbers.between_after("room.width", depth, 2.4, 3.6),
        };
        let far = match sized {
            OneWall | Peninsula => between("room.depth", 2.6, 4.6),
            Galley => between("room.depth", 2.8, 4.6),
            L => between("room.depth", 2.8, 5.0),
            U => between("room.depth", 3.0, 5.0),
            Island | LWithIsland => between("room.depth", 3.8, 5.8),
        };
        let room = Rectangle::of([0.0, 0.0], [width, far]);
        // Along the back wall, looking at the front wall; along the left one; along the right one.
        let back = |from: f64, to: f64| ("back", [from, far], 3, to - from);
        let left = |from: f64, to: f64| ("left", [0.0, from], 0, to - from);
        let right = |from: f64, to: f64| ("right", [width, from], 2, from - to);
        let corner = depth + CORNER;
        // What is set is so, or not at all.
        let is_cut = Cell::new(false);
        let held = |name: &str, length: f64| {
            let set = settings.number(name);
            is_cut.set(is_cut.get() || set.is_some_and(|set| (set - length).abs() > 1e-9));
            length
        };
        let length_of = |name: &str, least: f64, most: f64| {
            let length = between(name, 1.5, 2.6).min(far - 1.0);
            held(name, length.max(least).min(most))
        };
        let side = |name: &str| length_of(name, 0.0, f64::INFINITY);
        let mut places = match arrangement {
            OneWall | Island => vec![back(0.0, width)],
            Galley => vec![
                left(far - side("left.length"), far),
                right(far, far - side("right.length")),
            ],
            L | LWithIsland => {
                let length = length_of("left.length", corner + 0.9, far - 0.9);
                vec![back(0.0, width), left(far - length, far - depth)]
            }
            U => {
                let lengths = ["left.length", "right.length"]
                    .map(|name| length_of(name, corner + 0.9, far - 0.9));
                vec![
                    back(0.0, width),
                    left(far - lengths[0], far - depth),
                    right(far - depth, far - lengths[1]),
                ]
            }
            Peninsula => {
                let length = length_of("right.length", corner + 0.9, far - 1.0);
                let free = ("right", [width - 0.9, far - depth], 2, length - depth);
                vec![back(0.0, width - 0.9), free]
            }
        };
        if matches!(arrangement, Island | LWithIsland) {
            let wide = between("island.width", 1.2, 2.2).min(width - 2.0);
            let wide = held("island.width", wide);
            let left = if arrangement == LWithIsland {
                depth
            } else {
                0.0
            };
            let start = rounded(left + (width - left - wide) / 2.0);
            // Its fronts look at the row along the wall.
            let at = rounded(far - depth - aisle - depth);
            places.push(("island", [start + wide, at], 1, wide));
        }
        if is_cut.get() {
            return Err(Rejection::Narrow);
        }
        let mut rows = Vec::new();
        for (index, (name, origin, turns, length)) in places.iter().enumerate() {
            let meets = |other: &str| places.iter().any(|place| place.0 == other);
            let has_corners = ["back", "left", "right"].contains(name)
                && arrangement != Galley
                && places.len() > 1;
            let dead = match *name {
                "back" if has_corners => [
                    if meets("left") { corner } else { 0.0 },
                    if meets("right") { corner } else { 0.0 },
                ],
                // Along the left wall the row ends at the back one; along the right wall it begins there.
                "left" if has_corners => [0.0, CORNER],
                "right" if has_corners => [CORNER, 0.0],
                _ => [0.0, 0.0],
            };
            let row = Row {
                name,
                origin: *origin,
                turns: *turns,
                modules: fill(numbers, arrangement, index, name, *length, dead)?,
                has_wall: *name != "island" && (arrangement != Peninsula || *name != "right"),
            };
            rows.push(row);
        }
        let doorway = between("doorway.width", 0.95, 1.1);
        let free = match arrangement {
            Galley => depth + 0.05,
            _ => 0.15,
        };
        let begin = between("doorway.at", free, (width - free - doorway).max(free));
        let mut plan = Self {
            arrangement,
            style,
            room,
            doorway: [begin, begin + doorway],
            rows,
            table: None,
            stools: Vec::new(),
            has_wall_cabinets: settings.flag("wall-cabinets").unwrap_or(true),
            start: [0.0; 2],
            aisle: match arrangement {
                Galley | Island | LWithIsland => aisle,
                U => width - 2.0 * depth,
                _ => f64::INFINITY,
            },
        };
        plan.check_rows()?;
        plan.close_what_does_not_open();
        plan.check_units()?;
        plan.set_table(numbers);
        if settings.flag("table") == Some(true) && plan.table.is_none() {
            return Err(Rejection::NoPlace);
        }
        plan.check()?;
        Ok(plan)
    }

    /// Whether rows are in the room and do not overlap.
    fn check_rows(&self) -> Result<(), Rejection> {
        let depth = self.style.depth;
        let rows = self.rows.iter();
        let rows: Vec<Rectangle> = rows
            .map(|row| row.rectangle([0.0, 0.0], [depth, row.length()]))
            .collect();
        let fits = rows.iter().enumerate().all(|(number, row)| {
            let mut before = rows.iter().take(number);
            row.is_inside(&self.room) && !before.any(|other| other.overlaps(row))
        });
        match fits {
            true => Ok(()),
            false => Err(Rejection::Narrow),
        }
    }

    /// What the rows take of the floor, without handles.
    fn obstacles(&self) -> Vec<Rectangle> {
        let rows = self.rows.iter();
        let rows =
            rows.map(|row| row.rectangle([0.0, 0.0], [self.style.depth + 0.02, row.length()]));
        let standing = self.table.iter().chain(&self.stools);
        rows.chain(standing.map(|one| one.place)).collect()
    }

    /// The floor that a module needs to open.
    pub(crate) fn opened(&self, row: &Row, module: &Module) -> Option<Rectangle> {
        let depth = self.style.depth;
        let handle = self.style.front + self.style.ahead + self.style.bar + 0.01;
        let (from, to) = (module.at, module.at + module.width);
        Some(match module.unit {
            Unit::Drawers(_) => row.rectangle(
                [depth + 0.03, from + 0.01],
                [depth + self.style.travel + handle, to - 0.01],
            ),
            Unit::Door { is_left } | Unit::Fridge { is_left } => {
                // The panel stands ahead of the hinge, with its handle beside that.
                let aside = if is_left {
                    [from - ASIDE, to]
                } else {
                    [from, to + ASIDE]
                };
                row.rectangle(
                    [depth + 0.03, aside[0]],
                    [depth + module.width + handle, aside[1]],
                )
            }
            _ => return None,
        })
    }

    /// What could not be opened becomes a panel.
    fn close_what_does_not_open(&mut self) {
        let reach = self.style.front + self.style.ahead + self.style.bar;
        let blocks: Vec<Rectangle> = self
            .rows
            .iter()
            .map(|row| row.rectangle([0.0, 0.0], [self.style.depth + reach, row.length()]))
            .collect();
        let mut closed = Vec::new();
        for (at, row) in self.rows.iter().enumerate() {
            for (number, module) in row.modules.iter().enumerate() {
                let Some(needed) = self.opened(row, module) else {
                    continue;
                };
                let others = blocks.iter().enumerate().filter(|(other, _)| *other != at);
                let is_blocked = others.into_iter().any(|(_, block)| block.overlaps(&needed));
                if is_blocked || !needed.is_inside(&self.room) {
                    closed.push((at, number));
                }
            }
        }
        for (at, number) in closed {
            let module = &mut self.rows[at].modules[number];
            // A fridge beside a wall has its hinge there only if its handle has room.
            module.unit = match module.unit {
                Unit::Fridge { is_left } => Unit::Fridge { is_left: !is_left },
                _ => Unit::Panel,
            };
        }
    }

    /// Every kitchen has a sink, a fridge that opens, and drawers.
    fn check_units(&self) -> Result<(), Rejection> {
        let modules = || self.rows.iter().flat_map(|row| &row.modules);
        let drawers: usize = modules()
            .map(|module| match module.unit {
                Unit::Drawers(shares) => shares.len(),
                _ => 0,
            })
            .sum();
        let has = |is: fn(Unit) -> bool| modules().any(|module| is(module.unit));
        let is_complete = has(|unit| unit == Unit::Sink)
            && has(|unit| matches!(unit, Unit::Fridge { .. }))
            && drawers >= 3;
        let opens = self.rows.iter().all(|row| {
            let fridges = row.modules.iter().filter(|module| module.unit.is_tall());
            fridges
                .filter_map(|module| self.opened(row, module))
                .all(|needed| {
                    let others = self.rows.iter().filter(|other| other.name != row.name);
                    needed.is_inside(&self.room)
                        && others.into_iter().all(|other| {
                            let reach = self.style.depth + 0.08;
                            !other
                                .rectangle([0.0, 0.0], [reach, other.length()])
                                .overlaps(&needed)
                        })
                })
        });
        match is_complete && opens {
            true => Ok(()),
            false => Err(Rejection::Incomplete),
        }
    }

    /// Puts a table where there is room for it, with stools.
    fn set_table(&mut self, numbers: &Numbers<'_>) {
        if !numbers.flag("table", 0.6) {
            return;
        }
        let size = [
            numbers.between("table.length", 0.8, 1.6),
            numbers.between("table.width", 0.7, 0.9),
        ];
        let height = numbers.between("table.height", 0.70, 0.77);
        let door = (self.doorway[0] + self.doorway[1]) / 2.0;
        let [width, far] = self.room.high;
        let mut best: Option<(f64, Rectangle)> = None;
        for size in [size, [size[1], size[0]]] {
            for i in 0..12 {
                for j in 0..12 {
                    let at = [
                        f64::from(i) / 11.0 * (width - size[0]),
                        f64::from(j) / 11.0 * (far - size[1]),
                    ];
                    let at = at.map(rounded);
                    let place = Rectangle::of(at, [at[0] + size[0], at[1] + size[1]]);
                    let rows = self.obstacles();
                    let free = rows.iter().all(|row| !row.overlaps(&place.grown(1.25)));
                    let is_clear = place.distance([door, 0.0]) > 1.3;
                    let from_walls = (width - place.high[0]).min(place.low[0]).min(place.low[1]);
                    if free && is_clear && best.as_ref().is_none_or(|(far, _)| from_walls < *far) {
                        best = Some((from_walls, place));
                    }
                }
            }
        }
        let Some((_, place)) = best else {
            numbers.note("table", Setting::Flag(false));
            for size in ["table.length", "table.width", "table.height"] {
                numbers.forget(size);
            }
            return;
        };
        self.table = Some(Standing { place, height });
        let count = numbers.below("stools", 3);
        for (number, x) in [0.25, 0.75].into_iter().take(count).enumerate() {
            let middle = place.low[0] + x * (place.high[0] - place.low[0]);
            // Pushed in from the side of the front wall, or of the back one.
            let [near, edge] = [place.low[1] - 0.12, place.high[1] - 0.22];
            let y = if numbers.flag(&format!("stool.{number}.side"), 0.5) {
                near
            } else {
                edge
            };
            let at = [middle - 0.17, y].map(rounded);
            let stool = Rectangle::of(at, [at[0] + 0.34, at[1] + 0.34]);
            if stool.is_inside(&self.room) {
                self.stools.push(Standing {
                    place: stool,
                    height: 0.45,
                });
            }
        }
    }

    /// Whether the robot gets everywhere; finds out where it starts.
    fn check(&mut self) -> Result<(), Rejection> {
        let obstacles = self.obstacles();
        let mut floor = Floor::new(&self.room, &obstacles);
        let Some((start, _)) = floor.widest().filter(|(_, room)| *room >= START) else {
            return Err(Rejection::Narrow);
        };
        self.start = start.map(rounded);
        floor.explore(start, WAY);
        let reaches = |row: &Row, module: &Module| {
            let ahead = self.style.depth;
            let strip = row.rectangle(
                [ahead + STAND[0], module.at - 0.25],
                [ahead + STAND[1], module.at + module.width + 0.25],
            );
            floor.gets_to(&strip)
        };
        let rows = self.rows.iter();
        let mut modules = rows.flat_map(|row| row.modules.iter().map(move |module| (row, module)));
        let all =
            modules.all(|(row, module)| matches!(module.unit, Unit::Panel) || reaches(row, module));
        let door = Rectangle::of(
            [self.doorway[0] + WAY, WAY],
            [self.doorway[1] - WAY + 0.05, WAY + 0.15],
        );
        let table = self.table.is_none_or(|table| {
            let around = table.place.grown(0.65);
            floor.gets_to(&around)
        });
        match all && table && floor.gets_to(&door) {
            true => Ok(()),
            false => Err(Rejection::CutOff),
        }
    }
}
