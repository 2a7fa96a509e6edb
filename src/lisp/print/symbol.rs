//! Symbols as they are printed: with prefixes, escapes and the chosen case.

use super::settings::{Case, Settings};
use crate::image::Image;
use crate::reader::{self, LetterCase};
use crate::value::package::Access;
use crate::value::symbol::Sym;

/// A symbol under the settings.
pub(super) fn symbol(image: &Image, sym: Sym, settings: &Settings) -> String {
    let data = image.symbol(sym);
    if !settings.escape {
        return cased(&data.name, settings);
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
    if needs_bars(name, settings) {
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
    cased(name, settings)
}

fn cased(name: &str, settings: &Settings) -> String {
    match settings.letters {
        LetterCase::Upcase => {}
        LetterCase::Preserve => return name.to_owned(),
        LetterCase::Invert => return name.chars().map(reader::inverting(name.chars())).collect(),
        LetterCase::Downcase => {
            return match settings.case {
                Case::Down => name.to_owned(),
                Case::Up => name.chars().map(reader::upcase).collect(),
                Case::Capitalize => capitalized(name),
            };
        }
    }
    match settings.case {
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

/// A name of small letters with capitals at the beginnings of its words.
fn capitalized(name: &str) -> String {
    let mut in_word = false;
    name.chars()
        .map(|c| {
            let is_first = !in_word;
            in_word = c.is_alphanumeric();
            if is_first { reader::upcase(c) } else { c }
        })
        .collect()
}

fn needs_bars(name: &str, settings: &Settings) -> bool {
    name.is_empty()
        || name.starts_with('#')
        || name.chars().all(|c| c == '.')
        || name.chars().any(|c| is_special(c, settings.letters))
        || looks_like_number(name, settings.base)
}

/// Would the reader take the character for something else?
fn is_special(c: char, letters: LetterCase) -> bool {
    matches!(
        c,
        '(' | ')' | '"' | '\'' | '`' | ',' | ';' | ':' | '|' | '\\'
    ) || reader::lexer::is_blank(c)
        || c.is_control()
        || match letters {
            LetterCase::Upcase => reader::upcase(c) != c,
            LetterCase::Downcase => reader::downcase(c) != c,
            LetterCase::Preserve | LetterCase::Invert => false,
        }
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
