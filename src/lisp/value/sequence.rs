//! Sequences as Rust code sees them: lists, vectors and strings behind one interface.

use super::element_type::ElementType;
use std::rc::Rc;

use crate::value::array::Vector;
use crate::value::cons::{self, Cons};
use crate::value::cycles;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::string::LispString;
use crate::value::{Rounds, Value};

#[derive(Clone)]
pub(crate) enum Sequence {
    /// A list, possibly dotted or circular, which is discovered while walking it.
    List(Value),
    /// A one-dimensional array.
    Vector(Rc<Vector>),
    /// A string.
    Str(Rc<LispString>),
}

impl Sequence {
    /// A value as a sequence.
    pub(crate) fn of(value: &Value) -> Result<Sequence, Box<Raise>> {
        match value {
            Value::Symbol(known::NIL, ..) | Value::Cons(_) => Ok(Sequence::List(value.clone())),
            Value::Vector(vector) => Ok(Sequence::Vector(vector.clone())),
            Value::Str(string) => Ok(Sequence::Str(string.clone())),
            _ => Err(Raise::type_error(value, known::SEQUENCE)),
        }
    }

    /// The sequence as a value.
    pub(crate) fn value(&self) -> Value {
        match self {
            Sequence::List(list) => list.clone(),
            Sequence::Vector(vector) => Value::Vector(vector.clone()),
            Sequence::Str(string) => Value::Str(string.clone()),
        }
    }

    /// Number of elements.
    pub(crate) fn len(&self) -> Result<usize, Box<Raise>> {
        match self {
            Sequence::List(list) => list_length(list),
            Sequence::Vector(vector) => Ok(vector.len()),
            Sequence::Str(string) => Ok(string.len()),
        }
    }

    /// Walks the elements from `start` to `end` (`None`: to the end).
    pub(crate) fn walk(&self, bounds: Bounds) -> Walk {
        let state = match self {
            Sequence::List(list) => State::List(ListWalk::new(list.clone())),
            Sequence::Vector(vector) => State::Vector(vector.clone()),
            Sequence::Str(string) => State::Str(string.clone()),
        };
        let mut walk = Walk {
            state,
            index: 0,
            end: bounds.end,
        };
        walk.skip(bounds.start);
        walk
    }

    /// The elements within bounds.
    pub(crate) fn items(&self, bounds: Bounds) -> Result<Vec<Value>, Box<Raise>> {
        let mut items = Vec::new();
        let mut walk = self.walk(bounds);
        while let Some(item) = walk.next()? {
            items.push(item);
        }
        Ok(items)
    }

    /// All elements.
    pub(crate) fn all(&self) -> Result<Vec<Value>, Box<Raise>> {
        match self {
            Sequence::Vector(vector) => Ok(vector.to_vec()),
            _ => self.items(Bounds::ALL),
        }
    }

    /// The kind of the sequence.
    pub(crate) fn kind(&self) -> Kind {
        match self {
            Sequence::List(_) => Kind::List,
            Sequence::Vector(vector) => Kind::Vector(vector.element_type),
            Sequence::Str(_) => Kind::Str,
        }
    }

    /// Replaces all elements of a sequence by as many others.
    pub(crate) fn set_all(&self, items: &[Value]) -> Result<(), Box<Raise>> {
        match self {
            Sequence::List(list) => {
                for (cons, item) in conses(list)?.iter().zip(items) {
                    cycles::note(cons, item);
                    cons.set_car(item.clone());
                }
            }
            Sequence::Vector(vector) => {
                for (index, item) in items.iter().enumerate() {
                    let item = element(vector, item.clone())?;
                    cycles::note(vector, &item);
                    vector.set(index, item);
                }
            }
            Sequence::Str(string) => string.set_text(text_of(items)?),
        }
        Ok(())
    }

    /// Replaces the element at an index that is within the sequence.
    pub(crate) fn set(&self, index: usize, value: Value) -> Result<(), Box<Raise>> {
        let length = match self {
            Sequence::List(list) => {
                let mut rest = list.clone();
                for _ in 0..index {
                    rest = rest.cdr_or_nil();
                }
                match rest {
                    Value::Cons(cons) => {
                        cycles::note(&cons, &value);
                        cons.set_car(value);
                        return Ok(());
                    }
                    _ => list_length(list)?,
                }
            }
            Sequence::Vector(vector) => {
                cycles::note(vector, &value);
                if index < vector.len() && vector.set(index, element(vector, value)?) {
                    return Ok(());
                }
                vector.len()
            }
            Sequence::Str(string) => {
                if string.set_char(index, character(&value)?) {
                    return Ok(());
                }
                string.len()
            }
        };
        Err(self.no_such_index(index, length))
    }

