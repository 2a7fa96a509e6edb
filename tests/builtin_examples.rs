//! The examples in the tables of builtins and macros: each is evaluated in an image of its
//! own.

use planwright::lisp::vm::fiber::Fiber;
use planwright::lisp::vm::machine::{Event, Machine};
use planwright::lisp::{Image, Value, known, print};
use planwright::reader;

/// What the prompt prints for a form, several values separated by ` ; `.
fn evaluate(text: &str) -> String {
    let mut image = Image::new();
    let source = image.sources.add("example", text);
    let forms = match reader::read_all(&mut image, source) {
        Ok(forms) => forms,
        Err(error) => return format!("cannot be read: {error}"),
    };
    let mut result = String::new();
    for (form, _) in forms {
        let mut fiber = Fiber::default();
        let event = Machine::new(&mut image, &mut fiber).start(known::EVAL.into(), vec![form]);
        let value = match event {
            Event::Done(value) => value,
            Event::Unhandled(condition) => {
                return format!("fails: {}", print::to_string(&image, &condition, false));
            }
            _ => Value::NIL,
        };
        let shown: Vec<String> = value
            .into_values()
            .iter()
            .map(|v| print::to_string(&image, v, true))
            .collect();
        result = match shown.as_slice() {
            [] => "; No value".to_owned(),
            values => one_line(&values.join(" ; ")),
        };
    }
    result
}

/// The text with every stretch of blanks as one: examples are written on one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn examples_come_out_as_documented() {
    let image = Image::new();
    let builtins = image.builtins.values().map(|b| (b.name, b.examples));
    let operators = image.operators.values().map(|o| (o.name, o.examples));
    let mut complaints = Vec::new();
    for (name, examples) in builtins.chain(operators) {
        for example in examples {
            let Some((form, expected)) = example.rsplit_once(" => ") else {
                complaints.push(format!("{name}: {example}: no result is given"));
                continue;
            };
            let result = evaluate(form);
            if result != one_line(expected) {
                complaints.push(format!("{name}: {form} => {expected}, but it is {result}"));
            }
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}
