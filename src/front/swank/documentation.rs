//! What names mean: descriptions, documentation and searches.

use super::hub::Request;
use super::package_text::package_of;
use super::sexp::Sexp;
use session::dialogue::{KnownSymbol, Names};

fn symbol<'n>(names: &'n Names, request: &Request) -> Result<&'n KnownSymbol, String> {
    let typed = request.text(0).unwrap_or_default();
    let package = package_of(names, request.package.as_deref());
    let typed = typed.trim_start_matches(['\'', '`', ',', '@']);
    let typed = typed.strip_prefix("#'").unwrap_or(typed);
    let known = names.typed(package, typed);
    known
        .filter(|symbol| symbol.has_meaning() || symbol.variable_doc.is_some())
        .ok_or_else(|| format!("Nothing is known about {}.", typed.to_uppercase()))
}

/// The lines of a text, indented.
fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}\n")).collect()
}

/// `describe-symbol` and `describe-function`.
pub(super) fn describe(names: &Names, request: &Request) -> Option<Sexp> {
    let symbol = match symbol(names, request) {
        Ok(symbol) => symbol,
        Err(told) => return Some(told.into()),
    };
    let package = names.packages.get(symbol.package);
    let package = package.map_or("", |package| package.name.as_str());
    let mut text = format!("{}: a symbol in {package}\n", symbol.name);
    if let (Some(function), Some(call)) = (&symbol.function, symbol.call()) {
        text.push_str(&format!("\nNames a {}:\n  {call}\n", function.kind));
        text.push_str(&indented(function.doc.as_deref().unwrap_or_default()));
        if let Some(library) = &function.library {
            text.push_str(&format!("Defined at {}.\n", library.place));
        }
    }
    if symbol.is_variable {
        text.push_str("\nNames a variable.\n");
        text.push_str(&indented(
            symbol.variable_doc.as_deref().unwrap_or_default(),
        ));
    }
    if symbol.is_class {
        text.push_str("\nNames a class.\n");
    }
    if !symbol.topics.is_empty() {
        text.push('\n');
        text.push_str(&symbol.topics);
    }
    Some(text.into())
}

/// `documentation-symbol`.
pub(super) fn documentation(names: &Names, request: &Request) -> Option<Sexp> {
    let symbol = match symbol(names, request) {
        Ok(symbol) => symbol,
        Err(told) => return Some(told.into()),
    };
    let of_function = symbol.function.as_ref().and_then(|f| f.doc.as_deref());
    let docs = [
        ("Documentation for the function", of_function),
        (
            "Documentation for the variable",
            symbol.variable_doc.as_deref(),
        ),
    ];
    let docs = docs
        .into_iter()
        .filter_map(|(what, doc)| Some(format!("{what} {}:\n\n{}\n", symbol.name, doc?)));
    let text = docs.collect::<Vec<_>>().join("\n") + &symbol.topics;
    Some(match text.is_empty() {
        true => format!("{} has no documentation.", symbol.name).into(),
        false => text.into(),
    })
}

/// `apropos-list-for-emacs`.
pub(super) fn apropos(names: &Names, request: &Request) -> Option<Sexp> {
    let text = request.text(0)?;
    let given = |index: usize| request.argument(index).filter(|given| !given.is_nil());
    let (only_external, exact_case) = (given(1).is_some(), given(2).is_some());
    let package = given(3).and_then(|given| given.as_str().or_else(|| given.as_name()));
    let package = package.map(|package| package_of(names, Some(package)));
    let wanted = if exact_case {
        text.to_owned()
    } else {
        text.to_uppercase()
    };
    let fits = |name: &str| match exact_case {
        true => name.contains(&wanted),
        false => name.to_uppercase().contains(&wanted),
    };
    let mut found = Vec::new();
    for (at, home) in names.packages.iter().enumerate() {
        if package.is_some_and(|package| package != at) || home.name == "KEYWORD" {
            continue;
        }
        for (name, (number, is_external)) in &home.symbols {
            let symbol = names.symbols.get(*number).filter(|symbol| {
                let is_home = package.is_some() || symbol.package == at;
                is_home && fits(name) && symbol.has_meaning()
            });
            if let Some(symbol) = symbol.filter(|_| *is_external || !only_external) {
                let colons = if *is_external { ":" } else { "::" };
                found.push((format!("{}{colons}{name}", home.prompt), symbol));
            }
        }
    }
    found.sort_by(|(a, _), (b, _)| a.cmp(b));
    Some(Sexp::list(found.into_iter().map(|(name, symbol)| {
        let mut told = vec![Sexp::symbol(":designator"), name.into()];
        let undocumented = Sexp::symbol(":not-documented");
        if let Some(function) = &symbol.function {
            let kind = match function.kind {
                "macro" => ":macro",
                "special operator" => ":special-operator",
                "generic function" => ":generic-function",
                _ => ":function",
            };
            let doc = function.doc.as_deref().map(first_line);
            told.extend([
                Sexp::symbol(kind),
                doc.map_or_else(|| undocumented.clone(), Sexp::from),
            ]);
        }
        if symbol.is_variable {
            let doc = symbol.variable_doc.as_deref().map(first_line);
            told.extend([
                Sexp::symbol(":variable"),
                doc.map_or_else(|| undocumented.clone(), Sexp::from),
            ]);
        }
        if symbol.is_class {
            told.extend([Sexp::symbol(":type"), undocumented]);
        }
        Sexp::List(told)
    })))
}

fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or_default()
}
