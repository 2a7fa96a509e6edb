//! The package that a buffer says it is in.

use session::dialogue::Names;

/// The name in the text of a package designator: `pp-tut`, `:pp-tut`, `#:pp-tut` or `"PP-TUT"`.
pub(super) fn package_name(text: &str) -> &str {
    let text = text.trim();
    if let Some(name) = text.strip_prefix('"') {
        return name.trim_end_matches('"');
    }
    text.trim_start_matches("#:")
        .trim_start_matches("cl:")
        .trim_start_matches(':')
}

/// The index of the package of a text; that of the session if there is none.
pub(super) fn package_of(names: &Names, text: Option<&str>) -> usize {
    let found = text.and_then(|text| names.package(package_name(text)));
    found.unwrap_or(names.current)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_ways_to_write_a_package_are_known() {
        for text in ["PP-TUT", ":PP-TUT", "#:PP-TUT", "\"PP-TUT\"", " :PP-TUT "] {
            assert_eq!(package_name(text), "PP-TUT");
        }
    }
}
