//! What is known of every world before its plan begins: the values of its draws.

use super::record::{Drawn, Record};

/// What a draw is in every world: a number, or one of several values.
pub(super) struct Feature {
    pub(super) name: String,
    pub(super) values: Vec<Level>,
}

/// The value of a feature in a world.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Level {
    Number(f64),
    Text(String),
    /// Not drawn in that world.
    Absent,
}

/// All features of some worlds: what is drawn, and whether groups have things of a kind.
pub(super) fn features(tried: &[&Record]) -> Vec<Feature> {
    let mut names: Vec<&str> = Vec::new();
    let mut groups: Vec<(String, String)> = Vec::new();
    for (path, value) in tried.iter().flat_map(|record| record.draws.iter()) {
        match group_of(path) {
            None if !names.contains(&path) => names.push(path),
            Some((group, "")) => {
                if let Drawn::Text(kind) = value {
                    let member = (group.to_owned(), kind.clone());
                    if !groups.contains(&member) {
                        groups.push(member);
                    }
                }
            }
            _ => {}
        }
    }
    groups.sort();
    let drawn = names.into_iter().map(|name| Feature {
        name: name.to_owned(),
        values: tried.iter().map(|r| level(r.draws.get(name))).collect(),
    });
    // Whether a group has a thing of a kind.
    let has = |record: &Record, group: &str, kind: &str| {
        record.draws.iter().any(|(path, value)| {
            group_of(path) == Some((group, "")) && *value == Drawn::Text(kind.to_owned())
        })
    };
    let of_groups = groups.iter().map(|(group, kind)| Feature {
        name: format!("{group} has {}", kind.to_lowercase()),
        values: tried
            .iter()
            .map(|r| Level::Text(has(r, group, kind).to_string()))
            .collect(),
    });
    drawn.chain(of_groups).collect()
}

/// The group to whose numbered members a path belongs, and what of the member it is.
fn group_of(path: &str) -> Option<(&str, &str)> {
    let (group, member) = path.split_once('.')?;
    let (number, rest) = member.split_once('.').unwrap_or((member, ""));
    number.parse::<u32>().ok().map(|_| (group, rest))
}

/// A value that was drawn, or that nothing was.
fn level(value: Option<&Drawn>) -> Level {
    match value {
        None => Level::Absent,
        Some(value @ (Drawn::Flag(_) | Drawn::Text(_))) => Level::Text(value.to_string()),
        Some(value) => value.number().map_or(Level::Absent, Level::Number),
    }
}

impl Feature {
    /// Whether it is a number in every world.
    pub(super) fn is_number(&self) -> bool {
        self.values.iter().all(|value| value.number().is_some())
    }
}

impl Level {
    /// It as a number, if it is one.
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }
}
