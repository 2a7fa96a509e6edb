//! What a Lisp expression can evaluate to.
//!
//! A value is sixteen bytes: immediate or a counted reference. Identity (`eq`) is the
//! identity of the reference; nothing shows an address to the user.

pub mod array;
pub mod class;
pub mod code;
pub mod cons;
pub mod copy;
pub mod cycles;
pub mod dispatch;
pub(crate) mod document;
pub(crate) mod element_type;
pub mod elements;
pub mod equality;
pub mod foreign;
pub mod form;
pub mod function;
pub mod generic;
pub mod hash_table;
mod key_hasher;
pub mod known;
pub mod number;
pub mod operation;
pub mod package;
pub mod parameters;
pub mod pathname;
pub mod placing;
mod present_symbols;
pub mod raise;
pub mod release;
pub mod sequence;
pub mod shared_slot;
pub mod slot;
mod spare;
pub mod stream;
pub mod string;
pub mod symbol;
pub mod weak;

use std::rc::Rc;

use num_bigint::BigInt;

use self::array::{Array, Vector};
use self::class::{Class, Instance};
use self::cons::Cons;
use self::foreign::ForeignBox;
use self::function::Function;
use self::hash_table::HashTable;
use self::number::Ratio;
use self::package::PackageId;
use self::shared_slot::SharedSlot;
use self::stream::Stream;
use self::string::LispString;
use self::symbol::{Hold, Sym};
use crate::guard::{self, Pace, STEPS};

/// A Lisp value.
///
/// The kinds of which there is nothing to free come first, so that one comparison tells them.
#[derive(Default)]
pub enum Value {
    /// Internal: no value (unbound variable or slot, argument not supplied).
    #[default]
    Unbound,
    /// An integer that fits 64 bits.
    Int(i64),
    /// A single float.
    Single(f32),
    /// A double float.
    Double(f64),
    /// A character.
    Char(char),
    /// A package.
    Package(PackageId),
    /// A symbol; `NIL` and `T` are symbols too. With what holds its data, if that may be freed.
    Symbol(Sym, Hold),
    /// A pair.
    Cons(Rc<Cons>),
    /// An integer that does not fit 64 bits.
    Big(Rc<BigInt>),
    /// A ratio in lowest terms with a denominator greater than one.
    Ratio(Rc<Ratio>),
    /// A string.
    Str(Rc<LispString>),
    /// A one-dimensional array of anything.
    Vector(Rc<Vector>),
    /// An array of rank other than one.
    Array(Rc<Array>),
    /// A function: closure, builtin or generic function.
    Function(Rc<Function>),
    /// A hash table.
    Hash(Rc<HashTable>),
    /// An instance of a class, a structure or a condition.
    Instance(Rc<Instance>),
    /// A class.
    Class(Rc<Class>),
    /// A stream.
    Stream(Rc<Stream>),
    /// A value of a layer above the language (task, fluent, designator, pose, …).
    Foreign(Rc<ForeignBox>),
    /// Internal: the box of a variable that a closure shares. Never reaches user code.
    Cell(Rc<SharedSlot>),
    /// Internal: zero, or more than one, values returned by a call. Never stored in a variable.
    Multiple(Rc<Vec<Value>>),
}

impl Clone for Value {
    /// The most frequent kinds are copied in place, which is several times faster than a call.
    #[inline(always)]
    fn clone(&self) -> Value {
        match self {
            Value::Int(n) => Value::Int(*n),
            Value::Cons(cons) => Value::Cons(cons.clone()),
            Value::Symbol(sym, hold) if hold.is_none() => Value::symbol(*sym),
            other => other.clone_other(),
        }
    }
}

