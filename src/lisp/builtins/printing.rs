//! Writing values and characters to streams: `print`, `princ`, `write-line`, …

use super::composing::compose;
use super::streams::or_method;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::print::{self, Case, Settings};
use crate::stream;
use crate::typed::keywords;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::package::PackageTable;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence};
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// Writes a newline, the object so that it can be read back, and a blank.
///
/// ```lisp
/// (with-output-to-string (s) (print "a" s)) => "
/// \"a\" "
/// ```
#[builtin(_, "object &optional stream")]
fn print(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    write_object(machine, args, Manner::Print)
}

/// Writes the object so that it can be read back.
///
/// `(with-output-to-string (s) (prin1 "a" s))` => `"\"a\""`
#[builtin(_, "object &optional stream")]
fn prin1(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    write_object(machine, args, Manner::Prin1)
}

/// Writes the object for people.
///
/// `(with-output-to-string (s) (princ '("a" #\b) s))` => `"(a b)"`
#[builtin(_, "object &optional stream")]
fn princ(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    write_object(machine, args, Manner::Princ)
}

/// Writes a newline and the object with line breaks.
///
/// ```lisp
/// (with-output-to-string (s) (pprint '(a b) s)) => "
/// (A B)"
/// ```
#[builtin(_, "object &optional stream")]
fn pprint(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    write_object(machine, args, Manner::Pprint)
}

/// The text that PRIN1 writes.
///
/// `(prin1-to-string '(a "b"))` => `"(A \"b\")"`
#[builtin(_, "object")]
fn prin1_to_string(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    to_string(machine, args, Some(true))
}

/// The text that PRINC writes.
///
/// `(princ-to-string '(a "b"))` => `"(A b)"`
#[builtin(_, "object")]
fn princ_to_string(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    to_string(machine, args, Some(false))
}

/// The text that WRITE writes.
///
/// `(write-to-string '(1 2 3 4) :length 2)` => `"(1 2 ...)"`
#[builtin(
    _,
    "object &key escape radix base circle pretty level length case gensym array readably right-margin lines miser-width pprint-dispatch"
)]
fn write_to_string(m: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    to_string(m, args, None)
}

/// Writes the string as it is.
///
/// `(with-output-to-string (s) (write-string "abc" s :start 1))` => `"bc"`
#[builtin("WRITE-STRING", "string &optional stream &key start end")]
fn write_string_builtin(image: &mut Image, args: &[Value]) -> Outcome {
    write_string(image, args, "")
}

/// Writes the string and a newline.
///
/// ```lisp
/// (with-output-to-string (s) (write-line "abc" s)) => "abc
/// "
/// ```
#[builtin(_, "string &optional stream &key start end")]
fn write_line(image: &mut Image, args: &[Value]) -> Outcome {
    write_string(image, args, "\n")
}

/// Writes the character.
///
/// `(with-output-to-string (s) (write-char #\a s))` => `"a"`
#[builtin(_, "character &optional stream")]
fn write_char(image: &mut Image, args: &[Value]) -> Outcome {
    let Value::Char(c) = args[0] else {
        return Err(Raise::type_error(&args[0], known::CHARACTER));
    };
    stream::write(image, &stream_argument(args, 1), c.encode_utf8(&mut [0; 4]))?;
    Ok(args[0].clone())
}

/// Writes a newline.
///
/// ```lisp
/// (with-output-to-string (s) (terpri s)) => "
/// "
/// ```
#[builtin(_, "&optional stream")]
fn terpri(image: &mut Image, args: &[Value]) -> Outcome {
    stream::write(image, &stream_argument(args, 0), "\n")?;
    Ok(Value::NIL)
}

/// Writes a newline unless at the start of a line; was one written?
///
/// `(with-output-to-string (s) (fresh-line s))` => `""`
#[builtin(_, "&optional stream")]
fn fresh_line(image: &mut Image, args: &[Value]) -> Outcome {
    stream::fresh_line(image, &stream_argument(args, 0)).map(Value::bool)
}

#[derive(Clone, Copy, PartialEq)]
enum Manner {
    Print,
    Prin1,
    Princ,
    Pprint,
}