    /// The element at an index.
    pub(crate) fn get(&self, index: usize) -> Result<Value, Box<Raise>> {
        let found = match self {
            Sequence::List(list) => {
                let mut walk = ListWalk::new(list.clone());
                let mut item = walk.next()?;
                for _ in 0..index {
                    if item.is_none() {
                        break;
                    }
                    item = walk.next()?;
                }
                item
            }
            Sequence::Vector(vector) if index < vector.len() => vector.get(index),
            Sequence::Vector(_) => None,
            Sequence::Str(string) => string.char_at(index).map(Value::Char),
        };
        match found {
            Some(value) => Ok(value),
            None => Err(self.no_such_index(index, self.len()?)),
        }
    }

    fn no_such_index(&self, index: usize, length: usize) -> Box<Raise> {
        match self {
            Sequence::List(_) => index_too_large(index, "list", length),
            Sequence::Vector(vector) => index_too_large(
                index,
                if vector.element_type == ElementType::Bit {
                    "bit vector"
                } else {
                    "vector"
                },
                length,
            ),
            Sequence::Str(_) => index_too_large(index, "string", length),
        }
    }
}

/// "The index 5 is too large for a list of length 2."
pub(crate) fn index_too_large(index: usize, what: &str, length: usize) -> Box<Raise> {
    Raise::new(
        known::TYPE_ERROR,
        format!("The index {index} is too large for a {what} of length {length}."),
    )
    .with(known::K_DATUM, index.into())
    .with(
        known::K_EXPECTED_TYPE,
        Value::list([
            known::INTEGER.into(),
            Value::Int(0),
            Value::list([length.into()]),
        ]),
    )
}

/// What a vector with this element type stores for a value.
pub fn element(vector: &Vector, value: Value) -> Result<Value, Box<Raise>> {
    checked_element(vector.element_type, value)
}

/// Checks that a value may be stored in an array of an element type.
pub(crate) fn checked_element(
    element_type: ElementType,
    value: Value,
) -> Result<Value, Box<Raise>> {
    if element_type.holds(&value) {
        Ok(value)
    } else {
        Err(Raise::type_error(&value, element_type.specifier()))
    }
}

/// A value as a character.
pub fn character(value: &Value) -> Result<char, Box<Raise>> {
    match value {
        Value::Char(c) => Ok(*c),
        _ => Err(Raise::type_error(value, known::CHARACTER)),
    }
}

/// The text made of characters.
pub fn text_of(items: &[Value]) -> Result<String, Box<Raise>> {
    items.iter().map(character).collect()
}

/// The kind of sequence that a result is to be.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A list.
    List,
    /// A vector with an element type.
    Vector(ElementType),
    /// A string.
    Str,
}

impl Kind {
    /// A fresh sequence of this kind.
    pub fn make(self, items: Vec<Value>) -> Result<Value, Box<Raise>> {
        match self {
            Kind::List => Ok(Value::list(items)),
            Kind::Str => Ok(Value::string(text_of(&items)?)),
            Kind::Vector(element_type) => {
                let items: Result<Vec<Value>, _> = items
                    .into_iter()
                    .map(|item| checked_element(element_type, item))
                    .collect();
                let mut vector = Vector::simple(items?);
                vector.element_type = element_type;
                Ok(Value::Vector(Rc::new(vector)))
            }
        }
    }
}

/// Bounds of a part of a sequence.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// Index of the first element.
    pub start: usize,
    /// Index after the last element; none means the sequence's end.
    pub end: Option<usize>,
}

impl Bounds {
    /// The whole sequence.
    pub(crate) const ALL: Bounds = Bounds {
        start: 0,
        end: None,
    };

