//! How the furniture of a kitchen is arranged.

/// How the furniture is arranged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Arrangement {
    /// All along one wall.
    OneWall,
    /// Two rows that face each other.
    Galley,
    /// Two rows around a corner.
    L,
    /// Three rows around two corners.
    U,
    /// One row and an island.
    Island,
    /// Two rows around a corner, and an island.
    LWithIsland,
    /// A row, and one from its end into the room.
    Peninsula,
}

impl Arrangement {
    /// All, with how often they occur.
    pub(crate) const SHARES: [(f64, Self); 7] = [
        (0.10, Self::OneWall),
        (0.15, Self::Galley),
        (0.25, Self::L),
        (0.15, Self::U),
        (0.12, Self::Island),
        (0.18, Self::LWithIsland),
        (0.05, Self::Peninsula),
    ];

    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::SHARES.into_iter().map(|(_, one)| one)
    }

    /// The one of that name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|one| one.name() == name)
    }

    /// The same without its island.
    pub(crate) fn without_island(self) -> Self {
        match self {
            Self::Island => Self::OneWall,
            Self::LWithIsland => Self::L,
            other => other,
        }
    }

    /// The same with an island, if there is one.
    pub(crate) fn with_island(self) -> Option<Self> {
        match self {
            Self::OneWall | Self::Island => Some(Self::Island),
            Self::L | Self::LWithIsland => Some(Self::LWithIsland),
            _ => None,
        }
    }

    /// Simpler ones, the simplest first.
    pub(crate) fn simpler(self) -> &'static [Self] {
        match self {
            Self::OneWall => &[],
            Self::Galley | Self::L | Self::Island | Self::Peninsula => &[Self::OneWall],
            Self::U => &[Self::OneWall, Self::L],
            Self::LWithIsland => &[Self::OneWall, Self::Island, Self::L],
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::OneWall => "one-wall",
            Self::Galley => "galley",
            Self::L => "l",
            Self::U => "u",
            Self::Island => "island",
            Self::LWithIsland => "l-with-island",
            Self::Peninsula => "peninsula",
        }
    }
}
