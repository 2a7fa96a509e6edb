//! Completions of names: by their beginnings, also part by part, as `m-v-b` for
//! `multiple-value-bind`; and fuzzy ones, whose letters only have to occur in order.

use super::hub::Request;
use super::package_text::package_of;
use super::sexp::Sexp;
use super::version::Version;
use session::dialogue::{KnownSymbol, Names, parameters};

/// Maximum number of completions.
const MOST: usize = 500;
/// Maximum number of fuzzy completions, unless the client says less.
const MAX_FUZZY: usize = 300;

/// A possible completion.
struct Candidate<'n> {
    /// As it would be typed.
    text: String,
    /// What it names; `None` for a package.
    symbol: Option<&'n KnownSymbol>,
}

/// The parts of a name that were typed: their places, in characters, and their texts.
type Chunks = Vec<(usize, String)>;

/// A completion with its score.
type Scored<'n> = (f64, Candidate<'n>, Chunks);

/// What was typed of a name.
struct Typed<'t> {
    /// The prefix with its colons; empty if there is none.
    prefix: &'t str,
    /// The name so far.
    name: &'t str,
}

impl<'t> Typed<'t> {
    fn of(text: &'t str) -> Typed<'t> {
        let at = text.rfind(':').map_or(0, |at| at + 1);
        let (prefix, name) = text.split_at(at);
        Typed { prefix, name }
    }
}

/// The symbols that may be meant, with their names.
fn symbols<'n>(
    names: &'n Names,
    package: usize,
    typed: &Typed<'_>,
) -> Vec<(&'n str, &'n KnownSymbol)> {
    let wanted = match typed.prefix {
        "" => {
            let accessible = names.all_accessible(package);
            return accessible
                .filter(|(_, symbol)| symbol.has_meaning())
                .collect();
        }
        ":" => names.package("KEYWORD"),
        prefix => names.package(prefix.trim_end_matches(':')),
    };
    let package = wanted.and_then(|wanted| names.packages.get(wanted));
    let all = typed.prefix.ends_with("::") || typed.prefix == ":";
    let present = package.into_iter().flat_map(|package| &package.symbols);
    present
        .filter(|(_, (_, is_external))| all || *is_external)
        .filter_map(|(name, (symbol, _))| {
            let symbol: &KnownSymbol = names.symbols.get(*symbol)?;
            Some((name.as_str(), symbol))
        })
        .collect()
}

/// A name in the case in which the user types.
fn cased(name: &str, typed: &str) -> String {
    match typed.contains(char::is_uppercase) {
        true => name.to_owned(),
        false => name.to_lowercase(),
    }
}

/// Whether each part of what was typed begins a part of the name.
fn fits(name: &str, typed: &str) -> bool {
    let mut parts = name.split('-');
    typed
        .split('-')
        .all(|typed| parts.next().is_some_and(|part| part.starts_with(typed)))
}

fn candidates<'n>(names: &'n Names, package: usize, text: &str) -> Vec<Candidate<'n>> {
    let typed = Typed::of(text);
    let upper = typed.name.to_uppercase();
    let mut found: Vec<Candidate<'n>> = symbols(names, package, &typed)
        .into_iter()
        .filter(|(name, _)| fits(name, &upper))
        .map(|(name, symbol)| Candidate {
            text: format!("{}{}", typed.prefix, cased(name, text)),
            symbol: Some(symbol),
        })
        .collect();
    if typed.prefix.is_empty() && !upper.is_empty() {
        let packages = names.package_names.keys();
        let packages = packages.filter(|name| fits(name, &upper) && *name != "KEYWORD");
        found.extend(packages.map(|name| Candidate {
            text: cased(name, text) + ":",
            symbol: None,
        }));
    }
    found.sort_by(|a, b| a.text.cmp(&b.text));
    found.dedup_by(|a, b| a.text == b.text);
    found.truncate(MOST);
    found
}