impl Manner {
    /// The function that prints so.
    fn function(self) -> Sym {
        match self {
            Manner::Print => known::PRINT,
            Manner::Prin1 => known::PRIN1,
            Manner::Princ => known::PRINC,
            Manner::Pprint => known::PPRINT,
        }
    }
}

fn stream_argument(args: &[Value], index: usize) -> Value {
    args.get(index).cloned().unwrap_or(Value::NIL)
}

/// The column of a stream, zero if that is not known.
fn column(image: &Image, stream: &Value) -> Result<usize, Box<Raise>> {
    Ok(stream::column(image, stream)?.unwrap_or(0))
}

fn write_object(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
    manner: Manner,
) -> Result<Step, Box<Raise>> {
    let target = stream_argument(&args, 1);
    let object = args[0].clone();
    let mut settings = Settings::of(machine.image).with_escape(manner != Manner::Princ);
    let mut start = match column(machine.image, &target) {
        Ok(start) => start,
        Err(raise) => return or_method(raise, manner.function(), args),
    };
    if matches!(manner, Manner::Print | Manner::Pprint) {
        start = 0;
    }
    settings.pretty |= manner == Manner::Pprint;
    let printed = object.clone();
    if let Some(stream) = stream::pretty(machine.image, &target) {
        return compose(
            machine,
            "PRINT",
            move |image, calls| Ok(print::document(image, &printed, &settings, calls)),
            move |_, text| {
                stream.with_document(|document| {
                    if matches!(manner, Manner::Print | Manner::Pprint) {
                        document.text("\n");
                    }
                    document.append(&text);
                    if manner == Manner::Print {
                        document.text(" ");
                    }
                });
                Ok(Step::Return(match manner {
                    Manner::Pprint => Value::values(Vec::new()),
                    _ => object,
                }))
            },
        );
    }
    compose(
        machine,
        "PRINT",
        move |image, calls| Ok(print::write(image, &printed, &settings, start, calls)),
        move |machine, text| {
            let text = match manner {
                Manner::Print => format!("\n{text} "),
                Manner::Pprint => format!("\n{text}"),
                Manner::Prin1 | Manner::Princ => text,
            };
            stream::write(machine.image, &target, &text)?;
            Ok(Step::Return(match manner {
                Manner::Pprint => Value::values(Vec::new()),
                _ => object,
            }))
        },
    )
}

/// The settings of `write`, and the stream.
fn write_settings(image: &Image, args: &[Value]) -> Result<(Settings, Value), Box<Raise>> {
    let given = keywords::parse(
        image,
        args,
        [
            known::K_STREAM,
            known::K_ESCAPE,
            known::K_RADIX,
            known::K_BASE,
            known::K_CIRCLE,
            known::K_PRETTY,
            known::K_LEVEL,
            known::K_LENGTH,
            known::K_CASE,
            known::K_GENSYM,
            known::K_ARRAY,
            known::K_READABLY,
            known::K_RIGHT_MARGIN,
            known::K_LINES,
            known::K_MISER_WIDTH,
            known::K_PPRINT_DISPATCH,
        ],
    )?;
    let [
        stream,
        escape,
        radix,
        base,
        circle,
        pretty,
        level,
        length,
        case,
        gensym,
        array,
        readably,
        right_margin,
        lines,
        miser_width,
        _,
    ] = given;
    let mut settings = Settings::of(image);
    let flag = |place: &mut bool, value: Option<Value>| {
        if let Some(value) = value {
            *place = value.is_true();
        }
    };
    flag(&mut settings.escape, escape);
    flag(&mut settings.radix, radix);
    flag(&mut settings.circle, circle);
    flag(&mut settings.pretty, pretty);
    flag(&mut settings.gensym, gensym);
    flag(&mut settings.array, array);
    flag(&mut settings.readably, readably);
    count(&mut settings.level, level)?;
    count(&mut settings.length, length)?;
    count(&mut settings.lines, lines)?;
    count(&mut settings.miser_width, miser_width)?;
    let mut margin = Some(settings.right_margin);
    count(&mut margin, right_margin)?;
    settings.right_margin = margin.unwrap_or(80);
    match base {
        None => {}
        Some(Value::Int(n @ 2..=36)) => settings.base = u32::try_from(n).unwrap_or(10),
        Some(other) => {
            let range = [known::INTEGER.into(), Value::Int(2), Value::Int(36)];
            return Err(Raise::type_error(&other, Value::list(range)));
        }
    }
    match case.map(|value| (value.as_symbol(), value)) {
        None => {}
        Some((Some(known::K_UPCASE), _)) => settings.case = Case::Up,
        Some((Some(known::K_DOWNCASE), _)) => settings.case = Case::Down,
        Some((Some(known::K_CAPITALIZE), _)) => settings.case = Case::Capitalize,
        Some((_, other)) => {
            let cases: [Value; 4] = [
                known::MEMBER.into(),
                known::K_UPCASE.into(),
                known::K_DOWNCASE.into(),
                known::K_CAPITALIZE.into(),
            ];
            return Err(Raise::type_error(&other, Value::list(cases)));
        }
    }
    Ok((settings, stream.unwrap_or(Value::NIL)))
}

