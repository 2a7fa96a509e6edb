//! Types as Rust values, and the calls that reading or testing them may need.

use crate::value::element_type::ElementType;
use std::rc::Rc;

use crate::value::Value;
use crate::value::class::Class;
use crate::value::raise::Raise;

/// A set of values.
#[derive(Clone)]
pub enum Type {
    /// Everything.
    Any,
    /// Nothing.
    Nothing,
    /// Instances of a class that none of the other kinds describes.
    Class(Rc<Class>),
    /// The values themselves, by `eql`.
    Member(Vec<Value>),
    /// Real numbers of one representation between two bounds.
    Real(RealKind, Bound, Bound),
    /// Complex numbers whose parts are both of the type, which has numbers of one representation, or
    /// integers and ratios.
    Complex(Box<Type>),
    /// Values of all the types.
    And(Vec<Type>),
    /// Values of any of the types.
    Or(Vec<Type>),
    /// Values that are not of the type.
    Not(Box<Type>),
    /// Pairs by the types of their halves.
    Cons(Box<Type>, Box<Type>),
    /// Arrays.
    Array {
        /// Must it be simple?
        simple: bool,
        /// The upgraded element type; any if none.
        element: Option<ElementType>,
        /// The dimensions; any if none.
        dimensions: Option<Vec<Option<usize>>>,
    },
    /// The 96 characters of the standard.
    StandardCharacters,
    /// Functions that are not generic.
    CompiledFunction,
    /// Values for which the function returns true.
    Satisfies(Value),
}

/// How a real number is represented.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RealKind {
    /// Integers.
    Integer,
    /// Ratios.
    Ratio,
    /// Single floats.
    Single,
    /// Double floats.
    Double,
}

impl RealKind {
    /// Is a value a number of this representation?
    pub fn has(self, value: &Value) -> bool {
        match value {
            Value::Int(_) | Value::Big(_) => self == RealKind::Integer,
            Value::Ratio(_) => self == RealKind::Ratio,
            Value::Single(_) => self == RealKind::Single,
            Value::Double(_) => self == RealKind::Double,
            _ => false,
        }
    }
}

/// A bound of a range.
#[derive(Clone)]
pub enum Bound {
    /// There is none.
    None,
    /// The number itself belongs to the range.
    Inclusive(Value),
    /// The number itself does not.
    Exclusive(Value),
}

/// Why an operation on types stops early.
pub enum Stop {
    /// A function must be called; the operation is started again with its value.
    Call {
        function: Value,
        /// The arguments.
        args: Vec<Value>,
    },
    /// A name that is not a type, with the error that says so.
    UnknownType(Box<Raise>),
    /// Another error.
    Raise(Box<Raise>),
}

impl From<Box<Raise>> for Stop {
    fn from(raise: Box<Raise>) -> Stop {
        Stop::Raise(raise)
    }
}

/// Values of the calls made so far, in the order in which an operation asks for them.
#[derive(Clone, Default)]
pub struct Answers {
    given: Vec<Value>,
    used: usize,
}

impl Answers {
    /// Adds the value of the call that the operation stopped at, and starts again.
    pub fn add(&mut self, value: Value) {
        self.given.push(value);
        self.used = 0;
    }

    /// The value of a call: known, or a reason to stop.
    pub fn ask(&mut self, function: &Value, args: Vec<Value>) -> Result<Value, Stop> {
        match self.given.get(self.used) {
            Some(value) => {
                self.used += 1;
                Ok(value.clone())
            }
            None => Err(Stop::Call {
                function: function.clone(),
                args,
            }),
        }
    }
}
