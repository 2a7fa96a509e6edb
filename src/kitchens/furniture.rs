//! The furniture of a plan: modules, counters, what hangs on walls, what stands free, as links.

use std::f64::consts::FRAC_PI_2;

use crate::draws::Numbers;
use crate::plan::{ASIDE, Module, Plan, Row, Standing, Unit};
use crate::urdf::{Block, Moves, Urdf};

/// Thickness (m) of boards, and gaps between fronts.
const BOARD: f64 = 0.018;
const GAP: f64 = 0.004;
/// Height (m) and thickness of walls.
const WALL: f64 = 0.1;
/// Height (m) of the foot of a wall.
const FOOT: f64 = 0.12;
/// How far (m) the counter stands out ahead of the carcasses.
const LEDGE: f64 = 0.02;

/// Colours of the fronts and the counters.
const COLORS: [[[f64; 3]; 2]; 5] = [
    [[0.275, 0.287, 0.27], [0.12, 0.11, 0.1]],
    [[0.62, 0.61, 0.58], [0.3, 0.2, 0.12]],
    [[0.12, 0.2, 0.24], [0.6, 0.58, 0.54]],
    [[0.36, 0.22, 0.12], [0.5, 0.5, 0.48]],
    [[0.2, 0.26, 0.18], [0.42, 0.3, 0.18]],
];

/// What a kitchen has, by the names of its links.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inventory {
    /// Counters, the longest first.
    pub(crate) counters: Vec<(f64, String)>,
    pub(crate) island: Option<String>,
    pub(crate) table: Option<String>,
    pub(crate) sink: Option<String>,
    pub(crate) fridge: Option<String>,
    /// Drawers with the heights (m) of their middles and of themselves.
    pub(crate) drawers: Vec<(String, f64, f64)>,
    /// The door of the fridge.
    pub(crate) usual_joint: Option<String>,
}

/// Writes a plan as a URDF.
pub(crate) fn write(plan: &Plan, numbers: &Numbers) -> (String, Inventory) {
    let [front, top] = COLORS[plan.style.color % COLORS.len()];
    let materials = [
        ("body", [0.03, 0.03, 0.03]),
        ("front", front),
        ("handle", [0.125, 0.115, 0.102]),
        ("inner", [0.285, 0.277, 0.285]),
        ("steel", [0.431, 0.431, 0.431]),
        ("glass", [0.025, 0.025, 0.025]),
        ("top", top),
        ("wall", [0.8, 0.8, 0.8]),
        ("white", [0.8, 0.8, 0.8]),
        ("wood", [0.4, 0.25, 0.13]),
    ];
    let mut maker = Maker {
        plan,
        numbers,
        urdf: Urdf::new("kitchen", &materials),
        inventory: Inventory::default(),
    };
    maker.room();
    for row in &plan.rows {
        maker.row(row);
    }
    if let Some(table) = &plan.table {
        maker.standing("table", table, "wood");
        maker.inventory.table = Some("table".to_owned());
    }
    for (number, stool) in plan.stools.iter().enumerate() {
        maker.standing(&format!("stool_{}", number + 1), stool, "wood");
    }
    let Maker {
        urdf,
        mut inventory,
        ..
    } = maker;
    inventory.counters.sort_by(|a, b| b.0.total_cmp(&a.0));
    (urdf.finish(), inventory)
}

struct Maker<'a> {
    plan: &'a Plan,
    numbers: &'a Numbers,
    urdf: Urdf,
    inventory: Inventory,
}

