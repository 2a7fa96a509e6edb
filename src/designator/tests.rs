//! Designators at work: each test evaluates text and compares what is printed.

use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::symbol::known;
use crate::lisp::value::Value;
use crate::lisp::vm::fiber::Fiber;
use crate::lisp::vm::machine::{Event, Machine};
use crate::reader;

pub(crate) fn image() -> Image {
    let mut image = Image::new();
    super::install(&mut image);
    crate::transform::install(&mut image);
    image
}

/// The printed values of the last form, or `!!` and the report of a condition.
pub(crate) fn evaluate_in(image: &mut Image, text: &str) -> String {
    let source = image.sources.add("test", text);
    let forms = reader::read_all(image, source).unwrap_or_else(|e| panic!("{e}"));
    let mut result = String::new();
    for (form, _) in forms {
        let mut fiber = Fiber::default();
        let mut machine = Machine::new(image, &mut fiber);
        let value = match machine.start(known::EVAL.into(), vec![form]) {
            Event::Done(value) => value,
            Event::Unhandled(condition) => {
                machine.unwind_all();
                return format!("!! {}", print::to_string(image, &condition, false));
            }
            _ => Value::NIL,
        };
        let shown: Vec<String> = value
            .into_values()
            .iter()
            .map(|v| print::to_string(image, v, true))
            .collect();
        result = shown.join(" ; ");
    }
    result
}

fn evaluate(text: &str) -> String {
    evaluate_in(&mut image(), text)
}

#[test]
fn a_designator_prints_its_properties_line_by_line() {
    assert_eq!(
        evaluate("(desig:an object (type bottle) (name ?)) "),
        "!! The variable ? is unbound."
    );
    assert_eq!(
        evaluate(
            "(let ((?arm :left)) (desig:an action (type picking-up) (arm ?arm) (object (desig:an object (type bottle)))))"
        ),
        "#<A ACTION\n    (TYPE PICKING-UP)\n    (ARM LEFT)\n    (OBJECT #<A OBJECT\n    (TYPE BOTTLE)>)>"
    );
}
