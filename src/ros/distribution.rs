//! The distributions of ROS 2 whose messages are known.

use closest_name::closest_name;
use thiserror::Error;

/// A distribution of ROS 2; later ones are greater.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Distribution {
    /// Humble Hawksbill, 2022.
    Humble,
    /// Iron Irwini, 2023.
    Iron,
    /// Jazzy Jalisco, 2024.
    Jazzy,
    /// Kilted Kaiju, 2025.
    Kilted,
    /// Lyrical Luth, 2026.
    Lyrical,
}

/// There is no such distribution, or its messages are not known.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no distribution of ROS 2 is called {wanted:?}{}: known are {}", meant(.wanted), all())]
pub struct UnknownDistribution {
    /// What was asked for.
    pub wanted: String,
}

impl Distribution {
    /// All of them, oldest first.
    pub const ALL: [Self; 5] = [
        Self::Humble,
        Self::Iron,
        Self::Jazzy,
        Self::Kilted,
        Self::Lyrical,
    ];

    /// The distribution that is spoken where none is asked for.
    pub const DEFAULT: Self = Self::Jazzy;

    /// The name, as in the environment's `ROS_DISTRO`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Humble => "humble",
            Self::Iron => "iron",
            Self::Jazzy => "jazzy",
            Self::Kilted => "kilted",
            Self::Lyrical => "lyrical",
        }
    }

    /// The distribution of a name.
    pub fn named(name: &str) -> Result<Self, UnknownDistribution> {
        let known = Self::ALL.into_iter().find(|known| known.name() == name);
        known.ok_or_else(|| UnknownDistribution {
            wanted: name.to_owned(),
        })
    }
}

fn meant(wanted: &str) -> String {
    let names = Distribution::ALL.map(Distribution::name);
    closest_name(wanted, names).map_or_else(String::new, |name| format!(" (did you mean {name}?)"))
}

fn all() -> String {
    Distribution::ALL.map(Distribution::name).join(", ")
}
