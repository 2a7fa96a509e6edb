//! The furniture of a plan: modules, counters, what hangs on walls, what stands free, as links.

use std::f64::consts::FRAC_PI_2;

use crate::draws::Numbers;
use crate::fittings::Door;
use crate::modules::{Module, Unit};
use crate::plan::{Plan, Row, Standing};
use crate::settings::Setting;
use crate::urdf::{Block, Joint, Urdf};

/// Thickness (m) of boards, and gaps between fronts.
pub(super) const BOARD: f64 = 0.018;
pub(super) const GAP: f64 = 0.004;
/// Height (m) and thickness of walls.
const WALL: f64 = 0.1;
/// Height (m) of the foot of a wall.
pub(super) const FOOT: f64 = 0.12;
/// How far (m) the counter stands out ahead of the carcasses.
const LEDGE: f64 = 0.02;

/// Colours of the fronts and the counters.
pub(super) const COLORS: [[[f64; 3]; 2]; 5] = [
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

/// The materials of a kitchen with fronts and counters of some colours.
pub(super) fn materials([front, top]: [[f64; 3]; 2]) -> [(&'static str, [f64; 3]); 10] {
    [
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
    ]
}

/// Writes a plan as a URDF.
pub(crate) fn write(plan: &Plan, numbers: &Numbers<'_>) -> (String, Inventory) {
    let materials = materials(COLORS[plan.style.color % COLORS.len()]);
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

/// Makes the links of a plan.
pub(super) struct Maker<'a> {
    pub(super) plan: &'a Plan,
    pub(super) numbers: &'a Numbers<'a>,
    pub(super) urdf: Urdf,
    pub(super) inventory: Inventory,
}

impl Maker<'_> {
    fn room(&mut self) {
        let [x, y] = self.plan.start;
        let corner = Joint::fixed("world", [-x, -y, 0.0], 0.0);
        self.urdf.link("room", corner, &[]);
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
                .link_that_shows(name, Joint::fixed("room", at, 0.0), &blocks, &shown);
        }
    }

    fn row(&mut self, row: &Row) {
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
                .link(&name, Joint::fixed("room", at, yaw), &blocks);
        }
        match module.unit {
            Unit::Drawers(shares) => self.drawers(&name, width, [low, high], shares),
            Unit::Door { is_left } => {
                self.door(&Door {
                    unit: &name,
                    name: &name,
                    is_left,
                    width,
                    across: 0.0,
                    span: [low, high],
                    handle_at: 0.75,
                    handle_length: [0.12, 0.3],
                });
            }
            Unit::Fridge { is_left } => self.fridge(at, yaw, width, is_left),
            _ => {}
        }
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
            .link("fridge", Joint::fixed("room", at, yaw), &blocks);
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
            .link(main, Joint::fixed("fridge", [0.0; 3], 0.0), &blocks);
        self.door(&Door {
            unit: main,
            name: "fridge",
            is_left,
            width,
            across: 0.0,
            span: [low, roof],
            handle_at: 0.45,
            handle_length: [0.3, 0.5],
        });
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
        self.urdf.link(name, Joint::fixed("room", at, yaw), &blocks);
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
                .link_that_shows("hob", Joint::fixed("room", at, yaw), &[], &[plate]);
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
            .link("sink", Joint::fixed("room", place, yaw), &blocks);
        self.inventory.sink = Some("sink".to_owned());
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
                    .link("hood", Joint::fixed("room", at, yaw), &[block]);
            }
            Unit::Drawers(_) | Unit::Door { .. } | Unit::Dishwasher
                if self.numbers.flag(&format!("{name}.there"), 0.6)
                    && self.plan.has_wall_cabinets
                    && high - low > 0.35
                    && width <= 0.6 =>
            {
                self.numbers.note("wall-cabinets", Setting::Flag(true));
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
                    .link(name, Joint::fixed("room", at, yaw), &blocks[..count]);
                let wanted = self.numbers.flag(&format!("{name}.hinge"), 0.5);
                let mut hinges = [wanted, !wanted].into_iter();
                if let Some(is_left) = hinges.find(|is_left| self.opens(row, module, *is_left)) {
                    self.door(&Door {
                        unit: name,
                        name,
                        is_left,
                        width,
                        across: 0.0,
                        span: [low, high],
                        handle_at: 0.15,
                        handle_length: [0.1, 0.14],
                    });
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
            .link(name, Joint::fixed("room", [x, y, one.height], 0.0), &blocks);
    }
}
