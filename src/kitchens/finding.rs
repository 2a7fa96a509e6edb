//! Failures of a sweep that are the same in several kitchens.

use std::collections::{BTreeMap, BTreeSet};

use sweep::Record;
use sweep::plural::plural;

use crate::part::kind_of_part;
use crate::table::World;

/// Maximum number of worlds that are named with a finding.
const MAX_EXAMPLES: usize = 3;

/// A failure that is the same in some worlds.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Its class, its cause, and the kinds of what touched.
    pub kind: [String; 3],
    /// The worlds, in order.
    pub worlds: Vec<u64>,
    /// The number of different kitchens.
    pub kitchens: usize,
    /// How many of the worlds have each layout.
    pub layouts: BTreeMap<String, usize>,
}

impl Finding {
    /// What it is, in one line.
    pub fn words(&self) -> String {
        let parts: Vec<&str> = self.kind.iter().map(String::as_str).collect();
        let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        parts.join("  ")
    }

    /// In how many worlds and kitchens of which layouts it is.
    pub fn where_it_is(&self) -> String {
        let layouts = self.layouts.iter();
        let layouts: Vec<String> = layouts
            .map(|(layout, count)| format!("{layout} {count}"))
            .collect();
        format!(
            "{} in {}: {}",
            plural(self.worlds.len(), "world"),
            plural(self.kitchens, "kitchen"),
            layouts.join(", ")
        )
    }

    /// Some of the worlds.
    pub(crate) fn examples(&self) -> String {
        let worlds = self.worlds.iter().take(MAX_EXAMPLES);
        let mut worlds: Vec<String> = worlds.map(u64::to_string).collect();
        if self.worlds.len() > MAX_EXAMPLES {
            worlds.push("…".to_owned());
        }
        worlds.join(" ")
    }
}

/// Why a world ended as it did; bodies are told by the kind of furniture that they are.
pub fn kind_of_failure(record: &Record) -> [String; 3] {
    let [class, cause, _] = record.kind();
    let bodies: Vec<String> = record
        .bodies
        .iter()
        .map(|body| kind_of_part(body))
        .collect();
    [class, cause, bodies.join("/")]
}

/// The failures of worlds, those first that occur in most kitchens.
pub(crate) fn findings<'a>(failing: impl Iterator<Item = &'a World<'a>>) -> Vec<Finding> {
    let mut by_kind: BTreeMap<[String; 3], Vec<&World<'_>>> = BTreeMap::new();
    for world in failing {
        let kind = kind_of_failure(world.record);
        by_kind.entry(kind).or_default().push(world);
    }
    let mut findings: Vec<Finding> = by_kind
        .into_iter()
        .map(|(kind, worlds)| {
            let kitchens: BTreeSet<String> = worlds.iter().map(|world| world.kitchen()).collect();
            let mut layouts: BTreeMap<String, usize> = BTreeMap::new();
            for world in &worlds {
                *layouts.entry(world.layout()).or_default() += 1;
            }
            Finding {
                kind,
                worlds: worlds.iter().map(|world| world.record.world).collect(),
                kitchens: kitchens.len(),
                layouts,
            }
        })
        .collect();
    findings.sort_by_key(|finding| std::cmp::Reverse((finding.kitchens, finding.worlds.len())));
    findings
}
