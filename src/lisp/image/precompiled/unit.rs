//! Reading code from bytes.

use std::cell::OnceCell;
use std::rc::Rc;

use num_bigint::BigInt;

use super::encode::tag;
use super::{Form, Precompiled};
use crate::image::Image;
use crate::source::{CommonReading, Place, SourceId};
use crate::value::Value;
use crate::value::array::Vector;
use crate::value::code::{
    Capture, Code, Content, Local, Parameters, SharedList, Signature, Unread,
};
use crate::value::cons::Cons;
use crate::value::number;
use crate::value::operation::Op;
use crate::value::raise::Raise;
use crate::value::string::LispString;
use crate::value::symbol::Sym;

/// Bytes that have not been read yet.
#[derive(Clone, Copy)]
pub(super) struct Bytes(pub(super) &'static [u8]);

impl Bytes {
    pub(super) fn is_empty(self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    fn wide(&mut self) -> Option<u64> {
        let (mut n, mut shift) = (0, 0);
        loop {
            let byte = self.byte()?;
            n |= u64::from(byte & 0x7f).checked_shl(shift)?;
            if byte < 0x80 {
                return Some(n);
            }
            shift += 7;
        }
    }

    pub(super) fn number(&mut self) -> Option<u32> {
        u32::try_from(self.wide()?).ok()
    }

    pub(super) fn count(&mut self) -> Option<usize> {
        usize::try_from(self.wide()?).ok()
    }

    fn flag(&mut self) -> Option<bool> {
        Some(self.byte()? != 0)
    }

    fn fixed<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }

    pub(super) fn slice(&mut self) -> Option<&'static [u8]> {
        let count = self.count()?;
        let (first, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(first)
    }

    pub(super) fn text(&mut self) -> Option<&'static str> {
        std::str::from_utf8(self.slice()?).ok()
    }
}

/// The symbol with a number, which is made if the image does not have it.
pub(super) fn resolve(image: &mut Image, from: &'static Precompiled, number: u32) -> Option<Sym> {
    let at = usize::try_from(number).ok()?;
    let resolved = &mut image.library.resolved;
    if resolved.is_empty() {
        resolved.resize(from.symbols.len(), None);
    }
    if let Some(sym) = resolved.get(at).copied()? {
        return Some(sym);
    }
    let symbol = from.symbols.get(at)?;
    let sym = match symbol.package {
        None => image.make_symbol(symbol.name),
        Some(package) => {
            let package = image.packages.find(package)?;
            if image.has_locks() {
                image.intern(package, symbol.name)
            } else {
                // The packages are what they were when the code was made.
                let symbols = &mut image.symbols;
                image.packages.intern_at_home(symbols, package, symbol.name)
            }
        }
    };
    *image.library.resolved.get_mut(at)? = Some(sym);
    Some(sym)
}

/// What code is read into: what its symbols and places are there.
pub(super) trait Target {
    /// The symbol with a number.
    fn symbol(&mut self, from: &'static Precompiled, number: u32) -> Option<Sym>;

    /// The source of a name.
    fn source(&self, name: &str) -> Option<SourceId>;

    /// A place for the bytes `start..end` of a source.
    fn place(&mut self, source: SourceId, start: usize, end: usize) -> Place;
}

/// What is only for one image.
impl Target for Image {
    fn symbol(&mut self, from: &'static Precompiled, number: u32) -> Option<Sym> {
        resolve(self, from, number)
    }

    fn source(&self, name: &str) -> Option<SourceId> {
        self.sources.named(name)
    }

    fn place(&mut self, source: SourceId, start: usize, end: usize) -> Place {
        self.sources.place(source, start, end)
    }
}

/// An image whose copies read the code, too: where its symbols are found, and the places of what is read.
struct Common<S>(S, CommonReading);

impl<S: FnMut(u32) -> Option<Sym>> Target for Common<S> {
    fn symbol(&mut self, _: &'static Precompiled, number: u32) -> Option<Sym> {
        self.0(number)
    }

    /// There is no other source than that of the form.
    fn source(&self, _: &str) -> Option<SourceId> {
        None
    }

    fn place(&mut self, source: SourceId, start: usize, end: usize) -> Place {
        self.1.place(source, start, end)
    }
}

impl Image {
    /// The content of code, which is read if it has not been needed before.
    ///
    /// # Errors
    ///
    /// It cannot be read.
    #[inline]
    pub(crate) fn content<'a>(&mut self, code: &'a Code) -> Result<&'a Content, Box<Raise>> {
        match code.content() {
            Some(content) => Ok(content),
            None => self.read_content(code).ok_or_else(malformed),
        }
    }

    #[cold]
    fn read_content<'a>(&mut self, code: &'a Code) -> Option<&'a Content> {
        let (unread, from) = (code.unread?, self.library.precompiled?);
        let places = self.sources.read_common(unread.bytes);
        unread.read(code, from, places, |number| resolve(self, from, number))
    }

    /// The content of code, once all files are loaded: what symbols there are to be found have been found.
    pub fn content_to_look_at<'a>(&self, code: &'a Code) -> Option<&'a Content> {
        if let Some(content) = code.content() {
            return Some(content);
        }
        let (unread, from) = (code.unread?, self.library.precompiled?);
        let places = self.sources.read_common(unread.bytes);
        unread.read(code, from, places, |number| {
            let at = usize::try_from(number).ok()?;
            self.library.resolved.get(at).copied()?
        })
    }
}

