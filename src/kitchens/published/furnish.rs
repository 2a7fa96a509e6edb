//! Furniture of a layout: its fixtures as links.

use super::fixture::{Counter, Doors, Fixture, Fridge, HandlePlace, Kind, turned};
use super::layout::Layout;
use super::room::Room;
use super::{LayoutError, Published};
use crate::description::description;
use crate::fittings::{Door, Drawer, Fittings, Flap};
use crate::furniture::{BOARD, COLORS, FOOT, GAP, Inventory, materials};
use crate::urdf::{Block, Joint, Urdf};
use std::f64::consts::FRAC_PI_2;

/// Fronts and handles; RoboCasa's panels are as thick, its handles are in its meshes.
const FITTINGS: Fittings = Fittings {
    front: 0.02,
    bar: 0.012,
    ahead: 0.035,
};
/// Thickness (m) of tops of counters.
const TOP: f64 = 0.03;
/// Thickness (m) of the walls of appliances and of what separates compartments.
const WALL: f64 = 0.03;
/// Lengths (m) of handles of doors, and of knobs.
const HANDLE: [f64; 2] = [0.1, 0.24];
const KNOB: [f64; 2] = [0.03, 0.03];
/// How far (m) bases are set back.
const SET_BACK: f64 = 0.07;
/// Longest way (m) of a drawer.
const TRAVEL: f64 = 0.45;
/// How many pairs that overlap are named.
const NAMED: usize = 4;

/// Makes a kitchen of a layout.
pub(super) fn furnish(layout: Layout) -> Result<Published, LayoutError> {
    let room = Room::of(&layout);
    let room =
        room.ok_or_else(|| LayoutError::whole("there is no place where a robot could stand"))?;
    let mut maker = Maker {
        urdf: Urdf::new("kitchen", &materials(COLORS[0])),
        inventory: Inventory::default(),
        solids: Vec::new(),
        number: 0,
    };
    let [x, y] = room.start;
    let corner = Joint::fixed("world", [-x, -y, 0.0], 0.0);
    maker.urdf.link("room", corner, &[]);
    for (number, fixture) in layout.fixtures.iter().enumerate() {
        maker.number = number;
        maker.fixture(fixture);
    }
    if let Some(name) = maker.urdf.doubled() {
        return Err(LayoutError::whole(format!(
            "two parts would have the name {name}: rename one"
        )));
    }
    let mut remarks = layout.remarks.clone();
    remarks.extend(maker.overlaps(&layout.fixtures));
    if !room.cut_off.is_empty() {
        remarks.push(format!(
            "the robot does not get to {}",
            room.cut_off.join(", ")
        ));
    }
    let mut inventory = maker.inventory;
    inventory.counters.sort_by(|a, b| b.0.total_cmp(&a.0));
    Ok(Published {
        urdf: maker.urdf.finish(),
        description: description(&inventory),
        remarks,
    })
}

/// A solid box of a fixture, seen in the room.
struct Solid {
    fixture: usize,
    low: [f64; 3],
    high: [f64; 3],
}

/// Makes links of fixtures.
struct Maker {
    urdf: Urdf,
    inventory: Inventory,
    solids: Vec<Solid>,
    /// The number of the fixture that is being made.
    number: usize,
}

impl Maker {
    /// Adds the fixed part of a fixture. Its x axis looks out of the front, and is 0 so far (m) ahead of the middle and
    /// so far above it.
    fn body(&mut self, fixture: &Fixture, [ahead, up]: [f64; 2], blocks: &[Block]) {
        self.body_that_shows(fixture, [ahead, up], blocks, blocks);
    }

    fn body_that_shows(
        &mut self,
        fixture: &Fixture,
        [ahead, up]: [f64; 2],
        blocks: &[Block],
        shown: &[Block],
    ) {
        let at = fixture.point([0.0, -ahead, up]);
        let yaw = fixture.turn - FRAC_PI_2;
        let joint = Joint::fixed("room", at, yaw);
        self.urdf
            .link_that_shows(&fixture.name, joint, blocks, shown);
        self.note(fixture, [ahead, up], blocks);
    }

