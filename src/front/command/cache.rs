//! Where what can be made again is kept, to save the time.

use std::ffi::OsString;
use std::path::PathBuf;

/// The folder with that name among the caches of the program; `None` if there is no place for it.
pub(super) fn directory(name: &str) -> Option<String> {
    let directory = path(|variable| std::env::var_os(variable))?.join(name);
    directory.to_str().map(str::to_owned)
}

/// `$XDG_CACHE_HOME/planwright`, or else the same under `~/.cache`. The XDG Base Directory Specification
/// says to ignore relative paths.
fn path(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    let directory = |name| {
        let path = variable(name).map(PathBuf::from);
        path.filter(|path| path.is_absolute())
    };
    let cache = directory("XDG_CACHE_HOME").or_else(|| Some(directory("HOME")?.join(".cache")))?;
    Some(cache.join("planwright"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cache_is_where_the_user_wants_it() {
        let found = |variables: &[(&str, &str)]| {
            path(|name| {
                let found = variables.iter().find(|(key, _)| *key == name);
                found.map(|(_, value)| value.into())
            })
        };
        let both = [("XDG_CACHE_HOME", "/c"), ("HOME", "/h")];
        assert_eq!(found(&both), Some("/c/planwright".into()));
        let home = [("XDG_CACHE_HOME", "c"), ("HOME", "/h")];
        assert_eq!(found(&home), Some("/h/.cache/planwright".into()));
        assert_eq!(found(&[]), None);
    }
}
