//! Writing code as bytes.
//!
//! Numbers are written seven bits at a time, the lowest first. A further reference to a pair, string or vector of a
//! form is the byte at which that is written, which says then that it is referred to again.
//!
//! The content of the functions that a form makes can be written so that each is read by itself, when it is
//! first needed. It is numbered from the start: a literal object that it has in common with the rest of the form
//! becomes two that are alike.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use super::record::Symbols;
use crate::image::Image;
use crate::source::{Place, SourceId};
use crate::value::Value;
use crate::value::array::Vector;
use crate::value::code::{Capture, Code, Content, Parameters, Signature};
use crate::value::cons::Cons;
use crate::value::operation::Op;
use crate::value::symbol::Sym;

/// The kinds of values, as they are written.
pub(super) mod tag {
    pub(crate) const UNBOUND: u8 = 0;
    pub(crate) const SYMBOL: u8 = 1;
    pub(crate) const POSITIVE: u8 = 2;
    pub(crate) const NEGATIVE: u8 = 3;
    pub(crate) const SINGLE: u8 = 4;
    pub(crate) const DOUBLE: u8 = 5;
    pub(crate) const CHARACTER: u8 = 6;
    pub(crate) const BIG: u8 = 7;
    pub(crate) const STRING: u8 = 8;
    pub(crate) const VECTOR: u8 = 9;
    /// A pair without a place in a source.
    pub(crate) const CONS: u8 = 10;
    /// A pair with its place.
    pub(crate) const PLACED: u8 = 11;
    /// What has been written already, by the byte of its tag.
    pub(crate) const AGAIN: u8 = 12;
    pub(crate) const RATIO: u8 = 13;
    /// Beside the tag of what is referred to again.
    pub(crate) const SHARED: u8 = 0x80;
}

/// How deeply values may be nested in what is written.
const DEEPEST: usize = 500;

/// Writes a number.
pub(super) fn number(bytes: &mut Vec<u8>, n: u32) {
    wide(bytes, n.into());
}

/// Writes a number of things.
pub(super) fn count(bytes: &mut Vec<u8>, n: usize) {
    wide(bytes, n as u64);
}

fn wide(bytes: &mut Vec<u8>, mut n: u64) {
    while n >= 0x80 {
        bytes.push((n & 0x7f) as u8 | 0x80);
        n >>= 7;
    }
    bytes.push(n as u8);
}

/// Writes bytes with their number.
pub(super) fn slice(bytes: &mut Vec<u8>, slice: &[u8]) {
    count(bytes, slice.len());
    bytes.extend_from_slice(slice);
}

/// Writes a text.
pub(super) fn text(bytes: &mut Vec<u8>, text: &str) {
    slice(bytes, text.as_bytes());
}

/// The code of a form as bytes: parts that are run one after the other.
pub(super) struct Encoding {
    bytes: Vec<u8>,
    /// The sources of the places so far; first that of the form.
    sources: Vec<SourceId>,
    /// The bytes at which objects have been written, by address.
    objects: HashMap<usize, usize>,
    /// Are the functions that the form makes read by themselves?
    apart: bool,
    /// What has been written, so that no address is used again.
    kept: Vec<Rc<Code>>,
}

impl Encoding {
    /// Of a form of a source, or of a text that is read without places; `apart`: are the functions that the
    /// form makes read by themselves?
    pub(super) fn of(source: Option<SourceId>, apart: bool) -> Encoding {
        Encoding {
            bytes: Vec::new(),
            sources: source.into_iter().collect(),
            objects: HashMap::new(),
            apart,
            kept: Vec::new(),
        }
    }

    /// Adds a part; `None` if something of it cannot be written down.
    pub(super) fn add(
        &mut self,
        image: &Image,
        symbols: &mut Symbols,
        code: &Rc<Code>,
    ) -> Option<()> {
        self.kept.push(code.clone());
        Writer {
            image,
            symbols,
            open: HashSet::new(),
            depth: 0,
            is_apart: false,
            encoding: self,
        }
        .code(code)
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

/// The address of an object that may be referred to several times.
fn address(value: &Value) -> Option<usize> {
    match value {
        Value::Cons(cons) => Some(Rc::as_ptr(cons).addr()),
        Value::Str(string) => Some(Rc::as_ptr(string).addr()),
        Value::Vector(vector) => Some(Rc::as_ptr(vector).addr()),
        _ => None,
    }
}

struct Writer<'a> {
    image: &'a Image,
    symbols: &'a mut Symbols,
    /// The addresses of the vectors whose elements are being written.
    open: HashSet<usize>,
    depth: usize,
    /// Is this in a function that is read by itself?
    is_apart: bool,
    encoding: &'a mut Encoding,
}

impl Writer<'_> {
    fn bytes(&mut self) -> &mut Vec<u8> {
        &mut self.encoding.bytes
    }

