//! A small image for the tests of this layer.

use crate::evaluator::nested;
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// An image like the one that sessions start with.
pub fn image() -> Image {
    Image::new()
}

/// Evaluates all forms of a text; the values of the last, or the class of the condition.
pub(crate) fn eval_values(image: &mut Image, text: &str) -> Result<Vec<Value>, String> {
    let mut reader = crate::reader::Reader::of_text(text.to_owned());
    let mut last = Vec::new();
    while let Some((form, _)) = reader.next_form(image).map_err(|e| e.to_string())? {
        let eval = Value::symbol(known::EVAL);
        last = nested::call_nested_values(image, eval, vec![form])
            .map_err(|raise| name_of(image, &raise))?;
    }
    Ok(last)
}

fn name_of(image: &Image, raise: &Raise) -> String {
    match raise {
        Raise::Condition {
            condition: Value::Instance(condition),
            ..
        } => image.name(condition.class().name).to_owned(),
        Raise::Condition { .. } => "?".to_owned(),
        Raise::Make { class, .. } => image.name(*class).to_owned(),
    }
}

/// Asserts that the last form of a text has a value that is `equalp` to what `expected`
/// reads as.
pub(crate) fn assert_value(image: &mut Image, text: &str, expected: &str) {
    let values = eval_values(image, text).unwrap_or_else(|e| panic!("{text}: {e}"));
    let wanted = eval_values(image, &format!("'{expected}")).unwrap_or_default();
    let is_same = values.len() == wanted.len()
        && values
            .iter()
            .zip(&wanted)
            .all(|(a, b)| crate::value::equality::equalp(a, b));
    let shown: Vec<String> = values
        .iter()
        .map(|v| crate::print::to_string(image, v, true))
        .collect();
    assert!(is_same, "{text} => {}, not {expected}", shown.join(" ; "));
}

/// The class of the condition in which evaluating a text ends.
pub(crate) fn error_class(image: &mut Image, text: &str) -> String {
    match eval_values(image, text) {
        Ok(_) => "no error".to_owned(),
        Err(class) => class,
    }
}