impl Value {
    /// A copy of a value of one of the less frequent kinds.
    #[inline(never)]
    fn clone_other(&self) -> Value {
        match self {
            Value::Symbol(sym, hold) => Value::Symbol(*sym, hold.clone()),
            Value::Int(n) => Value::Int(*n),
            Value::Big(n) => Value::Big(n.clone()),
            Value::Ratio(ratio) => Value::Ratio(ratio.clone()),
            Value::Single(x) => Value::Single(*x),
            Value::Double(x) => Value::Double(*x),
            Value::Char(c) => Value::Char(*c),
            Value::Cons(cons) => Value::Cons(cons.clone()),
            Value::Str(string) => Value::Str(string.clone()),
            Value::Vector(vector) => Value::Vector(vector.clone()),
            Value::Array(array) => Value::Array(array.clone()),
            Value::Function(function) => Value::Function(function.clone()),
            Value::Hash(table) => Value::Hash(table.clone()),
            Value::Instance(instance) => Value::Instance(instance.clone()),
            Value::Class(class) => Value::Class(class.clone()),
            Value::Package(package) => Value::Package(*package),
            Value::Stream(stream) => Value::Stream(stream.clone()),
            Value::Foreign(object) => Value::Foreign(object.clone()),
            Value::Cell(cell) => Value::Cell(cell.clone()),
            Value::Multiple(values) => Value::Multiple(values.clone()),
            Value::Unbound => Value::Unbound,
        }
    }

    /// Is there nothing to free?
    #[inline(always)]
    pub fn is_plain(&self) -> bool {
        match self {
            Value::Unbound
            | Value::Int(_)
            | Value::Single(_)
            | Value::Double(_)
            | Value::Char(_)
            | Value::Package(_) => true,
            Value::Symbol(_, hold) => hold.is_none(),
            _ => false,
        }
    }

    /// The empty list and falsehood.
    pub const NIL: Value = Value::Symbol(known::NIL, Hold::NONE);
    /// Truth.
    pub const T: Value = Value::Symbol(known::T, Hold::NONE);

    /// A symbol, without a hold on its data.
    #[inline]
    pub const fn symbol(sym: Sym) -> Value {
        Value::Symbol(sym, Hold::NONE)
    }

    /// `T` or `NIL`.
    #[inline]
    pub fn bool(b: bool) -> Value {
        if b { Value::T } else { Value::NIL }
    }

    /// Is this `NIL`?
    #[inline]
    pub fn is_nil(&self) -> bool {
        matches!(self, Value::Symbol(known::NIL, ..))
    }

    /// Is this anything but `NIL`?
    #[inline]
    pub fn is_true(&self) -> bool {
        !self.is_nil()
    }

    /// Is this the internal marker for "no value"?
    #[inline]
    pub fn is_unbound(&self) -> bool {
        matches!(self, Value::Unbound)
    }

    /// A fresh string.
    pub fn string(text: impl Into<String>) -> Value {
        Value::Str(Rc::new(LispString::new(text.into())))
    }

    /// A fresh pair.
    #[inline]
    pub fn cons(car: Value, cdr: Value) -> Value {
        Value::Cons(Cons::shared(car, cdr))
    }

    /// A fresh list of the items.
    pub fn list<I>(items: I) -> Value
    where
        I: IntoIterator<Item = Value>,
        I::IntoIter: DoubleEndedIterator,
    {
        Value::list_with_tail(items, Value::NIL)
    }

    /// A fresh list of the items that ends in `tail`.
    pub fn list_with_tail<I>(items: I, tail: Value) -> Value
    where
        I: IntoIterator<Item = Value>,
        I::IntoIter: DoubleEndedIterator,
    {
        let mut pace = Pace::default();
        items.into_iter().rev().fold(tail, |rest, item| {
            pace.step();
            Value::cons(item, rest)
        })
    }

    /// A fresh simple vector.
    pub fn vector(items: Vec<Value>) -> Value {
        Value::Vector(Rc::new(Vector::simple(items)))
    }

    /// A value of a higher layer.
    pub fn foreign(object: impl foreign::Foreign) -> Value {
        Value::Foreign(Rc::new(ForeignBox::new(object)))
    }

    /// The multiple values; exactly one value is itself.
    pub fn values(mut items: Vec<Value>) -> Value {
        match items.len() {
            1 => items.pop().unwrap_or(Value::NIL),
            _ => Value::Multiple(Rc::new(items)),
        }
    }

