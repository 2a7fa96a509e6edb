//! Making the kernel known to Jupyter: a folder with a description.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};
use thiserror::Error;

/// The file that describes a kernel, and the one that shows its picture.
const DESCRIPTION: &str = "kernel.json";
const LOGO: &str = "logo-64x64.png";
/// The language, by which a description is known to be ours.
const LANGUAGE: &str = "plan";

/// For whom the kernel is installed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Place {
    /// This user.
    User,
    /// All that use the programs below a folder.
    Prefix(PathBuf),
    /// All that use the Python environment at hand.
    Environment,
}

/// A kernel as Jupyter is told of it.
#[derive(Clone, Debug)]
pub(crate) struct Specification {
    /// The name of its folder.
    pub(crate) name: String,
    /// The program with its arguments; the connection file comes last.
    pub(crate) command: Vec<String>,
}

/// Why a kernel cannot be installed or removed.
#[derive(Debug, Error)]
pub(crate) enum InstallError {
    /// The name cannot be a folder of Jupyter.
    #[error("{0:?} cannot be the name of a kernel: letters, digits and . _ - can")]
    Name(String),
    /// The environment does not say where the user's files are.
    #[error(
        "it is not known where Jupyter keeps its files: neither HOME nor JUPYTER_DATA_DIR is set"
    )]
    NoHome,
    /// There is no Python environment.
    #[error("there is no Python environment at hand: activate one, or use --prefix")]
    NoEnvironment,
    /// There is no such kernel.
    #[error("there is no kernel at {}", .0.display())]
    Missing(PathBuf),
    /// Another program's kernel has that name.
    #[error("the kernel at {} is not planwright's; use another --name", .0.display())]
    Foreign(PathBuf),
    /// A file cannot be written.
    #[error("cannot write {}: {error}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
}

impl Place {
    /// The folder of Jupyter's data.
    fn folder(&self, variable: impl Fn(&str) -> Option<OsString>) -> Result<PathBuf, InstallError> {
        let set = |name: &str| {
            let value = variable(name).filter(|value| !value.is_empty());
            value.map(PathBuf::from)
        };
        match self {
            Place::Prefix(prefix) => Ok(prefix.join("share/jupyter")),
            Place::Environment => {
                let prefix = set("VIRTUAL_ENV").or_else(|| set("CONDA_PREFIX"));
                let prefix = prefix.or_else(python_prefix);
                let prefix = prefix.ok_or(InstallError::NoEnvironment)?;
                Ok(prefix.join("share/jupyter"))
            }
            Place::User => {
                let home = || set("HOME").ok_or(InstallError::NoHome);
                if let Some(folder) = set("JUPYTER_DATA_DIR") {
                    Ok(folder)
                } else if cfg!(target_os = "macos") {
                    Ok(home()?.join("Library/Jupyter"))
                } else if cfg!(windows) {
                    let data = set("APPDATA").ok_or(InstallError::NoHome)?;
                    Ok(data.join("jupyter"))
                } else {
                    match set("XDG_DATA_HOME").filter(|folder| folder.is_absolute()) {
                        Some(folder) => Ok(folder.join("jupyter")),
                        None => Ok(home()?.join(".local/share/jupyter")),
                    }
                }
            }
        }
    }

    /// The folder of a kernel.
    fn of_kernel(&self, name: &str) -> Result<PathBuf, InstallError> {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
        let is_name = !name.trim_matches('.').is_empty() && name.chars().all(is_plain);
        if !is_name {
            return Err(InstallError::Name(name.to_owned()));
        }
        let folder = self.folder(|variable| std::env::var_os(variable))?;
        Ok(folder.join("kernels").join(name))
    }
}

/// Where Python keeps what belongs to it.
fn python_prefix() -> Option<PathBuf> {
    let mut python = Command::new("python3");
    let told = python
        .args(["-c", "import sys; print(sys.prefix)"])
        .output();
    let told = String::from_utf8(told.ok()?.stdout).ok()?;
    Some(PathBuf::from(told.trim())).filter(|prefix| prefix.is_absolute())
}

impl Specification {
    fn description(&self) -> Value {
        let mut command = self.command.clone();
        command.push("{connection_file}".to_owned());
        json!({
            "argv": command,
            "display_name": self.name,
            "language": LANGUAGE,
            "interrupt_mode": "message",
            "metadata": {},
        })
    }

