//! Directives that decide what comes next: moves among the arguments, controls that are arguments,
//! iteration, choice, and the way out.

use super::arguments::{Arguments, Given, list_items, number_of};
use super::{Context, Flow, Interpreter, Result};
use crate::print::format::Control;
use crate::print::format::directive::{Clause, Directive, Piece};
use crate::print::format::error::Problem;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// The deepest nesting of controls that `~?` and `~{~}` run.
const MAX_NESTED_CONTROLS: usize = 50;

impl Interpreter<'_> {
    pub(super) fn go_to(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let n = number_of(&given, 0)?;
        let next = i64::try_from(args.next).unwrap_or(i64::MAX);
        let index = match (d.colon, d.at) {
            (_, true) => n.unwrap_or(0),
            (true, _) => next.saturating_sub(n.unwrap_or(1)),
            _ => next.saturating_add(n.unwrap_or(1)),
        };
        match usize::try_from(index) {
            Ok(index) if index <= args.items.len() => {
                args.next = index;
                Ok(())
            }
            _ => {
                let count = args.items.len();
                Err(c.error(d, Problem::OutOfBounds { index, count }))
            }
        }
    }

    /// Runs a control that is an argument: a string, or a function made by `formatter`.
    fn run_control(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        control: &Value,
        args: &mut Arguments,
    ) -> Result<Flow> {
        if let Value::Function(_) = control {
            let after = args.rest();
            args.next = args.items.len();
            self.call_with_stream(control.clone(), after);
            return Ok(Flow::Through);
        }
        let Some(text) = control.as_text() else {
            return Err(Raise::type_error(control, known::STRING));
        };
        self.controls += 1;
        if self.controls > MAX_NESTED_CONTROLS {
            return Err(c.error(d, Problem::TooDeep(MAX_NESTED_CONTROLS)));
        }
        let parsed = Control::parse(&text)?;
        let inner = Context {
            control: &parsed.text,
        };
        let fills = std::mem::take(&mut self.fills);
        let flow = self.pieces(inner, &parsed.pieces, args);
        self.fills = fills;
        self.controls -= 1;
        flow
    }

    pub(super) fn indirect(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<()> {
        let control = self.next(c, d, args)?;
        if d.at {
            self.run_control(c, d, &control, args)?;
            return Ok(());
        }
        let list = self.next(c, d, args)?;
        let mut inner = Arguments::new(list_items(&list)?);
        self.run_control(c, d, &control, &mut inner)?;
        Ok(())
    }

    pub(super) fn iterate(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Flow> {
        let given = self.parameters(c, d, args)?;
        let most = number_of(&given, 0)?;
        let pieces = d.clauses.first().map_or(&[][..], |clause| &clause.pieces);
        // Without a body, the body is an argument.
        let control = match pieces {
            [] => Some(self.next(c, d, args)?),
            _ => None,
        };
        let mut items = if d.at {
            std::mem::replace(args, Arguments::new([]))
        } else {
            Arguments::new(list_items(&self.next(c, d, args)?)?)
        };
        let mut at_least_once = d.close.is_some_and(|close| close.colon);
        if let Some(function @ Value::Function(_)) = control {
            // What arguments it leaves is known when it has been called.
            let most = most.map_or(Value::NIL, Value::Int);
            let flags = [Value::bool(at_least_once), Value::bool(d.colon)];
            let after = [function, Value::list(items.rest()), most].into_iter();
            self.call_with_stream(known::SYS_ITERATE.into(), after.chain(flags).collect());
            return Ok(Flow::Through);
        }
        let mut count = 0;
        // The tail of a dotted list that a logical block prints comes after the elements.
        let has_more = |items: &Arguments| items.left() > 0 || (!d.colon && items.tail.is_some());
        while (has_more(&items) || at_least_once) && most.is_none_or(|most| count < most) {
            at_least_once = false;
            count += 1;
            let before = items.next;
            let flow = if d.colon {
                let sublist = self.next(c, d, &mut items)?;
                let mut inner = Arguments::new(list_items(&sublist)?);
                inner.has_more_lists = items.left() > 0;
                let flow = self.body(c, d, control.as_ref(), pieces, &mut inner)?;
                if flow == Flow::Exit {
                    Flow::Through
                } else {
                    flow
                }
            } else {
                self.body(c, d, control.as_ref(), pieces, &mut items)?
            };
            if flow != Flow::Through {
                break;
            }
            if !d.colon && has_more(&items) && items.next <= before && most.is_none() {
                // A body that uses no argument would be repeated for ever.
                return Err(c.error(
                    d,
                    Problem::Clauses("The iteration uses no argument, so it would never end."),
                ));
            }
        }
        if d.at {
            *args = items;
        }
        Ok(Flow::Through)
    }

    fn body(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        control: Option<&Value>,
        pieces: &[Piece],
        args: &mut Arguments,
    ) -> Result<Flow> {
        match control {
            Some(control) => self.run_control(c, d, control, args),
            None => self.pieces(c, pieces, args),
        }
    }

    pub(super) fn choose(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Flow> {
        let given = self.parameters(c, d, args)?;
        let clauses = &d.clauses;
        let chosen = match (d.colon, d.at) {
            (true, true) => return Err(c.error(d, Problem::BothModifiers)),
            (true, false) => {
                if clauses.len() != 2 {
                    let text = "Must specify exactly two sections.";
                    return Err(c.error(d, Problem::Clauses(text)));
                }
                let is_true = self.next(c, d, args)?.is_true();
                clauses.get(usize::from(is_true))
            }
            (false, true) => {
                if clauses.len() != 1 {
                    let text = "Can only specify one section.";
                    return Err(c.error(d, Problem::Clauses(text)));
                }
                let value = self.next(c, d, args)?;
                if value.is_nil() {
                    return Ok(Flow::Through);
                }
                // The clause gets the argument again.
                args.next -= 1;
                clauses.first()
            }
            (false, false) => {
                let index = match number_of(&given, 0)? {
                    Some(n) => usize::try_from(n).ok(),
                    None => match self.next(c, d, args)? {
                        Value::Int(n) => usize::try_from(n).ok(),
                        Value::Big(_) => None,
                        other => return Err(Raise::type_error(&other, known::INTEGER)),
                    },
                };
                index
                    .and_then(|i| clauses.get(i))
                    .or_else(|| default_clause(clauses))
            }
        };
        match chosen {
            Some(clause) => self.pieces(c, &clause.pieces, args),
            None => Ok(Flow::Through),
        }
    }

    pub(super) fn escape(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Flow> {
        let given = self.parameters(c, d, args)?;
        let order = |given: &Option<Given>| match given {
            Some(Given::Number(n)) => *n,
            Some(Given::Char(char)) => i64::from(u32::from(*char)),
            None => 0,
        };
        // An argument NIL in place of a parameter leaves it out.
        let count = given
            .iter()
            .rposition(Option::is_some)
            .map_or(0, |last| last + 1);
        let values: Vec<i64> = given.iter().take(count).map(order).collect();
        let leaves = match values.as_slice() {
            [] if d.colon => !args.has_more_lists,
            [] => args.left() == 0 && args.tail.is_none(),
            [a] => *a == 0,
            [a, b] => a == b,
            [a, b, c, ..] => a <= b && b <= c,
        };
        Ok(match (leaves, d.colon) {
            (false, _) => Flow::Through,
            (true, false) => Flow::Exit,
            (true, true) => Flow::ExitAll,
        })
    }
}

/// The clause after `~:;`.
fn default_clause(clauses: &[Clause]) -> Option<&Clause> {
    let (last, others) = clauses.split_last()?;
    let is_default = others
        .last()
        .and_then(|clause| clause.separator.as_ref())
        .is_some_and(|(colon, ..)| *colon);
    is_default.then_some(last)
}
