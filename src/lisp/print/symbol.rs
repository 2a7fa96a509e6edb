//! Symbols as they are printed: with prefixes, escapes and the chosen case.

use super::settings::{Case, Settings};
use crate::lisp::image::Image;
use crate::lisp::reader;
use crate::lisp::value::package::Access;
use crate::lisp::value::symbol::Sym;

/// A symbol under the settings.
pub(super) fn symbol(image: &Image, sym: Sym, settings: &Settings) -> String {
    let data = image.symbol(sym);
    if !settings.escape {
        return cased(&data.name, settings.case);
    }
    let mut text = String::new();
    match data.package {
        None if settings.gensym => text.push_str("#:"),
        None => {}
        Some(_) if image.is_keyword(sym) => text.push(':'),
        Some(_) if image.is_accessible(sym) => {}
        Some(package) => {
            text.push_str(&name(&image.packages.get(package).name, settings));
            text.push_str(match image.home_access(sym) {
                Some(Access::External) => ":",
                _ => "::",
            });
        }
    }
    text.push_str(&name(&data.name, settings));
    text
}

/// A name, between bars if the reader would change it.
pub(super) fn name(name: &str, settings: &Settings) -> String {
    if needs_bars(name, settings.base) {
        let mut text = String::with_capacity(name.len() + 2);
        text.push('|');
        for c in name.chars() {
            if matches!(c, '|' | '\\') {
                text.push('\\');
            }
            text.push(c);
        }
        text.push('|');
        return text;
    }
    cased(name, settings.case)
}

fn cased(name: &str, case: Case) -> String {
    match case {
        Case::Up => name.to_owned(),
        Case::Down => name.to_lowercase(),
        Case::Capitalize => {
            let mut in_word = false;
            name.chars()
                .map(|c| {
                    let lower = in_word;
                    in_word = c.is_alphanumeric();
                    if lower && c.is_uppercase() {
                        c.to_lowercase().next().unwrap_or(c)
                    } else {
                        c
                    }
                })
                .collect()
        }
    }
}

fn needs_bars(name: &str, base: u32) -> bool {
    name.is_empty()
        || name.starts_with('#')
        || name.chars().all(|c| c == '.')
        || name.chars().any(is_special)
        || looks_like_number(name, base)
}

/// Would the reader take the character for something else?
fn is_special(c: char) -> bool {
    matches!(
        c,
        '(' | ')' | '"' | '\'' | '`' | ',' | ';' | ':' | '|' | '\\'
    ) || reader::lexer::is_blank(c)
        || c.is_control()
        || reader::upcase(c) != c
        || reader::meant_by_quotation_mark(c).is_some()
}

/// Is the name a "potential number" (digits, signs, points, slashes, `^`, `_` and single
/// letters), which may not be printed bare?
fn looks_like_number(name: &str, base: u32) -> bool {
    let chars: Vec<char> = name.chars().collect();
    let (Some(first), Some(last)) = (chars.first(), chars.last()) else {
        return false;
    };
    let is_digit = |c: &char| c.is_digit(base);
    let starts = is_digit(first) || matches!(first, '+' | '-' | '.' | '^' | '_');
    if !starts || matches!(last, '+' | '-') || !chars.iter().any(is_digit) {
        return false;
    }
    chars.iter().enumerate().all(|(i, c)| {
        let is_letter =
            |c: Option<&char>| c.is_some_and(|c| c.is_ascii_alphabetic() && !is_digit(c));
        is_digit(c)
            || matches!(c, '+' | '-' | '/' | '.' | '^' | '_')
            || is_letter(Some(c))
                && !is_letter(chars.get(i + 1))
                && !is_letter(i.checked_sub(1).and_then(|before| chars.get(before)))
    })
}
