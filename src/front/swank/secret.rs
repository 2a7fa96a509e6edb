//! What clients have to say before anything else: the first line of a file that nobody else can read.

use std::fs::{self, Metadata, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use lisp::files::text_of;
use view::watch::live::random_word;

/// The file from which SLIME takes what it says, in the user's home.
const USUAL: &str = ".slime-secret";

/// Why there is no secret.
#[derive(Debug, Error)]
pub(crate) enum SecretError {
    /// The file cannot be read.
    #[error("cannot read {}: {error}", path.display())]
    Read { path: PathBuf, error: io::Error },
    /// Others can read the file.
    #[error(
        "others can read {path}, and could then do here all that you can: chmod 600 {path}",
        path = path.display()
    )]
    Shared { path: PathBuf },
    /// There is nothing in it.
    #[error("{} has no secret in its first line", .0.display())]
    Empty(PathBuf),
    /// The usual file cannot be made.
    #[error(
        "cannot make {}: {error}; --secret names another file, --no-secret lets all programs of this \
         machine connect", path.display()
    )]
    Make { path: PathBuf, error: io::Error },
}

/// What clients have to say first.
#[derive(Debug)]
pub(crate) struct Secret {
    /// The word.
    pub(crate) word: String,
    /// The file in which it is.
    pub(crate) path: PathBuf,
}

/// The secret in a file; without one, in that from which SLIME takes it, which is made with a random
/// word if it does not exist.
pub(crate) fn secret(file: Option<&Path>) -> Result<Secret, SecretError> {
    if let Some(path) = file {
        return read(path);
    }
    let home = std::env::home_dir().unwrap_or_default();
    let path = home.join(USUAL);
    if !path.exists() {
        make(&path).map_err(|error| SecretError::Make {
            path: path.clone(),
            error,
        })?;
    }
    read(&path)
}

fn read(path: &Path) -> Result<Secret, SecretError> {
    let failed = |error| SecretError::Read {
        path: path.to_owned(),
        error,
    };
    let known = fs::metadata(path).map_err(failed)?;
    let text = text_of(path).map_err(failed)?;
    if is_shared(&known) {
        return Err(SecretError::Shared {
            path: path.to_owned(),
        });
    }
    let word = text.lines().next().unwrap_or_default().trim_end();
    if word.is_empty() {
        return Err(SecretError::Empty(path.to_owned()));
    }
    Ok(Secret {
        word: word.to_owned(),
        path: path.to_owned(),
    })
}

/// Makes a file with a random word. One that somebody else makes meanwhile stays as it is.
fn make(path: &Path) -> io::Result<()> {
    let mut unfinished = path.as_os_str().to_owned();
    unfinished.push(format!(".{}", std::process::id()));
    let unfinished = PathBuf::from(unfinished);
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let mut file = options.open(&unfinished)?;
    // A link to it appears at once with all that is in it, and only if there is nothing else.
    let made = writeln!(file, "{}", random_word()).and_then(|()| fs::hard_link(&unfinished, path));
    // What is left of it does no harm.
    let _ = fs::remove_file(&unfinished);
    match made {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => Err(error),
        _ => Ok(()),
    }
}

#[cfg(unix)]
fn is_shared(known: &Metadata) -> bool {
    use std::os::unix::fs::PermissionsExt;
    known.permissions().mode() & 0o077 != 0
}

#[cfg(not(unix))]
fn is_shared(_: &Metadata) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn a_secret_is_made_for_its_user_alone_and_refused_if_others_can_read_it() {
        use std::os::unix::fs::PermissionsExt;
        let name = format!("planwright-{}-secret", std::process::id());
        let path = std::env::temp_dir().join(name);
        make(&path).unwrap();
        let word = read(&path).unwrap().word;
        assert_eq!(word.len(), 32);
        make(&path).unwrap();
        assert_eq!(read(&path).unwrap().word, word);
        for mode in [0o640, 0o604, 0o620] {
            fs::set_permissions(&path, fs::Permissions::from_mode(mode)).unwrap();
            let refused = read(&path).unwrap_err().to_string();
            assert!(refused.contains("chmod 600"), "{refused}");
        }
        fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
        fs::write(&path, "\nword").unwrap();
        assert!(matches!(read(&path), Err(SecretError::Empty(_))));
        fs::remove_file(&path).unwrap();
    }
}
