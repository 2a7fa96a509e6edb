//! The modules of a row: what they are, and how a row is filled with them.

use crate::arrangement::Arrangement;
use crate::draws::{Numbers, rounded};
use crate::plan::Rejection;

/// What a module is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unit {
    /// Drawers, one above the other, the lowest first: shares of the height.
    Drawers(&'static [f64]),
    /// A cabinet with a door; whether its hinge is at the left.
    Door { is_left: bool },
    /// The sink, above a closed front.
    Sink,
    /// The hob, above the oven.
    Hob,
    /// A dishwasher, which is not opened.
    Dishwasher,
    /// The fridge; whether its hinge is at the left.
    Fridge { is_left: bool },
    /// A closed panel.
    Panel,
}

impl Unit {
    /// Whether it is higher than the counter.
    pub(crate) fn is_tall(self) -> bool {
        matches!(self, Self::Fridge { .. })
    }
}

/// A module of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Module {
    /// Where it begins along the row, and its width (m).
    pub(crate) at: f64,
    pub(crate) width: f64,
    pub(crate) unit: Unit,
}

/// Widths (m) of modules.
const WIDTHS: [f64; 6] = [0.4, 0.45, 0.5, 0.6, 0.8, 0.9];
/// Stacks of drawers, with how often they occur.
const STACKS: [(f64, &[f64]); 4] = [
    (0.4, &[0.4, 0.4, 0.2]),
    (0.3, &[0.34, 0.33, 0.33]),
    (0.2, &[0.28, 0.27, 0.27, 0.18]),
    (0.1, &[0.5, 0.5]),
];

/// Fills a row with modules; parts of it at both ends are dead corners.
pub(crate) fn fill(
    numbers: &Numbers<'_>,
    arrangement: Arrangement,
    index: usize,
    name: &str,
    length: f64,
    [first, last]: [f64; 2],
) -> Result<Vec<Module>, Rejection> {
    let room = length - first - last;
    if room < 0.4 {
        return Err(Rejection::Narrow);
    }
    use Arrangement::{Galley, Island, LWithIsland, OneWall, Peninsula, U};
    let hinge = |name: &str| numbers.flag(&format!("{name}.hinge"), 0.5);
    let fridge = (
        numbers.one_of("fridge.width", &[0.6, 0.65, 0.7]),
        Unit::Fridge {
            is_left: hinge("fridge"),
        },
    );
    // A wide sink in a long row.
    let sink_width = match room > 2.4 {
        true => numbers.one_of("sink.width", &[0.8, 0.6]),
        false => numbers.settings().number("sink.width").unwrap_or(0.6),
    };
    let sink = (sink_width, Unit::Sink);
    let hob = (0.6, Unit::Hob);
    let washer = (0.6, Unit::Dishwasher);
    let stack = |at: &str| {
        let shares = numbers.choice(&format!("{at}.stack"), &STACKS);
        Unit::Drawers(shares.unwrap_or(&[0.5, 0.5]))
    };
    // What stands where, from the row's beginning; the fridge is at an end.
    let mut wanted: Vec<(f64, Unit)> = match (name, arrangement) {
        ("back", OneWall | Island | Peninsula) => vec![fridge, sink, hob],
        ("back", _) => vec![sink],
        ("left", Galley) => vec![sink],
        ("right", Galley) => vec![fridge, hob],
        ("left", U) => vec![hob],
        ("right", U) => vec![fridge],
        ("left", _) => vec![fridge, hob],
        _ => vec![],
    };
    if name == "island" && arrangement == LWithIsland {
        wanted.push((0.6, stack("island.first")));
    }
    let used = |units: &[(f64, Unit)]| units.iter().map(|unit| unit.0).sum::<f64>();
    if used(&wanted) > room + 1e-9 {
        let is_needed = |unit: &(f64, Unit)| unit.1 == Unit::Sink || unit.1.is_tall();
        wanted.retain(is_needed);
        if used(&wanted) > room + 1e-9 {
            return Err(Rejection::Narrow);
        }
    }
    let mut left = room - used(&wanted);
    let mut fillers = Vec::new();
    if left >= 1.3 && name != "island" && numbers.flag("dishwasher", 0.7) && wanted.contains(&sink)
    {
        fillers.push(washer);
        left -= 0.6;
    }
    let mut number = 0;
    while left >= WIDTHS[0] - 1e-9 {
        let fits: Vec<(f64, f64)> = WIDTHS
            .iter()
            .filter(|width| **width <= left + 1e-9)
            .map(|width| (1.0, *width))
            .collect();
        let at = format!("{name}.{number}");
        let width = numbers.choice(&format!("{at}.width"), &fits).unwrap_or(0.4);
        let is_stack = number == 0 || numbers.flag(&format!("{at}.kind"), 0.6);
        let unit = match is_stack {
            true => stack(&at),
            false => Unit::Door {
                is_left: hinge(&at),
            },
        };
        // A wide cabinet would need two doors.
        let width = if is_stack { width } else { width.min(0.6) };
        fillers.push((width, unit));
        left -= width;
        number += 1;
    }
    // The fridge comes first or last, away from a corner.
    let (fridges, others): (Vec<_>, Vec<_>) = wanted.into_iter().partition(|unit| unit.1.is_tall());
    let mut inner = others;
    for (number, filler) in fillers.into_iter().enumerate() {
        let place = numbers.below(&format!("{name}.{number}.place"), inner.len() + 1);
        inner.insert(place, filler);
    }
    let at_end = if last > 0.0 {
        false
    } else {
        first > 0.0 || numbers.flag(&format!("{index}.fridge.end"), 0.5)
    };
    let mut units = Vec::new();
    if first > 0.0 {
        units.push((first, Unit::Panel));
    }
    // The rest becomes a filler beside the corner, or at the end.
    let rest = rounded(left);
    let filler = (rest > 0.002).then_some((rest, Unit::Panel));
    if !at_end {
        units.extend(fridges.iter().copied());
        units.extend(inner.iter().copied());
        units.extend(filler);
    } else {
        units.extend(filler);
        units.extend(inner.iter().copied());
        units.extend(fridges.iter().copied());
    }
    if last > 0.0 {
        units.push((last, Unit::Panel));
    }
    let mut at = 0.0;
    let placed = units.into_iter().map(|(width, unit)| {
        let module = Module { at, width, unit };
        at = rounded(at + width);
        module
    });
    let mut placed: Vec<Module> = placed.collect();
    for (number, module) in placed.iter_mut().enumerate() {
        if numbers.settings().is_closed(name, number + 1) {
            module.unit = Unit::Panel;
        }
    }
    Ok(placed)
}
