//! Kitchens that others describe for their simulators, made of furniture of our own: layouts of RoboCasa and
//! houses of ProcTHOR, as the text of a URDF and of a description of what it is for.
//!
//! Such files say what stands where and how large it is; what it looks like is in meshes that only their
//! simulators have. Here it consists of boxes, with drawers, doors and handles as in generated kitchens.

mod appliances;
mod cabinets;
mod fixture;
mod furnish;
mod house;
mod kinds;
mod layout;
mod node;
mod on_counters;
mod overlaps;
mod placing;
mod room;
mod sizes;
mod stack;
#[cfg(test)]
mod tests;
mod walls;

use std::fmt;
use std::path::Path;

use node::Node;

/// A kitchen of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Published {
    /// The text of its URDF.
    pub urdf: String,
    /// The text of its description.
    pub description: String,
    /// What is not as in the file, and what of it the robot cannot use.
    pub remarks: Vec<String>,
}

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LayoutError {
    /// The line, from 1; `None` if it is the whole file.
    pub line: Option<usize>,
    /// What is wrong.
    pub text: String,
}

impl LayoutError {
    fn at(line: usize, text: impl Into<String>) -> Self {
        Self {
            line: Some(line),
            text: text.into(),
        }
    }

    fn whole(text: impl Into<String>) -> Self {
        Self {
            line: None,
            text: text.into(),
        }
    }
}

impl fmt::Display for LayoutError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.text),
            None => f.write_str(&self.text),
        }
    }
}

impl std::error::Error for LayoutError {}

/// The name of the file with the sizes of what stands in houses.
pub const ASSETS: &str = "asset-database.json";

/// What a file describes a kitchen for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simulator {
    /// RoboCasa: a layout, in YAML.
    RoboCasa,
    /// ProcTHOR: a house, in JSON.
    ProcThor,
}

impl Simulator {
    /// The one for which a file is, by its name; `None` if that is not the name of such a file.
    pub fn of(file: &Path) -> Option<Self> {
        let ending = file.extension()?.to_str()?.to_lowercase();
        match ending.as_str() {
            "yaml" | "yml" => Some(Self::RoboCasa),
            "json" => Some(Self::ProcThor),
            _ => None,
        }
    }
}

impl Published {
    /// Reads a layout of RoboCasa: a map of groups of fixtures.
    ///
    /// # Errors
    ///
    /// It is no YAML, a fixture is wrong, or there is nothing in it that a robot could use.
    pub fn of_layout(text: &str) -> Result<Self, LayoutError> {
        let layout = layout::Layout::read(&Node::of_yaml(text)?)?;
        furnish::furnish(layout)
    }

    /// Reads a house of ProcTHOR, and the database of assets, which has their sizes. Rooms other than kitchens are
    /// walls.
    ///
    /// # Errors
    ///
    /// One of them is no JSON of its kind, or the house has no kitchen that a robot could use.
    pub fn of_house(text: &str, assets: &str) -> Result<Self, LayoutError> {
        furnish::furnish(house::read(text, assets)?)
    }
}