impl Unread {
    /// Reads it as the content of code.
    fn read<'a>(
        self,
        code: &'a Code,
        from: &'static Precompiled,
        places: CommonReading,
        symbol: impl FnMut(u32) -> Option<Sym>,
    ) -> Option<&'a Content> {
        let mut unit = Unit {
            from,
            bytes: Bytes(self.bytes),
            length: self.bytes.len(),
            sources: self.source.into_iter().collect(),
            objects: Vec::new(),
        };
        let content = unit.content(&mut Common(symbol, places))?;
        Some(code.content.get_or_init(|| content))
    }
}

#[cold]
fn malformed() -> Box<Raise> {
    Raise::program("Code that has been made ahead cannot be read.")
}

/// The code of a form, read part by part.
pub struct Unit {
    from: &'static Precompiled,
    bytes: Bytes,
    /// How many bytes there were.
    length: usize,
    /// The sources of the places so far; first that of the form.
    sources: Vec<SourceId>,
    /// The pairs, strings and vectors so far that are referred to again, by the bytes of their tags.
    objects: Vec<(usize, Value)>,
}

impl Unit {
    /// The code of a form of a source, or of a text that is read without places.
    pub fn of(from: &'static Precompiled, form: &Form, source: Option<SourceId>) -> Option<Unit> {
        let bytes = form.code?;
        Some(Unit {
            from,
            bytes: Bytes(bytes),
            length: bytes.len(),
            sources: source.into_iter().collect(),
            objects: Vec::new(),
        })
    }

    /// The next part, to be run before the one after it is read; `None` at the end.
    pub fn next(&mut self, image: &mut Image) -> Option<Result<Rc<Code>, Box<Raise>>> {
        if self.bytes.is_empty() {
            return None;
        }
        let code = self.code(image);
        Some(code.ok_or_else(malformed))
    }

    fn all<T, I: Target>(
        &mut self,
        image: &mut I,
        one: impl Fn(&mut Self, &mut I) -> Option<T>,
    ) -> Option<Vec<T>> {
        let count = self.bytes.count()?;
        // Each takes at least a byte.
        let mut all = Vec::with_capacity(count.min(self.bytes.0.len()));
        for _ in 0..count {
            all.push(one(self, image)?);
        }
        Some(all)
    }

    fn numbers(&mut self) -> Option<Vec<u32>> {
        let count = self.bytes.count()?;
        (0..count).map(|_| self.bytes.number()).collect()
    }

    /// Code with its content.
    fn code(&mut self, image: &mut impl Target) -> Option<Rc<Code>> {
        let mut code = self.head(image)?;
        let content = self.content(image)?;
        code.is_fixed = code.name.is_fixed() && content.is_fixed();
        code.content = content.into();
        Some(Rc::new(code))
    }

    /// What callers see of code.
    fn head(&mut self, image: &mut impl Target) -> Option<Code> {
        let name = self.signature(image)?;
        let parameters = self.parameters(image)?;
        Some(Code {
            name,
            exact_count: parameters.exact_count(),
            parameters,
            room: self.bytes.count()?,
            is_fixed: false,
            content: OnceCell::new(),
            unread: None,
        })
    }

    fn content(&mut self, image: &mut impl Target) -> Option<Content> {
        Some(Content {
            ops: self.all(image, Unit::op)?.into(),
            constants: self.all(image, Unit::value)?,
            inner: self.all(image, Unit::inner)?,
            tags: self.all(image, |unit, _| unit.numbers())?.into(),
            places: self.places(image)?.into(),
            locals: self.all(image, Unit::local)?.into(),
            free: self.all(image, Unit::symbol)?.into(),
            lambda_list: self.signature(image)?,
            doc: match self.bytes.flag()? {
                true => Some(self.bytes.text()?.into()),
                false => None,
            },
        })
    }

    fn inner(&mut self, image: &mut impl Target) -> Option<(Rc<Code>, SharedList<Capture>)> {
        let code = match self.bytes.flag()? {
            true => self.unread(image)?,
            false => self.code(image)?,
        };
        let captures = self.all(image, |unit, _| {
            let is_free = unit.bytes.flag()?;
            let at = unit.bytes.number()?;
            Some(if is_free {
                Capture::Free(at)
            } else {
                Capture::Local(at)
            })
        })?;
        Some((code, captures.into()))
    }

    /// Code whose content is read when it is needed.
    fn unread(&mut self, image: &mut impl Target) -> Option<Rc<Code>> {
        let mut code = self.head(image)?;
        code.is_fixed = self.bytes.flag()?;
        code.unread = Some(Unread {
            bytes: self.bytes.slice()?,
            source: self.sources.first().copied(),
        });
        Some(Rc::new(code))
    }

