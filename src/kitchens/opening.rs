//! What of the furniture opens: drawers and doors, with their handles.

use std::f64::consts::FRAC_PI_2;

use crate::furniture::{BOARD, GAP, Maker};
use crate::modules::Module;
use crate::plan::{ASIDE, Row};
use crate::urdf::{Block, Joint, Moves};

/// A door.
#[derive(Clone, Copy, Debug)]
pub(super) struct Door<'a> {
    /// The link that it is joined to.
    pub(super) unit: &'a str,
    /// The name before `_door`.
    pub(super) name: &'a str,
    /// Whether its hinge is at the left.
    pub(super) is_left: bool,
    /// Its width (m).
    pub(super) width: f64,
    /// Where it begins and ends above the floor (m).
    pub(super) span: [f64; 2],
    /// The share of its height at which the middle of its handle is.
    pub(super) handle_at: f64,
    /// How long its handle is at least and at most (m).
    pub(super) handle_length: [f64; 2],
}

impl Maker<'_> {
    /// The bar of a handle and its posts, along y or z.
    fn handle(&self, length: f64, is_upright: bool) -> Vec<Block> {
        let style = self.plan.style;
        let thick = style.bar;
        let along = |length: f64| match is_upright {
            true => [thick, thick, length],
            false => [thick, length, thick],
        };
        let post = style.ahead;
        let mut blocks: Vec<Block> = vec![([0.0; 3], along(length), "handle")];
        for end in [-1.0, 1.0] {
            let far = end * (length - thick) / 2.0;
            let at = match is_upright {
                true => [-(thick + post) / 2.0, 0.0, far],
                false => [-(thick + post) / 2.0, far, 0.0],
            };
            blocks.push((at, [post, thick, thick], "handle"));
        }
        blocks
    }

    pub(super) fn drawers(
        &mut self,
        unit: &str,
        width: f64,
        [low, high]: [f64; 2],
        shares: &[f64],
    ) {
        let style = self.plan.style;
        let length = (style.depth - 0.08).min(style.travel + 0.04);
        let mut from = low;
        let count = shares.len();
        for (number, share) in shares.iter().enumerate() {
            let tall = (high - low) * share;
            let middle = from + tall / 2.0;
            let name = format!("{unit}_drawer_{}", count - number);
            let inner = width - 2.0 * BOARD - 0.03;
            // What is inside ends below the drawer above.
            let side = (tall - 0.055).max(0.04);
            let bottom = -tall / 2.0 + 0.025;
            let walls = bottom + side / 2.0 + 0.005;
            let blocks: [Block; 5] = [
                (
                    [style.front / 2.0, 0.0, 0.0],
                    [style.front, width - GAP, tall - GAP],
                    "front",
                ),
                (
                    [-length / 2.0, 0.0, bottom],
                    [length, inner, 0.012],
                    "inner",
                ),
                (
                    [-length / 2.0, (inner - 0.014) / 2.0, walls],
                    [length, 0.014, side],
                    "inner",
                ),
                (
                    [-length / 2.0, -(inner - 0.014) / 2.0, walls],
                    [length, 0.014, side],
                    "inner",
                ),
                (
                    [-length + 0.007, 0.0, walls],
                    [0.014, inner - 0.028, side],
                    "inner",
                ),
            ];
            let main = format!("{name}_main");
            let way = style.travel.min(length);
            self.urdf.link(
                &main,
                Joint {
                    parent: unit,
                    at: [0.0, 0.0, middle],
                    yaw: 0.0,
                    moves: Moves::Slides(way),
                },
                &blocks,
            );
            let bar = (width - 0.09).min(self.numbers.between("handle.length", 0.16, 0.6));
            let place = match self.numbers.flag("handle.middle", 0.4) {
                true => 0.0,
                false => (tall / 2.0 - 0.045).max(0.0),
            };
            let ahead = style.front + style.ahead + style.bar / 2.0;
            let blocks = self.handle(bar, false);
            let handle = format!("{name}_handle");
            self.urdf.link(
                &handle,
                Joint::fixed(&main, [ahead, 0.0, place], 0.0),
                &blocks,
            );
            self.inventory.drawers.push((main, middle, tall));
            from += tall;
        }
    }

    /// A door with an upright handle.
    pub(super) fn door(&mut self, door: &Door<'_>) {
        let Door {
            unit,
            name,
            is_left,
            width,
            span: [low, high],
            handle_at: share,
            handle_length: lengths,
        } = *door;
        let style = self.plan.style;
        let side = if is_left { -1.0 } else { 1.0 };
        let tall = high - low - GAP;
        let door = format!("{name}_door");
        // The hinge is at the outer edge.
        let panel: Block = (
            [-style.front / 2.0, -side * width / 2.0, 0.0],
            [style.front, width - GAP, tall],
            "front",
        );
        let moves = Moves::Turns {
            is_left,
            angle: FRAC_PI_2,
        };
        let at = [style.front, side * width / 2.0, (low + high) / 2.0];
        self.urdf.link(
            &door,
            Joint {
                parent: unit,
                at,
                yaw: 0.0,
                moves,
            },
            &[panel],
        );
        let length = lengths[1].min(tall * 0.8).max(lengths[0].min(tall * 0.9));
        let up = ((share - 0.5) * tall)
            .clamp(-(tall - length) / 2.0 + 0.02, (tall - length) / 2.0 - 0.02);
        let ahead = style.ahead + style.bar / 2.0;
        let place = [ahead, -side * (width - 0.045), up];
        let blocks = self.handle(length, true);
        let handle = format!("{name}_door_handle");
        self.urdf
            .link(&handle, Joint::fixed(&door, place, 0.0), &blocks);
    }

    /// Whether the door of a cabinet on the wall has room to open.
    pub(super) fn opens(&self, row: &Row, module: &Module, is_left: bool) -> bool {
        let style = self.plan.style;
        let depth = style.hanging[2];
        let (from, to) = (module.at, module.at + module.width);
        let aside = match is_left {
            true => [from - ASIDE, to],
            false => [from, to + ASIDE],
        };
        let ahead = depth + module.width + style.front + style.ahead + style.bar;
        let needed = row.rectangle([depth + 0.03, aside[0]], [ahead, aside[1]]);
        let mut others = self.plan.rows.iter().flat_map(|other| {
            let modules = other.modules.iter();
            modules.filter_map(move |one| {
                let depth = match one.unit.is_tall() {
                    true => style.depth + 0.08,
                    false if other.name != row.name && other.has_wall => depth + 0.08,
                    false => return None,
                };
                Some(other.rectangle([0.0, one.at], [depth, one.at + one.width]))
            })
        });
        needed.is_inside(&self.plan.room) && !others.any(|other| other.overlaps(&needed))
    }
}
