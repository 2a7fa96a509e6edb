//! Every example in the tables of builtins and macros evaluates to what it says.

use planwright::dialogue::{Evaluate, Event};
use planwright::lisp::Image;
use planwright::session::Session;

/// What the prompt prints for a form: values separated by `" ; "`, or the report of an error.
fn printed(form: &str) -> String {
    let mut result = String::new();
    Session::new().evaluate("example", form, &mut |event| match event {
        Event::Values(values) => result = values.join(" ; "),
        Event::Aborted(abort) => result = format!("error: {}", abort.report),
        _ => {}
    });
    result
}

#[test]
fn examples_print_what_they_say() {
    let image = Image::new();
    let builtins = image.builtins.values().map(|b| (b.name, b.examples));
    let operators = image.operators.values().map(|o| (o.name, o.examples));
    let mut wrong = Vec::new();
    let mut count = 0;
    for (name, examples) in builtins.chain(operators) {
        for example in examples {
            let Some((form, expected)) = example.rsplit_once("=>") else {
                wrong.push(format!("{name}: {example} has no =>"));
                continue;
            };
            count += 1;
            let found = printed(form);
            if found != expected.trim() {
                wrong.push(format!("{name}: {form}=> {found}, not {}", expected.trim()));
            }
        }
    }
    assert!(count > 500, "only {count} examples were found");
    assert!(
        wrong.is_empty(),
        "{} wrong:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