    /// Checks `:start` and `:end` arguments against a sequence.
    pub(crate) fn new(
        sequence: &Sequence,
        start: Option<&Value>,
        end: Option<&Value>,
    ) -> Result<Bounds, Box<Raise>> {
        if let Some(start @ Value::Symbol(known::NIL, ..)) = start {
            return Err(Raise::type_error(start, known::UNSIGNED_BYTE));
        }
        let start_index = index_or(start, Some(0))?;
        let end_index = index_or(end, None)?;
        if start_index == Some(0) && end_index.is_none() && end.is_none_or(Value::is_nil) {
            return Ok(Bounds::ALL);
        }
        let length = sequence.len()?;
        let last = match end {
            Some(end) if end.is_true() => end_index,
            _ => Some(length),
        };
        match (start_index, last) {
            (Some(start), Some(end)) if start <= end && end <= length => Ok(Bounds {
                start,
                end: Some(end),
            }),
            _ => Err(bad_bounds(start, end, length)),
        }
    }

    /// Index after the last element, for a sequence of a length.
    pub(crate) fn end_of(self, length: usize) -> usize {
        self.end.unwrap_or(length)
    }
}

/// A non-negative integer argument; the default where it is absent or `NIL`; none where it
/// is too large to be an index.
fn index_or(value: Option<&Value>, default: Option<usize>) -> Result<Option<usize>, Box<Raise>> {
    match value {
        None | Some(Value::Symbol(known::NIL, ..)) => Ok(default),
        Some(Value::Int(n)) if *n >= 0 => Ok(usize::try_from(*n).ok()),
        Some(Value::Big(n)) if n.sign() == num_bigint::Sign::Plus => Ok(None),
        Some(other) => Err(Raise::type_error(other, known::UNSIGNED_BYTE)),
    }
}

fn bad_bounds(start: Option<&Value>, end: Option<&Value>, length: usize) -> Box<Raise> {
    let show = |value: Option<&Value>, default: &str| match value {
        Some(Value::Int(n)) => n.to_string(),
        Some(Value::Big(n)) => n.to_string(),
        _ => default.to_owned(),
    };
    let datum = Value::cons(
        start.cloned().unwrap_or(Value::Int(0)),
        end.cloned().unwrap_or(Value::NIL),
    );
    Raise::new(
        known::TYPE_ERROR,
        format!(
            "The bounding indices {} and {} are bad for a sequence of length {length}.",
            show(start, "0"),
            show(end, "NIL"),
        ),
    )
    .with(known::K_DATUM, datum)
    .with(
        known::K_EXPECTED_TYPE,
        Value::list([
            known::CONS.into(),
            Value::list([known::INTEGER.into(), Value::Int(0), length.into()]),
            Value::list([known::INTEGER.into(), Value::Int(0), length.into()]),
        ]),
    )
}

/// A non-negative integer that can be an index or a count.
pub fn index(value: &Value) -> Result<usize, Box<Raise>> {
    match value {
        Value::Int(n) => {
            usize::try_from(*n).map_err(|_| Raise::type_error(value, known::UNSIGNED_BYTE))
        }
        Value::Big(n) if n.sign() == num_bigint::Sign::Plus => Ok(usize::MAX),
        _ => Err(Raise::type_error(value, known::UNSIGNED_BYTE)),
    }
}

/// Walks elements one by one.
pub(crate) struct Walk {
    state: State,
    index: usize,
    end: Option<usize>,
}

enum State {
    List(ListWalk),
    Vector(Rc<Vector>),
    Str(Rc<LispString>),
}

impl Walk {
    fn skip(&mut self, count: usize) {
        self.index = count;
        if let State::List(walk) = &mut self.state {
            for _ in 0..count {
                walk.rest = walk.rest.cdr_or_nil();
            }
        }
    }

    /// The next element.
    pub(crate) fn next(&mut self) -> Result<Option<Value>, Box<Raise>> {
        if self.end.is_some_and(|end| self.index >= end) {
            return Ok(None);
        }
        let item = match &mut self.state {
            State::List(walk) => walk.next()?,
            State::Vector(vector) if self.index < vector.len() => vector.get(self.index),
            State::Vector(_) => None,
            State::Str(string) => string.char_at(self.index).map(Value::Char),
        };
        self.index += 1;
        Ok(item)
    }
}

/// Walks a list that must be proper: a dotted or circular one is an error when its end, or
/// the second round, is reached.
pub(crate) struct ListWalk {
    /// What has not been visited yet.
    pub rest: Value,
    rounds: Rounds,
}

impl ListWalk {
    /// A walk over a list.
    pub(crate) fn new(list: Value) -> ListWalk {
        ListWalk {
            rest: list,
            rounds: Rounds::default(),
        }
    }

