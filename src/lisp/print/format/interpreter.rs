//! Carrying out directives.
//!
//! Nested directives recurse, as deep as the parser allows; `~?` has a limit of its own.

mod arguments;
mod block;
mod clause_text;
mod control_flow;
mod numbers;

use super::super::calls::{Call, Calls};
use super::super::circle::SharedLabels;
use super::super::printer::Printer;
use super::super::settings::Settings;
use super::Control;
use super::directive::{Directive, Piece};
use super::error::{FormatError, Problem};
use super::output::Output;
use crate::image::Image;
use crate::reader::char_name::char_name;
use crate::value::Value;
use crate::value::document::{Newline, Tab};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use arguments::{Arguments, Given, char_of, number_of, width_of};

type Result<T> = std::result::Result<T, Box<Raise>>;

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

struct Interpreter<'a> {
    image: &'a Image,
    calls: &'a mut Calls,
    settings: Settings,
    output: Output,
    controls: usize,
    /// Does a group of blanks in the text end where the line may break, as `~:@>` wants?
    fills: bool,
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
        fills: false,
    };
    let mut arguments = Arguments::new(args);
    let context = Context {
        control: &control.text,
    };
    let shared = interpreter.settings.shared.clone();
    interpreter.settings.shared = shared.as_ref().map(SharedLabels::for_attempt);
    interpreter.pieces(context, &control.pieces, &mut arguments)?;
    if let (Some(shared), Some(attempt)) = (shared, &interpreter.settings.shared) {
        shared.note_attempt(attempt, interpreter.calls.are_made());
    }
    Ok((interpreter.output, arguments.rest()))
}

impl Interpreter<'_> {
    fn pieces(&mut self, c: Context<'_>, pieces: &[Piece], args: &mut Arguments) -> Result<Flow> {
        for piece in pieces {
            match piece {
                Piece::Text(text) if self.fills => self.filled(text),
                Piece::Text(text) => self.output.push(text),
                Piece::Directive(directive) => match self.directive(c, directive, args)? {
                    Flow::Through => {}
                    exit => return Ok(exit),
                },
            }
        }
        Ok(Flow::Through)
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
            '<' if d.is_logical_block() => {
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

    fn character(&mut self, c: Context<'_>, d: &Directive, args: &mut Arguments) -> Result<()> {
        let value = self.next(c, d, args)?;
        let Value::Char(char) = value else {
            return Err(Raise::type_error(&value, known::CHARACTER));
        };
        if d.colon {
            let is_named = char == ' ' || char.is_control();
            let name = char_name(char).filter(|_| is_named);
            self.output.push(&name.unwrap_or_else(|| char.to_string()));
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
            && self.settings.pretty
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
