//! Feature expressions of `#+` and `#-`.

use super::error::ReadErrorKind;
use crate::image::Image;
use crate::value::Value;
use crate::value::known;

/// A feature expression nested more deeply than this is a mistake.
const MAX_DEPTH: usize = 64;

/// Does the feature expression hold with the current `*features*`?
pub(crate) fn holds(image: &Image, expression: &Value) -> Result<bool, ReadErrorKind> {
    holds_at(image, expression, 0)
}

fn holds_at(image: &Image, expression: &Value, depth: usize) -> Result<bool, ReadErrorKind> {
    if depth > MAX_DEPTH {
        return Err(ReadErrorKind::BadFeature);
    }
    if let Value::Symbol(..) = expression {
        let features = image.special(known::V_FEATURES);
        return Ok(features.iter_list().any(|f| f.is_eq(expression)));
    }
    let parts = expression.list_to_vec().ok_or(ReadErrorKind::BadFeature)?;
    let Some((Value::Symbol(operator, ..), arguments)) = parts.split_first() else {
        return Err(ReadErrorKind::BadFeature);
    };
    // What does not matter any more may be an expression of another implementation.
    let first = |wanted: bool| {
        for argument in arguments {
            if holds_at(image, argument, depth + 1)? == wanted {
                return Ok(wanted);
            }
        }
        Ok(!wanted)
    };
    match (image.name(*operator), arguments) {
        ("AND", _) => first(false),
        ("OR", _) => first(true),
        ("NOT", [one]) => Ok(!holds_at(image, one, depth + 1)?),
        _ => Err(ReadErrorKind::BadFeature),
    }
}