    /// Notes where solid boxes of a fixture are.
    fn note(&mut self, fixture: &Fixture, [ahead, up]: [f64; 2], blocks: &[Block]) {
        let at = fixture.point([0.0, -ahead, up]);
        let yaw = fixture.turn - FRAC_PI_2;
        for (middle, size, _) in blocks {
            let [x, y] = turned([middle[0], middle[1]], yaw);
            let corner = turned([size[0] / 2.0, size[1] / 2.0], yaw);
            let other = turned([size[0] / 2.0, -size[1] / 2.0], yaw);
            let middle = [at[0] + x, at[1] + y, at[2] + middle[2]];
            let half = [
                corner[0].abs().max(other[0].abs()),
                corner[1].abs().max(other[1].abs()),
                size[2] / 2.0,
            ];
            self.solids.push(Solid {
                fixture: self.number,
                low: [0, 1, 2].map(|i| middle[i] - half[i]),
                high: [0, 1, 2].map(|i| middle[i] + half[i]),
            });
        }
    }

    fn fixture(&mut self, fixture: &Fixture) {
        let [width, depth, height] = fixture.size;
        match &fixture.kind {
            Kind::Counter(counter) => self.counter(fixture, counter),
            Kind::Drawer => self.drawer(fixture),
            Kind::Cabinet {
                doors,
                handle,
                is_knob,
            } => self.cabinet(fixture, *doors, *handle, *is_knob),
            Kind::Shelves(count) => self.shelves(fixture, *count),
            Kind::Solid => {
                let front = Self::front(fixture);
                let block: Block = ([-front, 0.0, 0.0], [depth, width, height], "front");
                let blocks: Vec<Block> = [block].into_iter().chain(Self::base(fixture)).collect();
                self.body(fixture, [front, 0.0], &blocks);
            }
            Kind::Panel => {
                let half = height / 2.0;
                let has_top = !fixture.is_covered;
                let mut blocks =
                    Self::carcass([width, depth], [-half, half], BOARD, has_top, "body");
                let size = [FITTINGS.front, width - GAP, height - GAP];
                blocks.push(([FITTINGS.front / 2.0, 0.0, 0.0], size, "front"));
                blocks.extend(Self::base(fixture));
                self.body(fixture, [Self::front(fixture), 0.0], &blocks);
            }
            Kind::Housing(frame) => self.housing(fixture, frame),
            Kind::Stove => self.oven(fixture, [0.12, 0.11]),
            Kind::Oven => self.oven(fixture, [0.05, 0.09]),
            Kind::Dishwasher => self.oven(fixture, [0.12, WALL]),
            Kind::Microwave => self.microwave(fixture),
            Kind::Stovetop => {
                let plate: Block = ([0.0; 3], [depth, width, 0.001], "glass");
                self.body_that_shows(fixture, [0.0, height / 2.0], &[], &[plate]);
            }
            Kind::Hood => {
                let thin = (height / 4.0).min(0.15);
                let blocks: [Block; 2] = [
                    (
                        [0.0, 0.0, (thin - height) / 2.0],
                        [depth, width, thin],
                        "steel",
                    ),
                    (
                        [-depth / 4.0, 0.0, thin / 2.0],
                        [depth / 2.0, width / 2.5, height - thin],
                        "steel",
                    ),
                ];
                self.body(fixture, [0.0; 2], &blocks);
            }
            Kind::Sink => self.sink(fixture),
            Kind::Fridge(kind) => self.fridge(fixture, *kind),
            Kind::OnLegs { is_table } => self.on_legs(fixture, *is_table),
            Kind::Wall { is_foot } => {
                let block: Block = ([0.0; 3], [depth, width, height], "wall");
                let foot = FOOT.min(height);
                let foot: Block = (
                    [0.0, 0.0, (foot - height) / 2.0],
                    [depth, width, foot],
                    "wall",
                );
                let low = fixture.span()[0] < 0.1;
                match (*is_foot, low) {
                    (true, true) => self.body_that_shows(fixture, [0.0; 2], &[block], &[foot]),
                    (true, false) => self.body_that_shows(fixture, [0.0; 2], &[block], &[]),
                    _ => self.body(fixture, [0.0; 2], &[block]),
                }
            }
        }
    }

