//! The chapters on packages: functions, macros and special operators with their examples.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::{code, line};
use lisp::builtin::Entry;
use lisp::image::Image;
use lisp::value::package::PackageId;
use lisp::value::symbol::Sym;

/// What the manual says about a package.
pub(crate) struct PackageChapter {
    pub(crate) name: Rc<str>,
    nicknames: Vec<Rc<str>>,
    doc: Option<Rc<str>>,
    /// Sorted by name.
    pub(crate) entries: Vec<NamedEntry>,
}

/// An entry and its name.
pub(crate) struct NamedEntry {
    name: Rc<str>,
    entry: Entry,
}

/// Packages of names that macros expand into and that are not for users.
const LEFT_OUT: &[&str] = &["SYSTEM", "PLAN-SYSTEM"];

/// Packages that users know by the name of another one, which exports their symbols.
const SHOWN_AS: &[(&str, &str)] = &[("CRAM-LANGUAGE-IMPLEMENTATION", "CRAM-LANGUAGE")];

/// The packages that define functions or operators, `COMMON-LISP` first.
pub(crate) fn packages(image: &Image) -> Vec<PackageChapter> {
    let mut by_package: BTreeMap<PackageId, BTreeMap<Rc<str>, Entry>> = BTreeMap::new();
    let shown_as = |home: PackageId| {
        let home_name = &image.packages.get(home).name;
        SHOWN_AS
            .iter()
            .find(|(name, _)| *name == home_name.as_ref())
            .and_then(|(_, shown)| image.packages.find(shown))
            .unwrap_or(home)
    };
    let mut add = |sym: Sym, entry: Entry| {
        let data = image.symbol(sym);
        if let Some(package) = data.package.map(shown_as) {
            by_package
                .entry(package)
                .or_default()
                .insert(data.name.clone(), entry);
        }
    };
    for (sym, entry) in &image.entries {
        add(*sym, *entry);
    }
    by_package
        .into_iter()
        .filter(|(id, _)| !LEFT_OUT.contains(&image.packages.get(*id).name.as_ref()))
        .map(|(id, entries)| {
            let package = image.packages.get(id);
            PackageChapter {
                name: package.name.clone(),
                nicknames: package.nicknames.clone(),
                doc: package.doc.clone(),
                entries: entries
                    .into_iter()
                    .map(|(name, entry)| NamedEntry { name, entry })
                    .collect(),
            }
        })
        .collect()
}

impl PackageChapter {
    pub(crate) fn write(&self, to: &mut String) {
        line(to, &format!("\n## Package {}\n", self.name));
        if let Some(doc) = &self.doc {
            line(to, &format!("{doc}\n"));
        }
        if !self.nicknames.is_empty() {
            let names = crate::manual::codes(self.nicknames.iter().map(AsRef::as_ref));
            line(to, &format!("Also called {names}.\n"));
        }
        for entry in &self.entries {
            entry.write(to);
        }
    }
}

impl NamedEntry {
    fn write(&self, to: &mut String) {
        let entry = &self.entry;
        line(to, &format!("### {}\n", code(&self.name)));
        let lambda_list = entry.lambda_list();
        let form = if lambda_list.is_empty() {
            format!("({})", self.name.to_lowercase())
        } else {
            format!("({} {lambda_list})", self.name.to_lowercase())
        };
        line(to, &format!("`{form}` — {}\n", entry.kind()));
        line(to, &format!("{}\n", entry.doc()));
        let examples = entry.examples();
        if examples.is_empty() {
            return;
        }
        line(to, "```lisp");
        for example in examples {
            line(to, example);
        }
        line(to, "```\n");
    }
}
