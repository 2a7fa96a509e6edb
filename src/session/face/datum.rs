//! Values as data.

use spatial::Pose;

/// A value of the plan language as data: it refers to nothing in the session, and may be sent to
/// another thread.
///
/// Numbers, texts and booleans are made with `from`: `Datum::from(3)`, `Datum::from("text")`,
/// `Datum::from(true)`. Names of symbols are in upper case, as the language has them.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum Datum {
    /// `NIL`: false, and the empty list.
    Nil,
    /// `T`: true.
    True,
    /// An integer of 64 bits.
    Integer(i64),
    /// A larger integer, in decimal digits.
    Big(String),
    /// A ratio: numerator and denominator in decimal digits.
    Ratio(String, String),
    /// A single float.
    Single(f32),
    /// A double float.
    Float(f64),
    /// A character.
    Character(char),
    /// A string.
    String(String),
    /// A keyword, without its colon.
    Keyword(String),
    /// Another symbol.
    Symbol {
        /// The name of its package. An argument without one belongs to the current package, a value
        /// without one to none.
        package: Option<String>,
        /// Its name.
        name: String,
    },
    /// A list that is not empty.
    List(Vec<Datum>),
    /// A list that ends in something else than `NIL`: its elements and that.
    Dotted(Vec<Datum>, Box<Datum>),
    /// A vector.
    Vector(Vec<Datum>),
    /// A pose in a frame.
    Pose(FramedPose),
    /// A designator of an object that is known by name, such as one that the robot has perceived. As
    /// an argument: a new designator of the object with that name.
    Object(String),
    /// Any other value, as it is printed. Cannot be an argument.
    Other(String),
}

/// A pose in a frame.
#[derive(Clone, PartialEq, Debug)]
pub struct FramedPose {
    /// The frame: `map`, a link of the robot or the kitchen as in their URDFs, or an object.
    pub frame: String,
    /// Position (m) and rotation in that frame.
    pub pose: Pose,
}

impl FramedPose {
    /// A pose in a frame.
    pub fn new(frame: impl Into<String>, pose: Pose) -> FramedPose {
        let frame = frame.into();
        FramedPose { frame, pose }
    }
}

impl From<Pose> for FramedPose {
    /// A pose in the map frame.
    fn from(pose: Pose) -> FramedPose {
        FramedPose::new("map", pose)
    }
}

impl Datum {
    /// A keyword; its name in any case.
    pub fn keyword(name: &str) -> Datum {
        Datum::Keyword(name.to_uppercase())
    }

    /// A symbol of the current package; its name in any case.
    pub fn symbol(name: &str) -> Datum {
        Datum::Symbol {
            package: None,
            name: name.to_uppercase(),
        }
    }

    /// A list; `NIL` if there are no items.
    pub fn list(items: impl IntoIterator<Item = Datum>) -> Datum {
        let items: Vec<Datum> = items.into_iter().collect();
        match items.is_empty() {
            true => Datum::Nil,
            false => Datum::List(items),
        }
    }

    /// Whether it counts as true: all do but `NIL`.
    pub fn is_true(&self) -> bool {
        *self != Datum::Nil
    }

    /// The integer.
    pub fn as_integer(&self) -> Option<i64> {
        match self {
            Datum::Integer(number) => Some(*number),
            _ => None,
        }
    }

    /// The value of an integer of 64 bits or a float, to the precision of a double float.
    pub fn as_float(&self) -> Option<f64> {
        match self {
            Datum::Integer(number) => Some(*number as f64),
            Datum::Single(number) => Some(f64::from(*number)),
            Datum::Float(number) => Some(*number),
            _ => None,
        }
    }

    /// The text of a string.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            Datum::String(text) => Some(text),
            _ => None,
        }
    }

    /// The name of a symbol, a keyword or an object.
    pub fn as_name(&self) -> Option<&str> {
        match self {
            Datum::Nil => Some("NIL"),
            Datum::True => Some("T"),
            Datum::Keyword(name) | Datum::Symbol { name, .. } | Datum::Object(name) => Some(name),
            _ => None,
        }
    }

    /// The elements of a list or a vector; `NIL` has none.
    pub fn as_items(&self) -> Option<&[Datum]> {
        match self {
            Datum::Nil => Some(&[]),
            Datum::List(items) | Datum::Vector(items) => Some(items),
            _ => None,
        }
    }

    /// The pose.
    pub fn as_pose(&self) -> Option<&FramedPose> {
        match self {
            Datum::Pose(pose) => Some(pose),
            _ => None,
        }
    }
}

impl From<bool> for Datum {
    fn from(is_true: bool) -> Datum {
        match is_true {
            true => Datum::True,
            false => Datum::Nil,
        }
    }
}

macro_rules! from {
    ($($type:ty => $kind:ident,)*) => {$(
        impl From<$type> for Datum {
            fn from(value: $type) -> Datum {
                Datum::$kind(value.into())
            }
        }
    )*};
}

from! {
    i64 => Integer,
    i32 => Integer,
    f64 => Float,
    &str => String,
    String => String,
    char => Character,
    FramedPose => Pose,
    Pose => Pose,
}