    fn counter(&mut self, fixture: &Fixture, counter: &Counter) {
        let [width, depth, height] = fixture.size;
        let [right, front] = [width / 2.0, depth / 2.0];
        let thick = TOP.min(height);
        let slab = |[a, b]: [f64; 2], [c, d]: [f64; 2]| -> Block {
            (
                [(a + b) / 2.0, (c + d) / 2.0, -thick / 2.0],
                [b - a, d - c, thick],
                "top",
            )
        };
        let across = match counter.half {
            [true, false] => [-right, 0.0],
            [false, true] => [0.0, right],
            _ => [-right, right],
        };
        let mut blocks = match counter.hole {
            None => vec![slab([-front, front], across)],
            Some([low, high]) => vec![
                slab([-front, front], [-right, low[0]]),
                slab([-front, front], [high[0], right]),
                slab([-low[1], front], [low[0], high[0]]),
                slab([-front, -high[1]], [low[0], high[0]]),
            ],
        };
        blocks.retain(|(_, size, _)| size.iter().all(|length| *length > 1e-4));
        let tall = height - thick;
        let under = -thick - tall / 2.0;
        let edge = front - counter.overhang;
        let is_open = counter.opening[0] || counter.opening[1];
        if tall > 0.01 {
            if is_open {
                // Two ends carry it, with a panel between them.
                let end = 0.1_f64.min(width / 4.0);
                for side in [-1.0, 1.0] {
                    blocks.push((
                        [(edge - front) / 2.0, side * (right - end / 2.0), under],
                        [edge + front, end, tall],
                        "front",
                    ));
                }
                let at = match counter.opening[0] {
                    true => -front + WALL / 2.0,
                    false => edge - WALL / 2.0,
                };
                blocks.push(([at, 0.0, under], [WALL, width - 2.0 * end, tall], "front"));
            } else if !counter.hollow[0] && !counter.hollow[1] {
                let size = [edge + front, width, tall];
                blocks.push(([(edge - front) / 2.0, 0.0, under], size, "front"));
            } else if !counter.is_filled {
                for (is_hollow, at) in [
                    (counter.hollow[0], -front + WALL / 2.0),
                    (counter.hollow[1], edge - WALL / 2.0),
                ] {
                    if !is_hollow {
                        blocks.push(([at, 0.0, under], [WALL, width, tall], "front"));
                    }
                }
            }
        }
        self.body(fixture, [0.0, height / 2.0], &blocks);
        let length = across[1] - across[0];
        self.inventory.counters.push((length, fixture.name.clone()));
        let is_longer = |other: &str| {
            let mut counters = self.inventory.counters.iter();
            counters.any(|(one, name)| name == other && *one < length)
        };
        if fixture.is_island && self.inventory.island.as_deref().is_none_or(is_longer) {
            self.inventory.island = Some(fixture.name.clone());
        }
    }

    /// How far (m) ahead of the middle the frame of something with fronts is.
    fn front(fixture: &Fixture) -> f64 {
        fixture.size[1] / 2.0 - FITTINGS.front
    }

    /// The base on which a fixture stands, in the frame of its front.
    fn base(fixture: &Fixture) -> Option<Block> {
        let [width, depth, height] = fixture.size;
        let deep = depth - SET_BACK;
        (fixture.base > 0.0 && deep > 0.0).then(|| {
            let middle = FITTINGS.front - SET_BACK - deep / 2.0;
            let size = [deep, width, fixture.base];
            ([middle, 0.0, -(height + fixture.base) / 2.0], size, "body")
        })
    }

    /// A box that is open at the front, in the frame of its front, from a height to another one.
    fn carcass(
        [width, depth]: [f64; 2],
        [low, high]: [f64; 2],
        thick: f64,
        has_top: bool,
        material: &'static str,
    ) -> Vec<Block> {
        let deep = depth - FITTINGS.front;
        let (middle, tall) = ((low + high) / 2.0, high - low);
        let inner = width - 2.0 * thick;
        let half = (width - thick) / 2.0;
        let mut blocks: Vec<Block> = vec![
            ([-deep / 2.0, -half, middle], [deep, thick, tall], material),
            ([-deep / 2.0, half, middle], [deep, thick, tall], material),
            (
                [-deep + thick / 2.0, 0.0, middle],
                [thick, inner, tall],
                material,
            ),
            (
                [(thick - deep) / 2.0, 0.0, low + thick / 2.0],
                [deep - thick, inner, thick],
                material,
            ),
        ];
        if has_top {
            blocks.push((
                [(thick - deep) / 2.0, 0.0, high - thick / 2.0],
                [deep - thick, inner, thick],
                material,
            ));
        }
        blocks
    }

    /// A board in such a box.
    fn board([width, depth]: [f64; 2], height: f64, thick: f64) -> Block {
        let deep = depth - FITTINGS.front - 0.06;
        (
            [-deep / 2.0 - 0.05, 0.0, height],
            [deep - 0.03, width - 2.0 * thick, 0.016],
            "inner",
        )
    }

