//! What can be wrong with a URDF, where, and what would be right.

use std::fmt;

use thiserror::Error;

use crate::mesh::MeshError;

/// The first thing that is wrong with a URDF.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{place}: {problem}")]
pub struct UrdfError {
    /// Where the problem is.
    pub place: Place,
    /// What the problem is.
    pub problem: Box<UrdfProblem>,
}

/// A place in a file; line and column count from 1, columns in characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Name of the file as it was given.
    pub file: String,
    /// Line and column, if known.
    pub(crate) line_column: Option<(usize, usize)>,
}

impl Place {
    /// The place of the byte `offset` of `text`.
    pub fn at(file: &str, text: &str, offset: usize) -> Self {
        let before = text.get(..offset).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let line = before.matches('\n').count() + 1;
        let column = before[line_start..].chars().count() + 1;
        Self {
            file: file.to_owned(),
            line_column: Some((line, column)),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line_column {
            Some((line, column)) => write!(f, "{}:{line}:{column}", self.file),
            None => write!(f, "{}", self.file),
        }
    }
}

/// What is wrong with a URDF.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum UrdfProblem {
    /// A comment, tag or attribute does not end.
    #[error("this {0} has no end; expected `{1}` before the end of the file")]
    Unterminated(&'static str, &'static str),
    /// A tag contains something that is not an attribute.
    #[error("expected an attribute such as name=\"…\" in <{element}>, found {found:?}")]
    NotAnAttribute {
        /// Name of the element.
        element: String,
        /// The character found there.
        found: char,
    },
    /// An attribute appears twice in a tag.
    #[error("<{element}> has {attribute} twice; keep one of them")]
    RepeatedAttribute {
        /// Name of the element.
        element: String,
        /// The attribute.
        attribute: String,
    },
    /// A closing tag does not match the open element.
    #[error("</{found}> closes nothing; expected </{expected}>, which line {line} opens")]
    WrongClosingTag {
        /// Name in the closing tag.
        found: String,
        /// Name of the element that is open.
        expected: String,
        /// Line on which that element starts.
        line: usize,
    },
    /// A closing tag appears where no element is open.
    #[error("</{0}> closes nothing; there is no open element here")]
    StrayClosingTag(String),
    /// An element is never closed.
    #[error("<{0}> is never closed; add </{0}>")]
    Unclosed(String),
    /// Elements are nested too deeply.
    #[error("<{0}> is nested more than {1} deep; a URDF needs five levels")]
    TooDeep(String, usize),
    /// The file's outermost element is not a robot.
    #[error("expected <robot name=\"…\"> as the outermost element, found {0}")]
    NotARobot(String),
    /// A required attribute is missing.
    #[error("<{element}> has no {attribute}; add {attribute}=\"{example}\"")]
    MissingAttribute {
        /// Name of the element.
        element: String,
        /// The missing attribute.
        attribute: &'static str,
        /// What its value could be.
        example: &'static str,
    },
    /// A required child element is missing.
    #[error("<{element}> has no <{child}>; add {example}")]
    MissingChild {
        /// Name of the element.
        element: String,
        /// Name of the missing child.
        child: &'static str,
        /// What it could look like.
        example: &'static str,
    },
    /// Macros, from which a URDF is yet to be made.
    #[error(
        "this is xacro, from which a URDF is made: expand it, `xacro FILE.xacro > FILE.urdf`, and give \
         the FILE.urdf"
    )]
    Xacro,
    /// A file that is neither UTF-8 nor what it declares to be.
    #[error("{0}")]
    Encoding(String),
    /// An attribute has a value that is not of the right kind.
    #[error("{attribute}=\"{value}\" in <{element}> is wrong; expected {expected}")]
    BadValue {
        /// Name of the element.
        element: String,
        /// The attribute.
        attribute: String,
        /// Its value.
        value: String,
        /// What would be right.
        expected: &'static str,
    },
    /// A shape of a kind that is not supported.
    #[error("<{0}> is not supported: use <box>, <cylinder>, <sphere>, <capsule> or <mesh>")]
    UnsupportedShape(String),
    /// A kind of joint that is not supported.
    #[error("joint type \"{0}\" is not supported; use fixed, revolute, continuous or prismatic")]
    UnsupportedJoint(String),
    /// Two links or two joints share a name.
    #[error("there are two {what}s named \"{name}\" (the other one is on line {line}); rename one")]
    DuplicateName {
        /// `link` or `joint`.
        what: &'static str,
        /// The name.
        name: String,
        /// Line of the other one.
        line: usize,
    },
    /// A joint names a link or joint that does not exist.
    #[error("joint \"{joint}\" names the {role} \"{name}\", which does not exist{}", did_you_mean(.closest))]
    UnknownName {
        /// The joint that names it.
        joint: String,
        /// `parent link`, `child link` or `mimicked joint`.
        role: &'static str,
        /// The unknown name.
        name: String,
        /// The nearest known name.
        closest: Option<String>,
    },
    /// A link is the child of two joints.
    #[error("link \"{link}\" is the child of two joints, \"{first}\" and \"{second}\"; keep one")]
    TwoParents {
        /// The link.
        link: String,
        /// The joint that comes first in the file.
        first: String,
        /// The other joint.
        second: String,
    },
    /// Following the parents from this link leads back to it.
    #[error("link \"{0}\" hangs on itself through its parent joints; the joints must form a tree")]
    Cycle(String),
    /// More than one link has no parent.
    #[error(
        "links \"{first}\" and \"{second}\" both have no parent; connect one of them by a joint"
    )]
    SeveralRoots {
        /// The root that comes first in the file.
        first: String,
        /// Another root.
        second: String,
    },
    /// There are no links.
    #[error("there is no link; a robot needs at least one <link name=\"…\"/>")]
    NoLinks,
    /// Limits whose lower end is above their upper end.
    #[error("the {which} of joint \"{joint}\" are reversed: lower {lower} is above upper {upper}")]
    ReversedLimits {
        /// The joint.
        joint: String,
        /// `limits` or `soft limits`.
        which: &'static str,
        /// Lower end (rad or m).
        lower: f64,
        /// Upper end (rad or m).
        upper: f64,
    },
    /// A joint axis of length zero.
    #[error("the axis of joint \"{0}\" is zero; give a direction such as xyz=\"0 0 1\"")]
    ZeroAxis(String),
    /// A joint that follows itself.
    #[error("joint \"{0}\" mimics itself, directly or through other joints")]
    MimicCycle(String),
    /// A mesh of a solid cannot be had.
    #[error("{0}")]
    Mesh(MeshError),
}

/// `; did you mean "x"?`, or nothing.
fn did_you_mean(closest: &Option<String>) -> String {
    match closest {
        Some(name) => format!("; did you mean \"{name}\"?"),
        None => String::new(),
    }
}
