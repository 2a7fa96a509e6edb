//! Completions of functions, macros, variables, keywords and packages.

use std::collections::HashSet;

use super::assistant::Assistant;
use super::context::Context;
use super::wording::{first_sentence, lower};
use crate::dialogue::Candidate;
use crate::printing::on_one_line;
use lisp::builtins::help;
use lisp::image::identity::aside;
use lisp::print;
use lisp::value::package::{PackageId, PackageTable};
use lisp::value::symbol::{FunctionCell, Sym, VariableKind};

/// Maximum number of names offered.
const MAX_NAMES: usize = 500;

impl Assistant<'_> {
    /// The names that begin with the word at the cursor.
    pub(super) fn names(&self, context: &Context<'_>) -> Vec<Candidate> {
        let word = context.word;
        let is_operator = !context.is_quoted
            && context
                .lists
                .last()
                .is_some_and(|list| list.elements == 0 && !list.is_quoted);
        let mut found = match word.rsplit_once(':') {
            Some(("", _)) => self.keywords(context),
            Some((prefix, name)) => self.names_of_package(prefix, name),
            None => self.accessible_names(word, is_operator),
        };
        found.sort();
        let mut first = if context.is_quoted {
            self.things_by_name()
        } else {
            self.local_variables(context)
        };
        first.append(&mut found);
        let mut found = first;
        if !word.contains(char::is_uppercase) {
            found.iter_mut().for_each(|c| c.text = lower(&c.text));
        }
        let wanted = word.to_uppercase();
        let mut seen = HashSet::new();
        found.retain(|c| c.text.to_uppercase().starts_with(&wanted) && seen.insert(c.text.clone()));
        found.truncate(MAX_NAMES);
        found
    }

    /// The variables that the form being typed binds around the cursor.
    fn local_variables(&self, context: &Context<'_>) -> Vec<Candidate> {
        let mut names = context.locals.clone();
        names.sort_unstable();
        let candidates = names.into_iter().map(|name| Candidate {
            text: name.to_owned(),
            doc: "a local variable".to_owned(),
        });
        candidates.collect()
    }

    /// The objects in the world, then furniture.
    fn things_by_name(&self) -> Vec<Candidate> {
        let mut found = self.object_names();
        found.sort();
        found.extend(self.furniture_names());
        found
    }

    fn accessible_names(&self, word: &str, is_operator: bool) -> Vec<Candidate> {
        let wanted = word.to_uppercase();
        let mut found = Vec::new();
        if wanted.is_empty() && !is_operator {
            return found;
        }
        let current = self.image.current_package();
        let package = self.image.packages.get(current);
        let own = package.symbols.iter().map(|(name, (sym, _))| (name, *sym));
        let inherited = package.uses.iter().flat_map(|used| {
            let symbols = self.image.packages.get(*used).symbols.iter();
            symbols
                .filter(|(_, (_, is_external))| *is_external)
                .map(|(name, (sym, _))| (name, *sym))
        });
        for (name, sym) in own.chain(inherited) {
            if !name.starts_with(&wanted) {
                continue;
            }
            if let Some(doc) = self.meaning(sym, is_operator) {
                found.push(Candidate {
                    text: name.to_string(),
                    doc,
                });
            }
        }
        if !wanted.is_empty() {
            found.extend(self.package_names(&wanted));
        }
        found
    }

    fn package_names(&self, wanted: &str) -> Vec<Candidate> {
        let names = self.image.packages.names();
        names
            .filter(|(name, id)| name.starts_with(wanted) && *id != PackageTable::KEYWORD)
            .map(|(name, _)| Candidate {
                text: format!("{name}:"),
                doc: "a package".to_owned(),
            })
            .collect()
    }

    fn names_of_package(&self, prefix: &str, name: &str) -> Vec<Candidate> {
        let is_internal = prefix.ends_with(':');
        let package_name = prefix.trim_end_matches(':').to_uppercase();
        let Some(id) = self.image.packages.find(&package_name) else {
            return Vec::new();
        };
        let wanted = name.to_uppercase();
        let prefix = format!("{}{}", package_name, if is_internal { "::" } else { ":" });
        self.symbols_of(id, is_internal)
            .filter(|(found, _)| found.starts_with(&wanted))
            .map(|(found, sym)| Candidate {
                text: format!("{prefix}{found}"),
                doc: self.meaning(sym, false).unwrap_or_default(),
            })
            .collect()
    }

    fn symbols_of(&self, id: PackageId, all: bool) -> impl Iterator<Item = (&str, Sym)> {
        let symbols = self.image.packages.get(id).symbols.iter();
        symbols
            .filter(move |(_, (_, is_external))| all || *is_external)
            .map(|(name, (sym, _))| (&**name, *sym))
    }

    /// Keywords with a meaning: those of the function being called, types, grasps and arms.
    fn keywords(&self, context: &Context<'_>) -> Vec<Candidate> {
        let keyword = |c: Candidate| Candidate {
            text: format!(":{}", c.text),
            doc: c.doc,
        };
        let mut found: Vec<Candidate> = Vec::new();
        if let Some(signature) = context
            .lists
            .last()
            .and_then(|list| list.operator)
            .and_then(|name| self.symbol_typed(name))
            .and_then(|sym| help::signature(self.image, sym))
        {
            let after_key = signature
                .lambda_list
                .split_once("&key")
                .map(|(_, keys)| keys);
            for name in after_key.unwrap_or_default().split_whitespace() {
                let name = name.trim_matches(['(', ')']);
                if !name.starts_with('&') && !name.is_empty() {
                    found.push(Candidate {
                        text: format!(":{}", name.trim_start_matches(':')),
                        doc: "a keyword argument".to_owned(),
                    });
                }
            }
        }
        found.extend(self.object_types().into_iter().map(keyword));
        found.extend(self.grasps(context).into_iter().map(keyword));
        for arm in ["left", "right"] {
            found.push(Candidate {
                text: format!(":{arm}"),
                doc: "an arm".to_owned(),
            });
        }
        found
    }

    /// The symbol that a name means in the current package, if there is one.
    pub(super) fn symbol_typed(&self, name: &str) -> Option<Sym> {
        let upper = name.to_uppercase();
        match upper.rsplit_once(':') {
            None => {
                let current = self.image.current_package();
                self.image.packages.find_symbol(current, &upper)
            }
            Some((package, name)) => {
                let id = self.image.packages.find(package.trim_end_matches(':'))?;
                self.image.packages.find_symbol(id, name)
            }
        }
        .map(|(sym, _)| sym)
    }

    /// One line on what a symbol means, if it has a meaning.
    fn meaning(&self, sym: Sym, is_operator: bool) -> Option<String> {
        let data = self.image.symbol(sym);
        if !matches!(data.function, FunctionCell::Unbound) {
            let signature = help::signature(self.image, sym)?;
            let doc = signature.doc.as_deref().map(first_sentence);
            return Some(doc.unwrap_or_else(|| signature.call(self.image, sym)));
        }
        if is_operator || (data.kind == VariableKind::Lexical && data.value.is_unbound()) {
            return None;
        }
        if data.value.is_unbound() {
            return Some("a variable without a value".to_owned());
        }
        let image = self.image;
        let shown = aside(image, || print::to_string(image, &data.value, true));
        Some(format!("= {}", on_one_line(&shown)))
    }
}
