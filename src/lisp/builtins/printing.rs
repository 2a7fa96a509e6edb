//! Writing values and characters to streams: `print`, `princ`, `write-line`, …

use std::rc::Rc;

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
use crate::value::string::LispString;
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Writes a newline, the object so that it can be read back, and a blank.
///
/// ```lisp
/// (with-output-to-string (s) (print "a" s)) => "
/// \"a\" "
/// ```
#[builtin]
fn print(machine: &mut Machine<'_>, object: Value, stream: Option<Value>) -> Result<Step> {
    write_object(machine, object, stream, Manner::Print)
}

/// Writes the object so that it can be read back.
///
/// `(with-output-to-string (s) (prin1 "a" s))` => `"\"a\""`
#[builtin]
fn prin1(machine: &mut Machine<'_>, object: Value, stream: Option<Value>) -> Result<Step> {
    write_object(machine, object, stream, Manner::Prin1)
}

/// Writes the object for people.
///
/// `(with-output-to-string (s) (princ '("a" #\b) s))` => `"(a b)"`
#[builtin]
fn princ(machine: &mut Machine<'_>, object: Value, stream: Option<Value>) -> Result<Step> {
    write_object(machine, object, stream, Manner::Princ)
}

/// Writes a newline and the object with line breaks.
///
/// ```lisp
/// (with-output-to-string (s) (pprint '(a b) s)) => "
/// (A B)"
/// ```
#[builtin]
fn pprint(machine: &mut Machine<'_>, object: Value, stream: Option<Value>) -> Result<Step> {
    write_object(machine, object, stream, Manner::Pprint)
}

/// The text that PRIN1 writes.
///
/// `(prin1-to-string '(a "b"))` => `"(A \"b\")"`
#[builtin]
fn prin1_to_string(machine: &mut Machine<'_>, object: Value) -> Result<Step> {
    let settings = Settings::of(machine.image).with_escape(true);
    to_string(machine, object, settings)
}

/// The text that PRINC writes.
///
/// `(princ-to-string '(a "b"))` => `"(A b)"`
#[builtin]
fn princ_to_string(machine: &mut Machine<'_>, object: Value) -> Result<Step> {
    let settings = Settings::of(machine.image).with_escape(false);
    to_string(machine, object, settings)
}

/// The text that WRITE writes.
///
/// `(write-to-string '(1 2 3 4) :length 2)` => `"(1 2 ...)"`
#[builtin(
    _,
    "object &key escape radix base circle pretty level length case gensym array readably right-margin lines miser-width pprint-dispatch"
)]
fn write_to_string(machine: &mut Machine<'_>, object: Value, options: &[Value]) -> Result<Step> {
    if let Some(step) = with_dispatch(machine.image, &object, options, "WRITE-TO-STRING") {
        return Ok(step);
    }
    let (settings, _) = write_settings(machine.image, options)?;
    to_string(machine, object, settings)
}

/// Writes the string as it is.
///
/// `(with-output-to-string (s) (write-string "abc" s :start 1))` => `"bc"`
#[builtin]
fn write_string(
    image: &mut Image,
    string: &Rc<LispString>,
    #[default(&Value::NIL)] stream: &Value,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
) -> Result<Value> {
    write_part(image, string, stream, [start, end], "")
}

/// Writes the string and a newline.
///
/// ```lisp
/// (with-output-to-string (s) (write-line "abc" s)) => "abc
/// "
/// ```
#[builtin]
fn write_line(
    image: &mut Image,
    string: &Rc<LispString>,
    #[default(&Value::NIL)] stream: &Value,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
) -> Result<Value> {
    write_part(image, string, stream, [start, end], "\n")
}

/// Writes the character.
///
/// `(with-output-to-string (s) (write-char #\a s))` => `"a"`
#[builtin]
fn write_char(
    image: &mut Image,
    character: char,
    #[default(&Value::NIL)] stream: &Value,
) -> Result<char> {
    stream::write(image, stream, character.encode_utf8(&mut [0; 4]))?;
    Ok(character)
}

/// Writes a newline.
///
/// ```lisp
/// (with-output-to-string (s) (terpri s)) => "
/// "
/// ```
#[builtin]
fn terpri(image: &mut Image, #[default(&Value::NIL)] stream: &Value) -> Result<()> {
    stream::write(image, stream, "\n")
}

