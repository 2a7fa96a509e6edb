//! Carrying out directives.
//!
//! Nested directives recurse, as deep as the parser allows; `~?` has a limit of its own.

mod block;

use std::rc::Rc;

use num_bigint::BigInt;

use super::super::calls::{Call, Calls};
use super::super::printer::Printer;
use super::super::settings::Settings;
use super::Control;
use super::directive::{Clause, Directive, Parameter, Piece};
use super::english;
use super::error::{FormatError, Problem};
use super::float::{self, FloatStyle};
use super::integer::{IntegerStyle, integer};
use super::justify::Justification;
use super::output::Output;
use crate::lisp::image::Image;
use crate::lisp::reader::char_name::char_name;
use crate::lisp::value::Value;
use crate::lisp::value::document::{Newline, Tab};
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The widest padding, and the most repetitions of a character.
const MAX_WIDTH: i64 = 1_000_000;

/// The deepest nesting of controls that `~?` and `~{~}` run.
const MAX_NESTED_CONTROLS: usize = 50;

/// How a sequence of pieces ended.
#[derive(Clone, Copy, PartialEq)]
enum Flow {
    /// At its end.
    Through,
    /// At `~^`.
    Exit,
    /// At `~:^`: the whole iteration ends.
    ExitAll,
}

/// Arguments, and which one is next.
#[derive(Clone)]
struct Arguments {
    items: Rc<[Value]>,
    next: usize,
    /// In `~:{`, are there further sublists?
    has_more_lists: bool,
    /// Are they the elements of a list that a logical block prints?
    of_block: bool,
    /// What the list ends with in place of `NIL`.
    tail: Option<Value>,
}

impl Arguments {
    fn new(items: impl Into<Rc<[Value]>>) -> Arguments {
        Arguments {
            items: items.into(),
            next: 0,
            has_more_lists: false,
            of_block: false,
            tail: None,
        }
    }

    fn left(&self) -> usize {
        self.items.len().saturating_sub(self.next)
    }

    fn rest(&self) -> Vec<Value> {
        self.items.iter().skip(self.next).cloned().collect()
    }
}

/// A parameter with its value.
#[derive(Clone, Copy)]
enum Given {
    Number(i64),
    Char(char),
}

struct Interpreter<'a> {
    image: &'a Image,
    calls: &'a mut Calls,
    settings: Settings,
    output: Output,
    controls: usize,
}

/// One control string with the position of a directive in it, for errors.
#[derive(Clone, Copy)]
struct Context<'c> {
    control: &'c str,
}

impl Context<'_> {
    fn error(&self, directive: &Directive, problem: Problem) -> Box<Raise> {
        FormatError {
            problem,
            control: self.control.to_owned(),
            position: directive.position,
        }
        .into()
    }
}

pub(super) fn run(
    control: &Control,
    image: &Image,
    args: &[Value],
    column: usize,
    calls: &mut Calls,
) -> Result<String> {
    run_into(control, image, args, Output::new(column), calls).map(Output::into_text)
}

/// Like [`run()`], for an output that may be a document.
pub(super) fn run_into(
    control: &Control,
    image: &Image,
    args: &[Value],
    output: Output,
    calls: &mut Calls,
) -> Result<Output> {
    run_for_rest(control, image, args, output, calls).map(|(output, _)| output)
}

/// Like [`run_into()`]; also the arguments that are left.
pub(super) fn run_for_rest(
    control: &Control,
    image: &Image,
    args: &[Value],
    output: Output,
    calls: &mut Calls,
) -> Result<(Output, Vec<Value>)> {
    let mut interpreter = Interpreter {
        image,
        calls,
        settings: Settings::of(image),
        output,
        controls: 0,
    };
    let mut arguments = Arguments::new(args);
    let context = Context {
        control: &control.text,
    };
    interpreter.pieces(context, &control.pieces, &mut arguments)?;
    Ok((interpreter.output, arguments.rest()))
}