    /// Writes the description and a picture; returns the folder. A description is there as a whole
    /// or not at all.
    pub(crate) fn install(&self, place: &Place, logo: &[u8]) -> Result<PathBuf, InstallError> {
        let folder = place.of_kernel(&self.name)?;
        if folder.exists() {
            check_ours(&folder)?;
        }
        let failed = |path: &Path| {
            let path = path.to_owned();
            move |error| InstallError::Write { path, error }
        };
        fs::create_dir_all(&folder).map_err(failed(&folder))?;
        let text = format!("{:#}\n", self.description());
        for (name, bytes) in [(LOGO, logo), (DESCRIPTION, text.as_bytes())] {
            let path = folder.join(name);
            let unfinished = folder.join(format!(".{name}.{}", std::process::id()));
            let written = fs::write(&unfinished, bytes);
            let written = written.and_then(|()| fs::rename(&unfinished, &path));
            if written.is_err() {
                // There may be nothing to remove.
                let _ = fs::remove_file(&unfinished);
                let _ = fs::remove_dir(&folder);
            }
            written.map_err(failed(&path))?;
        }
        Ok(folder)
    }

    /// Removes the kernel of a name; returns where it was.
    pub(crate) fn uninstall(name: &str, place: &Place) -> Result<PathBuf, InstallError> {
        let folder = place.of_kernel(name)?;
        if !folder.exists() {
            return Err(InstallError::Missing(folder));
        }
        check_ours(&folder)?;
        fs::remove_dir_all(&folder).map_err(|error| InstallError::Write {
            path: folder.clone(),
            error,
        })?;
        Ok(folder)
    }
}

/// Makes sure that a folder, unless it is empty, describes a kernel of planwright.
fn check_ours(folder: &Path) -> Result<(), InstallError> {
    let mut entries = fs::read_dir(folder).into_iter().flatten();
    let text = fs::read_to_string(folder.join(DESCRIPTION));
    let description: Option<Value> = text.ok().and_then(|t| serde_json::from_str(&t).ok());
    let is_ours = description.is_some_and(|found| found["language"] == json!(LANGUAGE));
    match is_ours || entries.next().is_none() {
        true => Ok(()),
        false => Err(InstallError::Foreign(folder.to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(set: &[(&str, &str)]) -> Option<PathBuf> {
        let variable = |name: &str| {
            let found = set.iter().find(|(known, _)| *known == name);
            found.map(|(_, value)| OsString::from(value))
        };
        Place::User.folder(variable).ok()
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn the_folder_is_the_one_where_jupyter_looks() {
        let home = ("HOME", "/h");
        assert_eq!(folder(&[home]), Some("/h/.local/share/jupyter".into()));
        let data = ("XDG_DATA_HOME", "/d");
        assert_eq!(folder(&[home, data]), Some("/d/jupyter".into()));
        let own = ("JUPYTER_DATA_DIR", "/j");
        assert_eq!(folder(&[home, data, own]), Some("/j".into()));
        assert_eq!(folder(&[("HOME", "")]), None);
    }

    #[test]
    fn a_kernel_is_installed_again_and_removed() {
        let prefix = std::env::temp_dir().join(format!("kernel-{}", std::process::id()));
        let place = Place::Prefix(prefix.clone());
        let specification = Specification {
            name: "plan-1.0".to_owned(),
            command: vec![
                "/bin/planwright".to_owned(),
                "jupyter".to_owned(),
                "run".to_owned(),
            ],
        };
        for _ in 0..2 {
            let folder = specification
                .install(&place, b"png")
                .expect("it can be installed");
            assert_eq!(folder, prefix.join("share/jupyter/kernels/plan-1.0"));
            let text = fs::read_to_string(folder.join(DESCRIPTION)).expect("it is there");
            let read: Value = serde_json::from_str(&text).expect("it is JSON");
            assert_eq!(read["argv"][3], json!("{connection_file}"));
        }
        let remove = || Specification::uninstall("plan-1.0", &place);
        assert!(remove().is_ok());
        assert!(matches!(remove(), Err(InstallError::Missing(_))));
        fs::remove_dir_all(&prefix).expect("the folder is there");
    }

    #[test]
    fn another_programs_kernel_is_left_alone() {
        let prefix = std::env::temp_dir().join(format!("foreign-{}", std::process::id()));
        let place = Place::Prefix(prefix.clone());
        let folder = prefix.join("share/jupyter/kernels/python3");
        fs::create_dir_all(&folder).expect("the folder can be made");
        fs::write(folder.join(DESCRIPTION), r#"{"language": "python"}"#)
            .expect("it can be written");
        let specification = Specification {
            name: "python3".to_owned(),
            command: Vec::new(),
        };
        assert!(matches!(
            specification.install(&place, b""),
            Err(InstallError::Foreign(_))
        ));
        let removed = Specification::uninstall("python3", &place);
        assert!(matches!(removed, Err(InstallError::Foreign(_))));
        fs::remove_dir_all(&prefix).expect("the folder is there");
    }

    #[test]
    fn names_do_not_lead_elsewhere() {
        let place = Place::Prefix(PathBuf::from("/p"));
        for name in ["", ".", "..", "a/b", "a b", "ä"] {
            assert!(
                matches!(place.of_kernel(name), Err(InstallError::Name(_))),
                "{name}"
            );
        }
    }
}
