//! What a command is going to write: nothing that it reads, and no two things into one file. All of
//! it is tried before anything runs, since a run may take an hour.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use super::failure::CommandError;
use session::WatchError;

/// The files that a command reads and those that it is going to write.
#[derive(Default)]
pub(super) struct Outputs {
    inputs: Vec<PathBuf>,
    files: Vec<(&'static str, PathBuf)>,
    folders: Vec<(&'static str, PathBuf)>,
}

/// How many links are followed to a file that does not exist yet.
const MAX_LINKS: usize = 32;

impl Outputs {
    /// A command reads these files.
    pub(super) fn reading<'a>(inputs: impl IntoIterator<Item = &'a PathBuf>) -> Outputs {
        Outputs {
            inputs: inputs.into_iter().cloned().collect(),
            ..Outputs::default()
        }
    }

    /// It writes a file if the option is given.
    pub(super) fn file(mut self, option: &'static str, path: Option<&PathBuf>) -> Outputs {
        self.files.extend(path.map(|path| (option, path.clone())));
        self
    }

    /// It writes files into a folder if the option is given.
    pub(super) fn folder(mut self, option: &'static str, path: Option<&PathBuf>) -> Outputs {
        self.folders.extend(path.map(|path| (option, path.clone())));
        self
    }

    /// An error if anything would be destroyed or cannot be written. Folders are made.
    pub(super) fn check(&self) -> Result<(), CommandError> {
        for (option, path) in &self.files {
            if let Some(input) = self.inputs.iter().find(|input| is_same(input, path)) {
                return Err(CommandError::Overwrites {
                    option,
                    path: path.clone(),
                    input: input.clone(),
                });
            }
        }
        for (at, (option, path)) in self.files.iter().enumerate() {
            let mut others = self.files.iter().skip(at + 1);
            if let Some((other, _)) = others.find(|(_, other)| is_same(path, other)) {
                return Err(CommandError::WritesTwice {
                    options: [option, other],
                    path: path.clone(),
                });
            }
        }
        for (option, path) in &self.files {
            try_file(path).map_err(|error| match *option {
                "--record" => CommandError::Watch(WatchError::Record {
                    path: path.clone(),
                    error: error.into(),
                }),
                _ => refused(path, error),
            })?;
        }
        for (_, folder) in &self.folders {
            fs::create_dir_all(folder).map_err(|error| refused(folder, error))?;
            let probe = folder.join(format!(".planwright-{}", std::process::id()));
            try_file(&probe).map_err(|error| refused(folder, error))?;
        }
        Ok(())
    }
}

fn refused(path: &Path, error: io::Error) -> CommandError {
    CommandError::Rewrite {
        path: path.to_owned(),
        error,
    }
}

/// Whether a file can be written. It is left as it is, or is not there, as before.
fn try_file(path: &Path) -> io::Result<()> {
    match fs::metadata(path) {
        // Opening a pipe waits for whoever reads it, and devices have nothing to lose.
        Ok(found) if !found.is_file() && !found.is_dir() => Ok(()),
        Ok(_) => OpenOptions::new().append(true).open(path).map(drop),
        Err(_) => {
            let place = followed(path);
            drop(File::create_new(&place)?);
            fs::remove_file(&place)
        }
    }
}

/// Whether two paths name the same regular file: by whatever names, links or spellings, and also if
/// it does not exist yet.
fn is_same(one: &Path, other: &Path) -> bool {
    match (fs::metadata(one), fs::metadata(other)) {
        (Ok(found), Ok(also)) => found.is_file() && is_same_file(&found, &also, one, other),
        (Err(_), Err(_)) => place(one).is_some_and(|at| place(other) == Some(at)),
        _ => false,
    }
}

#[cfg(unix)]
fn is_same_file(found: &Metadata, also: &Metadata, _: &Path, _: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    (found.dev(), found.ino()) == (also.dev(), also.ino())
}

#[cfg(not(unix))]
fn is_same_file(_: &Metadata, _: &Metadata, one: &Path, other: &Path) -> bool {
    let canonical = |path: &Path| fs::canonicalize(path).ok();
    canonical(one).is_some_and(|at| canonical(other) == Some(at))
}

/// Where a file would be made: links to files that do not exist are followed.
fn followed(path: &Path) -> PathBuf {
    let mut at = path.to_owned();
    for _ in 0..MAX_LINKS {
        let Ok(target) = fs::read_link(&at) else {
            break;
        };
        at = at.parent().unwrap_or(Path::new("")).join(target);
    }
    at
}

/// The one spelling of the place where a file would be made, if its folder exists.
fn place(path: &Path) -> Option<PathBuf> {
    let path = followed(path);
    let folder = match path.parent() {
        Some(folder) if folder.as_os_str().is_empty() => Path::new("."),
        Some(folder) => folder,
        None => return None,
    };
    Some(fs::canonicalize(folder).ok()?.join(path.file_name()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str) -> Folder {
            let name = format!("planwright-{}-outputs-{name}", std::process::id());
            let path = std::env::temp_dir().join(name);
            fs::create_dir_all(path.join("inner")).expect("a folder");
            fs::write(path.join("a.plan"), "(list 1)").expect("a file");
            Folder(path)
        }

        fn checked(&self, input: &str, output: &str) -> Result<(), CommandError> {
            let (input, output) = (self.0.join(input), self.0.join(output));
            let outputs = Outputs::reading([&input]).file("--record", Some(&output));
            outputs.check()
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn an_input_is_not_overwritten_by_whatever_name() {
        let folder = Folder::new("names");
        let mut names = vec!["a.plan", "./a.plan", "inner/../a.plan"];
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("a.plan", folder.0.join("soft")).expect("a link");
            std::os::unix::fs::symlink("../soft", folder.0.join("inner/soft")).expect("a link");
            fs::hard_link(folder.0.join("a.plan"), folder.0.join("hard")).expect("a link");
            names.extend(["soft", "inner/soft", "hard"]);
        }
        for name in names {
            let error = folder.checked("a.plan", name).expect_err(name).to_string();
            assert!(error.contains("would overwrite"), "{error}");
        }
        let text = fs::read_to_string(folder.0.join("a.plan")).expect("it is there");
        assert_eq!(text, "(list 1)");
        assert!(folder.checked("a.plan", "b.mcap").is_ok());
        assert!(!folder.0.join("b.mcap").exists());
    }

    #[test]
    fn two_outputs_are_two_files() {
        let folder = Folder::new("two");
        #[cfg(unix)]
        std::os::unix::fs::symlink("new.gif", folder.0.join("link.png")).expect("a link");
        let outputs = |one: &str, other: &str| {
            Outputs::default()
                .file("--output", Some(&folder.0.join(one)))
                .file("--gif", Some(&folder.0.join(other)))
                .check()
        };
        assert!(outputs("new.png", "new.gif").is_ok());
        assert!(outputs("new.gif", "inner/../new.gif").is_err());
        #[cfg(unix)]
        assert!(outputs("link.png", "new.gif").is_err());
    }

    #[test]
    fn what_cannot_be_written_is_told_before() {
        let folder = Folder::new("tried");
        assert!(folder.checked("a.plan", "none/b.mcap").is_err());
        assert!(folder.checked("a.plan", "inner").is_err());
        assert!(folder.checked("/dev/null", "/dev/null").is_ok());
        let within = folder.0.join("a.plan/frames");
        let outputs = Outputs::default().folder("--frames", Some(&within));
        assert!(outputs.check().is_err());
        let new = folder.0.join("new/frames");
        let outputs = Outputs::default().folder("--frames", Some(&new));
        assert!(outputs.check().is_ok());
        assert_eq!(fs::read_dir(&new).expect("it is made").count(), 0);
    }
}
