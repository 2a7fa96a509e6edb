//! Macros around plans: `with-simulated-robot`.

use lisp::builtin::Operator;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

/// Macros of package `CRAM-PR2-PROJECTION`.
pub(crate) static OPERATORS: &[Operator] = &[
    Operator {
        name: "WITH-SIMULATED-ROBOT",
        lambda_list: "&body body",
        doc: "Runs the body as a plan on the simulated robot; the first value of the last form.",
        examples: &["(pr2-proj:with-simulated-robot 1 2) => 2"],
        expand: Some(with_simulated_robot),
    },
    Operator {
        name: "WITH-PROJECTED-ROBOT",
        lambda_list: "&body body",
        doc: "The same as WITH-SIMULATED-ROBOT.",
        examples: &["(pr2-proj:with-projected-robot (values 1 2)) => 1"],
        expand: Some(with_simulated_robot),
    },
];

fn with_simulated_robot(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let Some(package) = image.packages.find("CRAM-LANGUAGE-IMPLEMENTATION") else {
        return Err(Raise::program("The plan language is not installed."));
    };
    let top_level = image.intern(package, "NAMED-TOP-LEVEL");
    let name = image.keyword("TOP-LEVEL");
    let options = Value::list([known::K_NAME.into(), name.into()]);
    let plan = Value::list_with_tail([top_level.into(), options], form.cdr_or_nil());
    if let (Value::Cons(from), Value::Cons(to)) = (form, &plan) {
        to.set_place(from.place());
    }
    Ok(Value::list([known::VALUES.into(), plan]))
}
