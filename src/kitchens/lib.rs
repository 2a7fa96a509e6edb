//! Kitchens by the thousand: a seed gives a room, rows of cabinets with drawers and doors, sink, hob and
//! fridge, an island or a table, as the text of a URDF and of a description of what it is for.
//!
//! Sizes are those of real kitchens. Every kitchen is made such that what opens does so without hitting
//! anything and that a robot which needs a way of 0.8 m gets from the doorway to every front. What is drawn
//! in vain is drawn anew. The same seed gives the same kitchen on every machine.

mod description;
mod draws;
mod floor;
mod furniture;
mod modules;
mod opening;
mod plan;
#[cfg(test)]
mod tests;
mod urdf;

use draws::Numbers;
use plan::Plan;
pub use plan::{Arrangement, Rejection};

/// Maximum number of attempts for a seed.
const MAX_ATTEMPTS: u64 = 200;

/// A generated kitchen.
#[derive(Clone, Debug, PartialEq)]
pub struct Kitchen {
    /// The text of its URDF.
    pub urdf: String,
    /// The text of its description.
    pub description: String,
    /// What is remarkable about it.
    pub facts: Facts,
}

/// What is remarkable about a kitchen.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// How the furniture is arranged.
    pub arrangement: Arrangement,
    /// Width and depth of the room (m).
    pub room: [f64; 2],
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
}

impl Kitchen {
    /// The kitchen of a seed; `None` if none could be made in 200 attempts.
    pub fn of_seed(seed: u64) -> Option<Self> {
        let mut rejections = Vec::new();
        for attempt in 0..MAX_ATTEMPTS {
            let numbers = Numbers::new(seed, attempt);
            match Plan::draw(&numbers) {
                Ok(plan) => return Some(Self::of_plan(&plan, &numbers, rejections)),
                Err(rejection) => rejections.push(rejection),
            }
        }
        None
    }

    fn of_plan(plan: &Plan, numbers: &Numbers, rejections: Vec<Rejection>) -> Self {
        let (urdf, inventory) = furniture::write(plan, numbers);
        let description = description::description(&inventory);
        Self {
            urdf,
            description,
            facts: Facts {
                arrangement: plan.arrangement,
                room: plan.room.high,
                aisle: plan.aisle,
                counter_height: plan.style.height,
                drawers: inventory.drawers.len(),
                has_table: plan.table.is_some(),
                rejections,
            },
        }
    }
}
