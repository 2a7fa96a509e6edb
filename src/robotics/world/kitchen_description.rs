//! What the furniture of a kitchen is for: places with names, where things of a type are and where
//! they belong in a context, and from where the furniture is looked at.
//!
//! Read from `world/kitchen.sexp` or a file like it, and checked against the kitchen's tree. Plans
//! and the rest of the program take these facts from here and name no furniture themselves.

use crate::robot::tree::Alias;
use crate::robot::{JointId, KinematicTree};
use crate::sexp::DataError;
use descriptions::KITCHEN_DESCRIPTION;

use super::kitchen_description_file::{Fit, read};

/// The views of furniture that a description may say.
pub const CLOSE_UPS: [&str; 2] = ["table", "island"];

/// What the furniture of a kitchen is for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KitchenDescription {
    /// What plans call the kitchen.
    pub name: String,
    /// What the kitchen's URDF is called by programs that ask for it.
    pub urdf_name: String,
    /// The joint that is meant where none is named.
    pub usual_joint: Option<JointId>,
    /// Where the robot starts: x and y (m) and heading (degrees) in the map.
    pub start: Option<[f64; 3]>,
    /// The link of a drawer or door of the kitchen, with one that is behind it.
    pub behind: Vec<[String; 2]>,
    /// Places by name.
    pub places: Vec<(String, Vec<PlaceProperty>)>,
    /// Where things usually are; the first rule that fits counts.
    pub usually: Vec<PlaceRule>,
    /// Where things belong; the first rule that fits counts.
    pub belongs: Vec<PlaceRule>,
    /// Where things are before a household demo.
    pub stores: Vec<Store>,
    /// Link of a surface, and what of it a set table leaves free: at the lower and upper end of x,
    /// then of y (m).
    pub margins: Vec<(String, [f64; 4])>,
    /// The views of furniture.
    pub close_ups: Vec<CloseUp>,
    /// Names by which users call links and joints, besides those in the URDF.
    pub(crate) aliases: Vec<Alias>,
}

/// A property of a place, as a location designator has it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceProperty {
    /// The key.
    pub key: &'static str,
    /// The value.
    pub value: PlaceValue,
}

/// The value of a property of a place.
#[derive(Clone, Debug, PartialEq)]
pub enum PlaceValue {
    /// A link of the kitchen.
    Furniture(String),
    /// A word.
    Word(String),
    /// Several words.
    Words(Vec<String>),
    /// A number.
    Number(f64),
    /// A whole number.
    Count(usize),
}

/// In which contexts things of some types have a place.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceRule {
    /// The name of the place.
    pub place: String,
    /// The contexts.
    pub contexts: Vec<String>,
    /// The types; all if empty.
    pub types: Vec<String>,
}

/// Where a thing is before a household demo.
#[derive(Clone, Debug, PartialEq)]
pub struct Store {
    /// Its type.
    pub kind: String,
    /// The link that it is in.
    pub link: String,
    /// Position in the link's frame (m).
    pub position: [f64; 3],
    /// Heading in the link's frame (degrees).
    pub heading: f64,
}

/// A view of a piece of furniture.
#[derive(Clone, Debug, PartialEq)]
pub struct CloseUp {
    /// The name of the view, one of [`CLOSE_UPS`].
    pub name: String,
    /// The link that is looked at; the kitchen may lack it.
    pub link: String,
    /// The point in the middle of the picture, in the link's frame (m).
    pub at: [f64; 3],
    /// The eye: x and y from that point along the axes of the map, and its height above the floor (m).
    pub eye: [f64; 3],
}

impl KitchenDescription {
    /// Reads the description of the kitchen with that tree; `file_name` is used only in errors.
    pub fn from_sexp(text: &str, file_name: &str, tree: &KinematicTree) -> Result<Self, DataError> {
        read(text, file_name, tree, Fit::Whole)
    }

    /// What of the built-in description is true of a kitchen that came without one: all that names
    /// only furniture which is there.
    pub fn built_in(tree: &KinematicTree) -> Result<Self, DataError> {
        read(KITCHEN_DESCRIPTION, "kitchen.sexp", tree, Fit::WhatIsThere)
    }

    /// The view of furniture with that name.
    pub fn close_up(&self, name: &str) -> Option<&CloseUp> {
        self.close_ups.iter().find(|view| view.name == name)
    }
}