    /// The first of possibly several values (`NIL` when there is none).
    #[inline]
    pub fn primary(self) -> Value {
        match self {
            Value::Multiple(values) => values.first().cloned().unwrap_or(Value::NIL),
            single => single,
        }
    }

    /// All values of a call's result.
    pub fn into_values(self) -> Vec<Value> {
        match self {
            Value::Multiple(values) => values.as_ref().clone(),
            single => vec![single],
        }
    }

    /// The symbol, if this is one.
    #[inline]
    pub fn as_symbol(&self) -> Option<Sym> {
        match self {
            Value::Symbol(s, ..) => Some(*s),
            _ => None,
        }
    }

    /// The pair, if this is one.
    #[inline]
    pub fn as_cons(&self) -> Option<&Rc<Cons>> {
        match self {
            Value::Cons(c) => Some(c),
            _ => None,
        }
    }

    /// The string, if this is one.
    pub(crate) fn as_string(&self) -> Option<&Rc<LispString>> {
        match self {
            Value::Str(string) => Some(string),
            _ => None,
        }
    }

    /// The text of a string, if this is one.
    pub fn as_text(&self) -> Option<String> {
        match self {
            Value::Str(s) => Some(s.text()),
            _ => None,
        }
    }

    /// The object of a higher layer, if this is one of type `T`.
    pub fn as_foreign<T: 'static>(&self) -> Option<&T> {
        match self {
            Value::Foreign(f) => f.downcast_ref::<T>(),
            _ => None,
        }
    }

    /// Is this a list: a pair or `NIL`?
    pub fn is_list(&self) -> bool {
        self.is_nil() || matches!(self, Value::Cons(_))
    }

    /// Identity: the same object. Numbers and characters are identical when `eql`, except that
    /// bignums, ratios and floats are compared only by `eql`.
    #[inline(always)]
    pub fn is_eq(&self, other: &Value) -> bool {
        match (self, other) {
            (Value::Symbol(a, _), Value::Symbol(b, _)) => a == b,
            (Value::Int(a), Value::Int(b)) => a == b,
            _ => self.is_same_object(other),
        }
    }

    /// The same for values that are not both symbols or small integers.
    fn is_same_object(&self, other: &Value) -> bool {
        match (self, other) {
            (Value::Single(a), Value::Single(b)) => a.to_bits() == b.to_bits(),
            (Value::Double(a), Value::Double(b)) => a.to_bits() == b.to_bits(),
            (Value::Char(a), Value::Char(b)) => a == b,
            (Value::Package(a), Value::Package(b)) => a == b,
            (Value::Big(a), Value::Big(b)) => Rc::ptr_eq(a, b),
            (Value::Ratio(a), Value::Ratio(b)) => Rc::ptr_eq(a, b),
            (Value::Cons(a), Value::Cons(b)) => Rc::ptr_eq(a, b),
            (Value::Str(a), Value::Str(b)) => Rc::ptr_eq(a, b),
            (Value::Vector(a), Value::Vector(b)) => Rc::ptr_eq(a, b),
            (Value::Array(a), Value::Array(b)) => Rc::ptr_eq(a, b),
            (Value::Function(a), Value::Function(b)) => Rc::ptr_eq(a, b),
            (Value::Hash(a), Value::Hash(b)) => Rc::ptr_eq(a, b),
            (Value::Instance(a), Value::Instance(b)) => Rc::ptr_eq(a, b),
            (Value::Class(a), Value::Class(b)) => Rc::ptr_eq(a, b),
            (Value::Stream(a), Value::Stream(b)) => Rc::ptr_eq(a, b),
            (Value::Foreign(a), Value::Foreign(b)) => Rc::ptr_eq(a, b),
            (Value::Cell(a), Value::Cell(b)) => Rc::ptr_eq(a, b),
            (Value::Unbound, Value::Unbound) => true,
            _ => false,
        }
    }

    /// `eql`: identical, or numbers of one type and value.
    pub fn is_eql(&self, other: &Value) -> bool {
        match (self, other) {
            (Value::Big(a), Value::Big(b)) => a == b,
            (Value::Ratio(a), Value::Ratio(b)) => a == b,
            (Value::Foreign(a), Value::Foreign(_)) if number::is_complex(self) => {
                a.object().is_equal(other)
            }
            _ => self.is_eq(other),
        }
    }

    /// Iterates over the elements of a list; stops at the first tail that is not a pair, and
    /// after a few rounds of a circular list.
    pub fn iter_list(&self) -> ListIter {
        ListIter {
            rest: self.clone(),
            rounds: Rounds::default(),
        }
    }

    /// The elements of a proper list, or `None` if the value is a dotted list or not a list.
    pub fn list_to_vec(&self) -> Option<Vec<Value>> {
        let mut iter = self.iter_list();
        let items: Vec<Value> = iter.by_ref().collect();
        iter.rest.is_nil().then_some(items)
    }

    /// The symbol of the name `(setf symbol)`.
    pub(crate) fn setf_name(&self) -> Option<Sym> {
        match self.list_to_vec()?.as_slice() {
            [Value::Symbol(known::SETF, ..), Value::Symbol(sym, ..)] => Some(*sym),
            _ => None,
        }
    }

    /// The car of a pair; `NIL` for anything else.
    pub fn car_or_nil(&self) -> Value {
        self.as_cons().map_or(Value::NIL, |c| c.car())
    }

    /// The cdr of a pair; `NIL` for anything else.
    pub fn cdr_or_nil(&self) -> Value {
        self.as_cons().map_or(Value::NIL, |c| c.cdr())
    }
}

