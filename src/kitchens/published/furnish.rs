//! Furniture of a layout: its fixtures as links.

use super::fixture::{Counter, Fixture, Kind, turned};
use super::layout::Layout;
use super::overlaps::{Solid, overlaps};
use super::room::Room;
use super::{LayoutError, Published};
use crate::description::description;
use crate::furniture::{COLORS, FOOT, Inventory, materials};
use crate::urdf::{Block, Joint, Urdf};
use std::f64::consts::FRAC_PI_2;

/// Thickness (m) of tops of counters.
const TOP: f64 = 0.03;
/// Thickness (m) of the walls of appliances and of what separates compartments.
pub(super) const WALL: f64 = 0.03;

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
    remarks.extend(overlaps(&maker.solids, &layout.fixtures));
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

/// Makes links of fixtures.
pub(super) struct Maker {
    pub(super) urdf: Urdf,
    pub(super) inventory: Inventory,
    solids: Vec<Solid>,
    /// The number of the fixture that is being made.
    number: usize,
}

impl Maker {
    /// Adds the fixed part of a fixture. Its x axis looks out of the front, and is 0 so far (m) ahead of the middle and
    /// so far above it.
    pub(super) fn body(&mut self, fixture: &Fixture, [ahead, up]: [f64; 2], blocks: &[Block]) {
        self.body_that_shows(fixture, [ahead, up], blocks, blocks);
    }

    /// The same for one that shows other blocks than those that are solid.
    pub(super) fn body_that_shows(
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
    pub(super) fn note(&mut self, fixture: &Fixture, [ahead, up]: [f64; 2], blocks: &[Block]) {
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

    /// Adds all links of a fixture.
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
            Kind::Solid => self.solid(fixture),
            Kind::Panel => self.panel(fixture),
            Kind::Housing(frame) => self.housing(fixture, frame),
            Kind::Stove => self.oven(fixture, [0.12, 0.11]),
            Kind::Oven => self.oven(fixture, [0.05, 0.09]),
            Kind::Dishwasher => self.oven(fixture, [0.12, WALL]),
            Kind::Microwave => self.microwave(fixture),
            Kind::Stovetop => {
                let plate: Block = ([0.0; 3], [depth, width, 0.001], "glass");
                self.body_that_shows(fixture, [0.0, height / 2.0], &[], &[plate]);
            }
            Kind::Hood => self.hood(fixture),
            Kind::Sink => self.sink(fixture),
            Kind::Fridge(kind) => self.fridge(fixture, *kind),
            Kind::OnLegs { is_table } => self.on_legs(fixture, *is_table),
            Kind::Wall { is_foot } => self.wall(fixture, *is_foot),
        }
    }

    /// A box.
    fn solid(&mut self, fixture: &Fixture) {
        let [width, depth, height] = fixture.size;
        let front = Self::front(fixture);
        let block: Block = ([-front, 0.0, 0.0], [depth, width, height], "front");
        let blocks: Vec<Block> = [block].into_iter().chain(Self::base(fixture)).collect();
        self.body(fixture, [front, 0.0], &blocks);
    }

    /// A wall; of one that would hide the room, only the foot is shown, if it has one.
    fn wall(&mut self, fixture: &Fixture, is_foot: bool) {
        let [width, depth, height] = fixture.size;
        let block: Block = ([0.0; 3], [depth, width, height], "wall");
        let foot = FOOT.min(height);
        let foot: Block = (
            [0.0, 0.0, (foot - height) / 2.0],
            [depth, width, foot],
            "wall",
        );
        let stands = fixture.span()[0] < 0.1;
        let shown: &[Block] = match (is_foot, stands) {
            (true, true) => &[foot],
            (true, false) => &[],
            (false, _) => &[block],
        };
        self.body_that_shows(fixture, [0.0; 2], &[block], shown);
    }

    /// A top, with what carries it.
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
                // Two ends carry it, with a panel between them in the middle: half of the depth is for legs, the other half for cabinets.
                let end = 0.1_f64.min(width / 4.0);
                for side in [-1.0, 1.0] {
                    blocks.push((
                        [(edge - front) / 2.0, side * (right - end / 2.0), under],
                        [edge + front, end, tall],
                        "front",
                    ));
                }
                let size = [WALL, width - 2.0 * end, tall];
                blocks.push(([0.0, 0.0, under], size, "front"));
                if !counter.is_filled {
                    let closed = match counter.opening[0] {
                        true => -front + WALL / 2.0,
                        false => edge - WALL / 2.0,
                    };
                    blocks.push(([closed, 0.0, under], size, "front"));
                }
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
}
