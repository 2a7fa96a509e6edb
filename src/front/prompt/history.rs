//! Where the inputs of earlier sessions are kept.

use std::ffi::OsString;
use std::path::PathBuf;

/// The history file, in an existing directory; `None` if there is no place for it.
pub(crate) fn history_file() -> Option<PathBuf> {
    let directory = state_directory()?;
    std::fs::create_dir_all(&directory).ok()?;
    Some(directory.join("history"))
}

/// The file with what has been done of lessons; `None` if there is no place for it.
pub(crate) fn lessons_file() -> Option<PathBuf> {
    Some(state_directory()?.join("lessons"))
}

/// The directory for what outlives a session; `None` if there is no place for it.
pub(crate) fn state_directory() -> Option<PathBuf> {
    state_path(|name| std::env::var_os(name))
}

/// `$XDG_STATE_HOME/planwright`, or else the same under `~/.local/state`. The XDG Base
/// Directory Specification says to ignore relative paths.
fn state_path(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    let directory = |name| {
        variable(name)
            .map(PathBuf::from)
            .filter(|p| p.is_absolute())
    };
    let state = directory("XDG_STATE_HOME")
        .or_else(|| Some(directory("HOME")?.join(".local").join("state")))?;
    Some(state.join("planwright"))
}

#[cfg(test)]
mod tests {
    use crate::prompt::history::*;

    fn path(variables: &[(&str, &str)]) -> Option<PathBuf> {
        state_path(|name| {
            let found = variables.iter().find(|(key, _)| *key == name);
            found.map(|(_, value)| value.into())
        })
    }

    #[test]
    fn the_state_directory_comes_before_home() {
        assert_eq!(
            path(&[("XDG_STATE_HOME", "/s"), ("HOME", "/h")]),
            Some("/s/planwright".into())
        );
        assert_eq!(
            path(&[("XDG_STATE_HOME", "s"), ("HOME", "/h")]),
            Some("/h/.local/state/planwright".into())
        );
    }

    #[test]
    fn without_home_nothing_is_kept() {
        assert_eq!(path(&[]), None);
        assert_eq!(path(&[("HOME", "")]), None);
    }
}
