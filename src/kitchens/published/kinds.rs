//! What fixtures of a layout are, by their types and keys.

use closest_name::closest_name;

use super::LayoutError;
use super::fixture::{Counter, Doors, Fridge, HandlePlace, Kind};
use super::layout::Reader;
use super::node::Node;

/// How far (m) tops of counters stand out, and what a front takes besides, where a sink is let in.
const OVERHANG: f64 = 0.05;
const FRONT: f64 = 0.015;
/// Least distance (m) of a sink to the end of its counter.
const SINK_GAP: f64 = 0.02;

impl Reader {
    /// What a fixture of a type and a size is.
    pub(super) fn kind(
        &self,
        kind: &str,
        group: &str,
        size: [f64; 3],
        node: &Node,
    ) -> Result<Kind, LayoutError> {
        Ok(match kind {
            "counter" => Kind::Counter(self.counter(group, size, node)?),
            "drawer" => Kind::Drawer,
            "hinge_cabinet" | "single_cabinet" => Kind::Cabinet {
                doors: doors(kind, node)?,
                handle: handle_place(node.get("panel_config"))?.unwrap_or(HandlePlace::Bottom),
                is_knob: is_knob(node)?,
            },
            "open_cabinet" => {
                let count = node.get("num_levels");
                let count = count.map_or(Ok(2.0), |count| count.number("num_levels"))?;
                Kind::Shelves(count.clamp(1.0, 20.0) as usize)
            }
            "housing_cabinet" => Kind::Housing(self.frame(group, size, node)?),
            "stove" | "stove_wide" => Kind::Stove,
            "stovetop" => Kind::Stovetop,
            "oven" => Kind::Oven,
            "microwave" => Kind::Microwave,
            "hood" => Kind::Hood,
            "sink" => Kind::Sink,
            "fridge_french_door" => Kind::Fridge(Fridge::FrenchDoor),
            "fridge_side_by_side" => Kind::Fridge(Fridge::SideBySide),
            "fridge_bottom_freezer" => Kind::Fridge(Fridge::BottomFreezer),
            "dishwasher" => Kind::Dishwasher,
            "panel_cabinet" => Kind::Panel,
            "stool" => Kind::OnLegs { is_table: false },
            _ => Kind::Solid,
        })
    }

    /// A counter, with the hole for what is let into it.
    fn counter(
        &self,
        group: &str,
        [width, depth, _]: [f64; 3],
        node: &Node,
    ) -> Result<Counter, LayoutError> {
        let flags = |key: &str, usual: [bool; 2]| -> Result<[bool; 2], LayoutError> {
            let Some(given) = node.get(key).filter(|given| !given.is_null()) else {
                return Ok(usual);
            };
            match given.items(key)? {
                [a, b] => Ok([a.flag(key)?, b.flag(key)?]),
                _ => Err(given.error(format!("{key} is a list of two, true or false"))),
            }
        };
        let share = |key: &str| -> Result<f64, LayoutError> {
            node.get(key).map_or(Ok(0.5), |share| share.number(key))
        };
        let overhang = node.get("overhang");
        let overhang = overhang.map_or(Ok(OVERHANG), |overhang| overhang.number("overhang"))?;
        let mut counter = Counter {
            hollow: flags("hollow", [false, true])?,
            opening: flags("base_opening", [false; 2])?,
            half: flags("half_top", [false; 2])?,
            overhang,
            is_filled: false,
            hole: None,
        };
        if let Some(inner) = self.interior(group, node)? {
            let ahead = counter.overhang + FRONT;
            let free = [width, depth - ahead];
            let shares = [share("obj_x_percent")?, share("obj_y_percent")?];
            let mut hole = [[0.0; 2]; 2];
            for axis in 0..2 {
                let half = inner.size[axis].min(free[axis] - 2.0 * SINK_GAP) / 2.0;
                if half <= 0.0 {
                    return Err(node.error("this counter is too small for what is let into it"));
                }
                let most = (free[axis] - SINK_GAP - half) / free[axis];
                let share = shares[axis].max(1.0 - most).min(most);
                let shift = if axis == 1 { ahead / 2.0 } else { 0.0 };
                let middle = shift + (share - 0.5) * free[axis];
                hole[0][axis] = middle - half;
                hole[1][axis] = middle + half;
            }
            counter.hole = Some(hole);
        }
        Ok(counter)
    }
}

/// What a level of a stack is.
pub(super) fn level_kind(
    text: &str,
    config: Option<&Node>,
    node: &Node,
) -> Result<Kind, LayoutError> {
    Ok(match text {
        "drawer" => Kind::Drawer,
        "single_cabinet" | "hinge_cabinet" => Kind::Cabinet {
            doors: doors(text, config.unwrap_or(node))?,
            handle: match config {
                Some(config) => handle_place(config.get("panel_config"))?,
                None => None,
            }
            .unwrap_or(HandlePlace::Top),
            is_knob: config.map_or(Ok(false), is_knob)?,
        },
        "open_cabinet" => Kind::Shelves(2),
        "panel_cabinet" => Kind::Panel,
        "box" => Kind::Solid,
        other => {
            let known = [
                "drawer",
                "single_cabinet",
                "hinge_cabinet",
                "open_cabinet",
                "panel_cabinet",
                "box",
            ];
            let near = closest_name(other, known);
            let hint = near.map_or_else(String::new, |near| format!("; did you mean {near}?"));
            return Err(node.error(format!("{other} is no level of a stack{hint}")));
        }
    })
}

/// The doors of a cabinet of a type.
fn doors(kind: &str, node: &Node) -> Result<Doors, LayoutError> {
    if kind == "hinge_cabinet" {
        return Ok(Doors::Pair);
    }
    let given = node.get("orientation").filter(|given| !given.is_null());
    match given.map_or(Ok("right"), |given| given.text("orientation"))? {
        "left" => Ok(Doors::One { is_left: true }),
        "right" => Ok(Doors::One { is_left: false }),
        other => Err(node.error(format!("a door opens to the left or right, not {other}"))),
    }
}

/// Whether its handles are knobs.
fn is_knob(node: &Node) -> Result<bool, LayoutError> {
    let given = node.get("handle_type").filter(|given| !given.is_null());
    Ok(given.map_or(Ok(""), |given| given.text("handle_type"))? == "knob")
}

/// Where the handles of a panel are, if it says so.
fn handle_place(config: Option<&Node>) -> Result<Option<HandlePlace>, LayoutError> {
    let Some(given) = config.and_then(|config| config.get("handle_vpos")) else {
        return Ok(None);
    };
    match given.text("handle_vpos")? {
        "bottom" => Ok(Some(HandlePlace::Bottom)),
        "center" => Ok(Some(HandlePlace::Middle)),
        "top" => Ok(Some(HandlePlace::Top)),
        other => Err(given.error(format!(
            "a handle is at the bottom, center or top of its panel, not at {other}"
        ))),
    }
}