/// Detects that a walk along a list is going round in a circle, after a few rounds (Brent's
/// algorithm).
pub(crate) struct Rounds {
    /// A pair visited before: the list is circular if it is met again.
    mark: Option<Rc<Cons>>,
    steps: usize,
    next_mark: usize,
    /// The number of steps at which there is to be a mark, or the walk may have to stop.
    next_stop: usize,
}

impl Default for Rounds {
    fn default() -> Rounds {
        Rounds {
            mark: None,
            steps: 0,
            next_mark: 1024,
            next_stop: 1024,
        }
    }
}

impl Rounds {
    /// Is the list circular? Must be called for each pair of the list in turn.
    #[inline(always)]
    pub(crate) fn is_closed_by(&mut self, pair: &Rc<Cons>) -> bool {
        if self
            .mark
            .as_ref()
            .is_some_and(|mark| Rc::ptr_eq(mark, pair))
        {
            return true;
        }
        self.steps += 1;
        if self.steps == self.next_stop {
            self.stop(pair);
        }
        false
    }

    #[cold]
    #[inline(never)]
    fn stop(&mut self, pair: &Rc<Cons>) {
        if self.steps.is_multiple_of(STEPS) {
            guard::look();
        }
        if self.steps == self.next_mark {
            self.mark = Some(pair.clone());
            self.next_mark *= 2;
        }
        self.next_stop = self.next_mark.min((self.steps + 1).next_multiple_of(STEPS));
    }
}

/// Iterator over the elements of a list.
pub struct ListIter {
    /// What has not been visited yet; at the end, the list's tail: a pair if the list is
    /// circular.
    pub rest: Value,
    rounds: Rounds,
}

impl Iterator for ListIter {
    type Item = Value;

    fn next(&mut self) -> Option<Value> {
        if self.rounds.is_closed_by(self.rest.as_cons()?) {
            return None;
        }
        let cons = self.rest.take_pair()?;
        cons.copy_cdr_into(&mut self.rest);
        Some(cons.car())
    }
}

impl From<bool> for Value {
    fn from(b: bool) -> Value {
        Value::bool(b)
    }
}

impl From<i64> for Value {
    fn from(n: i64) -> Value {
        Value::Int(n)
    }
}

impl From<usize> for Value {
    fn from(n: usize) -> Value {
        i64::try_from(n).map_or_else(|_| Value::Big(Rc::new(n.into())), Value::Int)
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Value {
        Value::Double(x)
    }
}

impl From<Sym> for Value {
    fn from(s: Sym) -> Value {
        Value::symbol(s)
    }
}

impl From<&str> for Value {
    fn from(s: &str) -> Value {
        Value::string(s)
    }
}
