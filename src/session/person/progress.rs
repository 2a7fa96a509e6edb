//! What a person has done of lessons, in a small file that outlives the session.

use std::io;
use std::sync::Arc;

use lisp::files::Files;

/// Maximum number of lessons that are remembered, and of characters of their names.
const MAX_LESSONS: usize = 1000;
const MAX_NAME: usize = 100;
/// Maximum number of steps that a lesson is believed to have.
const MAX_STEPS: usize = 1000;

/// What has been done of a lesson.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Done {
    /// Its name.
    pub lesson: String,
    /// The number of steps that were done at the same time, at most.
    pub steps: usize,
    /// The number of all steps.
    pub all: usize,
}

/// The file in which that is kept: a line for each lesson, its name and the two numbers.
#[derive(Clone, Debug)]
pub(crate) struct Progress {
    path: String,
    /// Part of the name of the file that is written first.
    mark: String,
    files: Arc<dyn Files>,
}

impl Progress {
    /// The file with a path.
    pub(crate) fn new(path: String, mark: &str, files: Arc<dyn Files>) -> Progress {
        let mark = mark.to_owned();
        Progress { path, mark, files }
    }

    /// What it says. Lines that make no sense are left out, and so is a file that cannot be read.
    pub(crate) fn all(&self) -> Vec<Done> {
        let bytes = self.files.read_plan(&self.path).unwrap_or_default();
        let text = String::from_utf8_lossy(&bytes);
        let mut all: Vec<Done> = Vec::new();
        for done in text.lines().filter_map(of_line).take(MAX_LESSONS) {
            all.retain(|known| known.lesson != done.lesson);
            all.push(done);
        }
        all
    }

    /// So many steps of a lesson are done. Nothing that was done before is forgotten, unless the lesson has
    /// another number of steps now.
    ///
    /// # Errors
    ///
    /// The file cannot be written.
    pub(crate) fn keep(&self, done: Done) -> io::Result<()> {
        let mut all = self.all();
        let known = all.iter().find(|known| known.lesson == done.lesson);
        if known.is_some_and(|known| known.all == done.all && known.steps >= done.steps) {
            return Ok(());
        }
        all.retain(|known| known.lesson != done.lesson);
        all.push(done);
        let first = all.len().saturating_sub(MAX_LESSONS);
        let lines = all.iter().skip(first);
        let text: String = lines
            .map(|done| format!("{} {} {}\n", done.lesson, done.steps, done.all))
            .collect();
        if let Some((folder, _)) = self.path.rsplit_once(['/', '\\']) {
            self.files.create_folders(folder)?;
        }
        // The file is whole at any time.
        let new = format!("{}.{}.new", self.path, self.mark);
        self.files.write(&new, text.as_bytes())?;
        self.files.rename(&new, &self.path).inspect_err(|_| {
            // What is left over does no harm.
            let _ = self.files.remove(&new);
        })
    }
}

/// What a line says.
fn of_line(line: &str) -> Option<Done> {
    let mut words = line.split(' ');
    let (lesson, steps, all) = (words.next()?, words.next()?, words.next()?);
    let is_name = |c: char| c.is_alphanumeric() || "-_+*/.".contains(c);
    let is_name = !lesson.is_empty() && lesson.len() <= MAX_NAME && lesson.chars().all(is_name);
    let (steps, all) = (steps.parse().ok()?, all.parse().ok()?);
    let is_possible = is_name && words.next().is_none() && steps <= all && all <= MAX_STEPS;
    is_possible.then(|| Done {
        lesson: lesson.to_owned(),
        steps,
        all,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lisp::files::Disk;

    fn done(lesson: &str, steps: usize, all: usize) -> Done {
        Done {
            lesson: lesson.to_owned(),
            steps,
            all,
        }
    }

    fn in_folder(test: &str, work: impl FnOnce(&Progress, &std::path::Path)) {
        let name = format!("planwright-progress-{test}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let path = folder.join("state").join("lessons");
        let progress = Progress::new(path.display().to_string(), "test", Arc::new(Disk));
        work(&progress, &path);
        // It may not be there.
        let _ = std::fs::remove_dir_all(&folder);
    }

    #[test]
    fn what_was_done_is_remembered_and_the_best_counts() {
        in_folder("kept", |progress, _| {
            assert_eq!(progress.all(), []);
            for kept in [
                done("a", 1, 3),
                done("b", 2, 2),
                done("a", 3, 3),
                done("a", 2, 3),
            ] {
                progress.keep(kept).unwrap();
            }
            assert_eq!(progress.all(), [done("b", 2, 2), done("a", 3, 3)]);
            // The lesson has changed.
            progress.keep(done("a", 1, 4)).unwrap();
            assert_eq!(progress.all(), [done("b", 2, 2), done("a", 1, 4)]);
        });
    }

    #[test]
    fn a_damaged_file_says_what_it_can_and_is_mended() {
        in_folder("damaged", |progress, path| {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            let long = "x".repeat(200);
            let text = format!(
                "a 1 3\n\0\n\u{1b}[31m 1 1\nb 3 2\nc x 1\n{long} 1 1\nd 1 99999999\ne 1\na 2 3\nf 1 1 1\n"
            );
            std::fs::write(path, [text.as_bytes(), b"\xff\xfe 1 1\n"].concat()).unwrap();
            assert_eq!(progress.all(), [done("a", 2, 3)]);
            progress.keep(done("g", 0, 1)).unwrap();
            assert_eq!(std::fs::read_to_string(path).unwrap(), "a 2 3\ng 0 1\n");
        });
    }

    #[test]
    fn what_cannot_be_written_is_an_error_and_leaves_nothing_behind() {
        in_folder("unwritable", |progress, path| {
            // A folder stands where the file should be.
            std::fs::create_dir_all(path).unwrap();
            assert_eq!(progress.all(), []);
            assert!(progress.keep(done("a", 1, 1)).is_err());
            let beside = std::fs::read_dir(path.parent().unwrap()).unwrap().count();
            assert_eq!(beside, 1);
        });
        let nowhere = Progress::new("/proc/no/such/lessons".to_owned(), "test", Arc::new(Disk));
        assert!(nowhere.keep(done("a", 1, 1)).is_err());
    }
}