/// What a symbol is, a letter for each meaning at its place.
fn flags(symbol: Option<&KnownSymbol>, version: &Version) -> String {
    let kind = symbol.and_then(|symbol| symbol.function.as_ref());
    let kind = kind.map_or("", |function| function.kind);
    let is_operator = matches!(kind, "macro" | "special operator");
    let marks = [
        ('b', symbol.is_some_and(|symbol| symbol.is_variable)),
        ('f', !kind.is_empty()),
        ('g', kind == "generic function"),
        ('c', symbol.is_some_and(|symbol| symbol.is_class)),
        ('t', symbol.is_some_and(|symbol| symbol.is_class)),
        ('m', kind == "macro"),
        ('s', is_operator && kind != "macro"),
        ('p', symbol.is_none()),
    ];
    let mut text: String = marks
        .into_iter()
        .map(|(mark, holds)| if holds { mark } else { '-' })
        .collect();
    if version.has_new_completions() {
        text.push('-');
    }
    text
}

/// The full name, as later versions want to know it.
fn qualified(names: &Names, candidate: &Candidate<'_>) -> String {
    let Some(symbol) = candidate.symbol else {
        return candidate.text.to_uppercase();
    };
    let package = names.packages.get(symbol.package);
    let package = package.map_or("", |package| package.prompt.as_str());
    format!("{package}:{}", symbol.name)
}

/// The longest beginning that all have in common, but no less than what was typed.
fn common_beginning(candidates: &[Candidate<'_>], typed: &str) -> String {
    let Some((first, rest)) = candidates.split_first() else {
        return typed.to_owned();
    };
    let mut common = first.text.as_str();
    for other in rest {
        let same = common.char_indices().zip(other.text.chars());
        let end = same.take_while(|((_, a), b)| a == b).last();
        let end = end.map_or(0, |((at, c), _)| at + c.len_utf8());
        common = common.get(..end).unwrap_or_default();
    }
    match common.len() < typed.len() {
        true => typed.to_owned(),
        false => common.to_owned(),
    }
}

fn told(names: &Names, version: &Version, found: &[Candidate<'_>], typed: &str) -> Sexp {
    if version.has_new_completions() {
        return Sexp::list(found.iter().map(|candidate| {
            let flags = flags(candidate.symbol, version);
            let texts = [candidate.text.clone(), flags, qualified(names, candidate)];
            Sexp::list(texts.map(Sexp::from))
        }));
    }
    let texts = found.iter().map(|c| Sexp::from(c.text.as_str()));
    Sexp::list([Sexp::list(texts), common_beginning(found, typed).into()])
}

/// `completions` and `simple-completions`.
pub(super) fn completions(names: &Names, version: &Version, request: &Request) -> Option<Sexp> {
    let typed = request.text(0)?;
    let package = package_of(names, request.argument(1).and_then(Sexp::as_name));
    let found = candidates(names, package, typed);
    Some(told(names, version, &found, typed))
}

/// `completions-for-keyword`: the keywords of the innermost call that is being typed.
pub(super) fn keyword_completions(
    names: &Names,
    version: &Version,
    request: &Request,
) -> Option<Sexp> {
    let typed = request.text(0)?;
    let package = package_of(names, request.package.as_deref());
    let form = request.argument(1)?;
    let calls = super::autodoc::open_calls(form);
    let found: Vec<Candidate<'_>> = calls.iter().find_map(|call| {
        let function = names.typed(package, call.operator)?.function.as_ref()?;
        let keys = parameters(&function.lambda_list);
        let keys = keys.into_iter().skip_while(|word| *word != "&key").skip(1);
        let keys = keys.filter(|word| !word.starts_with('&'));
        let keys = keys.filter_map(|word| word.trim_matches(['(', ')']).split_whitespace().next());
        let keys = keys.map(|key| format!(":{}", key.trim_start_matches(':')));
        let fitting = keys.filter(|key| fits(key, &typed.to_lowercase()));
        let found: Vec<Candidate<'_>> = fitting
            .map(|text| Candidate { text, symbol: None })
            .collect();
        (!found.is_empty()).then_some(found)
    })?;
    Some(told(names, version, &found, typed))
}

