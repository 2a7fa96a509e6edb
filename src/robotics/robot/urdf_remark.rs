//! What a reader of URDFs has taken leniently, and where.

use std::fmt;

use super::urdf_error::Place;

/// Something in a URDF that the standard does not allow, or that could not be had, and what was done
/// instead.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfRemark {
    /// The first place.
    pub place: Place,
    /// What was found there and what was done.
    pub leniency: Leniency,
    /// How often the same was found elsewhere.
    pub others: usize,
}

/// A way to read what the standard does not allow.
#[derive(Clone, Debug, PartialEq)]
pub enum Leniency {
    /// The file is in an encoding other than UTF-8.
    Encoding(&'static str),
    /// A material has no name.
    UnnamedMaterial,
    /// A child that may stand only once is there twice.
    SecondChild {
        /// Name of the element.
        element: String,
        /// Name of the child.
        child: String,
    },
    /// A capsule.
    Capsule,
    /// A shape has no size.
    NoSize(String),
    /// The limits say no speed.
    NoVelocity,
    /// The limits say no range.
    NoRange(String),
    /// A joint that follows another one has no limits of its own.
    FollowersRange(String),
    /// A greatest effort or speed is negative.
    NegativeLimit(String),
    /// An axis has no direction.
    NoDirection,
    /// A mesh has one scale for all axes.
    OneScale,
    /// A colour is out of range.
    Color(String),
    /// A loop of joints.
    LoopJoint,
    /// No link has a shape to collide with.
    NoCollisions,
    /// A mesh for the eye is not to be had.
    NoLooks(String),
    /// A mesh is as large as if its unit were another one.
    Unit {
        /// The mesh.
        file: String,
        /// Its longest side (m).
        length: f64,
    },
}

impl Leniency {
    /// Whether both are of one kind, so that one remark is enough.
    fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::SecondChild { child: one, .. }, Self::SecondChild { child: two, .. }) => {
                one == two
            }
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

impl fmt::Display for Leniency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Encoding(name) => write!(f, "the file is read as {name}, as it declares"),
            Self::UnnamedMaterial => {
                f.write_str("<material> has no name; its colour is that of this shape alone")
            }
            Self::SecondChild { element, child } => {
                write!(f, "<{element}> has a second <{child}>; the last one counts")
            }
            Self::Capsule => {
                f.write_str("<capsule> is taken as a cylinder with a ball at either end")
            }
            Self::NoSize(value) => write!(f, "a shape of size {value:?} is left out"),
            Self::NoVelocity => {
                f.write_str("<limit> has no velocity; the joint is as fast as others are")
            }
            Self::NoRange(joint) => write!(
                f,
                "<limit> of joint {joint:?} has neither lower nor upper; the joint stands at 0"
            ),
            Self::FollowersRange(joint) => write!(
                f,
                "joint {joint:?} follows another one and has no limits; they follow from the other's"
            ),
            Self::NegativeLimit(attribute) => {
                write!(f, "{attribute} is negative; it is taken as not given")
            }
            Self::NoDirection => f.write_str("<axis> has no xyz; it is taken as 1 0 0"),
            Self::OneScale => f.write_str("scale is one number; it is taken for all three axes"),
            Self::Color(value) => {
                write!(
                    f,
                    "rgba={value:?} is not from 0 to 1; it is taken as near as can be"
                )
            }
            Self::LoopJoint => f.write_str("<loop_joint> is left out: joints form a tree here"),
            Self::NoCollisions => {
                f.write_str("no link has a <collision>; what is visible is taken as solid")
            }
            Self::NoLooks(problem) => {
                write!(f, "{problem}; what is solid there is shown instead")
            }
            Self::Unit { file, length } => write!(
                f,
                "{file} is {length:.0} m long; if it is in millimetres, give it scale=\"0.001 0.001 0.001\""
            ),
        }
    }
}

impl fmt::Display for UrdfRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.leniency)?;
        match self.others {
            0 => Ok(()),
            1 => f.write_str(" (and once more)"),
            n => write!(f, " (and {n} times more)"),
        }
    }
}

/// The remarks about a file, one for each kind.
#[derive(Default)]
pub(super) struct Remarks {
    /// Byte offset, kind, and how often it was found elsewhere.
    found: Vec<(usize, Leniency, usize)>,
}

impl Remarks {
    /// Notes something found at a byte offset.
    pub(super) fn add(&mut self, offset: usize, leniency: Leniency) {
        match self
            .found
            .iter_mut()
            .find(|(_, known, _)| known.is_like(&leniency))
        {
            Some((_, _, others)) => *others += 1,
            None => self.found.push((offset, leniency, 0)),
        }
    }

    /// The remarks about a text, in the order of the first places.
    pub(super) fn of(mut self, file_name: &str, text: &str) -> Vec<UrdfRemark> {
        self.found.sort_by_key(|(offset, ..)| *offset);
        let remarks = self.found.into_iter();
        let remark = |(offset, leniency, others)| UrdfRemark {
            place: Place::at(file_name, text, offset),
            leniency,
            others,
        };
        remarks.map(remark).collect()
    }
}
