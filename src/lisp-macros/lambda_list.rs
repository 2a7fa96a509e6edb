//! Lambda lists as the manual shows them, without their parentheses.

use crate::parameters::{Argument, Arguments, Shape};

/// The lambda list of a function's arguments.
pub(crate) fn of(arguments: &Arguments) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut shape = Shape::Required;
    for argument in &arguments.list {
        if argument.shape != shape {
            shape = argument.shape;
            words.extend(marker(shape).map(str::to_owned));
        }
        words.push(argument.name());
    }
    words.join(" ")
}

/// The word that comes before parameters of a shape.
fn marker(shape: Shape) -> Option<&'static str> {
    match shape {
        Shape::Required => None,
        Shape::Optional => Some("&optional"),
        Shape::Rest => Some("&rest"),
        Shape::Key => Some("&key"),
    }
}

/// Numbers of parameters in a lambda list.
#[derive(Default, Debug, PartialEq, Eq)]
struct Counts {
    required: usize,
    optional: usize,
    /// Are there parameters for any number of further arguments?
    rest: bool,
    keys: Vec<String>,
}

impl Counts {
    fn of(lambda_list: &str) -> Counts {
        let mut counts = Counts::default();
        let mut shape = Shape::Required;
        let mut depth = 0_usize;
        for word in lambda_list.split_whitespace() {
            let is_parameter = depth == 0;
            depth += word.matches('(').count();
            depth = depth.saturating_sub(word.matches(')').count());
            match word {
                _ if !is_parameter => {}
                "&optional" => shape = Shape::Optional,
                "&rest" | "&body" => {
                    shape = Shape::Rest;
                    counts.rest = true;
                }
                "&key" => {
                    shape = Shape::Key;
                    counts.rest = true;
                }
                _ => match shape {
                    Shape::Required => counts.required += 1,
                    Shape::Optional => counts.optional += 1,
                    Shape::Rest => {}
                    Shape::Key => counts
                        .keys
                        .push(word.trim_start_matches('(').to_uppercase()),
                },
            }
        }
        counts
    }
}

/// Why a lambda list is not one of calls with these arguments, if it is not.
pub(crate) fn mismatch(lambda_list: &str, arguments: &Arguments) -> Option<String> {
    let counts = Counts::of(lambda_list);
    let of_shape = |shape| arguments.list.iter().filter(move |a| a.shape == shape);
    let required = of_shape(Shape::Required).count();
    let optional = of_shape(Shape::Optional).count();
    let most = counts.required + counts.optional;
    if arguments.takes_rest() {
        // The rest may be required or optional by the lambda list.
        let fits = required <= counts.required && required + optional <= most;
        return (!fits).then(|| "the function has more parameters than the lambda list".to_owned());
    }
    let is_named = |key: &Argument| counts.keys.contains(&key.name().to_uppercase());
    if let Some(key) = of_shape(Shape::Key).find(|key| !key.is_ignored() && !is_named(key)) {
        return Some(format!("the lambda list lacks &key {}", key.name()));
    }
    let keys = of_shape(Shape::Key).count();
    if (required, optional) != (counts.required, counts.optional) {
        return Some(format!(
            "the function has {required} required and {optional} optional parameters, the lambda list {} and {}",
            counts.required, counts.optional,
        ));
    }
    (counts.rest && keys == 0).then(|| "the function has no parameter for the rest".to_owned())
}

#[cfg(test)]
mod tests {
    use super::Counts;

    #[test]
    fn counts_parameters() {
        let counts = Counts::of("a (b c) &optional (n 1) &key (start 0) end");
        assert_eq!((counts.required, counts.optional), (2, 1));
        assert_eq!(counts.keys, ["START", "END"]);
        assert!(counts.rest);
        assert_eq!(Counts::of(""), Counts::default());
    }
}
