//! Check that a robot has the links and joints that a description names.

use std::fmt;

use super::KinematicTree;
use crate::sexp::{DataError, DataFile, Node};

/// Keys whose values are links, and keys whose values are joints.
const LINK_KEYS: &[&str] = &[
    "frame",
    "body",
    "link",
    "pan-link",
    "tilt-link",
    "base",
    "wrist",
    "tool",
    "palm",
    "left-finger",
    "right-finger",
];
const JOINT_KEYS: &[&str] = &["joint", "pan-joint", "tilt-joint", "tip-joint"];

/// Records whose entries are links, and records whose entries are joints.
const LINK_RECORDS: &[&str] = &["touching", "wheels"];
const JOINT_RECORDS: &[&str] = &["idle-joints", "speed"];

/// Number of names listed of each kind; the rest are only counted.
const MAX_TOLD: usize = 6;

/// The names in a description that a robot lacks, each once, in order of appearance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MissingNames {
    /// Links.
    pub links: Vec<String>,
    /// Joints.
    pub joints: Vec<String>,
}

impl MissingNames {
    /// The links and joints that the description names and the tree lacks.
    pub fn of(description: &str, file_name: &str, tree: &KinematicTree) -> Result<Self, DataError> {
        let mut missing = Self::default();
        for record in DataFile::read(description, file_name)?.nodes() {
            let head = record.head()?;
            let mut key = None;
            for node in record.list()?.into_iter().skip(1) {
                if let Some(name) = node.as_keyword() {
                    key = Some(name);
                    continue;
                }
                let is_among = |keys: &[&str], records: &[&str]| match key {
                    Some(key) => keys.contains(&key),
                    None => records.contains(&head),
                };
                for name in names(&node) {
                    if is_among(LINK_KEYS, LINK_RECORDS) && tree.link_named(name).is_none() {
                        add(&mut missing.links, name);
                    }
                    if is_among(JOINT_KEYS, JOINT_RECORDS) && tree.joint_named(name).is_none() {
                        add(&mut missing.joints, name);
                    }
                }
            }
        }
        Ok(missing)
    }

    /// Whether the robot has everything that the description names.
    pub fn is_empty(&self) -> bool {
        self.links.is_empty() && self.joints.is_empty()
    }
}

/// A single name, or the names in a list.
fn names<'a>(node: &Node<'a>) -> Vec<&'a str> {
    match node.symbol() {
        Ok(name) => vec![name],
        Err(_) => node.symbols().unwrap_or_default(),
    }
}

fn add(names: &mut Vec<String>, name: &str) {
    if !names.iter().any(|known| known == name) {
        names.push(name.to_owned());
    }
}

impl fmt::Display for MissingNames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kinds = [("link", &self.links), ("joint", &self.joints)];
        let mut kinds = kinds.into_iter().filter(|(_, names)| !names.is_empty());
        if let Some((kind, names)) = kinds.next() {
            write_names(f, kind, names)?;
        }
        for (kind, names) in kinds {
            f.write_str(" and ")?;
            write_names(f, kind, names)?;
        }
        Ok(())
    }
}

fn write_names(f: &mut fmt::Formatter<'_>, kind: &str, names: &[String]) -> fmt::Result {
    let ending = if names.len() == 1 { "" } else { "s" };
    let told: Vec<&str> = names.iter().take(MAX_TOLD).map(String::as_str).collect();
    write!(f, "the {kind}{ending} {}", told.join(", "))?;
    match names.len().saturating_sub(MAX_TOLD) {
        0 => Ok(()),
        more => write!(f, " and {more} more"),
    }
}
