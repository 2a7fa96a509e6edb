//! Grades what students hand in: each submission in processes and worlds of its own.

mod options;
mod submission;
mod supervisor;
mod worker;

use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::failure::{CommandError, Status};
use super::open::open_session;
use super::options::{LogLevel, Options};
use super::outputs::Outputs;
use super::sweep::{pool, worker::threads};
use crate::grade_report::{Graded, Task, class_page, csv, junit, student_page, table};
pub(crate) use options::GradeArguments;
use session::lesson_file::LessonFile;
use submission::Submission;
use supervisor::Supervisor;
use sweep::Ending;

/// Grades the submissions and tells what came of them.
pub(crate) fn grade(options: &Options, wanted: &GradeArguments) -> Result<Status, CommandError> {
    if wanted.worker {
        return worker::work(options);
    }
    let path = lesson_path(&wanted.lesson)?;
    let file = lesson_file(&path)?;
    let outputs = Outputs::reading(wanted.files.iter().chain([&path]))
        .file("--csv", wanted.csv.as_ref())
        .file("--junit", wanted.junit.as_ref())
        .folder("--html", wanted.html.as_ref());
    outputs.check()?;
    let quiet = Options {
        log_level: LogLevel::None,
        realtime: None,
        ..options.clone()
    };
    let mut session = open_session(&quiet)?;
    let plan = file.load(&mut session).map_err(CommandError::Grade)?;
    drop(session);
    if !plan.has_run {
        return Err(CommandError::Grade(format!(
            "{}: the lesson {} is for the prompt: without (run FORM …) there is nothing to grade",
            file.name, plan.name
        )));
    }
    let submissions = match (wanted.files.as_slice(), &plan.solution) {
        ([], Some(text)) => vec![Submission::solution(text)],
        ([], None) => {
            return Err(CommandError::Grade(format!(
                "{} has no solution that could be graded: name files to grade",
                file.name
            )));
        }
        (files, _) => submission::read_all(files),
    };
    let task = Task {
        name: plan.name,
        title: plan.title,
        steps: plan
            .steps
            .into_iter()
            .map(|step| (step.name, step.text))
            .collect(),
        seed: options.seed,
        worlds: wanted.worlds.map_or(plan.worlds, |worlds| worlds.get()),
    };
    let supervisor = Supervisor {
        lesson: path,
        options: quiet,
        seed: task.seed,
        worlds: task.worlds,
        wall_clock: Duration::from_secs_f64(wanted.time_limit),
        pages: wanted.html.clone(),
    };
    let count = submissions.len();
    let mut done = 0;
    let shows = io::stderr().is_terminal();
    let all: Vec<Graded> = pool::in_order(
        wanted.threads.map_or_else(threads, usize::from),
        submissions,
        || |submission| supervisor.grade(submission),
        |_| {
            done += 1;
            if shows {
                // If standard error is closed, nobody wants to know.
                let _ = write!(io::stderr(), "\r{done}/{count} submissions\x1b[K");
            }
            true
        },
    );
    if shows {
        let _ = write!(io::stderr(), "\r\x1b[K");
    }
    if let Some(mistake) = mistake(&all) {
        return Err(CommandError::Grade(mistake));
    }
    report(wanted, &task, &all)
}

/// What is wrong with the lesson itself, if a mark says that.
fn mistake(all: &[Graded]) -> Option<String> {
    let marks = all.iter().flat_map(|one| &one.marks);
    let mistaken = marks
        .into_iter()
        .find(|mark| mark.record.outcome == Ending::Mistake)?;
    Some(format!(
        "{} [in the lesson, world {}]",
        mistaken.why, mistaken.record.world
    ))
}

/// Writes the table, and what else is asked for.
fn report(wanted: &GradeArguments, task: &Task, all: &[Graded]) -> Result<Status, CommandError> {
    let write = |path: &Path, text: &str| {
        fs::write(path, text).map_err(|error| CommandError::Rewrite {
            path: path.to_owned(),
            error,
        })
    };
    if let Some(path) = &wanted.csv {
        write(path, &csv(task, all))?;
    }
    if let Some(path) = &wanted.junit {
        write(path, &junit(task, all))?;
    }
    if let Some(folder) = &wanted.html {
        let files = submission::page_names(all.iter().map(|one| one.student.as_str()));
        for (one, file) in all.iter().zip(&files) {
            write(&folder.join(file), &student_page(task, one))?;
        }
        write(&folder.join("index.html"), &class_page(task, all, &files))?;
    }
    write!(io::stdout(), "{}", table(task, all))?;
    let marks = || all.iter().flat_map(|one| &one.marks);
    Ok(
        if marks().any(|mark| mark.record.outcome == Ending::Defect) {
            Status::Defective
        } else if all.iter().all(Graded::is_passed) {
            Status::Good
        } else {
            Status::Bad
        },
    )
}

/// Where a lesson is: a file, or the name of one that is built in.
fn lesson_path(name: &str) -> Result<PathBuf, CommandError> {
    let mut names = plan_files::lesson_names();
    if let Some(known) = names.find(|known| known.eq_ignore_ascii_case(name)) {
        return Ok(PathBuf::from(format!("plans/lessons/{known}.lesson")));
    }
    if Path::new(name).is_file() || name.contains(['/', '.']) {
        return Ok(PathBuf::from(name));
    }
    let names: Vec<&str> = plan_files::lesson_names().collect();
    let near = closest_name::closest_name(name, names.iter().copied());
    Err(CommandError::Grade(match near {
        Some(near) => format!("there is no lesson {name}; did you mean {near}?"),
        None => format!(
            "there is no lesson {name}: a file such as my.lesson was expected, or one of {}",
            names.join(", ")
        ),
    }))
}

/// The file of a lesson.
fn lesson_file(path: &Path) -> Result<LessonFile, CommandError> {
    Ok(LessonFile {
        name: path.display().to_string(),
        text: super::failure::read(path)?,
    })
}