impl Interpreter<'_> {
    fn pieces(&mut self, c: Context<'_>, pieces: &[Piece], args: &mut Arguments) -> Result<Flow> {
        for piece in pieces {
            match piece {
                Piece::Text(text) => self.output.push(text),
                Piece::Directive(directive) => match self.directive(c, directive, args)? {
                    Flow::Through => {}
                    exit => return Ok(exit),
                },
            }
        }
        Ok(Flow::Through)
    }

    fn next(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<Value> {
        let value = args
            .items
            .get(args.next)
            .cloned()
            .ok_or_else(|| c.error(d, Problem::NoMoreArguments))?;
        args.next += 1;
        Ok(value)
    }

    /// The values of a directive's parameters.
    fn parameters(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Vec<Option<Given>>> {
        self.given(c, d, &d.parameters, args)
    }

    fn given(
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

    fn directive(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<Flow> {
        if args.of_block && self.ends_block(d, args) {
            return Ok(Flow::Exit);
        }
        match d.letter {
            'A' | 'S' => self.object(c, d, args)?,
            'W' => {
                let value = self.next(c, d, args)?;
                let mut settings = self.settings.clone();
                settings.pretty |= d.colon;
                if d.at {
                    settings.length = None;
                    settings.level = None;
                }
                self.write(&value, &settings);
            }
            'D' => self.integer(c, d, args, 10)?,
            'B' => self.integer(c, d, args, 2)?,
            'O' => self.integer(c, d, args, 8)?,
            'X' => self.integer(c, d, args, 16)?,
            'R' => self.radix(c, d, args)?,
            'F' | 'E' | 'G' => self.float(c, d, args)?,
            '$' => self.money(c, d, args)?,
            'C' => self.character(c, d, args)?,
            'P' => self.plural(c, d, args)?,
            '%' | '&' | '|' | '~' => self.repeated(c, d, args)?,
            'T' => self.tabulate(c, d, args)?,
            '*' => self.go_to(c, d, args)?,
            '?' => self.indirect(c, d, args)?,
            '{' => return self.iterate(c, d, args),
            '[' => return self.choose(c, d, args),
            '(' => return self.convert_case(c, d, args),
            '<' if d.close.is_some_and(|close| close.colon) => {
                return self.logical_block(c, d, args);
            }
            '<' => return self.justify(c, d, args),
            '^' => return self.escape(c, d, args),
            '_' => {
                let newline = match (d.colon, d.at) {
                    (false, false) => Newline::Linear,
                    (true, false) => Newline::Fill,
                    (false, true) => Newline::Miser,
                    (true, true) => Newline::Mandatory,
                };
                if let Some(document) = self.output.document() {
                    document.newline(newline);
                }
            }
            'I' => {
                let given = self.parameters(c, d, args)?;
                let columns = number_of(&given, 0)?.unwrap_or(0);
                if let Some(document) = self.output.document() {
                    if d.colon {
                        document.indent_current(columns);
                    } else {
                        document.indent_block(columns);
                    }
                }
            }
            '/' => self.call(c, d, args)?,
            // The parser lets no other letter through.
            _ => {}
        }
        Ok(Flow::Through)
    }

    /// Prints a value at the end of the text.
    fn write(&mut self, value: &Value, settings: &Settings) {
        if let Some(document) = self.output.document() {
            let settings = settings.effective();
            let printer = Printer::new(self.image, &settings, self.calls);
            printer.print_into(document, value);
            return;
        }
        let column = self.output.column();
        let text = super::super::write(self.image, value, settings, column, self.calls);
        self.output.push(&text);
    }

    fn text_of(&mut self, value: &Value, settings: &Settings) -> String {
        super::super::write(self.image, value, settings, 0, self.calls)
    }

    fn object(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let width = width_of(&given, 0)?.unwrap_or(0);
        let step = width_of(&given, 1)?.unwrap_or(1).max(1);
        let least = width_of(&given, 2)?.unwrap_or(0);
        let pad = char_of(&given, 3)?.unwrap_or(' ');
        let value = self.next(c, d, args)?;
        let settings = self.settings.clone().with_escape(d.letter == 'S');
        if d.colon && value.is_nil() || width > 0 || least > 0 {
            let text = if d.colon && value.is_nil() {
                "()".to_owned()
            } else {
                self.text_of(&value, &settings)
            };
            let length = text.chars().count();
            let mut padding = least;
            if length + padding < width {
                padding += (width - length - padding).div_ceil(step) * step;
            }
            if d.at {
                self.output.repeat(pad, padding);
                self.output.push(&text);
            } else {
                self.output.push(&text);
                self.output.repeat(pad, padding);
            }
        } else {
            self.write(&value, &settings);
        }
        Ok(())
    }

    fn integer(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
        radix: u32,
    ) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        self.write_integer(d, &given, &value, radix)
    }

    /// Parameters: width, padding, comma character, comma interval.
    fn write_integer(
        &mut self,
        d: &Directive,
        given: &[Option<Given>],
        value: &Value,
        radix: u32,
    ) -> Result<()> {
        let comma = char_of(given, 2)?.unwrap_or(',');
        let interval = width_of(given, 3)?.unwrap_or(3);
        let style = IntegerStyle {
            radix,
            width: width_of(given, 0)?.unwrap_or(0),
            pad: char_of(given, 1)?.unwrap_or(' '),
            comma: d.colon.then_some((comma, interval)),
            sign: d.at,
        };
        match number::to_big(value) {
            Some(n) => self.output.push(&integer(&n, &style)),
            None => {
                let mut settings = self.settings.clone().with_escape(false);
                settings.base = radix;
                settings.radix = false;
                self.write(value, &settings);
            }
        }
        Ok(())
    }

    fn radix(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        if let Some(radix) = number_of(&given, 0)? {
            let radix = u32::try_from(radix).unwrap_or(0);
            if !(2..=36).contains(&radix) {
                let problem = Problem::Argument(format!("{radix} is not a radix from 2 to 36."));
                return Err(c.error(d, problem));
            }
            return self.write_integer(d, given.get(1..).unwrap_or(&[]), &value, radix);
        }
        let n: BigInt =
            number::to_big(&value).ok_or_else(|| Raise::type_error(&value, known::INTEGER))?;
        let words = match (d.colon, d.at) {
            (false, false) => english::cardinal(&n),
            (true, false) => english::ordinal(&n),
            (old, true) => english::roman(&n, old),
        };
        match words {
            Some(words) => self.output.push(&words),
            None => {
                let how = if d.at { "Roman numerals" } else { "English" };
                let problem = Problem::Argument(format!("Number out of range for {how}: {n}"));
                return Err(c.error(d, problem));
            }
        }
        Ok(())
    }

    /// The number that a float directive prints: rationals become single floats.
    fn float_argument(&mut self, value: &Value) -> Result<Option<Value>> {
        match value {
            Value::Single(x) if x.is_finite() => Ok(Some(value.clone())),
            Value::Double(x) if x.is_finite() => Ok(Some(value.clone())),
            rational if number::is_rational(rational) => number::to_single(rational)
                .or_else(|_| number::to_double(rational))
                .map(Some),
            _ => Ok(None),
        }
    }

    fn float(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        let at =
            |index| number_of(&given, index).map(|n| n.map(|n| n.clamp(-MAX_WIDTH, MAX_WIDTH)));
        let mut style = FloatStyle {
            width: at(0)?,
            places: at(1)?.map(|n| n.max(0)),
            sign: d.at,
            ..FloatStyle::default()
        };
        if d.letter == 'F' {
            style.scale = at(2)?;
            style.overflow = char_of(&given, 3)?;
            style.pad = char_of(&given, 4)?;
        } else {
            style.exponent = at(2)?;
            style.scale = at(3)?;
            style.overflow = char_of(&given, 4)?;
            style.pad = char_of(&given, 5)?;
            style.marker = char_of(&given, 6)?;
        }
        let Some(x) = self.float_argument(&value)? else {
            self.padded_left(&value, style.width.unwrap_or(0));
            return Ok(());
        };
        let text = match d.letter {
            'F' => float::fixed(&x, &style),
            'E' => float::exponential(&x, &style, self.settings.float_format),
            _ => float::general(&x, &style, self.settings.float_format),
        };
        self.output.push(&text);
        Ok(())
    }

    /// Prints a value that is not a number as by `princ`, right-aligned in its field.
    fn padded_left(&mut self, value: &Value, width: i64) {
        let settings = self.settings.clone().with_escape(false);
        let text = self.text_of(value, &settings);
        let width = usize::try_from(width).unwrap_or(0);
        self.output
            .repeat(' ', width.saturating_sub(text.chars().count()));
        self.output.push(&text);
    }

    fn money(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        let at = |index| number_of(&given, index).map(|n| n.map(|n| n.clamp(0, MAX_WIDTH)));
        let style = FloatStyle {
            width: at(2)?,
            pad: char_of(&given, 3)?,
            sign: d.at,
            ..FloatStyle::default()
        };
        let Some(x) = self.float_argument(&value)? else {
            self.padded_left(&value, style.width.unwrap_or(0));
            return Ok(());
        };
        let places = at(0)?.unwrap_or(2);
        let before = at(1)?.unwrap_or(1);
        self.output
            .push(&float::money(&x, places, before, &style, d.colon));
        Ok(())
    }

    fn character(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let value = self.next(c, d, args)?;
        let Value::Char(char) = value else {
            return Err(Raise::type_error(&value, known::CHARACTER));
        };
        if d.colon {
            let name = char_name(char).unwrap_or_else(|| char.to_string());
            self.output.push(&name);
        } else {
            let settings = self.settings.clone().with_escape(d.at);
            self.write(&value, &settings);
        }
        Ok(())
    }

    fn plural(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        if d.colon {
            args.next = args
                .next
                .checked_sub(1)
                .ok_or_else(|| c.error(d, Problem::NoMoreArguments))?;
        }
        let value = self.next(c, d, args)?;
        let is_one = value.is_eql(&Value::Int(1));
        self.output.push(match (d.at, is_one) {
            (false, true) => "",
            (false, false) => "s",
            (true, true) => "y",
            (true, false) => "ies",
        });
        Ok(())
    }

    fn repeated(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let mut count = width_of(&given, 0)?.unwrap_or(1);
        let char = match d.letter {
            '%' | '&' => '\n',
            '|' => '\u{c}',
            _ => '~',
        };
        if d.letter == '&' && count > 0 && self.output.column() == 0 {
            count -= 1;
        }
        self.output.repeat(char, count);
        Ok(())
    }

    fn tabulate(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let target = width_of(&given, 0)?.unwrap_or(1);
        let step = width_of(&given, 1)?.unwrap_or(1);
        let tab = Tab {
            by_section: d.colon,
            is_relative: d.at,
            column: target,
            step,
        };
        if let Some(document) = self.output.document()
            && document.is_pretty()
        {
            document.tab(tab);
            return Ok(());
        }
        // Sections are only known to the pretty printer.
        let blanks = if d.colon {
            0
        } else {
            tab.blanks(self.output.column())
        };
        self.output.repeat(' ', blanks);
        Ok(())
    }

    fn go_to(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
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
        let flow = self.pieces(inner, &parsed.pieces, args);
        self.controls -= 1;
        flow
    }

    fn indirect(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
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

    fn iterate(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<Flow> {
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
        let mut count = 0;
        while (items.left() > 0 || at_least_once) && most.is_none_or(|most| count < most) {
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
            if !d.colon && items.left() > 0 && items.next <= before && most.is_none() {
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

    fn choose(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<Flow> {
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

    /// Runs pieces into a text of their own.
    fn captured(
        &mut self,
        c: Context<'_>,
        pieces: &[Piece],
        args: &mut Arguments,
    ) -> Result<(String, Flow)> {
        let column = self.output.column();
        let outer = std::mem::replace(&mut self.output, Output::new(column));
        let flow = self.pieces(c, pieces, args);
        let inner = std::mem::replace(&mut self.output, outer);
        Ok((inner.into_text(), flow?))
    }

    fn convert_case(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Flow> {
        let pieces = d.clauses.first().map_or(&[][..], |clause| &clause.pieces);
        let (text, flow) = self.captured(c, pieces, args)?;
        let converted = match (d.colon, d.at) {
            (false, false) => text.to_lowercase(),
            (true, true) => text.to_uppercase(),
            (true, false) => capitalized(&text, true),
            (false, true) => capitalized(&text, false),
        };
        self.output.push(&converted);
        Ok(flow)
    }

    fn justify(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<Flow> {
        let given = self.parameters(c, d, args)?;
        let mut texts = Vec::new();
        let mut overflow = None;
        for (i, clause) in d.clauses.iter().enumerate() {
            let (text, flow) = self.captured(c, &clause.pieces, args)?;
            // A segment that `~^` cuts off is left out, and so are those after it.
            if flow != Flow::Through {
                break;
            }
            match &clause.separator {
                // `~<prefix~n:;…~>`: the prefix is written if the rest does not fit.
                Some((true, _, parameters)) if i == 0 => {
                    let limits = self.given(c, d, parameters, args)?;
                    let spare = width_of(&limits, 0)?.unwrap_or(0);
                    let line = width_of(&limits, 1)?.unwrap_or(self.settings.right_margin);
                    overflow = Some((text, spare, line));
                }
                _ => texts.push(text),
            }
        }
        let justification = Justification {
            width: width_of(&given, 0)?.unwrap_or(0),
            step: width_of(&given, 1)?.unwrap_or(1),
            least: width_of(&given, 2)?.unwrap_or(0),
            pad: char_of(&given, 3)?.unwrap_or(' '),
            before: d.colon,
            after: d.at,
        };
        let text = justification.spread(&texts);
        if let Some((prefix, spare, line)) = overflow
            && self.output.column() + text.chars().count() + spare > line
        {
            self.output.push(&prefix);
        }
        self.output.push(&text);
        Ok(Flow::Through)
    }

    fn escape(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<Flow> {
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

    /// `~/name/`
    fn call(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        let function = self.function_named(&d.name)?;
        let mut after = vec![value, Value::bool(d.colon), Value::bool(d.at)];
        after.extend(given.into_iter().map(|given| match given {
            None => Value::NIL,
            Some(Given::Number(n)) => Value::Int(n),
            Some(Given::Char(c)) => Value::Char(c),
        }));
        self.call_with_stream(function.into(), after);
        Ok(())
    }

    fn call_with_stream(&mut self, function: Value, after: Vec<Value>) {
        let call = || Call {
            function,
            before: Vec::new(),
            after,
            bindings: Vec::new(),
            is_pretty: self.settings.pretty,
        };
        if let Some(text) = self.calls.text(call) {
            self.output.append(&text, &self.settings);
        }
    }

    /// The symbol that a name between slashes means; in `COMMON-LISP-USER` unless it says
    /// otherwise.
    fn function_named(&self, name: &str) -> Result<Sym> {
        let upper = name.to_uppercase();
        let (package, symbol) = upper
            .split_once(':')
            .unwrap_or(("COMMON-LISP-USER", upper.as_str()));
        let symbol = symbol.trim_start_matches(':');
        self.image
            .packages
            .find(package)
            .and_then(|package| self.image.packages.find_symbol(package, symbol))
            .map(|(sym, _)| sym)
            .ok_or_else(|| {
                Raise::new(
                    known::UNDEFINED_FUNCTION,
                    format!("The function {package}::{symbol} is undefined."),
                )
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

fn list_items(list: &Value) -> Result<Vec<Value>> {
    let mut items = list.iter_list();
    let found = items.by_ref().collect();
    match items.rest.is_nil() {
        true => Ok(found),
        false => Err(Raise::type_error(&items.rest, known::LIST)),
    }
}

fn number_of(given: &[Option<Given>], index: usize) -> Result<Option<i64>> {
    match given.get(index).copied().flatten() {
        None => Ok(None),
        Some(Given::Number(n)) => Ok(Some(n)),
        Some(Given::Char(c)) => Err(Raise::type_error(&Value::Char(c), known::INTEGER)),
    }
}

fn width_of(given: &[Option<Given>], index: usize) -> Result<Option<usize>> {
    Ok(number_of(given, index)?.map(|n| usize::try_from(n.clamp(0, MAX_WIDTH)).unwrap_or(0)))
}

fn char_of(given: &[Option<Given>], index: usize) -> Result<Option<char>> {
    match given.get(index).copied().flatten() {
        None => Ok(None),
        Some(Given::Char(c)) => Ok(Some(c)),
        Some(Given::Number(n)) => Err(Raise::type_error(&Value::Int(n), known::CHARACTER)),
    }
}

/// The first letter of every word, or of the first word only, as a capital; others in lower case.
fn capitalized(text: &str, every_word: bool) -> String {
    let mut in_word = false;
    let mut is_first = true;
    let mut result = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_alphanumeric() {
            if !in_word && (every_word || is_first) {
                result.extend(c.to_uppercase());
            } else {
                result.extend(c.to_lowercase());
            }
            is_first = false;
            in_word = true;
        } else {
            result.push(c);
            in_word = false;
        }
    }
    result
}