    fn drawer(&mut self, fixture: &Fixture) {
        let [width, depth, height] = fixture.size;
        let half = height / 2.0;
        let mut blocks = Self::carcass(
            [width, depth],
            [-half, half],
            BOARD,
            !fixture.is_covered,
            "body",
        );
        blocks.extend(Self::base(fixture));
        self.body(fixture, [Self::front(fixture), 0.0], &blocks);
        let drawer = self.slide(fixture, &fixture.name, [-half, half]);
        self.inventory.drawers.extend(drawer);
    }

    /// A drawer between two heights of a body, with the height of its middle above the floor and its own, if there is room
    /// for one.
    fn slide(
        &mut self,
        fixture: &Fixture,
        name: &str,
        [low, high]: [f64; 2],
    ) -> Option<(String, f64, f64)> {
        let [width, depth, _] = fixture.size;
        let length = depth - FITTINGS.front - 0.06;
        let (middle, tall) = ((low + high) / 2.0, high - low);
        if width < 0.15 || length < 0.15 || tall < 0.06 {
            return None;
        }
        let drawer = Drawer {
            unit: &fixture.name,
            name,
            width,
            tall,
            length,
            at: [0.0, middle],
            travel: (length - 0.03).min(TRAVEL),
            handle: [HANDLE[1].min(width - 0.09), 0.0],
        };
        let main = FITTINGS.drawer(&mut self.urdf, &drawer);
        let (side, inside) = ((tall - 0.055).max(0.04), width - 2.0 * BOARD - 0.03);
        let block: Block = (
            [-length / 2.0, 0.0, middle],
            [length, inside, side],
            "inner",
        );
        self.note(fixture, [Self::front(fixture), 0.0], &[block]);
        Some((main, fixture.at[2] + middle, tall))
    }

    fn cabinet(&mut self, fixture: &Fixture, doors: Doors, handle: HandlePlace, is_knob: bool) {
        let [width, depth, height] = fixture.size;
        let half = height / 2.0;
        let mut blocks = Self::carcass(
            [width, depth],
            [-half, half],
            BOARD,
            !fixture.is_covered,
            "body",
        );
        let boards = (height / 0.45).round().max(1.0) as u32;
        for number in 1..boards {
            let height = -half + height * f64::from(number) / f64::from(boards);
            blocks.push(Self::board([width, depth], height, BOARD));
        }
        blocks.extend(Self::base(fixture));
        self.body(fixture, [Self::front(fixture), 0.0], &blocks);
        let handle_at = match handle {
            HandlePlace::Bottom => 0.15,
            HandlePlace::Middle => 0.5,
            HandlePlace::Top => 0.85,
        };
        self.doors(
            fixture,
            &fixture.name,
            doors,
            [-half, half],
            handle_at,
            is_knob,
        );
    }

    /// The doors of a body; the joint of the last one, if there is room for any.
    fn doors(
        &mut self,
        fixture: &Fixture,
        unit: &str,
        doors: Doors,
        span: [f64; 2],
        handle_at: f64,
        is_knob: bool,
    ) -> Option<String> {
        let width = fixture.size[0];
        let all = match doors {
            Doors::One { is_left } => vec![(unit.to_owned(), is_left, width, 0.0)],
            Doors::Pair => vec![
                (format!("{unit}_left"), true, width / 2.0, -width / 4.0),
                (format!("{unit}_right"), false, width / 2.0, width / 4.0),
            ],
        };
        if span[1] - span[0] < 0.1 || width < 0.15 {
            return None;
        }
        let mut last = None;
        for (name, is_left, width, across) in all {
            let door = Door {
                unit,
                name: &name,
                is_left,
                width,
                across,
                span,
                handle_at,
                handle_length: if is_knob { KNOB } else { HANDLE },
            };
            FITTINGS.door(&mut self.urdf, &door);
            last = Some(format!("{name}_door_joint"));
        }
        last
    }

    fn shelves(&mut self, fixture: &Fixture, count: usize) {
        let [width, depth, height] = fixture.size;
        let mut blocks: Vec<Block> = vec![(
            [-depth / 2.0 + BOARD / 2.0, 0.0, 0.0],
            [BOARD, width, height],
            "body",
        )];
        for number in 0..count {
            let share = number as f64 / count as f64;
            let up = -height / 2.0 + BOARD / 2.0 + share * height;
            blocks.push((
                [BOARD / 2.0, 0.0, up],
                [depth - BOARD, width, BOARD],
                "inner",
            ));
        }
        self.body(fixture, [0.0; 2], &blocks);
    }