    fn number(&mut self, n: u32) {
        number(self.bytes(), n);
    }

    fn count(&mut self, n: usize) {
        count(self.bytes(), n);
    }

    fn flag(&mut self, flag: bool) {
        self.bytes().push(flag.into());
    }

    fn code(&mut self, code: &Code) -> Option<()> {
        self.head(code)?;
        self.content(code.content()?)
    }

    /// What callers see of code.
    fn head(&mut self, code: &Code) -> Option<()> {
        self.signature(&code.name)?;
        self.parameters(&code.parameters)?;
        self.count(code.room);
        Some(())
    }

    /// Code of a closure: its content as bytes of their own, or after it.
    fn inner(&mut self, code: &Code) -> Option<()> {
        if !self.encoding.apart || self.is_apart {
            self.flag(false);
            return self.code(code);
        }
        self.flag(true);
        self.head(code)?;
        self.flag(code.is_fixed);
        let outside = std::mem::take(&mut self.encoding.bytes);
        let objects = std::mem::take(&mut self.encoding.objects);
        self.is_apart = true;
        self.content(code.content()?)?;
        self.is_apart = false;
        let content = std::mem::replace(&mut self.encoding.bytes, outside);
        self.encoding.objects = objects;
        slice(self.bytes(), &content);
        Some(())
    }

    fn content(&mut self, code: &Content) -> Option<()> {
        self.count(code.ops.len());
        for op in code.ops.iter() {
            self.op(*op)?;
        }
        self.count(code.constants.len());
        for value in &code.constants {
            self.value(value)?;
        }
        self.count(code.inner.len());
        for (inner, captures) in &code.inner {
            self.inner(inner)?;
            self.count(captures.len());
            for capture in captures.iter() {
                let (is_free, at) = match capture {
                    Capture::Local(at) => (false, *at),
                    Capture::Free(at) => (true, *at),
                };
                self.flag(is_free);
                self.number(at);
            }
        }
        self.count(code.tags.len());
        for tags in code.tags.iter() {
            self.count(tags.len());
            tags.iter().for_each(|at| self.number(*at));
        }
        self.count(code.places.len());
        let mut before = 0;
        for (first, place) in code.places.iter() {
            self.number(*first - before);
            before = *first;
            self.place(*place)?;
        }
        self.count(code.locals.len());
        for local in code.locals.iter() {
            self.number(local.slot);
            self.symbol(local.name)?;
            self.number(local.from);
            self.number(local.to);
        }
        self.all_symbols(&code.free)?;
        self.signature(&code.lambda_list)?;
        self.flag(code.doc.is_some());
        if let Some(doc) = &code.doc {
            text(self.bytes(), doc);
        }
        Some(())
    }

    fn parameters(&mut self, parameters: &Parameters) -> Option<()> {
        self.number(parameters.required.into());
        self.number(parameters.optional.into());
        self.flag(parameters.rest);
        self.flag(parameters.has_keys);
        self.flag(parameters.allow_other_keys);
        self.all_symbols(&parameters.keys)
    }

    fn all_symbols(&mut self, symbols: &[Sym]) -> Option<()> {
        self.count(symbols.len());
        for sym in symbols {
            self.symbol(*sym)?;
        }
        Some(())
    }

    fn symbol(&mut self, sym: Sym) -> Option<()> {
        let number = self.symbols.number(self.image, sym)?;
        self.number(number);
        Some(())
    }

    fn signature(&mut self, signature: &Signature) -> Option<()> {
        self.flag(signature.is_fixed());
        self.value(signature.shown())
    }

    fn op(&mut self, mut op: Op) -> Option<()> {
        if let Some(sym) = op.symbol_mut() {
            *sym = Sym(self.symbols.number(self.image, *sym)?);
        }
        let bytes = postcard::to_allocvec(&op).ok()?;
        self.bytes().extend(bytes);
        Some(())
    }

