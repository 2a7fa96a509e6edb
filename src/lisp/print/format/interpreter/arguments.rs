//! The arguments of a control string, and the parameters of its directives.

use std::rc::Rc;

use super::{Context, Interpreter, Result};
use crate::print::format::directive::{Directive, Parameter};
use crate::print::format::error::Problem;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// The widest padding, and the most repetitions of a character.
pub(super) const MAX_WIDTH: i64 = 1_000_000;

/// Arguments, and which one is next.
#[derive(Clone)]
pub(super) struct Arguments {
    pub(super) items: Rc<[Value]>,
    pub(super) next: usize,
    /// In `~:{`, are there further sublists?
    pub(super) has_more_lists: bool,
    /// Are they the elements of a list that a logical block prints?
    pub(super) of_block: bool,
    /// What the list ends with in place of `NIL`.
    pub(super) tail: Option<Value>,
}

impl Arguments {
    pub(super) fn new(items: impl Into<Rc<[Value]>>) -> Arguments {
        Arguments {
            items: items.into(),
            next: 0,
            has_more_lists: false,
            of_block: false,
            tail: None,
        }
    }

    pub(super) fn left(&self) -> usize {
        self.items.len().saturating_sub(self.next)
    }

    pub(super) fn rest(&self) -> Vec<Value> {
        self.items.iter().skip(self.next).cloned().collect()
    }
}

/// A parameter with its value.
#[derive(Clone, Copy)]
pub(super) enum Given {
    Number(i64),
    Char(char),
}

impl Interpreter<'_> {
    pub(super) fn next(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Value> {
        let value = args
            .items
            .get(args.next)
            .cloned()
            .ok_or_else(|| c.error(d, Problem::NoMoreArguments))?;
        args.next += 1;
        Ok(value)
    }

    /// The values of a directive's parameters.
    pub(super) fn parameters(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Vec<Option<Given>>> {
        self.given(c, d, &d.parameters, args)
    }

    pub(super) fn given(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        parameters: &[Parameter],
        args: &mut Arguments,
    ) -> Result<Vec<Option<Given>>> {
        let mut given = Vec::with_capacity(parameters.len());
        for parameter in parameters {
            given.push(match parameter {
                Parameter::None => None,
                Parameter::Number(n) => Some(Given::Number(*n)),
                Parameter::Char(char) => Some(Given::Char(*char)),
                Parameter::Count => i64::try_from(args.left()).ok().map(Given::Number),
                Parameter::Argument => match self.next(c, d, args)? {
                    Value::Symbol(known::NIL, ..) => None,
                    Value::Int(n) => Some(Given::Number(n)),
                    Value::Char(char) => Some(Given::Char(char)),
                    other => return Err(Raise::type_error(&other, known::INTEGER)),
                },
            });
        }
        Ok(given)
    }
}

pub(super) fn list_items(list: &Value) -> Result<Vec<Value>> {
    let mut items = list.iter_list();
    let found = items.by_ref().collect();
    match items.rest.is_nil() {
        true => Ok(found),
        false => Err(Raise::type_error(&items.rest, known::LIST)),
    }
}

pub(super) fn number_of(given: &[Option<Given>], index: usize) -> Result<Option<i64>> {
    match given.get(index).copied().flatten() {
        None => Ok(None),
        Some(Given::Number(n)) => Ok(Some(n)),
        Some(Given::Char(c)) => Err(Raise::type_error(&Value::Char(c), known::INTEGER)),
    }
}

pub(super) fn width_of(given: &[Option<Given>], index: usize) -> Result<Option<usize>> {
    Ok(number_of(given, index)?.map(|n| usize::try_from(n.clamp(0, MAX_WIDTH)).unwrap_or(0)))
}

pub(super) fn char_of(given: &[Option<Given>], index: usize) -> Result<Option<char>> {
    match given.get(index).copied().flatten() {
        None => Ok(None),
        Some(Given::Char(c)) => Ok(Some(c)),
        Some(Given::Number(n)) => Err(Raise::type_error(&Value::Int(n), known::CHARACTER)),
    }
}