    fn housing(&mut self, fixture: &Fixture, frame: &[[f64; 2]; 3]) {
        let [width, depth, height] = fixture.size;
        let thick = |axis: usize, end: usize| frame[axis][end].max(0.0);
        let inner = width - thick(0, 0) - thick(0, 1);
        let shift = (thick(0, 0) - thick(0, 1)) / 2.0;
        let tall = height - thick(2, 0) - thick(2, 1);
        let up = (thick(2, 0) - thick(2, 1)) / 2.0;
        let mut blocks: Vec<Block> = vec![
            (
                [0.0, (thick(0, 0) - width) / 2.0, 0.0],
                [depth, thick(0, 0), height],
                "front",
            ),
            (
                [0.0, (width - thick(0, 1)) / 2.0, 0.0],
                [depth, thick(0, 1), height],
                "front",
            ),
            (
                [0.0, shift, (thick(2, 0) - height) / 2.0],
                [depth, inner, thick(2, 0)],
                "front",
            ),
            (
                [0.0, shift, (height - thick(2, 1)) / 2.0],
                [depth, inner, thick(2, 1)],
                "front",
            ),
            (
                [(thick(1, 1) - depth) / 2.0, shift, up],
                [thick(1, 1), inner, tall],
                "front",
            ),
        ];
        blocks.retain(|(_, size, _)| size.iter().all(|length| *length > 2e-3));
        self.body(fixture, [0.0; 2], &blocks);
    }

    /// An appliance with a flap at its front, so far (m) above its lower end and below its upper one.
    fn oven(&mut self, fixture: &Fixture, [below, above]: [f64; 2]) {
        let [width, depth, height] = fixture.size;
        let half = height / 2.0;
        let (low, high) = (-half + below, half - above);
        if high - low < 0.15 || width < 0.25 {
            let block: Block = ([0.0; 3], [depth, width, height], "steel");
            self.body(fixture, [0.0; 2], &[block]);
            return;
        }
        let deep = depth - FITTINGS.front;
        let mut blocks = Self::carcass([width, depth], [low, high], WALL, true, "steel");
        blocks.push((
            [-deep / 2.0, 0.0, -half + below / 2.0],
            [deep, width, below],
            "steel",
        ));
        blocks.push((
            [FITTINGS.front / 2.0 - deep / 2.0, 0.0, half - above / 2.0],
            [depth, width, above],
            "steel",
        ));
        blocks.push(Self::board([width, depth], (low + high) / 2.0, WALL));
        self.body(fixture, [Self::front(fixture), 0.0], &blocks);
        let flap = Flap {
            unit: &fixture.name,
            name: &fixture.name,
            width,
            span: [low, high],
        };
        FITTINGS.flap(&mut self.urdf, &flap);
    }

    fn microwave(&mut self, fixture: &Fixture) {
        let [width, depth, height] = fixture.size;
        let half = height / 2.0;
        // The buttons are at the right of the door.
        let panel = 0.22 * width;
        let deep = depth - FITTINGS.front;
        let mut blocks = Self::carcass([width - panel, depth], [-half, half], WALL, true, "steel");
        for (middle, ..) in &mut blocks {
            middle[1] -= panel / 2.0;
        }
        blocks.push((
            [
                FITTINGS.front / 2.0 - deep / 2.0,
                (width - panel) / 2.0,
                0.0,
            ],
            [depth, panel, height],
            "steel",
        ));
        self.body(fixture, [Self::front(fixture), 0.0], &blocks);
        let door = Door {
            unit: &fixture.name,
            name: &fixture.name,
            is_left: true,
            width: width - panel,
            across: -panel / 2.0,
            span: [-half, half],
            handle_at: 0.5,
            handle_length: HANDLE,
        };
        FITTINGS.door(&mut self.urdf, &door);
    }

    fn sink(&mut self, fixture: &Fixture) {
        let [width, depth, height] = fixture.size;
        let (wall, middle) = (0.008, -height / 2.0);
        let [right, front] = [(width - wall) / 2.0, (depth - wall) / 2.0];
        let blocks: [Block; 5] = [
            (
                [0.0, 0.0, -height + wall / 2.0],
                [depth, width, wall],
                "steel",
            ),
            ([front, 0.0, middle], [wall, width, height], "steel"),
            ([-front, 0.0, middle], [wall, width, height], "steel"),
            (
                [0.0, right, middle],
                [depth - 2.0 * wall, wall, height],
                "steel",
            ),
            (
                [0.0, -right, middle],
                [depth - 2.0 * wall, wall, height],
                "steel",
            ),
        ];
        self.body(fixture, [0.0, height / 2.0], &blocks);
        self.inventory
            .sink
            .get_or_insert_with(|| fixture.name.clone());
    }