fn count(place: &mut Option<usize>, value: Option<Value>) -> Result<(), Box<Raise>> {
    *place = match value {
        None => return Ok(()),
        Some(Value::Symbol(known::NIL, ..)) => None,
        Some(Value::Int(n)) if n >= 0 => usize::try_from(n).ok(),
        Some(other) => return Err(Raise::type_error(&other, known::UNSIGNED_BYTE)),
    };
    Ok(())
}

/// A call with another dispatch table binds the variable; `None` if that is not wanted.
fn with_dispatch(image: &Image, args: &[Value], writer: &str) -> Option<Step> {
    let (object, options) = args.split_first()?;
    let mut pairs = options.chunks_exact(2);
    let table = pairs.find(|pair| pair[0].as_symbol() == Some(known::K_PPRINT_DISPATCH))?;
    let writer = image.packages.find_symbol(PackageTable::CL, writer)?.0;
    let arguments = [
        writer.into(),
        object.clone(),
        table[1].clone(),
        Value::list(options.iter().cloned()),
    ];
    Some(Step::tail_call(
        known::SYS_WRITE_DISPATCHED,
        arguments.to_vec(),
    ))
}

/// Writes the object under given printer variables.
///
/// `(with-output-to-string (s) (write 255 :base 16 :stream s))` => `"FF"`
#[builtin(
    _,
    "object &key stream escape radix base circle pretty level length case gensym array readably right-margin lines miser-width pprint-dispatch"
)]
fn write(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    if let Some(step) = with_dispatch(machine.image, &args, "WRITE") {
        return Ok(step);
    }
    let object = args[0].clone();
    let (settings, target) = write_settings(machine.image, args.get(1..).unwrap_or(&[]))?;
    let start = match column(machine.image, &target) {
        Ok(start) => start,
        Err(raise) => return or_method(raise, known::WRITE, args),
    };
    let printed = object.clone();
    if let Some(stream) = stream::pretty(machine.image, &target) {
        return compose(
            machine,
            "WRITE",
            move |image, calls| Ok(print::document(image, &printed, &settings, calls)),
            move |_, text| {
                stream.with_document(|document| document.append(&text));
                Ok(Step::Return(object))
            },
        );
    }
    compose(
        machine,
        "WRITE",
        move |image, calls| Ok(print::write(image, &printed, &settings, start, calls)),
        move |machine, text| {
            stream::write(machine.image, &target, &text)?;
            Ok(Step::Return(object))
        },
    )
}

fn to_string(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
    escape: Option<bool>,
) -> Result<Step, Box<Raise>> {
    if escape.is_none()
        && let Some(step) = with_dispatch(machine.image, &args, "WRITE-TO-STRING")
    {
        return Ok(step);
    }
    let settings = match escape {
        Some(escape) => Settings::of(machine.image).with_escape(escape),
        None => write_settings(machine.image, args.get(1..).unwrap_or(&[]))?.0,
    };
    compose(
        machine,
        "WRITE-TO-STRING",
        move |image, calls| Ok(print::write(image, &args[0], &settings, 0, calls)),
        |_, text| Ok(Step::Return(Value::string(text))),
    )
}

