//! Reading and compiling a definition of the library when it is first needed.
//!
//! Nothing that users see depends on whether that has happened: reading uses the standard settings
//! of the reader, leaves no symbol in a package that users look into, and takes no number from the
//! counter of `gensym`.

use std::rc::Rc;

use super::definition::{Definition, Kind};
use super::standard_value;
use crate::compile::Parts;
use crate::evaluator::nested;
use crate::image::Image;
use crate::image::precompiled::{Recording, Unit};
use crate::reader::Reader;
use crate::source::SourceId;
use crate::value::Value;
use crate::value::code::Code;
use crate::value::function::Function;
use crate::value::known;
use crate::value::package::PackageTable;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym};

/// Evaluates a definition, takes the function that it defines, and restores the meaning of its
/// name, which a program may have redefined in the meantime.
pub(super) fn compile(
    image: &mut Image,
    definition: &'static Definition,
    name: Sym,
) -> Result<Rc<Function>, Box<Raise>> {
    let data = image.symbols.get_mut(name);
    let outside = (
        std::mem::take(&mut data.function),
        data.setf_function.take(),
    );
    let evaluated = evaluate(image, definition);
    let data = image.symbols.get_mut(name);
    let (cell, setter) = (
        std::mem::replace(&mut data.function, outside.0),
        std::mem::replace(&mut data.setf_function, outside.1),
    );
    evaluated?;
    let function = match (definition.kind, cell) {
        (Kind::Setter, _) => setter,
        (_, FunctionCell::Function(function) | FunctionCell::Macro(function)) => Some(function),
        _ => None,
    };
    function.ok_or_else(|| Raise::undefined_function(name.into()))
}

/// Settings that the reader, the compiler and macros depend on, with the values for reading a
/// definition; a setting without a value keeps its own, which is restored afterwards.
fn settings(package: Value) -> [(Sym, Option<Value>); 8] {
    [
        (known::V_PACKAGE, Some(package)),
        (known::V_READTABLE, Some(Value::NIL)),
        (known::V_READ_BASE, Some(Value::Int(10))),
        (
            known::V_READ_DEFAULT_FLOAT_FORMAT,
            Some(known::SINGLE_FLOAT.into()),
        ),
        (known::V_READ_EVAL, Some(Value::NIL)),
        (known::V_READ_SUPPRESS, Some(Value::NIL)),
        (known::V_LOCKS_IGNORED, Some(Value::T)),
        (known::V_GENSYM_COUNTER, None),
    ]
}

/// Evaluates a form of the library.
pub(super) fn evaluate(
    image: &mut Image,
    definition: &'static Definition,
) -> Result<(), Box<Raise>> {
    let settings = settings(standard_value(image, &definition.reading_package));
    let outside: Vec<(Sym, Value)> = settings
        .into_iter()
        .map(|(variable, value)| {
            let old = image.special(variable).clone();
            if let Some(value) = value {
                image.set_special(variable, value);
            }
            (variable, old)
        })
        .collect();
    let notes = image.notes.take();
    let evaluated = evaluate_parts(image, definition);
    image.notes = notes;
    for (variable, value) in outside {
        image.set_special(variable, value);
    }
    evaluated
}

/// Runs the parts of a form: those that have been compiled ahead, or what it is compiled to.
fn evaluate_parts(image: &mut Image, definition: &'static Definition) -> Result<(), Box<Raise>> {
    let source = source(image, definition);
    let (file, start) = (definition.file.name, definition.start);
    let unit = image.library.precompiled.and_then(|precompiled| {
        let form = precompiled.form(file, start)?;
        Unit::of(precompiled, form, source)
    });
    if let Some(mut unit) = unit {
        while let Some(code) = unit.next(image) {
            run(image, code?)?;
        }
        return Ok(());
    }
    let form = read(image, definition, source)?;
    let mut recording = Recording::of_deferred(source);
    let mut parts = Parts::of(&form);
    while let Some(code) = parts.next(image)? {
        recording.add(image, &code);
        run(image, code)?;
    }
    recording.finish(image, file, start);
    Ok(())
}

/// Runs a part of a form.
fn run(image: &mut Image, code: Rc<Code>) -> Result<(), Box<Raise>> {
    let function = Value::Function(Rc::new(Function::closure(code, Vec::new())));
    nested::call_nested(image, function, Vec::new()).map(drop)
}

/// The source of a definition that is read with places: macros are read without, so that what they
/// expand into has the places of the calls.
fn source(image: &mut Image, definition: &'static Definition) -> Option<SourceId> {
    if let Kind::Macro | Kind::Form = definition.kind {
        return None;
    }
    let file = definition.file;
    let mut known = image.library.sources.iter();
    if let Some((_, source)) = known.find(|(name, _)| *name == file.name) {
        return Some(*source);
    }
    let source = image.sources.add_library(file.name, file.text);
    image.library.sources.push((file.name, source));
    Some(source)
}

/// Reads a definition. Symbols that its package does not have belong to `SYSTEM`.
fn read(
    image: &mut Image,
    definition: &'static Definition,
    source: Option<SourceId>,
) -> Result<Value, Box<Raise>> {
    let mut reader = match source {
        Some(source) => Reader::new(image, source).at(definition.start),
        None => Reader::of_text(definition.text()),
    };
    image.new_symbols = Some(PackageTable::SYSTEM);
    let form = reader.next_form(image);
    image.new_symbols = None;
    match form {
        Ok(Some((form, _))) => Ok(form),
        Ok(None) => Ok(Value::NIL),
        Err(error) => Err(error.raise()),
    }
}
