//! Inputs in the syntax of other languages: what they would be in Lisp.

use crate::dialogue::Event;
use crate::dialogue::screen::is_input_name;

/// The longest input that is looked at, in bytes.
const MAX_LENGTH: usize = 200;

/// Says what an input at a prompt would be in Lisp, if it is an assignment, a calculation or a call in
/// the syntax of other languages. It is evaluated as it stands.
pub(super) fn tell(source_name: &str, text: &str, sink: &mut dyn FnMut(Event)) {
    if is_input_name(source_name)
        && let Some(meant) = in_lisp(text)
    {
        sink(Event::Output(format!("; In Lisp, that is {meant}\n")));
    }
}

/// A line of another language in Lisp.
fn in_lisp(text: &str) -> Option<String> {
    let text = text.trim().trim_end_matches(';');
    let is_plain = text.len() <= MAX_LENGTH && !text.contains(['\n', '\'', '`', '#', ';', ':']);
    if !is_plain {
        return None;
    }
    called(text)
        .or_else(|| assigned(text))
        .or_else(|| calculated(text))
}

/// `x = 5`.
fn assigned(text: &str) -> Option<String> {
    let (name, value) = text.split_once(" = ")?;
    let name = name
        .strip_prefix("var ")
        .or(name.strip_prefix("let "))
        .unwrap_or(name);
    (is_name(name) && balances(value)).then(|| {
        let value = value.trim();
        let value = in_lisp(value).unwrap_or_else(|| value.to_owned());
        format!("(setf {name} {value})")
    })
}

/// `5 + 3`, or several with the same operator.
fn calculated(text: &str) -> Option<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let operator = *words.get(1)?;
    let is_operand = |word: &&str| is_name(word) || word.parse::<f64>().is_ok();
    let (operands, operators): (Vec<_>, Vec<_>) =
        words.iter().enumerate().partition(|(at, _)| at % 2 == 0);
    let fits = matches!(
        operator,
        "+" | "-" | "*" | "/" | "<" | ">" | "<=" | ">=" | "=="
    ) && words.len() % 2 == 1
        && operands.iter().all(|(_, word)| is_operand(word))
        && operators.iter().all(|(_, word)| **word == operator);
    fits.then(|| {
        let operands: Vec<&str> = operands.iter().map(|(_, word)| **word).collect();
        let operator = if operator == "==" { "=" } else { operator };
        format!("({operator} {})", operands.join(" "))
    })
}

/// `park(1, 2)`.
fn called(text: &str) -> Option<String> {
    let (name, arguments) = text.strip_suffix(')')?.split_once('(')?;
    let is_flat = is_name(name) && !arguments.contains(['(', ')', '"']);
    is_flat.then(|| {
        let arguments: Vec<&str> = arguments
            .split([',', ' '])
            .filter(|a| !a.is_empty())
            .collect();
        let call = std::iter::once(name).chain(arguments);
        format!("({})", call.collect::<Vec<_>>().join(" "))
    })
}

/// Is it a word that other languages take for a name?
fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && word
            .chars()
            .all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '?'))
}

/// Has it as many parentheses of one kind as of the other, and something else?
fn balances(text: &str) -> bool {
    let count = |wanted| text.chars().filter(|c| *c == wanted).count();
    count('(') == count(')') && !text.trim().is_empty()
}

#[cfg(test)]
mod tests {
    use super::in_lisp;

    #[test]
    fn lines_of_other_languages_are_told_apart_from_forms() {
        for (text, meant) in [
            ("x = 5", "(setf x 5)"),
            ("var speed = 0.5;", "(setf speed 0.5)"),
            ("x = (+ 1 2)", "(setf x (+ 1 2))"),
            ("x = y + 1", "(setf x (+ y 1))"),
            ("5 + 3", "(+ 5 3)"),
            ("1 * x * 2", "(* 1 x 2)"),
            ("a == b", "(= a b)"),
            ("park_arms()", "(park_arms)"),
            ("move(1, -2.5)", "(move 1 -2.5)"),
        ] {
            assert_eq!(in_lisp(text).as_deref(), Some(meant), "{text}");
        }
        for text in [
            "x",
            "5",
            "",
            "(+ 1 2)",
            "(setf x = 5)",
            "*",
            "* 5",
            "5 +",
            "+ 5 3",
            "x y z",
            "1 - x + 2",
            "'a = b",
            "foo (3)",
            "\"a\" = 3",
            "(x) = 5",
            "x = ",
            "x = (1",
            "q",
            "0",
            "$x(1)",
        ] {
            assert_eq!(in_lisp(text), None, "{text}");
        }
    }
}
