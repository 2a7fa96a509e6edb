//! Does a form fit the lambda list that the tables show for its operator? If not, the error says what
//! the operator takes.

use crate::image::Image;
use crate::print;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// Operators whose own errors say more.
const SAY_MORE: &[&str] = &[
    "DEFCLASS",
    "DEFMETHOD",
    "DEFSTRUCT",
    "DEFUN",
    "DO",
    "DO*",
    "IF",
    "THROW",
];

/// The longest form that an error shows whole, in characters.
const SHOWN: usize = 60;

/// Signals an error unless a form has the parts that a lambda list wants.
pub(crate) fn check(
    image: &Image,
    operator: Sym,
    lambda_list: &str,
    form: &Value,
) -> Result<(), Box<Raise>> {
    // Some lambda lists are only for people.
    if lambda_list.contains(['…', '[']) || SAY_MORE.contains(&image.name(operator)) {
        return Ok(());
    }
    let mut tokens = Tokens(lambda_list);
    match misfit(image, &mut tokens, &form.cdr_or_nil()) {
        Some(reason) => Err(malformed(image, operator, lambda_list, form, &reason)),
        None => Ok(()),
    }
}

/// The error of a macro of the library that could not take a form apart: it says what the macro takes
/// instead of what is no list.
pub(super) fn explained(
    image: &Image,
    operator: Sym,
    form: &Value,
    raise: Box<Raise>,
) -> Box<Raise> {
    let class = match &*raise {
        Raise::Make { class, .. } => Some(*class),
        Raise::Condition { condition, .. } => match condition {
            Value::Instance(instance) => Some(instance.class().name),
            _ => None,
        },
    };
    match image.entry(operator) {
        Some(entry) if class == Some(known::TYPE_ERROR) => {
            let lambda_list = entry.lambda_list();
            let reason = reason(image, lambda_list, form);
            malformed(image, operator, lambda_list, form, &reason)
        }
        _ => raise,
    }
}

/// Why a form that its macro could not take apart does not fit; a guess if the lambda list does not
/// tell.
fn reason(image: &Image, lambda_list: &str, form: &Value) -> String {
    let mut tokens = Tokens(lambda_list);
    misfit(image, &mut tokens, &form.cdr_or_nil())
        .unwrap_or_else(|| "a part of it is no list, or one too few".to_owned())
}

/// The error for a form that is not written as its operator wants.
fn malformed(
    image: &Image,
    operator: Sym,
    lambda_list: &str,
    form: &Value,
    reason: &str,
) -> Box<Raise> {
    Raise::program(format!(
        "{} is malformed: {reason}. What was expected is {}.",
        shortened(image, form),
        usage(image, operator, lambda_list)
    ))
}

/// How an operator is used, for people: `(dolist (variable list [result]) body…)`.
fn usage(image: &Image, operator: Sym, lambda_list: &str) -> String {
    let mut text = format!("({}", image.name(operator).to_lowercase());
    let mut ending = "";
    let tokens = Tokens(lambda_list);
    let mut marker = "";
    for token in tokens {
        match token {
            ")" => {
                text.push_str(ending);
                text.push(')');
                (ending, marker) = ("", "");
                continue;
            }
            "&optional" | "&key" | "&rest" | "&body" => {
                marker = token;
                continue;
            }
            _ => {}
        }
        if !text.ends_with('(') {
            text.push(' ');
        }
        match (token, marker) {
            ("(", _) => text.push('('),
            (name, "&optional") => text.push_str(&format!("[{name}]")),
            (name, "&key") => text.push_str(&format!("[:{name} …]")),
            (name, "&rest" | "&body") => text.push_str(&format!("{name}…")),
            (name, _) => text.push_str(name),
        }
        if token == "(" {
            marker = "";
        }
    }
    text.push(')');
    text
}

