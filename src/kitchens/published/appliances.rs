//! Appliances of a layout: ovens and the like, fridges, sinks.

use super::cabinets::{FITTINGS, HANDLE};
use super::fixture::{Doors, Fixture, Fridge};
use super::furnish::{Maker, WALL};
use crate::fittings::{Door, Flap};
use crate::urdf::{Block, Joint};

impl Maker {
    /// An appliance with a flap at its front, so far (m) above its lower end and below its upper one.
    pub(super) fn oven(&mut self, fixture: &Fixture, [below, above]: [f64; 2]) {
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

    /// A box whose door is at the left of its buttons.
    pub(super) fn microwave(&mut self, fixture: &Fixture) {
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

    /// A basin, open at the top.
    pub(super) fn sink(&mut self, fixture: &Fixture) {
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

    /// A fridge with boards, and a freezer below or beside it.
    pub(super) fn fridge(&mut self, fixture: &Fixture, kind: Fridge) {
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

    /// A flat hood below a chimney.
    pub(super) fn hood(&mut self, fixture: &Fixture) {
        let [width, depth, height] = fixture.size;
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
}
