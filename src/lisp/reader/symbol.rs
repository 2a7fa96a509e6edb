//! From the text of a token to a symbol of a package.

use super::error::ReadErrorKind;
use super::lexer::is_blank;
use super::readtable::LetterCase;
use super::suggest::nearest;
use crate::image::Image;
use crate::value::Value;
use crate::value::package::{Access, PackageId, PackageTable};

/// A token split at its package marker, escapes resolved and letters in the case of the readtable.
pub(crate) struct Name {
    /// The text before the marker; `None` without a marker.
    pub package: Option<String>,
    /// The text after the marker.
    pub name: String,
    /// Is the marker `::`?
    pub is_internal: bool,
    /// Was any character escaped? Then the token is not a number.
    pub is_escaped: bool,
}

/// Upcases as the reader does: only letters that have exactly one upper-case form.
pub(crate) fn upcase(c: char) -> char {
    if c.is_ascii() {
        return c.to_ascii_uppercase();
    }
    let mut upper = c.to_uppercase();
    match (upper.next(), upper.next()) {
        (Some(one), None) => one,
        _ => c,
    }
}

/// Downcases as the reader does: only letters that have exactly one lower-case form.
pub fn downcase(c: char) -> char {
    let mut lower = c.to_lowercase();
    match (lower.next(), lower.next()) {
        (Some(one), None) => one,
        _ => c,
    }
}

/// What a readtable does with a token's letters that are not escaped.
fn fold(token: &str, case: LetterCase) -> fn(char) -> char {
    match case {
        LetterCase::Upcase => upcase,
        LetterCase::Downcase => downcase,
        LetterCase::Preserve => std::convert::identity,
        LetterCase::Invert => inverting(unescaped(token)),
    }
}

/// How letters that are all in one case are put into the other one.
pub(crate) fn inverting(letters: impl Iterator<Item = char> + Clone) -> fn(char) -> char {
    let has_upper = letters.clone().any(|c| downcase(c) != c);
    let has_lower = letters.clone().any(|c| upcase(c) != c);
    match (has_upper, has_lower) {
        (true, false) => downcase,
        (false, true) => upcase,
        _ => std::convert::identity,
    }
}

/// The characters of a token that are not escaped.
fn unescaped(token: &str) -> impl Iterator<Item = char> + Clone {
    let mut in_bars = false;
    let mut is_next_escaped = false;
    token.chars().filter(move |c| {
        if std::mem::take(&mut is_next_escaped) {
            return false;
        }
        match c {
            '\\' => is_next_escaped = true,
            '|' => in_bars = !in_bars,
            _ => return !in_bars,
        }
        false
    })
}

/// Splits a token.
pub(crate) fn split(token: &str, case: LetterCase) -> Result<Name, ReadErrorKind> {
    let fold = fold(token, case);
    let mut result = Name {
        package: None,
        name: String::with_capacity(token.len()),
        is_internal: false,
        is_escaped: false,
    };
    let mut in_bars = false;
    let mut chars = token.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '\\' => {
                result.is_escaped = true;
                result.name.extend(chars.next());
            }
            '|' => {
                result.is_escaped = true;
                in_bars = !in_bars;
            }
            c if in_bars => result.name.push(c),
            ':' => {
                if result.package.is_some() {
                    return Err(ReadErrorKind::TooManyColons {
                        token: token.to_owned(),
                    });
                }
                result.package = Some(std::mem::take(&mut result.name));
                if chars.peek() == Some(&':') {
                    chars.next();
                    result.is_internal = true;
                }
            }
            '\u{8}' | '\u{7f}' => return Err(ReadErrorKind::InvalidConstituent(c)),
            c if is_blank(c) => return Err(ReadErrorKind::InvalidConstituent(c)),
            c => match meant_by_quotation_mark(c) {
                Some(instead) => return Err(ReadErrorKind::SmartQuote { mark: c, instead }),
                None => result.name.push(fold(c)),
            },
        }
    }
    if result.package.is_some() && result.name.is_empty() && !result.is_escaped {
        return Err(ReadErrorKind::NoNameAfterColon {
            token: token.to_owned(),
        });
    }
    Ok(result)
}

/// What Lisp text has instead of a typographic quotation mark, which word processors put there; a
/// name has one only between bars.
pub(crate) fn meant_by_quotation_mark(c: char) -> Option<&'static str> {
    match c {
        '“' | '”' | '„' => Some("\" around strings"),
        '‘' | '’' => Some("' before a quoted form"),
        _ => None,
    }
}

/// The symbol that a split token denotes, as a value. Unless a running program reads it, it stays.
pub(crate) fn resolve(
    image: &mut Image,
    name: &Name,
    is_for_program: bool,
) -> Result<Value, ReadErrorKind> {
    let intern = |image: &mut Image, package| match is_for_program {
        true => image.intern_for_program(package, &name.name),
        false => image.intern(package, &name.name).into(),
    };
    let Some(package_name) = &name.package else {
        let package = image.package_of_read(&name.name);
        return Ok(intern(image, package));
    };
    if package_name.is_empty() {
        return Ok(image.keyword(&name.name).into());
    }
    let Some(package) = image.packages.find(package_name) else {
        let known_names = image.packages.names().map(|(known, _)| known);
        return Err(ReadErrorKind::NoPackage {
            name: package_name.clone(),
            nearest: nearest(package_name, known_names).map(str::to_owned),
        });
    };
    if name.is_internal || package == PackageTable::KEYWORD {
        return Ok(intern(image, package));
    }
    match image.packages.find_symbol(package, &name.name) {
        Some((sym, Access::External)) => {
            if !is_for_program {
                image.symbols.keep(sym);
            }
            Ok(image.symbols.value(sym))
        }
        _ if image.packages.get(package).is_open => {
            Ok(image.export_symbol(package, &name.name).into())
        }
        Some(_) => Err(ReadErrorKind::NotExternal {
            name: name.name.clone(),
            package: image.packages.get(package).name.to_string(),
        }),
        None => Err(no_symbol(image, package, &name.name)),
    }
}

fn no_symbol(image: &Image, package: PackageId, name: &str) -> ReadErrorKind {
    let package = image.packages.get(package);
    let external = package
        .symbols
        .iter()
        .filter(|(_, (_, is_external))| *is_external)
        .map(|(name, _)| name.as_ref());
    let near = nearest(name, external).map(|near| format!("{}:{near}", package.name));
    ReadErrorKind::NoSymbol {
        name: name.to_owned(),
        package: package.name.to_string(),
        nearest: near.or_else(|| namesake(image, name)),
    }
}

/// A symbol of that name that another package exports, with that package's name.
fn namesake(image: &Image, name: &str) -> Option<String> {
    let is_home = |id: &PackageId| {
        let found = image.packages.get(*id).symbols.get(name);
        matches!(found, Some((sym, true)) if image.symbol(*sym).package == Some(*id))
    };
    let homes = image.packages.ids().filter(is_home);
    let mut names: Vec<&str> = homes
        .filter(|id| *id != PackageTable::SYSTEM)
        .map(|id| &*image.packages.get(id).name)
        .collect();
    names.sort_unstable();
    let home = names.first()?;
    Some(format!("{home}:{name}"))
}