/// Writes the object; a program may add methods.
///
/// `(with-output-to-string (s) (print-object 'a s))` => `"A"`
// What the default method does: prints the object's default form.
#[builtin(_, "object stream")]
fn print_object(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let settings = Settings::of(machine.image);
    let target = args[1].clone();
    let start = match column(machine.image, &target) {
        Ok(start) => start,
        Err(raise) => return or_method(raise, known::PRINT_OBJECT, args),
    };
    let object = args[0].clone();
    if let Some(stream) = stream::pretty(machine.image, &target) {
        return compose(
            machine,
            "PRINT-OBJECT",
            move |image, calls| Ok(print::document_default(image, &args[0], &settings, calls)),
            move |_, text| {
                stream.with_document(|document| document.append(&text));
                Ok(Step::Return(object))
            },
        );
    }
    compose(
        machine,
        "PRINT-OBJECT",
        move |image, calls| {
            Ok(print::write_default(
                image, &args[0], &settings, start, calls,
            ))
        },
        move |machine, text| {
            stream::write(machine.image, &target, &text)?;
            Ok(Step::Return(object))
        },
    )
}

fn write_string(image: &mut Image, args: &[Value], end_of_line: &str) -> Outcome {
    let Value::Str(string) = &args[0] else {
        return Err(Raise::type_error(&args[0], known::STRING));
    };
    let names: [Sym; 2] = [known::K_START, known::K_END];
    let [start, end] = keywords::parse(image, args.get(2..).unwrap_or(&[]), names)?;
    let sequence = Sequence::Str(string.clone());
    let bounds = Bounds::new(&sequence, start.as_ref(), end.as_ref())?;
    let text = string.text();
    let part: String = match (bounds.start, bounds.end) {
        (0, None) => text,
        (start, end) => {
            let end = end.unwrap_or(usize::MAX);
            text.chars().skip(start).take(end - start).collect()
        }
    };
    stream::write(
        image,
        &stream_argument(args, 1),
        &format!("{part}{end_of_line}"),
    )?;
    Ok(args[0].clone())
}

/// Writes #<…> with the object's type, what the body writes, and a made-up address.
#[builtin(_, "object stream type identity body")]
fn write_unreadable(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let [object, target, with_type, with_identity, body] = args.as_slice() else {
        return Err(Raise::program(format!(
            "invalid number of arguments: {}",
            args.len()
        )));
    };
    let image = &mut *machine.image;
    if image.special(known::V_PRINT_READABLY).is_true() {
        return Err(print::not_readable(object));
    }
    if let Err(raise) = stream::output_stream(image, target) {
        return or_method(raise, known::WRITE_UNREADABLE, args.clone());
    }
    let mut start = String::from("#<");
    if with_type.is_true() {
        let name = crate::object::class_of(image, object).name;
        start.push_str(&print::to_string(image, &name.into(), true));
    }
    // A blank follows the type and comes before the identity, also if nothing stands between; one is
    // enough for both then.
    if with_type.is_true() {
        start.push(' ');
    }
    let end = match (
        with_identity.is_true(),
        body.is_nil() && with_type.is_true(),
    ) {
        (false, _) => ">".to_owned(),
        (true, true) => format!("{}>", print::identity(image, object)),
        (true, false) => format!(" {}>", print::identity(image, object)),
    };
    stream::write(image, target, &start)?;
    if body.is_nil() {
        stream::write(image, target, &end)?;
        return Ok(Step::Return(Value::NIL));
    }
    let (body, target) = (body.clone(), target.clone());
    run(machine, "PRINT-UNREADABLE-OBJECT", |calls| async move {
        calls.call(&body, Args::Many(Vec::new())).await;
        calls
            .with(move |machine| stream::write(machine.image, &target, &end))
            .await?;
        Ok(Value::NIL)
    })
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    print,
    prin1,
    princ,
    pprint,
    write,
    prin1_to_string,
    princ_to_string,
    write_to_string,
    print_object,
    write_string_builtin,
    write_line,
    write_char,
    terpri,
    fresh_line,
];

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![write_unreadable,];
