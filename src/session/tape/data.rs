//! Values on the tape.
//!
//! A value is written only if a fresh copy cannot be told from it: numbers, interned symbols, and
//! lists, strings and poses that nothing else refers to. What was given to the call is referred to
//! by its place among the arguments, so that it stays identical. Of everything else there is no
//! copy, and the input is then not on the tape.

use std::rc::Rc;

use serde::{Deserialize, Serialize};

use cram::pose::value::{
    Placement, PoseStamped, Quaternion, TransformStamped, Vector3, as_quaternion, as_vector,
};
use lisp::image::Image;
use lisp::source::Place;
use lisp::value::Value;
use lisp::value::package::PackageId;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// Longest list that is written.
const LONGEST_LIST: usize = 10_000;

/// A symbol by its home package and its name.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
pub struct Name(u16, String);

/// A value.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
pub enum Data {
    /// What was given, by its number.
    Given(usize),
    Symbol(Name),
    Int(i64),
    Single(f32),
    Double(f64),
    Char(char),
    Text(String),
    /// The elements of a proper list.
    List(Vec<Data>),
    /// Zero or several values.
    Values(Vec<Data>),
    Vector([f64; 3]),
    Quaternion([f64; 4]),
    /// A pose in a frame: frame, time stamp (s), position (m), quaternion x y z w.
    Pose(String, f64, [f64; 3], [f64; 4]),
    /// A transform from a frame to a child frame, in the same way.
    Transform(String, String, f64, [f64; 3], [f64; 4]),
}

impl Name {
    /// `None` if the symbol is not interned.
    pub fn of(image: &Image, sym: Sym) -> Option<Name> {
        let data = image.symbol(sym);
        Some(Name(data.package?.0, data.name.to_string()))
    }

    pub fn symbol(&self, image: &mut Image) -> Sym {
        image.intern(PackageId(self.0), &self.1)
    }
}

fn numbers(placement: &Placement) -> ([f64; 3], [f64; 4]) {
    (placement.position.0, placement.orientation.0)
}

fn placement(position: [f64; 3], orientation: [f64; 4]) -> Placement {
    Placement {
        position: Vector3(position),
        orientation: Quaternion(orientation),
    }
}

impl Data {
    /// The value, which nothing else refers to, or which is among those given.
    pub fn of(image: &Image, value: &Value, given: &[Value]) -> Option<Data> {
        Data::held(image, value, given, 1)
    }

    /// The value, to which there are so many references if nothing else refers to it.
    fn held(image: &Image, value: &Value, given: &[Value], count: usize) -> Option<Data> {
        let is_heap = !matches!(
            value,
            Value::Symbol(..)
                | Value::Int(_)
                | Value::Single(_)
                | Value::Double(_)
                | Value::Char(_)
        );
        if is_heap && let Some(number) = given.iter().position(|one| one.is_eq(value)) {
            return Some(Data::Given(number));
        }
        let is_own = |references: usize| (references <= count).then_some(());
        Some(match value {
            Value::Symbol(sym, ..) => Data::Symbol(Name::of(image, *sym)?),
            Value::Int(number) => Data::Int(*number),
            Value::Single(number) => Data::Single(*number),
            Value::Double(number) => Data::Double(*number),
            Value::Char(c) => Data::Char(*c),
            Value::Str(text) => {
                is_own(Rc::strong_count(text))?;
                Data::Text(text.text())
            }
            Value::Cons(_) => {
                let mut items = Vec::new();
                let mut rest = value.clone();
                // The clone is a reference, too.
                let mut references = count + 1;
                while let Value::Cons(cons) = &rest {
                    is_own_of(Rc::strong_count(cons), references)?;
                    if items.len() == LONGEST_LIST || cons.place().is_some() {
                        return None;
                    }
                    items.push(Data::held(image, &cons.car(), given, 2)?);
                    let next = cons.cdr();
                    rest = next;
                    references = 2;
                }
                if !rest.is_nil() {
                    return None;
                }
                Data::List(items)
            }
            Value::Multiple(values) => {
                let items = values.iter().map(|item| Data::held(image, item, given, 1));
                Data::Values(items.collect::<Option<_>>()?)
            }
            Value::Foreign(object) => {
                is_own(Rc::strong_count(object))?;
                Data::of_pose(value)?
            }
            _ => return None,
        })
    }