    /// A place: nothing, or the number of its source, which is named when it is met first, and the
    /// bytes there.
    fn place(&mut self, place: Place) -> Option<()> {
        if place == Place::NONE {
            self.number(0);
            return Some(());
        }
        let (source, start, end) = self.image.sources.bytes_of(place)?;
        let mut sources = self.encoding.sources.iter();
        match sources.position(|known| *known == source) {
            Some(number) if number == 0 || !self.is_apart => self.count(number + 1),
            // What is read by itself knows no other source than that of the form.
            _ if self.is_apart => return None,
            _ => {
                self.encoding.sources.push(source);
                self.count(self.encoding.sources.len());
                let name = &self.image.sources.get(source)?.name;
                text(self.bytes(), name);
            }
        }
        self.number(start);
        self.number(end.checked_sub(start)?);
        Some(())
    }

    fn value(&mut self, value: &Value) -> Option<()> {
        self.depth += 1;
        let written = self.list(value);
        self.depth -= 1;
        written
    }

    /// A value; a list in a loop.
    fn list(&mut self, value: &Value) -> Option<()> {
        if self.depth > DEEPEST {
            return None;
        }
        let mut value = value.clone();
        loop {
            let address = address(&value);
            let known = address.and_then(|address| self.encoding.objects.get(&address));
            if let Some(at) = known.copied() {
                *self.bytes().get_mut(at)? |= tag::SHARED;
                self.bytes().push(tag::AGAIN);
                self.count(at);
                return Some(());
            }
            let at = self.bytes().len();
            match (&value, address) {
                (Value::Cons(cons), Some(address)) => {
                    self.note(address, at);
                    self.pair(cons)?;
                    let rest = cons.cdr();
                    value = rest;
                }
                (Value::Vector(vector), Some(address)) => {
                    // A vector is there after its elements, and so it cannot have itself.
                    if !self.open.insert(address) {
                        return None;
                    }
                    self.vector(vector)?;
                    self.open.remove(&address);
                    self.note(address, at);
                    return Some(());
                }
                (_, Some(address)) => {
                    self.no_pair(&value)?;
                    self.note(address, at);
                    return Some(());
                }
                (_, None) => return self.no_pair(&value),
            }
        }
    }

    /// Notes where an object is written.
    fn note(&mut self, address: usize, at: usize) {
        self.encoding.objects.insert(address, at);
    }

    /// A pair up to its second half.
    fn pair(&mut self, cons: &Cons) -> Option<()> {
        match cons.place() {
            Place::NONE => self.bytes().push(tag::CONS),
            place => {
                self.bytes().push(tag::PLACED);
                self.place(place)?;
            }
        }
        self.value(&cons.car())
    }

    fn no_pair(&mut self, value: &Value) -> Option<()> {
        match value {
            Value::Unbound => self.bytes().push(tag::UNBOUND),
            Value::Symbol(sym, _) => {
                self.bytes().push(tag::SYMBOL);
                self.symbol(*sym)?;
            }
            Value::Int(n) => {
                let is_negative = *n < 0;
                self.bytes().push(if is_negative {
                    tag::NEGATIVE
                } else {
                    tag::POSITIVE
                });
                wide(
                    self.bytes(),
                    if is_negative { !n } else { *n }.cast_unsigned(),
                );
            }
            Value::Single(x) => {
                self.bytes().push(tag::SINGLE);
                self.bytes().extend(x.to_le_bytes());
            }
            Value::Double(x) => {
                self.bytes().push(tag::DOUBLE);
                self.bytes().extend(x.to_le_bytes());
            }
            Value::Char(c) => {
                self.bytes().push(tag::CHARACTER);
                self.number((*c).into());
            }
            Value::Big(n) => {
                self.bytes().push(tag::BIG);
                slice(self.bytes(), &n.to_signed_bytes_le());
            }
            Value::Ratio(ratio) => {
                self.bytes().push(tag::RATIO);
                slice(self.bytes(), &ratio.numerator.to_signed_bytes_le());
                slice(self.bytes(), &ratio.denominator.to_signed_bytes_le());
            }
            Value::Str(string) if string.is_simple() => {
                self.bytes().push(tag::STRING);
                text(self.bytes(), &string.text());
            }
            _ => return None,
        }
        Some(())
    }

    fn vector(&mut self, vector: &Vector) -> Option<()> {
        if !vector.is_general_simple() {
            return None;
        }
        let items = vector.to_vec();
        self.bytes().push(tag::VECTOR);
        self.count(items.len());
        for item in &items {
            self.value(item)?;
        }
        Some(())
    }
}