impl Maker<'_> {
    fn room(&mut self) {
        let [x, y] = self.plan.start;
        let (moves, none) = (Moves::Fixed, &[]);
        self.urdf
            .link("room", "world", [-x, -y, 0.0], 0.0, moves, none);
        let [width, far] = self.plan.room.high;
        let height = self.plan.style.ceiling;
        let [open, close] = self.plan.doorway;
        let half = WALL / 2.0;
        let wall = |from: f64, to: f64| -> Block {
            let middle = [(from + to) / 2.0, -half, height / 2.0];
            (middle, [(to - from).max(0.01), WALL, height], "wall")
        };
        let walls = [
            (
                "wall_back",
                vec![(
                    [width / 2.0, far + half, height / 2.0],
                    [width + 2.0 * WALL, WALL, height],
                    "wall",
                )],
            ),
            (
                "wall_left",
                vec![(
                    [-half, far / 2.0, height / 2.0],
                    [WALL, far, height],
                    "wall",
                )],
            ),
            (
                "wall_right",
                vec![(
                    [width + half, far / 2.0, height / 2.0],
                    [WALL, far, height],
                    "wall",
                )],
            ),
            (
                "wall_front",
                vec![wall(-WALL, open), wall(close, width + WALL)],
            ),
        ];
        for (name, blocks) in walls {
            // Of those that would hide the room from people, only the foot is shown.
            let is_foot = ["wall_front", "wall_left"].contains(&name);
            let shown = blocks.iter().map(|([x, y, z], [a, b, c], material)| {
                let foot = if is_foot { FOOT } else { *c };
                ([*x, *y, z - (c - foot) / 2.0], [*a, *b, foot], *material)
            });
            let shown: Vec<Block> = shown.collect();
            let at = [0.0; 3];
            self.urdf
                .link_that_shows(name, "room", at, 0.0, Moves::Fixed, &blocks, &shown);
        }
    }

    fn row(&mut self, row: &Row) {
        let style = self.plan.style;
        for (number, module) in row.modules.iter().enumerate() {
            if module.width >= 0.01 {
                self.module(row, number, module);
            }
        }
        // Counters end at what is tall.
        let parts = row.modules.split(|module| module.unit.is_tall());
        for (number, part) in parts.filter(|part| !part.is_empty()).enumerate() {
            let name = match number {
                0 => format!("{}_counter", row.name),
                _ => format!("{}_counter_{}", row.name, number + 1),
            };
            self.counter(row, &name, part);
        }
        if row.has_wall {
            for (number, module) in row.modules.iter().enumerate() {
                let name = format!("{}_{}_hanging", row.name, number + 1);
                self.hanging(row, &name, module);
            }
        }
        let _ = style;
    }

    /// The place of a frame whose x axis looks out of the fronts of a row.
    fn place(&self, row: &Row, ahead: f64, along: f64, height: f64) -> ([f64; 3], f64) {
        let [x, y] = row.point([ahead, along]);
        ([x, y, height], f64::from(row.turns) * FRAC_PI_2)
    }

    fn module(&mut self, row: &Row, number: usize, module: &Module) {
        let style = self.plan.style;
        let name = match module.unit {
            Unit::Fridge { .. } => "fridge".to_owned(),
            _ => format!("{}_{}", row.name, number + 1),
        };
        let (depth, width, low) = (style.depth, module.width, style.plinth);
        let high = match module.unit {
            Unit::Fridge { .. } => style.fridge,
            _ => style.height - style.top,
        };
        let (at, yaw) = self.place(row, depth, module.at + width / 2.0, 0.0);
        let half = width / 2.0 - BOARD / 2.0;
        let (middle, tall) = ((low + high) / 2.0, high - low);
        let mut blocks: Vec<Block> = vec![(
            [-depth / 2.0 - 0.025, 0.0, low / 2.0],
            [depth - 0.05, width, low],
            "body",
        )];
        let front = |from: f64, to: f64, material: &'static str| -> Block {
            let size = [style.front, width - GAP, to - from - GAP];
            ([style.front / 2.0, 0.0, (from + to) / 2.0], size, material)
        };
        let back = depth - 0.01;
        match module.unit {
            Unit::Drawers(_) | Unit::Door { .. } => {
                for side in [-half, half] {
                    blocks.push(([-depth / 2.0, side, middle], [depth, BOARD, tall], "body"));
                }
                let inner = width - 2.0 * BOARD;
                blocks.push(([-back, 0.0, middle], [0.02, inner, tall], "body"));
                blocks.push((
                    [-depth / 2.0, 0.0, low + BOARD / 2.0],
                    [depth - 0.04, inner, BOARD],
                    "body",
                ));
                if matches!(module.unit, Unit::Door { .. }) {
                    blocks.push((
                        [-depth / 2.0 - 0.03, 0.0, middle],
                        [depth - 0.1, inner, BOARD],
                        "inner",
                    ));
                }
            }
            Unit::Fridge { .. } => {}
            Unit::Sink => blocks.extend([
                // The basin hangs into it.
                front(low, high, "front"),
                ([-depth / 2.0, -half, middle], [depth, BOARD, tall], "body"),
                ([-depth / 2.0, half, middle], [depth, BOARD, tall], "body"),
            ]),
            Unit::Hob => blocks.extend([
                ([-depth / 2.0, 0.0, middle], [depth, width, tall], "body"),
                front(low, low + 0.12, "front"),
                front(low + 0.12, high, "glass"),
                (
                    [style.front + 0.03, 0.0, high - 0.1],
                    [0.016, width - 0.15, 0.016],
                    "handle",
                ),
            ]),
            Unit::Dishwasher | Unit::Panel => blocks.extend([
                ([-depth / 2.0, 0.0, middle], [depth, width, tall], "body"),
                front(low, high, "front"),
            ]),
        }
        if !module.unit.is_tall() {
            self.urdf
                .link(&name, "room", at, yaw, Moves::Fixed, &blocks);
        }
        match module.unit {
            Unit::Drawers(shares) => self.drawers(&name, width, [low, high], shares),
            Unit::Door { is_left } => {
                self.door(&name, &name, is_left, width, [low, high], 0.75, [0.12, 0.3]);
            }
            Unit::Fridge { is_left } => self.fridge(at, yaw, width, is_left),
            _ => {}
        }
    }

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

    fn drawers(&mut self, unit: &str, width: f64, [low, high]: [f64; 2], shares: &[f64]) {
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
                unit,
                [0.0, 0.0, middle],
                0.0,
                Moves::Slides(way),
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
                &main,
                [ahead, 0.0, place],
                0.0,
                Moves::Fixed,
                &blocks,
            );
            self.inventory.drawers.push((main, middle, tall));
            from += tall;
        }
    }

    /// A door with an upright handle: whose middle is at a share of its height, and how long at most.
    #[allow(clippy::too_many_arguments, reason = "a door is made of so many")]
    fn door(
        &mut self,
        unit: &str,
        name: &str,
        is_left: bool,
        width: f64,
        [low, high]: [f64; 2],
        share: f64,
        lengths: [f64; 2],
    ) {
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
        self.urdf.link(&door, unit, at, 0.0, moves, &[panel]);
        let length = lengths[1].min(tall * 0.8).max(lengths[0].min(tall * 0.9));
        let up = ((share - 0.5) * tall)
            .clamp(-(tall - length) / 2.0 + 0.02, (tall - length) / 2.0 - 0.02);
        let ahead = style.ahead + style.bar / 2.0;
        let place = [ahead, -side * (width - 0.045), up];
        let blocks = self.handle(length, true);
        let handle = format!("{name}_door_handle");
        self.urdf
            .link(&handle, &door, place, 0.0, Moves::Fixed, &blocks);
    }

    fn fridge(&mut self, at: [f64; 3], yaw: f64, width: f64, is_left: bool) {
        let style = self.plan.style;
        let (depth, high) = (style.depth, style.fridge);
        let low = self.numbers.between("fridge.bottom", 0.42, 0.6);
        let roof = (low + 0.95).min(high);
        let middle = |from: f64, to: f64| (from + to) / 2.0;
        let mut blocks: Vec<Block> = vec![
            (
                [-depth / 2.0, 0.0, low / 2.0 - 0.02],
                [depth, width, low - 0.04],
                "body",
            ),
            (
                [style.front / 2.0, 0.0, middle(style.plinth, low)],
                [style.front, width - GAP, low - style.plinth - GAP],
                "front",
            ),
        ];
        if high - roof > 0.05 {
            blocks.push((
                [-depth / 2.0, 0.0, middle(roof, high)],
                [depth, width, high - roof],
                "body",
            ));
        }
        self.urdf
            .link("fridge", "room", at, yaw, Moves::Fixed, &blocks);
        let (tall, wall) = (roof - low, 0.03);
        let inside = width - 2.0 * wall;
        let blocks: [Block; 5] = [
            (
                [-depth / 2.0, 0.0, low - 0.02],
                [depth, width, 0.04],
                "white",
            ),
            (
                [-depth / 2.0, 0.0, roof - 0.02],
                [depth, width, 0.04],
                "white",
            ),
            (
                [-depth / 2.0, (width - wall) / 2.0, middle(low, roof - 0.04)],
                [depth, wall, tall - 0.04],
                "white",
            ),
            (
                [
                    -depth / 2.0,
                    -(width - wall) / 2.0,
                    middle(low, roof - 0.04),
                ],
                [depth, wall, tall - 0.04],
                "white",
            ),
            (
                [-depth + 0.03, 0.0, middle(low, roof - 0.04)],
                [0.06, inside, tall - 0.04],
                "white",
            ),
        ];
        let main = "fridge_main";
        let mut blocks = blocks.to_vec();
        if self.numbers.flag("fridge.board", 0.6) {
            let board = low + self.numbers.between("fridge.board.height", 0.36, 0.46);
            blocks.push((
                [-depth / 2.0 - 0.06, 0.0, board],
                [depth - 0.24, inside, 0.012],
                "white",
            ));
        }
        self.urdf
            .link(main, "fridge", [0.0; 3], 0.0, Moves::Fixed, &blocks);
        self.door(
            main,
            "fridge",
            is_left,
            width,
            [low, roof],
            0.45,
            [0.3, 0.5],
        );
        self.inventory.fridge = Some(main.to_owned());
        self.inventory.usual_joint = Some("fridge_door_joint".to_owned());
    }

    /// A counter over modules, with a hole for the sink.
    fn counter(&mut self, row: &Row, name: &str, modules: &[Module]) {
        let style = self.plan.style;
        let (Some(first), Some(last)) = (modules.first(), modules.last()) else {
            return;
        };
        let (from, to) = (first.at, last.at + last.width);
        let length = to - from;
        if length < 0.05 {
            return;
        }
        let origin = (from + to) / 2.0;
        let (deep, thick) = (style.depth + LEDGE, style.top);
        let (at, yaw) = self.place(row, deep / 2.0, origin, style.height);
        let slab = |[a, b]: [f64; 2], [c, d]: [f64; 2]| -> Block {
            (
                [(a + b) / 2.0, (c + d) / 2.0, -thick / 2.0],
                [b - a, d - c, thick],
                "top",
            )
        };
        let (back, front) = (-deep / 2.0, deep / 2.0);
        let (start, end) = (from - origin, to - origin);
        let sink = modules.iter().find(|module| module.unit == Unit::Sink);
        let blocks = match sink {
            None => vec![slab([back, front], [start, end])],
            Some(sink) => {
                let (left, right) = (
                    sink.at - origin + 0.06,
                    sink.at + sink.width - origin - 0.06,
                );
                let (near, far) = (front - 0.09, back + 0.1);
                let at_sink = self.place(row, deep / 2.0, origin, style.height);
                self.basin(at_sink, [far, near], [left, right]);
                vec![
                    slab([back, front], [start, left]),
                    slab([back, front], [right, end]),
                    slab([near, front], [left, right]),
                    slab([back, far], [left, right]),
                ]
            }
        };
        self.urdf.link(name, "room", at, yaw, Moves::Fixed, &blocks);
        if row.name == "island" {
            self.inventory.island = Some(name.to_owned());
        }
        self.inventory.counters.push((length, name.to_owned()));
        for module in modules.iter().filter(|module| module.unit == Unit::Hob) {
            let along = module.at + module.width / 2.0;
            let (at, yaw) = self.place(row, deep / 2.0, along, style.height);
            // It is let in: what stands on it stands on the counter.
            let plate: Block = ([0.0, 0.0, 0.0], [0.5, module.width - 0.04, 0.001], "glass");
            self.urdf
                .link_that_shows("hob", "room", at, yaw, Moves::Fixed, &[], &[plate]);
        }
    }

    fn basin(&mut self, (at, yaw): ([f64; 3], f64), [a, b]: [f64; 2], [c, d]: [f64; 2]) {
        let deep = self.numbers.between("sink.depth", 0.13, 0.19);
        let (wall, rim) = (0.008, -0.002);
        let [x, y, z] = [(a + b) / 2.0, (c + d) / 2.0, rim - deep / 2.0];
        let blocks: [Block; 5] = [
            (
                [0.0, 0.0, -deep / 2.0 + wall / 2.0],
                [b - a, d - c, wall],
                "steel",
            ),
            (
                [(b - a - wall) / 2.0, 0.0, 0.0],
                [wall, d - c, deep],
                "steel",
            ),
            (
                [-(b - a - wall) / 2.0, 0.0, 0.0],
                [wall, d - c, deep],
                "steel",
            ),
            (
                [0.0, (d - c - wall) / 2.0, 0.0],
                [b - a - 2.0 * wall, wall, deep],
                "steel",
            ),
            (
                [0.0, -(d - c - wall) / 2.0, 0.0],
                [b - a - 2.0 * wall, wall, deep],
                "steel",
            ),
        ];
        // In the frame of the counter.
        let (sine, cosine) = match (yaw / FRAC_PI_2).round() as i64 % 4 {
            0 => (0.0, 1.0),
            1 => (1.0, 0.0),
            2 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        };
        let place = [
            at[0] + x * cosine - y * sine,
            at[1] + x * sine + y * cosine,
            at[2] + z,
        ];
        self.urdf
            .link("sink", "room", place, yaw, Moves::Fixed, &blocks);
        self.inventory.sink = Some("sink".to_owned());
    }

    /// Whether the door of a cabinet on the wall has room to open.
    fn opens(&self, row: &Row, module: &Module, is_left: bool) -> bool {
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

    /// A cabinet on the wall over a module, or the hood over the hob.
    fn hanging(&mut self, row: &Row, name: &str, module: &Module) {
        let style = self.plan.style;
        let [bottom, tall, depth] = style.hanging;
        let low = style.height + bottom;
        let high = (low + tall).min(style.ceiling - 0.05);
        let (at, yaw) = self.place(row, depth, module.at + module.width / 2.0, 0.0);
        let width = module.width;
        let middle = [-depth / 2.0, 0.0, (low + high) / 2.0];
        match module.unit {
            Unit::Hob => {
                let from = style.height + 0.68;
                let block: Block = (
                    [-depth / 2.0, 0.0, from + 0.1],
                    [depth, width, 0.2],
                    "steel",
                );
                self.urdf
                    .link("hood", "room", at, yaw, Moves::Fixed, &[block]);
            }
            Unit::Drawers(_) | Unit::Door { .. } | Unit::Dishwasher
                if self.numbers.flag(&format!("{name}.there"), 0.6)
                    && high - low > 0.35
                    && width <= 0.6 =>
            {
                let half = (width - BOARD) / 2.0;
                let inner = width - 2.0 * BOARD;
                let blocks: [Block; 6] = [
                    (
                        [middle[0], -half, middle[2]],
                        [depth, BOARD, high - low],
                        "body",
                    ),
                    (
                        [middle[0], half, middle[2]],
                        [depth, BOARD, high - low],
                        "body",
                    ),
                    (
                        [middle[0], 0.0, low + BOARD / 2.0],
                        [depth, inner, BOARD],
                        "body",
                    ),
                    (
                        [middle[0], 0.0, high - BOARD / 2.0],
                        [depth, inner, BOARD],
                        "body",
                    ),
                    (
                        [-depth + 0.01, 0.0, middle[2]],
                        [0.02, inner, high - low - 2.0 * BOARD],
                        "body",
                    ),
                    (
                        [middle[0], 0.0, low + 0.32],
                        [depth - 0.05, inner, BOARD],
                        "inner",
                    ),
                ];
                let count = if high - low > 0.6 { 6 } else { 5 };
                self.urdf
                    .link(name, "room", at, yaw, Moves::Fixed, &blocks[..count]);
                let wanted = self.numbers.flag(&format!("{name}.hinge"), 0.5);
                let mut hinges = [wanted, !wanted].into_iter();
                if let Some(is_left) = hinges.find(|is_left| self.opens(row, module, *is_left)) {
                    self.door(name, name, is_left, width, [low, high], 0.15, [0.1, 0.14]);
                }
            }
            _ => {}
        }
    }

    /// A table on legs, or a stool.
    fn standing(&mut self, name: &str, one: &Standing, material: &'static str) {
        let [x, y] = [0, 1].map(|i| (one.place.low[i] + one.place.high[i]) / 2.0);
        let [width, depth] = [0, 1].map(|i| one.place.high[i] - one.place.low[i]);
        let mut blocks: Vec<Block> = vec![([0.0, 0.0, -0.015], [width, depth, 0.03], material)];
        for a in [-1.0, 1.0] {
            for b in [-1.0, 1.0] {
                let at = [
                    a * (width / 2.0 - 0.04),
                    b * (depth / 2.0 - 0.04),
                    -0.03 - (one.height - 0.03) / 2.0,
                ];
                blocks.push((at, [0.05, 0.05, one.height - 0.03], material));
            }
        }
        self.urdf
            .link(name, "room", [x, y, one.height], 0.0, Moves::Fixed, &blocks);
    }
}
