//! Cabinets of a layout: what has a carcass, with drawers, doors and boards.

use super::fixture::{Doors, Fixture, HandlePlace};
use super::furnish::Maker;
use crate::fittings::{Door, Drawer, Fittings};
use crate::furniture::{BOARD, GAP};
use crate::urdf::Block;

/// Fronts and handles; RoboCasa's panels are as thick, its handles are in its meshes.
pub(super) const FITTINGS: Fittings = Fittings {
    front: 0.02,
    bar: 0.012,
    ahead: 0.035,
};
/// Lengths (m) of handles of doors, and of knobs.
pub(super) const HANDLE: [f64; 2] = [0.1, 0.24];
const KNOB: [f64; 2] = [0.03, 0.03];
/// How far (m) bases are set back.
const SET_BACK: f64 = 0.07;
/// Longest way (m) of a drawer.
const TRAVEL: f64 = 0.45;

impl Maker {
    /// How far (m) ahead of the middle the frame of something with fronts is.
    pub(super) fn front(fixture: &Fixture) -> f64 {
        fixture.size[1] / 2.0 - FITTINGS.front
    }

    /// The base on which a fixture stands, in the frame of its front.
    pub(super) fn base(fixture: &Fixture) -> Option<Block> {
        let [width, depth, height] = fixture.size;
        let deep = depth - SET_BACK;
        (fixture.base > 0.0 && deep > 0.0).then(|| {
            let middle = FITTINGS.front - SET_BACK - deep / 2.0;
            let size = [deep, width, fixture.base];
            ([middle, 0.0, -(height + fixture.base) / 2.0], size, "body")
        })
    }

    /// A box that is open at the front, in the frame of its front, from a height to another one.
    pub(super) fn carcass(
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

    /// The carcass of a fixture on its base. Where a counter or another carcass stands on it, it has no top.
    fn cupboard(fixture: &Fixture) -> Vec<Block> {
        let [width, depth, height] = fixture.size;
        let half = height / 2.0;
        let has_top = !fixture.is_covered;
        let mut blocks = Self::carcass([width, depth], [-half, half], BOARD, has_top, "body");
        blocks.extend(Self::base(fixture));
        blocks
    }

    /// A carcass behind a panel that does not open.
    pub(super) fn panel(&mut self, fixture: &Fixture) {
        let [width, _, height] = fixture.size;
        let mut blocks = Self::cupboard(fixture);
        let size = [FITTINGS.front, width - GAP, height - GAP];
        blocks.push(([FITTINGS.front / 2.0, 0.0, 0.0], size, "front"));
        self.body(fixture, [Self::front(fixture), 0.0], &blocks);
    }

    /// A board in such a box.
    pub(super) fn board([width, depth]: [f64; 2], height: f64, thick: f64) -> Block {
        let deep = depth - FITTINGS.front - 0.06;
        (
            [-deep / 2.0 - 0.05, 0.0, height],
            [deep - 0.03, width - 2.0 * thick, 0.016],
            "inner",
        )
    }

    /// A carcass with a drawer.
    pub(super) fn drawer(&mut self, fixture: &Fixture) {
        let half = fixture.size[2] / 2.0;
        self.body(
            fixture,
            [Self::front(fixture), 0.0],
            &Self::cupboard(fixture),
        );
        let drawer = self.slide(fixture, &fixture.name, [-half, half]);
        self.inventory.drawers.extend(drawer);
    }

    /// A drawer between two heights of a body, with the height of its middle above the floor and its own, if there is room
    /// for one.
    pub(super) fn slide(
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

    /// A carcass with doors, and a board for each 45 cm of its height.
    pub(super) fn cabinet(
        &mut self,
        fixture: &Fixture,
        doors: Doors,
        handle: HandlePlace,
        is_knob: bool,
    ) {
        let [width, depth, height] = fixture.size;
        let half = height / 2.0;
        let mut blocks = Self::cupboard(fixture);
        let boards = (height / 0.45).round().max(1.0) as u32;
        for number in 1..boards {
            let height = -half + height * f64::from(number) / f64::from(boards);
            blocks.push(Self::board([width, depth], height, BOARD));
        }
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
    pub(super) fn doors(
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

    /// So many boards before a back.
    pub(super) fn shelves(&mut self, fixture: &Fixture, count: usize) {
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

    /// A frame of boards, so thick on all sides; one that is thinner than 2 mm is left out.
    pub(super) fn housing(&mut self, fixture: &Fixture, frame: &[[f64; 2]; 3]) {
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
}
