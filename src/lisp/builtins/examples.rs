//! The examples in the tables of builtins and macros, run one by one in fresh images.

use super::registry;
use crate::lisp::image::Image;
use crate::lisp::known;
use crate::lisp::raise::Raise;
use crate::lisp::value::Value;
use crate::lisp::vm::machine;
use crate::reader::Reader;

/// What the prompt prints for a text: the values of its last form, separated by `" ; "`.
fn printed(text: &str) -> Result<String, String> {
    let mut image = Image::new();
    let mut reader = Reader::of_text(text.to_owned());
    let mut values = Vec::new();
    while let Some((form, _)) = reader.next_form(&mut image).map_err(|e| e.to_string())? {
        values = call(&mut image, known::EVAL.into(), form)?;
    }
    let mut texts = Vec::new();
    for value in values {
        let text = call(&mut image, known::PRIN1_TO_STRING.into(), value)?;
        texts.push(text.first().and_then(Value::as_text).unwrap_or_default());
    }
    Ok(texts.join(" ; "))
}

fn call(image: &mut Image, function: Value, argument: Value) -> Result<Vec<Value>, String> {
    machine::call_nested_values(image, function, vec![argument]).map_err(|raise| match *raise {
        Raise::Condition(condition) => crate::lisp::print::to_string(image, &condition, false),
        Raise::Make { report, .. } => report.unwrap_or_default(),
    })
}

#[test]
#[ignore = "the examples of a few tables differ"]
fn every_example_prints_what_it_says() {
    let functions = registry::FUNCTIONS.iter().chain(registry::SYSTEM_FUNCTIONS);
    let operators = registry::OPERATORS.iter().chain(registry::SYSTEM_OPERATORS);
    let of_functions = functions.flat_map(|table| table.iter().map(|b| (b.name, b.examples)));
    let of_operators = operators.flat_map(|table| table.iter().map(|o| (o.name, o.examples)));
    let mut complaints = Vec::new();
    for (name, examples) in of_functions.chain(of_operators) {
        for example in examples {
            let Some((form, expected)) = example.rsplit_once(" => ") else {
                complaints.push(format!("{name}: no => in {example}"));
                continue;
            };
            let result = printed(form);
            if result.as_deref() != Ok(expected) {
                complaints.push(format!("{name}: {form}\n  is {result:?}, not {expected}"));
            }
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}