    /// The next pair.
    #[inline(always)]
    pub(crate) fn next_cons(&mut self) -> Result<Option<Rc<Cons>>, Box<Raise>> {
        match &self.rest {
            Value::Cons(cons) => {
                if self.rounds.is_closed_by(cons) {
                    return Err(circular(&self.rest));
                }
            }
            Value::Symbol(known::NIL, ..) => return Ok(None),
            other => return Err(Raise::type_error(other, known::LIST)),
        }
        let cons = self.rest.take_pair();
        if let Some(cons) = &cons {
            cons.copy_cdr_into(&mut self.rest);
        }
        Ok(cons)
    }

    /// The next element.
    pub(crate) fn next(&mut self) -> Result<Option<Value>, Box<Raise>> {
        Ok(self.next_cons()?.map(|cons| cons.car()))
    }
}

/// The error for a circular list that should end.
pub fn circular(list: &Value) -> Box<Raise> {
    Raise::new(known::TYPE_ERROR, "The list is circular.")
        .with(known::K_DATUM, list.clone())
        .with(known::K_EXPECTED_TYPE, known::LIST.into())
}

/// Length of a proper list.
pub(crate) fn list_length(list: &Value) -> Result<usize, Box<Raise>> {
    let mut pair = match list {
        Value::Cons(first) => first.clone(),
        Value::Symbol(known::NIL, ..) => return Ok(0),
        other => return Err(Raise::type_error(other, known::LIST)),
    };
    let mut rounds = Rounds::default();
    let mut count = 0;
    loop {
        if rounds.is_closed_by(&pair) {
            return Err(circular(&Value::Cons(pair)));
        }
        count += 1;
        match pair.cdr_cons() {
            Some(next) => cons::release(std::mem::replace(&mut pair, next)),
            None => break,
        }
    }
    match pair.cdr() {
        Value::Symbol(known::NIL, ..) => Ok(count),
        end => Err(Raise::type_error(&end, known::LIST)),
    }
}

/// The pairs of a proper list.
pub(crate) fn conses(list: &Value) -> Result<Vec<Rc<Cons>>, Box<Raise>> {
    let mut walk = ListWalk::new(list.clone());
    let mut conses = Vec::new();
    while let Some(cons) = walk.next_cons()? {
        conses.push(cons);
    }
    Ok(conses)
}

/// The elements of a proper list.
pub(crate) fn list_items(list: &Value) -> Result<Vec<Value>, Box<Raise>> {
    let mut walk = ListWalk::new(list.clone());
    let mut items = Vec::new();
    while let Some(item) = walk.next()? {
        items.push(item);
    }
    Ok(items)
}

/// Links pairs into a list that ends in `tail`.
pub(crate) fn relink(conses: &[Rc<Cons>], tail: Value) -> Value {
    let mut rest = tail;
    for cons in conses.iter().rev() {
        cons.set_cdr(rest);
        rest = Value::Cons(cons.clone());
    }
    rest
}

/// Builds a list from its front.
#[derive(Default)]
pub(crate) struct ListBuilder {
    head: Option<Value>,
    last: Option<Rc<Cons>>,
}

impl ListBuilder {
    /// An empty list.
    pub(crate) fn new() -> ListBuilder {
        ListBuilder::default()
    }

    /// Adds an element at the end.
    pub(crate) fn push(&mut self, item: Value) {
        let cons = Cons::shared(item, Value::NIL);
        match self.last.replace(cons.clone()) {
            Some(last) => last.set_cdr(Value::Cons(cons)),
            None => self.head = Some(Value::Cons(cons)),
        }
    }

    /// The list, ending in `tail`.
    pub(crate) fn finish_with(self, tail: Value) -> Value {
        match (self.head, self.last) {
            (Some(head), Some(last)) => {
                last.set_cdr(tail);
                head
            }
            _ => tail,
        }
    }

    /// The list.
    pub(crate) fn finish(self) -> Value {
        self.finish_with(Value::NIL)
    }
}

/// The last pair of a list that may be dotted.
pub(crate) fn last_pair(list: &Value) -> Result<Option<Rc<Cons>>, Box<Raise>> {
    let mut rounds = Rounds::default();
    let Value::Cons(first) = list else {
        return Ok(None);
    };
    let mut last = first.clone();
    while let Some(next) = last.cdr_cons() {
        if rounds.is_closed_by(&next) {
            return Err(circular(list));
        }
        cons::release(std::mem::replace(&mut last, next));
    }
    Ok(Some(last))
}
