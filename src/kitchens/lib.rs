//! Kitchens by the thousand: a seed gives a room, rows of cabinets with drawers and doors, sink, hob and
//! fridge, an island or a table, as the text of a URDF and of a description of what it is for.
//!
//! Sizes are those of real kitchens. Every kitchen is made such that what opens does so without hitting
//! anything and that a robot which needs a way of 0.8 m gets from the doorway to every front. What is drawn
//! in vain is drawn anew. The same seed gives the same kitchen on every machine.

mod arrangement;
mod description;
mod draws;
mod finding;
mod fittings;
mod floor;
mod furniture;
mod modules;
mod opening;
mod part;
mod plan;
mod published;
mod settings;
mod table;
#[cfg(test)]
mod tests;
mod urdf;

use std::fmt;

pub use arrangement::Arrangement;
use draws::Numbers;
pub use finding::{Finding, kind_of_failure};
use modules::Unit;
pub use part::kind_of_part;
use plan::Plan;
pub use plan::Rejection;
pub use published::{ASSETS, LayoutError, Published, Simulator};
pub use settings::{Setting, SettingError, Settings, is_parameter};
pub use table::{Division, KitchenTable, Row, kitchen_path};

/// Maximum number of attempts for a seed.
const MAX_ATTEMPTS: u64 = 200;
/// Maximum number of attempts where parameters are set, which may leave no kitchen at all.
const MAX_ATTEMPTS_WHEN_SET: u64 = 40;

/// A generated kitchen.
#[derive(Clone, Debug, PartialEq)]
pub struct Kitchen {
    /// The text of its URDF.
    pub urdf: String,
    /// The text of its description.
    pub description: String,
    /// What is remarkable about it.
    pub facts: Facts,
    /// Parameters with their simplest values, where they have others; those that change most come first.
    pub simpler: Vec<(String, Setting)>,
}

/// Why there is no kitchen of a seed in which parameters are as they are set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Impossible {
    /// The seed.
    pub seed: u64,
    /// What is wrong with the one in which all else is as drawn.
    pub rejection: Rejection,
}

impl fmt::Display for Impossible {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "There is no kitchen of the seed {} like that: {}. Set fewer parameters, or take another seed.",
            self.seed,
            self.rejection.words()
        )
    }
}

impl std::error::Error for Impossible {}

/// What is remarkable about a kitchen.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// How the furniture is arranged.
    pub arrangement: Arrangement,
    /// Width and depth of the room (m).
    pub room: [f64; 2],
    /// Where the robot starts, from the corner of the room at the left of the doorway (m).
    pub start: [f64; 2],
    /// The narrowest way between rows that face each other (m); infinite if there are none.
    pub aisle: f64,
    /// Height of the counters (m).
    pub counter_height: f64,
    /// Numbers of drawers and of doors.
    pub drawers: usize,
    /// Whether there is a table.
    pub has_table: bool,
    /// Why earlier attempts were given up.
    pub rejections: Vec<Rejection>,
    /// Whether all had to be drawn anew, since what is set does not go with what was drawn.
    pub is_redrawn: bool,
}

impl Kitchen {
    /// The kitchen of a seed; `None` if none could be made in 200 attempts.
    pub fn of_seed(seed: u64) -> Option<Self> {
        Self::with(seed, &Settings::default()).ok()
    }

