//! Finishing forms: a value goes to the form that it belongs to, which may be finished by it.

use super::frame::{Dot, Frame, Kind};
use super::{Outcome, Reader};
use crate::image::Image;
use crate::reader::error::ReadErrorKind;
use crate::reader::feature;
use crate::reader::label::Labels;
use crate::reader::literal;
use crate::reader::typed_array;
use crate::value::Value;
use crate::value::known;
use crate::value::pathname::Pathname;
use crate::value::symbol::{Sym, VariableKind};

impl Reader {
    pub(super) fn close(
        &mut self,
        image: &mut Image,
        start: usize,
        end: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        let Some(frame) = self.frames.last() else {
            return Err(ReadErrorKind::UnmatchedClose);
        };
        let (base, opened_at) = (frame.base, frame.start);
        let value = match frame.kind {
            Kind::List(Dot::Expecting) if self.skips == 0 => {
                return Err(ReadErrorKind::NothingAfterDot);
            }
            Kind::List(dot) => {
                let tail = match dot {
                    Dot::Done => self.values.pop().unwrap_or(Value::NIL),
                    _ => Value::NIL,
                };
                let list = Value::list_with_tail(self.values.drain(base..), tail);
                if let Value::Cons(cons) = &list {
                    cons.set_place(self.place(image, opened_at, end));
                }
                list
            }
            Kind::Vector(length) => {
                let items = self.values.drain(base..).collect();
                literal::vector(items, length, self.skips > 0)?
            }
            other => {
                return Err(ReadErrorKind::NothingAfterPrefix {
                    prefix: other
                        .what()
                        .trim_start_matches("the form after ")
                        .to_owned(),
                });
            }
        };
        self.frames.pop();
        self.deliver(image, value, start.min(opened_at), end)
    }

    /// Passes a finished value to the form that it belongs to, which may finish that form, too.
    pub(super) fn deliver(
        &mut self,
        image: &mut Image,
        mut value: Value,
        mut start: usize,
        end: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        loop {
            let is_skipped = self.skips > 0;
            let Some(frame) = self.frames.last_mut() else {
                self.labels = Labels::default();
                let place = self.place(image, start, end);
                return Ok(Some(Outcome::Form(value, place)));
            };
            match &mut frame.kind {
                Kind::List(dot) => {
                    match *dot {
                        Dot::None => {}
                        Dot::Expecting => *dot = Dot::Done,
                        Dot::Done => return Err(ReadErrorKind::MoreAfterDot),
                    }
                    self.values.push(value);
                    return Ok(None);
                }
                Kind::Vector(_) => {
                    self.values.push(value);
                    return Ok(None);
                }
                _ => {}
            }
            // Every other frame takes exactly one value.
            let Some(Frame {
                kind, start: at, ..
            }) = self.frames.pop()
            else {
                return Ok(None);
            };
            start = at;
            match kind {
                Kind::List(_) | Kind::Vector(_) => {}
                Kind::Wrap(operator) => value = self.wrap(image, operator, value, start, end),
                Kind::Backquote => {
                    self.backquotes = self.backquotes.saturating_sub(1);
                    value = self.wrap(image, known::QUASIQUOTE, value, start, end);
                }
                Kind::Comma(operator) => {
                    self.backquotes += 1;
                    value = self.wrap(image, operator, value, start, end);
                }
                Kind::Feature(wanted) => {
                    self.features = self.features.saturating_sub(1);
                    if feature::holds(image, &value)? != wanted {
                        self.push(Kind::Skip, at)?;
                    }
                    return Ok(None);
                }
                Kind::Skip => {
                    self.skips = self.skips.saturating_sub(1);
                    return Ok(None);
                }
                Kind::Suppressed => {
                    self.skips = self.skips.saturating_sub(1);
                    value = Value::NIL;
                }
                _ if is_skipped => value = Value::NIL,
                Kind::Evaluate => match read_time_value(image, &value)? {
                    Some(constant) => value = constant,
                    None => return Ok(Some(Outcome::Evaluate(value))),
                },
                Kind::Array(rank) => value = literal::array(&value, rank)?,
                Kind::TypedArray => value = typed_array::read(&value)?,
                Kind::Structure => match literal::structure(image, &value)? {
                    literal::Structure::Made(made) => value = made,
                    literal::Structure::ToEvaluate(form) => {
                        return Ok(Some(Outcome::Evaluate(form)));
                    }
                },
                Kind::Complex => value = literal::complex(&value)?,
                Kind::Pathname => {
                    if let Some(name) = value.as_text() {
                        // What stands before a colon may be a logical host.
                        if name.contains(':') {
                            let form = Value::list([known::PATHNAME.into(), value]);
                            return Ok(Some(Outcome::Evaluate(form)));
                        }
                        value = Value::foreign(Pathname::parse(&name));
                    }
                }
                Kind::Label(label) => self.labels.close(label, &value)?,
            }
        }
    }

    fn wrap(
        &self,
        image: &mut Image,
        operator: Sym,
        value: Value,
        start: usize,
        end: usize,
    ) -> Value {
        let list = Value::list([operator.into(), value]);
        if let Value::Cons(cons) = &list {
            cons.set_place(self.place(image, start, end));
        }
        list
    }
}

/// The value of a constant form after `#.`; `None` if it has to be evaluated.
fn read_time_value(image: &Image, form: &Value) -> Result<Option<Value>, ReadErrorKind> {
    if image.special(known::V_READ_EVAL).is_nil() {
        return Err(ReadErrorKind::ReadEvalDisabled);
    }
    Ok(match form {
        Value::Cons(_) => None,
        Value::Symbol(sym, ..) => {
            let data = image.symbol(*sym);
            (data.kind == VariableKind::Constant && !data.value.is_unbound())
                .then(|| data.value.clone())
        }
        literal => Some(literal.clone()),
    })
}
