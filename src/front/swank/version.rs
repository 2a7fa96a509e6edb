//! The version of SLIME that a client has, on which some answers depend.

use std::fmt;

/// A version as SLIME tells it, such as `2.27` or `2.32.git`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Version(String);

impl Version {
    /// The version of that name.
    pub(crate) fn named(name: &str) -> Version {
        Version(name.to_owned())
    }

    /// Whether completions are told as since 2.32.
    pub(super) fn has_new_completions(&self) -> bool {
        let mut numbers = self.0.split('.').map(str::parse::<u32>);
        match (numbers.next(), numbers.next()) {
            (Some(Ok(major)), Some(Ok(minor))) => (major, minor) >= (2, 32),
            _ => false,
        }
    }
}

impl Default for Version {
    /// The version in Debian 12.
    fn default() -> Version {
        Version("2.27".to_owned())
    }
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_by_their_numbers() {
        for (name, is_new) in [
            ("2.27", false),
            ("2.31", false),
            ("2.32.git", true),
            ("2.100", true),
            ("3.0", true),
            ("20100303", false),
            ("", false),
        ] {
            assert_eq!(Version::named(name).has_new_completions(), is_new, "{name}");
        }
    }
}