    fn of_pose(value: &Value) -> Option<Data> {
        if let Some(vector) = as_vector(value) {
            return Some(Data::Vector(vector));
        }
        if let Some(quaternion) = as_quaternion(value) {
            return Some(Data::Quaternion(quaternion));
        }
        if let Some(pose) = value.as_foreign::<PoseStamped>() {
            let (position, orientation) = numbers(&pose.placement);
            let frame = pose.frame.to_string();
            return Some(Data::Pose(frame, pose.stamp, position, orientation));
        }
        let transform = value.as_foreign::<TransformStamped>()?;
        let (position, orientation) = numbers(&transform.placement);
        let (frame, child) = (transform.frame.to_string(), transform.child.to_string());
        Some(Data::Transform(
            frame,
            child,
            transform.stamp,
            position,
            orientation,
        ))
    }

    /// The value again; `None` if something that it refers to was not given.
    pub fn value(&self, image: &mut Image, given: &[Value]) -> Option<Value> {
        let all = |image: &mut Image, items: &[Data]| -> Option<Vec<Value>> {
            items.iter().map(|item| item.value(image, given)).collect()
        };
        Some(match self {
            Data::Given(number) => given.get(*number)?.clone(),
            Data::Symbol(name) => Value::symbol(name.symbol(image)),
            Data::Int(number) => Value::Int(*number),
            Data::Single(number) => Value::Single(*number),
            Data::Double(number) => Value::Double(*number),
            Data::Char(c) => Value::Char(*c),
            Data::Text(text) => Value::from(text.as_str()),
            Data::List(items) => Value::list(all(image, items)?),
            Data::Values(items) => Value::values(all(image, items)?),
            Data::Vector(numbers) => Value::foreign(Vector3(*numbers)),
            Data::Quaternion(numbers) => Value::foreign(Quaternion(*numbers)),
            Data::Pose(frame, stamp, position, orientation) => Value::foreign(PoseStamped {
                frame: frame.as_str().into(),
                stamp: *stamp,
                placement: placement(*position, *orientation),
            }),
            Data::Transform(frame, child, stamp, position, orientation) => {
                Value::foreign(TransformStamped {
                    frame: frame.as_str().into(),
                    child: child.as_str().into(),
                    stamp: *stamp,
                    placement: placement(*position, *orientation),
                })
            }
        })
    }
}

fn is_own_of(references: usize, count: usize) -> Option<()> {
    (references <= count).then_some(())
}

/// A condition that is to be signalled.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
pub struct RaiseData {
    class: Name,
    report: Option<String>,
    initargs: Vec<(Name, Data)>,
}

impl RaiseData {
    pub fn of(image: &Image, raise: &Raise, given: &[Value]) -> Option<RaiseData> {
        let Raise::Make {
            class,
            report,
            initargs,
            place,
        } = raise
        else {
            return None;
        };
        if place.is_some() {
            return None;
        }
        let initargs = initargs
            .iter()
            .map(|(name, value)| Some((Name::of(image, *name)?, Data::of(image, value, given)?)));
        Some(RaiseData {
            class: Name::of(image, *class)?,
            report: report.clone(),
            initargs: initargs.collect::<Option<_>>()?,
        })
    }

    pub fn raise(&self, image: &mut Image, given: &[Value]) -> Option<Box<Raise>> {
        let mut initargs = Vec::with_capacity(self.initargs.len());
        for (name, data) in &self.initargs {
            initargs.push((name.symbol(image), data.value(image, given)?));
        }
        Some(Box::new(Raise::Make {
            class: self.class.symbol(image),
            report: self.report.clone(),
            initargs,
            place: Place::NONE,
        }))
    }
}
