//! Values of the language as data.

use super::{Datum, FramedPose};
use crate::simulation::names::name_text;
use crate::simulation::properties::property;
use cram::designator::value::{Class, as_class, current};
use cram::pose::value::PoseStamped;
use lisp::guard::stoppable;
use lisp::image::Image;
use lisp::image::identity::aside;
use lisp::print;
use lisp::value::Value;
use lisp::value::cons::Cons;
use lisp::value::known;

/// Maximum number of elements of a datum, all levels together; what exceeds it is cut off. Circular
/// lists have no end.
const MAX_ELEMENTS: usize = 1_000_000;
/// Maximum number of lists and vectors in one another.
const MAX_LEVELS: usize = 100;

/// What stands for elements that are cut off.
const CUT_OFF: &str = "…";

/// Values as data.
pub(super) fn data(image: &Image, values: &[Value]) -> Vec<Datum> {
    let mut reading = Reading {
        image,
        elements_left: MAX_ELEMENTS,
        levels_left: MAX_LEVELS,
    };
    values.iter().map(|value| reading.datum(value)).collect()
}

/// A value as a datum.
pub(super) fn datum(image: &Image, value: &Value) -> Datum {
    let mut reading = Reading {
        image,
        elements_left: MAX_ELEMENTS,
        levels_left: MAX_LEVELS,
    };
    reading.datum(value)
}

struct Reading<'a> {
    image: &'a Image,
    elements_left: usize,
    levels_left: usize,
}

impl Reading<'_> {
    fn datum(&mut self, value: &Value) -> Datum {
        match value {
            Value::Symbol(known::NIL, ..) => Datum::Nil,
            Value::Symbol(known::T, ..) => Datum::True,
            Value::Symbol(sym, ..) => {
                let symbol = self.image.symbol(*sym);
                let name = symbol.name.to_string();
                if self.image.is_keyword(*sym) {
                    return Datum::Keyword(name);
                }
                let package = symbol.package.map(|id| self.image.packages.get(id));
                let package = package.map(|package| package.name.to_string());
                Datum::Symbol { package, name }
            }
            Value::Int(number) => Datum::Integer(*number),
            Value::Big(number) => Datum::Big(number.to_string()),
            Value::Ratio(ratio) => {
                Datum::Ratio(ratio.numerator.to_string(), ratio.denominator.to_string())
            }
            Value::Single(number) => Datum::Single(*number),
            Value::Double(number) => Datum::Float(*number),
            Value::Char(character) => Datum::Character(*character),
            Value::Str(string) => Datum::String(string.text()),
            Value::Cons(cons) => self.deeper(|reading| reading.list(cons)),
            Value::Vector(vector) => self.deeper(|reading| {
                let items = vector.to_vec();
                Datum::Vector(reading.items(items.into_iter()))
            }),
            Value::Foreign(_) => self.foreign(value),
            _ => self.other(value),
        }
    }

    /// Goes down a level, if there may be one more.
    fn deeper(&mut self, read: impl FnOnce(&mut Self) -> Datum) -> Datum {
        if self.levels_left == 0 {
            return Datum::Other(CUT_OFF.to_owned());
        }
        self.levels_left -= 1;
        let datum = read(self);
        self.levels_left += 1;
        datum
    }

    fn list(&mut self, cons: &Cons) -> Datum {
        let mut items = Vec::new();
        let mut item = cons.car();
        let mut rest = cons.cdr();
        loop {
            if !self.take_element() {
                rest = Value::NIL;
                items.push(Datum::Other(CUT_OFF.to_owned()));
                break;
            }
            items.push(self.datum(&item));
            let Value::Cons(next) = &rest else { break };
            item = next.car();
            let after = next.cdr();
            rest = after;
        }
        match rest.is_nil() {
            true => Datum::List(items),
            false => Datum::Dotted(items, Box::new(self.datum(&rest))),
        }
    }

    fn items(&mut self, values: impl Iterator<Item = Value>) -> Vec<Datum> {
        let mut items = Vec::new();
        for value in values {
            if !self.take_element() {
                items.push(Datum::Other(CUT_OFF.to_owned()));
                break;
            }
            items.push(self.datum(&value));
        }
        items
    }

    fn take_element(&mut self) -> bool {
        let has_room = self.elements_left > 0;
        self.elements_left = self.elements_left.saturating_sub(1);
        has_room
    }

    fn foreign(&self, value: &Value) -> Datum {
        if let Some(stamped) = value.as_foreign::<PoseStamped>() {
            let pose = stamped.placement.to_pose();
            return Datum::Pose(FramedPose::new(&*stamped.frame, pose));
        }
        let is_object = as_class(value, Class::Object).is_some();
        let name = is_object.then(|| property(self.image, &current(value), "NAME"));
        let name = name.flatten().and_then(|name| name_text(self.image, &name));
        name.map_or_else(|| self.other(value), Datum::Object)
    }

    fn other(&self, value: &Value) -> Datum {
        let _watch = self.image.limits.watch();
        let text = stoppable(|| aside(self.image, || print::to_string(self.image, value, true)));
        Datum::Other(text.unwrap_or_else(|_| CUT_OFF.to_owned()))
    }
}