    fn fridge(&mut self, fixture: &Fixture, kind: Fridge) {
        let [width, depth, height] = fixture.size;
        let half = height / 2.0;
        let deep = depth - FITTINGS.front;
        let foot = -half + 0.06;
        // The freezer takes a third, or stands beside the fridge.
        let low = match kind {
            Fridge::SideBySide => foot,
            _ => foot + (height - 0.06) * 0.35,
        };
        let front = Self::front(fixture);
        let mut blocks: Vec<Block> = vec![(
            [-deep / 2.0, 0.0, (foot - half) / 2.0],
            [deep, width, foot + half],
            "steel",
        )];
        if kind != Fridge::SideBySide {
            let freezer = [foot, low - 0.01];
            blocks.extend(Self::carcass([width, depth], freezer, WALL, true, "steel"));
        }
        self.body(fixture, [front, 0.0], &blocks);
        let mut inside = Self::carcass([width, depth], [low, half], WALL, true, "white");
        if kind == Fridge::SideBySide {
            let size = [deep - 0.06, WALL, half - low - 2.0 * WALL];
            inside.push(([-deep / 2.0 - 0.01, 0.0, (low + half) / 2.0], size, "white"));
        }
        let boards = 3;
        for number in 1..boards {
            let share = f64::from(number) / f64::from(boards);
            let up = low + (half - low) * share;
            match kind {
                Fridge::SideBySide => {
                    for side in [-1.0, 1.0] {
                        let across = [width / 2.0 - WALL * 1.5, depth];
                        let (mut middle, size, material) = Self::board(across, up, 0.0);
                        middle[1] += side * (width / 4.0 - WALL / 4.0);
                        inside.push((middle, size, material));
                    }
                }
                _ => inside.push(Self::board([width, depth], up, WALL)),
            }
        }
        let main = format!("{}_main", fixture.name);
        self.urdf
            .link(&main, Joint::fixed(&fixture.name, [0.0; 3], 0.0), &inside);
        let doors = match kind {
            Fridge::BottomFreezer => Doors::One { is_left: false },
            _ => Doors::Pair,
        };
        let joint = self.doors(fixture, &main, doors, [low, half], 0.4, false);
        if kind != Fridge::SideBySide {
            let name = format!("{}_freezer", fixture.name);
            // Nobody looks for cutlery there.
            self.slide(fixture, &name, [foot, low - 0.01]);
        }
        if self.inventory.fridge.is_none() {
            self.inventory.usual_joint = joint;
            self.inventory.fridge = Some(main);
        }
    }

    /// A table, or a stool.
    fn on_legs(&mut self, fixture: &Fixture, is_table: bool) {
        let is_dining_table = fixture.name.starts_with("dining");
        if is_table && (is_dining_table || self.inventory.table.is_none()) {
            self.inventory.table = Some(fixture.name.clone());
        }
        let [width, depth, height] = fixture.size;
        let seat = 0.04;
        let mut blocks: Vec<Block> = vec![(
            [0.0, 0.0, (height - seat) / 2.0],
            [depth, width, seat],
            "wood",
        )];
        for [a, b] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
            let at = [
                a * (depth / 2.0 - 0.03),
                b * (width / 2.0 - 0.03),
                -seat / 2.0,
            ];
            blocks.push((at, [0.035, 0.035, height - seat], "wood"));
        }
        self.body(fixture, [0.0; 2], &blocks);
    }

    /// Which fixtures overlap by more than a millimetre, in words.
    fn overlaps(&self, fixtures: &[Fixture]) -> Option<String> {
        let mut of_each: Vec<Vec<&Solid>> = fixtures.iter().map(|_| Vec::new()).collect();
        for solid in &self.solids {
            of_each[solid.fixture].push(solid);
        }
        let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
        for one in 0..fixtures.len() {
            for other in one + 1..fixtures.len() {
                let solids = of_each[one]
                    .iter()
                    .flat_map(|a| of_each[other].iter().map(move |b| (a, b)));
                let depths = solids.map(|(a, b)| {
                    let depths =
                        [0, 1, 2].map(|i| a.high[i].min(b.high[i]) - a.low[i].max(b.low[i]));
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
}