    /// The kitchen of a seed in which some parameters are set: all others are as drawn without them. Only
    /// if that is no kitchen, everything else is drawn anew, which the facts say.
    ///
    /// # Errors
    ///
    /// None could be made in 200 attempts, or in 40 where parameters are set.
    pub fn with(seed: u64, settings: &Settings) -> Result<Self, Impossible> {
        let attempted = |settings: &Settings, attempt, rejections: &mut Vec<Rejection>| {
            let numbers = Numbers::new(seed, attempt, settings);
            match Plan::draw(&numbers) {
                Ok(plan) => Some(Self::of_plan(&plan, &numbers, rejections)),
                Err(rejection) => {
                    rejections.push(rejection);
                    None
                }
            }
        };
        let impossible = |rejections: &[Rejection]| Impossible {
            seed,
            rejection: rejections.first().copied().unwrap_or(Rejection::Narrow),
        };
        let mut rejections = Vec::new();
        let none = Settings::default();
        let mut plain = (0..MAX_ATTEMPTS)
            .filter_map(|attempt| Some((attempt, attempted(&none, attempt, &mut rejections)?)));
        let plain = plain.next();
        let Some((usual, kitchen)) = plain else {
            return Err(impossible(&rejections));
        };
        if settings.is_empty() {
            return Ok(kitchen);
        }
        let mut rejections = Vec::new();
        if let Some(kitchen) = attempted(settings, usual, &mut rejections) {
            return Ok(kitchen);
        }
        let others = (0..MAX_ATTEMPTS_WHEN_SET).filter(|attempt| *attempt != usual);
        for attempt in others {
            if let Some(mut kitchen) = attempted(settings, attempt, &mut rejections) {
                kitchen.facts.is_redrawn = true;
                return Ok(kitchen);
            }
        }
        Err(impossible(&rejections))
    }

    /// Those of some settings without which the kitchen of a seed would be another one: the length of a table that
    /// is not there changes nothing. Lengths and counts go first: a table may be missing because it is not
    /// wanted, or because it has been set too long, and then the former is kept.
    pub fn needed(seed: u64, settings: &Settings) -> Settings {
        let mut needed = settings.clone();
        let Ok(kitchen) = Self::with(seed, settings) else {
            return needed;
        };
        let is_number = |setting: &Setting| matches!(setting, Setting::Number(_));
        let (sizes, others): (Vec<_>, Vec<_>) =
            settings.iter().partition(|(_, setting)| is_number(setting));
        for (name, _) in sizes.into_iter().chain(others) {
            let fewer = needed.without(name);
            let is_same = |other: Self| {
                other.urdf == kitchen.urdf && other.description == kitchen.description
            };
            if Self::with(seed, &fewer).is_ok_and(is_same) {
                needed = fewer;
            }
        }
        needed
    }

    fn of_plan(plan: &Plan, numbers: &Numbers<'_>, rejections: &[Rejection]) -> Self {
        let (urdf, inventory) = furniture::write(plan, numbers);
        let description = description::description(&inventory);
        Self {
            urdf,
            description,
            facts: Facts {
                arrangement: plan.arrangement,
                room: plan.room.high,
                start: plan.start,
                aisle: plan.aisle,
                counter_height: plan.style.height,
                drawers: inventory.drawers.len(),
                has_table: plan.table.is_some(),
                rejections: rejections.to_vec(),
                is_redrawn: false,
            },
            simpler: simpler(plan, numbers),
        }
    }
}

/// Parameters with simpler values than those of a kitchen, those that change most first.
fn simpler(plan: &Plan, numbers: &Numbers<'_>) -> Vec<(String, Setting)> {
    let arrangements = plan.arrangement.simpler().iter().map(|one| {
        let name = one.name().to_owned();
        ("arrangement".to_owned(), Setting::Name(name))
    });
    let modules = plan.rows.iter().flat_map(|row| {
        let modules = row.modules.iter().enumerate();
        let closes = modules.filter(|(_, module)| {
            matches!(
                module.unit,
                Unit::Drawers(_) | Unit::Door { .. } | Unit::Hob
            )
        });
        closes.map(|(number, _)| {
            let name = format!("{}-{}", row.name, number + 1);
            (name, Setting::Flag(false))
        })
    });
    let parameters = settings::simpler(&numbers.used());
    let (lengths, others): (Vec<_>, Vec<_>) = parameters
        .into_iter()
        .partition(|(name, _)| settings::is_length(name));
    arrangements
        .chain(others)
        .chain(modules)
        .chain(lengths)
        .collect()
}
