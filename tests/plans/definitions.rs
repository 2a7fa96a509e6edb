//! What the plans of the library define.

use std::collections::BTreeMap;

use plan_files::LIBRARY;

/// A second definition replaces the first one for whoever calls it, and nothing says so.
#[test]
fn no_function_of_the_library_is_defined_twice() {
    let mut places: BTreeMap<(&str, &str), Vec<String>> = BTreeMap::new();
    for (file, text) in LIBRARY {
        let mut package = "";
        for (line, text) in (1..).zip(text.lines()) {
            if let Some(rest) = text.strip_prefix("(in-package ") {
                package = rest.trim_end_matches(')');
            }
            let definition = ["(defun ", "(defmacro ", "(defgeneric "];
            let rest = definition.iter().find_map(|d| text.strip_prefix(d));
            let Some(rest) = rest else { continue };
            let end = match rest.strip_prefix("(setf ") {
                Some(_) => rest.find(')').map(|end| end + 1),
                None => rest.find(' '),
            };
            let name = &rest[..end.unwrap_or(rest.len())];
            let at = places.entry((package, name)).or_default();
            at.push(format!("{file}:{line}"));
        }
    }
    assert!(places.len() > 1000, "{}", places.len());
    places.retain(|_, at| at.len() > 1);
    assert!(places.is_empty(), "{places:#?}");
}