    fn parameters(&mut self, image: &mut impl Target) -> Option<Parameters> {
        Some(Parameters {
            required: u16::try_from(self.bytes.number()?).ok()?,
            optional: u16::try_from(self.bytes.number()?).ok()?,
            rest: self.bytes.flag()?,
            has_keys: self.bytes.flag()?,
            allow_other_keys: self.bytes.flag()?,
            keys: self.all(image, Unit::symbol)?.into(),
        })
    }

    fn places(&mut self, image: &mut impl Target) -> Option<Vec<(u32, Place)>> {
        let mut first = 0_u32;
        let count = self.bytes.count()?;
        let mut places = Vec::with_capacity(count.min(self.bytes.0.len()));
        for _ in 0..count {
            first = first.checked_add(self.bytes.number()?)?;
            places.push((first, self.place(image)?));
        }
        Some(places)
    }

    fn place(&mut self, image: &mut impl Target) -> Option<Place> {
        let Some(number) = self.bytes.count()?.checked_sub(1) else {
            return Some(Place::NONE);
        };
        if number == self.sources.len() {
            let name = self.bytes.text()?;
            self.sources.push(image.source(name)?);
        }
        let source = *self.sources.get(number)?;
        let start = self.bytes.count()?;
        let end = start.checked_add(self.bytes.count()?)?;
        Some(image.place(source, start, end))
    }

    fn local(&mut self, image: &mut impl Target) -> Option<Local> {
        Some(Local {
            slot: self.bytes.number()?,
            name: self.symbol(image)?,
            from: self.bytes.number()?,
            to: self.bytes.number()?,
        })
    }

    fn symbol(&mut self, image: &mut impl Target) -> Option<Sym> {
        let number = self.bytes.number()?;
        image.symbol(self.from, number)
    }

    fn signature(&mut self, image: &mut impl Target) -> Option<Signature> {
        let is_fixed = self.bytes.flag()?;
        let value = self.value(image)?;
        Some(Signature::unchecked(value, is_fixed))
    }

    fn op(&mut self, image: &mut impl Target) -> Option<Op> {
        let (mut op, rest) = postcard::take_from_bytes::<Op>(self.bytes.0).ok()?;
        self.bytes.0 = rest;
        if let Some(sym) = op.symbol_mut() {
            *sym = image.symbol(self.from, sym.0)?;
        }
        Some(op)
    }

    fn big(&mut self) -> Option<BigInt> {
        Some(BigInt::from_signed_bytes_le(self.bytes.slice()?))
    }

    /// A value; a list in a loop.
    fn value(&mut self, image: &mut impl Target) -> Option<Value> {
        let mut whole = None;
        let mut last: Option<Rc<Cons>> = None;
        loop {
            let value = self.single(image)?;
            let next = match &value {
                (Value::Cons(cons), true) => Some(cons.clone()),
                _ => None,
            };
            match &last {
                Some(last) => last.set_cdr(value.0),
                None => whole = Some(value.0),
            }
            let Some(next) = next else {
                return whole;
            };
            last = Some(next);
        }
    }

    /// A value, and whether it is a pair whose second half comes next.
    fn single(&mut self, image: &mut impl Target) -> Option<(Value, bool)> {
        let at = self.length - self.bytes.0.len();
        let tag = self.bytes.byte()?;
        let (tag, is_shared) = (tag & !tag::SHARED, tag & tag::SHARED != 0);
        if let tag::CONS | tag::PLACED = tag {
            let cons = Cons::shared(Value::NIL, Value::NIL);
            if is_shared {
                self.objects.push((at, Value::Cons(cons.clone())));
            }
            if tag == tag::PLACED {
                cons.set_place(self.place(image)?);
            }
            cons.set_car(self.value(image)?);
            return Some((Value::Cons(cons), true));
        }
        let value = match tag {
            tag::UNBOUND => Value::Unbound,
            tag::SYMBOL => Value::symbol(self.symbol(image)?),
            tag::POSITIVE => Value::Int(self.bytes.wide()?.cast_signed()),
            tag::NEGATIVE => Value::Int(!self.bytes.wide()?.cast_signed()),
            tag::SINGLE => Value::Single(f32::from_le_bytes(self.bytes.fixed()?)),
            tag::DOUBLE => Value::Double(f64::from_le_bytes(self.bytes.fixed()?)),
            tag::CHARACTER => Value::Char(char::from_u32(self.bytes.number()?)?),
            tag::BIG => Value::Big(Rc::new(self.big()?)),
            tag::RATIO => number::ratio(self.big()?, self.big()?)?,
            tag::STRING => Value::Str(Rc::new(LispString::new(self.bytes.text()?.to_owned()))),
            tag::VECTOR => Value::Vector(Rc::new(Vector::simple(self.all(image, Unit::value)?))),
            tag::AGAIN => {
                let at = self.bytes.count()?;
                let (_, object) = self.objects.iter().find(|(known, _)| *known == at)?;
                return Some((object.clone(), false));
            }
            _ => return None,
        };
        if is_shared {
            self.objects.push((at, value.clone()));
        }
        Some((value, false))
    }
}
