//! Has submissions graded by other processes, which they may kill or hold up.

use std::env;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use super::submission::Submission;
use super::worker::{Answer, Work};
use crate::command::options::Options;
use crate::grade_report::Graded;
use sweep::{Ending, Mark, Record};

/// Memory that a submission may use unless --heap says otherwise.
const USUAL_HEAP: usize = 512 << 20;
/// Real time that a worker has to begin, and to end a world.
const PATIENCE: Duration = Duration::from_secs(30);
/// After so many worlds that a submission could not end, it is not run in others.
const MAX_HOPELESS: usize = 2;
/// Maximum number of bytes of a worker's answer.
const MAX_ANSWER: u64 = 16 << 20;
/// Maximum number of bytes of a page with a run.
const MAX_PAGE: u64 = 32 << 20;

/// Has submissions graded.
pub(super) struct Supervisor {
    pub(super) lesson: PathBuf,
    pub(super) options: Options,
    pub(super) seed: u64,
    pub(super) worlds: u64,
    pub(super) wall_clock: Duration,
    /// The folder for pages, if they are wanted.
    pub(super) pages: Option<PathBuf>,
}

impl Supervisor {
    /// What comes of a submission in all worlds.
    pub(super) fn grade(&self, submission: Submission) -> Graded {
        let mut graded = Graded {
            student: submission.student,
            file: submission.file,
            ..Graded::default()
        };
        match submission.text {
            Ok(text) => graded.text = text,
            Err(why) => {
                let why = format!("It cannot be read: {why}.");
                let unread = |world| lost(world, Ending::Failure, &why);
                graded.marks = (0..self.worlds).map(unread).collect();
                return graded;
            }
        }
        while (graded.marks.len() as u64) < self.worlds {
            let from = graded.marks.len() as u64;
            if graded.marks.iter().filter(|mark| is_hopeless(mark)).count() >= MAX_HOPELESS
                && let Some(last) = graded.marks.last().cloned()
            {
                let world = from;
                graded
                    .marks
                    .push(lost(world, last.record.outcome, &last.why));
                continue;
            }
            let ended = self.run_worker(&mut graded, from, self.worlds, None);
            if let Err(why) = ended {
                let world = graded.marks.len() as u64;
                if world < self.worlds {
                    graded.marks.push(lost(world, Ending::Crashed, &why));
                }
            }
        }
        self.keep_replay(&mut graded);
        graded
    }

    /// Has a worker run some worlds; what it says is noted. An error says why it did not end as it should.
    fn run_worker(
        &self,
        graded: &mut Graded,
        from: u64,
        to: u64,
        keep: Option<PathBuf>,
    ) -> Result<(), String> {
        let work = Work {
            lesson: self.lesson.clone(),
            file: place_name(&graded.file),
            text: graded.text.clone(),
            seed: self.seed,
            from,
            to,
            wall_clock: self.wall_clock,
            checks: from == 0 && keep.is_none(),
            keep,
        };
        let mut child = self.start(&work)?;
        let answers = answers(&mut child);
        let patience = self.wall_clock * 2 + PATIENCE;
        let ended = loop {
            match answers.recv_timeout(patience) {
                Ok(Answer::Style(style)) => graded.style = style,
                Ok(Answer::Mark(mark)) if work.keep.is_none() => {
                    graded.marks.push(*mark);
                    let hopeless = graded.marks.iter().filter(|mark| is_hopeless(mark)).count();
                    if hopeless >= MAX_HOPELESS {
                        break Ok(());
                    }
                }
                Ok(Answer::Mark(_)) => {}
                Ok(Answer::Done) => break Ok(()),
                Err(mpsc::RecvTimeoutError::Timeout) => {
                    break Err("It cannot be stopped; its process was ended.".to_owned());
                }
                Err(mpsc::RecvTimeoutError::Disconnected) => {
                    break Err("It ends the process in which it runs.".to_owned());
                }
            }
        };
        // It may have ended by itself.
        let _ = child.kill();
        let _ = child.wait();
        ended
    }

