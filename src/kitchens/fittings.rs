//! Fronts with their handles: drawers, doors and flaps, as links.

use std::f64::consts::FRAC_PI_2;

use crate::furniture::{BOARD, GAP};
use crate::urdf::{Block, Joint, Moves, Urdf};

/// What the fronts of a kitchen have in common (m).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fittings {
    /// Thickness of fronts.
    pub(crate) front: f64,
    /// Thickness of the bars of handles.
    pub(crate) bar: f64,
    /// Distance of the bars from the front.
    pub(crate) ahead: f64,
}

/// A drawer. It is joined to a link whose x axis looks out of the carcass, and is 0 at its front.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawer<'a> {
    /// The link that it is joined to.
    pub(crate) unit: &'a str,
    /// The name before `_main` and `_handle`.
    pub(crate) name: &'a str,
    /// Width of the carcass, height of the front, length of the box (m).
    pub(crate) width: f64,
    pub(crate) tall: f64,
    pub(crate) length: f64,
    /// Where the middle of its front is: to the right, and up (m).
    pub(crate) at: [f64; 2],
    /// How far it slides (m).
    pub(crate) travel: f64,
    /// Length of its handle, and how far that is above the middle (m).
    pub(crate) handle: [f64; 2],
}

/// A door. It is joined to a link as a drawer is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Door<'a> {
    /// The link that it is joined to.
    pub(crate) unit: &'a str,
    /// The name before `_door`.
    pub(crate) name: &'a str,
    /// Whether its hinge is at the left.
    pub(crate) is_left: bool,
    /// Its width, and how far its middle is to the right (m).
    pub(crate) width: f64,
    pub(crate) across: f64,
    /// Where it begins and ends, in the frame of the link (m).
    pub(crate) span: [f64; 2],
    /// The share of its height at which the middle of its handle is.
    pub(crate) handle_at: f64,
    /// How long its handle is at least and at most (m).
    pub(crate) handle_length: [f64; 2],
}

/// A flap that opens downwards, such as that of an oven. It is joined to a link as a drawer is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flap<'a> {
    /// The link that it is joined to.
    pub(crate) unit: &'a str,
    /// The name before `_door`.
    pub(crate) name: &'a str,
    /// Its width (m).
    pub(crate) width: f64,
    /// Where it begins and ends, in the frame of the link (m).
    pub(crate) span: [f64; 2],
}

impl Fittings {
    /// The bar of a handle and its posts, along y or z.
    fn handle(&self, length: f64, is_upright: bool) -> Vec<Block> {
        let thick = self.bar;
        let along = |length: f64| match is_upright {
            true => [thick, thick, length],
            false => [thick, length, thick],
        };
        let post = self.ahead;
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

    /// Adds a drawer with a lying handle. Returns the name of its link.
    pub(crate) fn drawer(&self, urdf: &mut Urdf, drawer: &Drawer<'_>) -> String {
        let Drawer {
            unit,
            name,
            width,
            tall,
            length,
            at: [across, middle],
            travel,
            handle: [bar, above],
        } = *drawer;
        let inner = width - 2.0 * BOARD - 0.03;
        // What is inside ends below the drawer above.
        let side = (tall - 0.055).max(0.04);
        let bottom = -tall / 2.0 + 0.025;
        let walls = bottom + side / 2.0 + 0.005;
        let blocks: [Block; 5] = [
            (
                [self.front / 2.0, 0.0, 0.0],
                [self.front, width - GAP, tall - GAP],
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
        let joint = Joint {
            parent: unit,
            at: [0.0, across, middle],
            yaw: 0.0,
            moves: Moves::Slides(travel),
        };
        urdf.link(&main, joint, &blocks);
        let ahead = self.front + self.ahead + self.bar / 2.0;
        urdf.link(
            &format!("{name}_handle"),
            Joint::fixed(&main, [ahead, 0.0, above], 0.0),
            &self.handle(bar, false),
        );
        main
    }

    /// Adds a door with an upright handle.
    pub(crate) fn door(&self, urdf: &mut Urdf, door: &Door<'_>) {
        let Door {
            unit,
            name,
            is_left,
            width,
            across,
            span: [low, high],
            handle_at: share,
            handle_length: lengths,
        } = *door;
        let side = if is_left { -1.0 } else { 1.0 };
        let tall = high - low - GAP;
        let door = format!("{name}_door");
        // The hinge is at the outer edge.
        let panel: Block = (
            [-self.front / 2.0, -side * width / 2.0, 0.0],
            [self.front, width - GAP, tall],
            "front",
        );
        let joint = Joint {
            parent: unit,
            at: [self.front, across + side * width / 2.0, (low + high) / 2.0],
            yaw: 0.0,
            moves: Moves::Turns {
                is_left,
                angle: FRAC_PI_2,
            },
        };
        urdf.link(&door, joint, &[panel]);
        let length = lengths[1].min(tall * 0.8).max(lengths[0].min(tall * 0.9));
        let most = ((tall - length) / 2.0 - 0.02).max(0.0);
        let up = ((share - 0.5) * tall).clamp(-most, most);
        let ahead = self.ahead + self.bar / 2.0;
        let place = [ahead, -side * (width - 0.045), up];
        urdf.link(
            &format!("{name}_door_handle"),
            Joint::fixed(&door, place, 0.0),
            &self.handle(length, true),
        );
    }

    /// Adds a flap with a lying handle near its upper edge.
    pub(crate) fn flap(&self, urdf: &mut Urdf, flap: &Flap<'_>) {
        let Flap {
            unit,
            name,
            width,
            span: [low, high],
        } = *flap;
        let tall = high - low - GAP;
        let door = format!("{name}_door");
        // The hinge is at the lower edge.
        let panel: Block = (
            [-self.front / 2.0, 0.0, tall / 2.0],
            [self.front, width - GAP, tall],
            "front",
        );
        let joint = Joint {
            parent: unit,
            at: [self.front, 0.0, low + GAP / 2.0],
            yaw: 0.0,
            moves: Moves::Falls(FRAC_PI_2),
        };
        urdf.link(&door, joint, &[panel]);
        let place = [self.ahead + self.bar / 2.0, 0.0, tall - 0.05];
        urdf.link(
            &format!("{name}_door_handle"),
            Joint::fixed(&door, place, 0.0),
            &self.handle((width - 0.1).min(0.5), false),
        );
    }
}