/// Writes a newline unless at the start of a line; was one written?
///
/// `(with-output-to-string (s) (fresh-line s))` => `""`
#[builtin]
fn fresh_line(image: &mut Image, #[default(&Value::NIL)] stream: &Value) -> Result<bool> {
    stream::fresh_line(image, stream)
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

/// The column of a stream, zero if that is not known.
fn column(image: &Image, stream: &Value) -> Result<usize> {
    Ok(stream::column(image, stream)?.unwrap_or(0))
}

fn write_object(
    machine: &mut Machine<'_>,
    object: Value,
    stream: Option<Value>,
    manner: Manner,
) -> Result<Step> {
    let target = stream.clone().unwrap_or(Value::NIL);
    let mut settings = Settings::of(machine.image).with_escape(manner != Manner::Princ);
    let mut start = match column(machine.image, &target) {
        Ok(start) => start,
        Err(raise) => {
            let args = std::iter::once(object).chain(stream).collect();
            return or_method(raise, manner.function(), args);
        }
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
fn write_settings(image: &Image, args: &[Value]) -> Result<(Settings, Value)> {
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

fn count(place: &mut Option<usize>, value: Option<Value>) -> Result<()> {
    *place = match value {
        None => return Ok(()),
        Some(Value::Symbol(known::NIL, ..)) => None,
        Some(Value::Int(n)) if n >= 0 => usize::try_from(n).ok(),
        Some(other) => return Err(Raise::type_error(&other, known::UNSIGNED_BYTE)),
    };
    Ok(())
}

/// A call with another dispatch table binds the variable; `None` if that is not wanted.
fn with_dispatch(image: &Image, object: &Value, options: &[Value], writer: &str) -> Option<Step> {
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
fn write(machine: &mut Machine<'_>, object: Value, options: &[Value]) -> Result<Step> {
    if let Some(step) = with_dispatch(machine.image, &object, options, "WRITE") {
        return Ok(step);
    }
    let (settings, target) = write_settings(machine.image, options)?;
    let start = match column(machine.image, &target) {
        Ok(start) => start,
        Err(raise) => return or_method(raise, known::WRITE, [&[object], options].concat()),
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

fn to_string(machine: &mut Machine<'_>, object: Value, settings: Settings) -> Result<Step> {
    compose(
        machine,
        "WRITE-TO-STRING",
        move |image, calls| Ok(print::write(image, &object, &settings, 0, calls)),
        |_, text| Ok(Step::Return(Value::string(text))),
    )
}

/// Writes the object; a program may add methods.
///
/// `(with-output-to-string (s) (print-object 'a s))` => `"A"`
// What the default method does: prints the object's default form.
#[builtin]
fn print_object(machine: &mut Machine<'_>, object: Value, stream: Value) -> Result<Step> {
    let settings = Settings::of(machine.image);
    let start = match column(machine.image, &stream) {
        Ok(start) => start,
        Err(raise) => return or_method(raise, known::PRINT_OBJECT, vec![object, stream]),
    };
    let (printed, target) = (object.clone(), stream);
    if let Some(stream) = stream::pretty(machine.image, &target) {
        return compose(
            machine,
            "PRINT-OBJECT",
            move |image, calls| Ok(print::document_default(image, &printed, &settings, calls)),
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
                image, &printed, &settings, start, calls,
            ))
        },
        move |machine, text| {
            stream::write(machine.image, &target, &text)?;
            Ok(Step::Return(object))
        },
    )
}

/// Writes the part of a string between two bounds, and the end of a line; the string.
fn write_part(
    image: &mut Image,
    string: &Rc<LispString>,
    stream: &Value,
    [start, end]: [Option<&Value>; 2],
    end_of_line: &str,
) -> Result<Value> {
    let sequence = Sequence::Str(string.clone());
    let bounds = Bounds::new(&sequence, start, end)?;
    let text = string.text();
    let part: String = match (bounds.start, bounds.end) {
        (0, None) => text,
        (start, end) => {
            let end = end.unwrap_or(usize::MAX);
            text.chars().skip(start).take(end - start).collect()
        }
    };
    stream::write(image, stream, &format!("{part}{end_of_line}"))?;
    Ok(sequence.value())
}

/// Writes #<…> with the object's type, what the body writes, and a made-up address.
#[builtin(_, "object stream type identity body")]
fn write_unreadable(
    machine: &mut Machine<'_>,
    object: &Value,
    target: &Value,
    with_type: &Value,
    with_identity: &Value,
    body: &Value,
) -> Result<Step> {
    let image = &mut *machine.image;
    if image.special(known::V_PRINT_READABLY).is_true() {
        return Err(print::not_readable(object));
    }
    if let Err(raise) = stream::output_stream(image, target) {
        let args = [object, target, with_type, with_identity, body];
        return or_method(
            raise,
            known::WRITE_UNREADABLE,
            args.map(Value::clone).into(),
        );
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
    write_string,
    write_line,
    write_char,
    terpri,
    fresh_line,
];

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![write_unreadable,];