/// How well a name fits to letters, and which parts of it they are.
fn fuzzy(name: &str, typed: &str) -> Option<(f64, Chunks)> {
    if typed.is_empty() {
        return Some((0.0, Vec::new()));
    }
    if let Some(at) = name.find(typed) {
        let is_at_part = at == 0 || name.get(..at).is_some_and(|before| before.ends_with('-'));
        let bonus = if at == 0 {
            30.0
        } else if is_at_part {
            15.0
        } else {
            0.0
        };
        let share = typed.len() as f64 / name.len() as f64;
        let at = name.get(..at)?.chars().count();
        return Some((40.0 + bonus + 30.0 * share, vec![(at, typed.to_owned())]));
    }
    let mut chunks = Chunks::new();
    let mut wanted = typed.chars().peekable();
    let mut goes_on = false;
    for (at, c) in name.chars().enumerate() {
        if wanted.peek() != Some(&c) {
            goes_on = false;
            continue;
        }
        wanted.next();
        match chunks.last_mut().filter(|_| goes_on) {
            Some((_, chunk)) => chunk.push(c),
            None => chunks.push((at, c.to_string())),
        }
        goes_on = true;
    }
    let share = typed.len() as f64 / name.len() as f64;
    wanted
        .peek()
        .is_none()
        .then(|| (40.0 * share / chunks.len() as f64, chunks))
}

/// `fuzzy-completions`.
pub(super) fn fuzzy_completions(
    names: &Names,
    version: &Version,
    request: &Request,
) -> Option<Sexp> {
    let text = request.text(0)?;
    let package = package_of(names, request.argument(1).and_then(Sexp::as_name));
    let keyword = |name: &str| {
        let mut rest = request.arguments.iter().skip(2);
        rest.find(|item| item.as_name() == Some(name))?;
        rest.next()?.as_index()
    };
    let limit = keyword(":limit").unwrap_or(MAX_FUZZY).min(MAX_FUZZY);
    let typed = Typed::of(text);
    let wanted = typed.name.to_lowercase();
    let before = typed.prefix.chars().count();
    let mut found: Vec<Scored<'_>> = symbols(names, package, &typed)
        .into_iter()
        .filter_map(|(name, symbol)| {
            let (score, chunks) = fuzzy(&name.to_lowercase(), &wanted)?;
            let text = format!("{}{}", typed.prefix, cased(name, text));
            let symbol = Some(symbol);
            Some((score, Candidate { text, symbol }, chunks))
        })
        .collect();
    found.sort_by(|(a, c, _), (b, d, _)| b.total_cmp(a).then_with(|| c.text.cmp(&d.text)));
    found.dedup_by(|(_, a, _), (_, b, _)| a.text == b.text);
    found.truncate(limit);
    let told = found.iter().map(|(score, candidate, chunks)| {
        let chunks =
            Sexp::list(chunks.iter().map(|(at, chunk)| {
                Sexp::list([Sexp::from(at + before), cased(chunk, text).into()])
            }));
        let flags = Sexp::from(flags(candidate.symbol, version));
        let text = Sexp::from(candidate.text.as_str());
        match version.has_new_completions() {
            true => Sexp::list([text, flags, qualified(names, candidate).into(), chunks]),
            false => Sexp::list([text, format!("{score:.2}").into(), chunks, flags]),
        }
    });
    Some(Sexp::list([Sexp::list(told), Sexp::NIL]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_names_are_enough() {
        assert!(fits("MULTIPLE-VALUE-BIND", "M-V-B"));
        assert!(fits("MULTIPLE-VALUE-BIND", "MULTIPLE-V"));
        assert!(!fits("MULTIPLE-VALUE-BIND", "V-B"));
        assert!(!fits("CAR", "C-A"));
    }

    #[test]
    fn letters_in_order_fit() {
        assert_eq!(
            fuzzy("park-arms", "park").unwrap().1,
            [(0, "park".to_owned())]
        );
        let chunks = fuzzy("park-arms", "pams").unwrap().1;
        let chunks: Vec<(usize, &str)> = chunks.iter().map(|(at, c)| (*at, c.as_str())).collect();
        assert_eq!(chunks, [(0, "pa"), (7, "ms")]);
        assert!(fuzzy("park-arms", "spa").is_none());
        let score = |name| fuzzy(name, "arm").unwrap().0;
        assert!(score("arm") > score("arms-up") && score("park-arm") > score("alarm-clock"));
    }
}
