//! Where the inputs of earlier sessions are kept.

use std::ffi::OsString;
use std::path::PathBuf;

/// The history file, in a directory that exists; none where there is no place for it.
pub(super) fn history_file() -> Option<PathBuf> {
    let path = history_path(|name| std::env::var_os(name))?;
    std::fs::create_dir_all(path.parent()?).ok()?;
    Some(path)
}

/// `$XDG_STATE_HOME/planwright/history`, or that under `~/.local/state`. Relative paths
/// are not to be used, says the XDG Base Directory Specification.
fn history_path(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    let directory = |name| {
        variable(name)
            .map(PathBuf::from)
            .filter(|p| p.is_absolute())
    };
    let state = directory("XDG_STATE_HOME")
        .or_else(|| Some(directory("HOME")?.join(".local").join("state")))?;
    Some(state.join("planwright").join("history"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(variables: &[(&str, &str)]) -> Option<PathBuf> {
        history_path(|name| {
            let found = variables.iter().find(|(key, _)| *key == name);
            found.map(|(_, value)| value.into())
        })
    }

    #[test]
    fn the_state_directory_comes_before_home() {
        assert_eq!(
            path(&[("XDG_STATE_HOME", "/s"), ("HOME", "/h")]),
            Some("/s/planwright/history".into())
        );
        assert_eq!(
            path(&[("XDG_STATE_HOME", "s"), ("HOME", "/h")]),
            Some("/h/.local/state/planwright/history".into())
        );
    }

    #[test]
    fn without_home_nothing_is_kept() {
        assert_eq!(path(&[]), None);
        assert_eq!(path(&[("HOME", "")]), None);
    }
}