    /// Starts a worker and says what it is to do.
    fn start(&self, work: &Work) -> Result<Child, String> {
        let started = || -> std::io::Result<Child> {
            let mut command = Command::new(env::current_exe()?);
            command.args(["grade", "--worker", "--seed", &self.seed.to_string()]);
            let heap = self.options.heap.unwrap_or(USUAL_HEAP);
            command.args(["--heap", &heap.to_string()]);
            let files = [
                ("--world", &self.options.world),
                ("--world-description", &self.options.world_description),
                ("--robot", &self.options.robot),
                ("--robot-description", &self.options.robot_description),
            ];
            for (option, path) in files {
                if let Some(path) = path {
                    command.arg(option).arg(path);
                }
            }
            for path in &self.options.package_path {
                command.arg("--package-path").arg(path);
            }
            if let Some(noise) = &self.options.noise {
                command.arg(format!("--noise={noise}"));
            }
            if self.options.faithful {
                command.arg("--faithful");
            }
            let mut child = command
                .stdin(Stdio::piped())
                .stdout(Stdio::piped())
                .stderr(Stdio::null())
                .spawn()?;
            if let Some(mut input) = child.stdin.take() {
                input.write_all(serde_json::to_string(work)?.as_bytes())?;
            }
            Ok(child)
        };
        started().map_err(|error| format!("No process can be started for it: {error}."))
    }

    /// Runs the first world again that was not passed, to keep what happens there.
    fn keep_replay(&self, graded: &mut Graded) {
        let Some(folder) = &self.pages else {
            return;
        };
        let shows = |mark: &&Mark| {
            !mark.is_passed()
                && matches!(
                    mark.record.outcome,
                    Ending::Failure | Ending::Expectation | Ending::Limit
                )
        };
        let Some(world) = graded
            .marks
            .iter()
            .find(shows)
            .map(|mark| mark.record.world)
        else {
            return;
        };
        let name = format!(
            ".run-{}-{:?}.html",
            std::process::id(),
            thread::current().id()
        );
        let name: String = name.chars().filter(|c| !"()".contains(*c)).collect();
        let path = folder.join(name);
        let path = std::path::absolute(&path).unwrap_or(path);
        let kept = self.run_worker(graded, world, world + 1, Some(path.clone()));
        let is_small = fs::metadata(&path).is_ok_and(|known| known.len() <= MAX_PAGE);
        if kept.is_ok()
            && is_small
            && let Ok(page) = fs::read_to_string(&path)
        {
            graded.replay = Some((world, page));
        }
        let _ = fs::remove_file(&path);
    }
}

/// The name of a submission in places: folders differ between machines.
fn place_name(file: &str) -> String {
    let name = Path::new(file).file_name();
    name.map_or_else(
        || file.to_owned(),
        |name| name.to_string_lossy().into_owned(),
    )
}

/// Whether a submission could not end by itself in a world.
fn is_hopeless(mark: &Mark) -> bool {
    matches!(
        mark.record.outcome,
        Ending::Endless | Ending::Timeout | Ending::Crashed
    ) || matches!(
        mark.record.class.as_deref(),
        Some("OUTPUT" | "HEAP-EXHAUSTED-ERROR")
    )
}

/// The answers of a worker, as they come.
fn answers(child: &mut Child) -> Receiver<Answer> {
    let (sender, receiver) = mpsc::channel();
    if let Some(output) = child.stdout.take() {
        thread::spawn(move || {
            let mut lines = BufReader::new(output);
            loop {
                let mut line = String::new();
                let read = lines.by_ref().take(MAX_ANSWER).read_line(&mut line);
                if !matches!(read, Ok(1..)) {
                    return;
                }
                // What is no answer ends the conversation.
                let Ok(answer) = serde_json::from_str(&line) else {
                    return;
                };
                if sender.send(answer).is_err() {
                    return;
                }
            }
        });
    }
    receiver
}

/// The mark of a world of which no worker has told.
fn lost(world: u64, ending: Ending, why: &str) -> Mark {
    Mark {
        record: Record::new(world, ending),
        why: why.to_owned(),
        line: None,
        printed: String::new(),
    }
}