/// Why a list of arguments does not fit the rest of a lambda list, which is passed over to its end.
fn misfit(image: &Image, tokens: &mut Tokens<'_>, arguments: &Value) -> Option<String> {
    let mut rest = arguments.clone();
    let mut is_optional = false;
    let mut takes_all = false;
    while let Some(token) = tokens.next() {
        match token {
            ")" => break,
            "&optional" => is_optional = true,
            "&rest" | "&body" | "&key" => takes_all = true,
            _ if takes_all => {
                if token == "(" {
                    tokens.skip_list();
                }
            }
            _ => {
                let pattern = *tokens;
                let name = if token == "(" {
                    tokens.skip_list();
                    usage_of_list(pattern)
                } else {
                    token.to_owned()
                };
                let Value::Cons(cons) = rest else {
                    if is_optional && rest.is_nil() {
                        continue;
                    }
                    return Some(format!("{name} is missing"));
                };
                if token == "(" {
                    let argument = cons.car();
                    if !argument.is_list() {
                        let shown = shortened(image, &argument);
                        return Some(format!("{shown} stands where {name} belongs"));
                    }
                    let mut inner = pattern;
                    if let Some(reason) = misfit(image, &mut inner, &argument) {
                        return Some(format!("in {}, {reason}", shortened(image, &argument)));
                    }
                }
                rest = cons.cdr();
            }
        }
    }
    if takes_all {
        return None;
    }
    match &rest {
        Value::Cons(cons) => Some(format!(
            "{} is more than it takes",
            shortened(image, &cons.car())
        )),
        _ => None,
    }
}

/// What stands in the parentheses that a lambda list has opened, for people.
fn usage_of_list(mut tokens: Tokens<'_>) -> String {
    let from = tokens.0;
    tokens.skip_list();
    let inner = from.len() - tokens.0.len();
    let text = from.get(..inner).unwrap_or_default();
    let names: Vec<String> = {
        let mut marker = "";
        let mut names = Vec::new();
        for word in text.trim_end_matches(')').split_whitespace() {
            match (word, marker) {
                ("&optional" | "&rest" | "&body" | "&key", _) => marker = word,
                (name, "&optional") => names.push(format!("[{name}]")),
                (name, "&rest" | "&body") => names.push(format!("{name}…")),
                (name, "&key") => names.push(format!("[:{name} …]")),
                (name, _) => names.push(name.to_owned()),
            }
        }
        names
    };
    format!("({})", names.join(" "))
}

/// A form as an error shows it.
fn shortened(image: &Image, form: &Value) -> String {
    let text = print::to_string(image, form, true);
    let words: Vec<&str> = text.split_whitespace().collect();
    let line = words.join(" ");
    if line.chars().count() <= SHOWN {
        return line;
    }
    let mut cut: String = line.chars().take(SHOWN - 1).collect();
    cut.push('…');
    cut
}

/// The words and parentheses of a lambda list.
#[derive(Clone, Copy)]
struct Tokens<'a>(&'a str);

impl<'a> Tokens<'a> {
    /// Passes over the rest of a list that has been opened.
    fn skip_list(&mut self) {
        let mut depth = 1;
        while depth > 0 {
            match self.next() {
                Some("(") => depth += 1,
                Some(")") => depth -= 1,
                Some(_) => {}
                None => return,
            }
        }
    }
}

impl<'a> Iterator for Tokens<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        self.0 = self.0.trim_start();
        let first = self.0.chars().next()?;
        let length = if matches!(first, '(' | ')') {
            1
        } else {
            self.0
                .find(|c: char| c.is_whitespace() || matches!(c, '(' | ')'))
                .unwrap_or(self.0.len())
        };
        let (token, rest) = self.0.split_at(length);
        self.0 = rest;
        Some(token)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usages_are_written_for_people() {
        let image = Image::new();
        let of = |name, list| usage(&image, name, list);
        assert_eq!(
            of(known::DOLIST, "(variable list &optional result) &body body"),
            "(dolist (variable list [result]) body…)"
        );
        assert_eq!(of(known::PUSH, "item place"), "(push item place)");
    }
}
