//! What students hand in.

use std::fs;
use std::path::{Path, PathBuf};

use lisp::files::text_of;

/// Maximum number of bytes of a submission.
const MAX_BYTES: u64 = 1 << 20;

/// What a student has handed in.
#[derive(Clone, Debug)]
pub(super) struct Submission {
    /// Who: the name of the file, without its folder and its ending.
    pub(super) student: String,
    /// The file, as it was named.
    pub(super) file: String,
    /// Its text, or why it cannot be read.
    pub(super) text: Result<String, String>,
}

impl Submission {
    /// The lesson's own solution.
    pub(super) fn solution(text: &str) -> Submission {
        Submission {
            student: "solution".to_owned(),
            file: "solution".to_owned(),
            text: Ok(text.to_owned()),
        }
    }
}

/// All submissions, in the order in which they are named.
pub(super) fn read_all(files: &[PathBuf]) -> Vec<Submission> {
    let stems = || files.iter().map(|path| stem(path));
    let read = |path: &PathBuf| {
        let file = path.display().to_string();
        let student = stem(path);
        let is_shared = stems().filter(|other| *other == student).count() > 1;
        Submission {
            student: if is_shared { file.clone() } else { student },
            text: read(path),
            file,
        }
    };
    files.iter().map(read).collect()
}

fn stem(path: &Path) -> String {
    let stem = path
        .file_stem()
        .map(|stem| stem.to_string_lossy().into_owned());
    stem.unwrap_or_else(|| path.display().to_string())
}

fn read(path: &Path) -> Result<String, String> {
    let bytes = fs::metadata(path).map_err(|error| error.to_string())?.len();
    if bytes > MAX_BYTES {
        return Err(format!(
            "it has {bytes} bytes, and a plan has {MAX_BYTES} at most"
        ));
    }
    text_of(path).map_err(|error| error.to_string())
}

/// Names of the pages of students: of letters, digits, hyphens and underscores, each another one.
pub(super) fn page_names<'a>(students: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for student in students {
        let plain = |c: char| {
            if c.is_alphanumeric() || "-_".contains(c) {
                c
            } else {
                '-'
            }
        };
        let base: String = student.chars().map(plain).take(80).collect();
        // INDEX is the same file on some systems.
        let base = if base.eq_ignore_ascii_case("index") {
            format!("{base}-")
        } else {
            base
        };
        let mut name = format!("{base}.html");
        let mut number = 2;
        while names
            .iter()
            .any(|known| known.to_lowercase() == name.to_lowercase())
        {
            name = format!("{base}-{number}.html");
            number += 1;
        }
        names.push(name);
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_stay_in_their_folder_and_do_not_overwrite_each_other() {
        let students = ["../../etc/x", "Ann", "ann", "index", "a\u{1b}[31m"];
        let names = page_names(students.into_iter());
        let expected = [
            "------etc-x.html",
            "Ann.html",
            "ann-2.html",
            "index-.html",
            "a--31m.html",
        ];
        assert_eq!(names, expected);
    }
}
