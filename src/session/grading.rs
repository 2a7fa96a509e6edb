//! Grades submissions: each in worlds of its own, judged in an image that it has never seen.

use std::path::Path;
use std::rc::Rc;
use std::time::Duration;

use crate::Session;
use crate::bounds::{Limit, Limits};
use crate::deeds::{Deed, Deeds};
use crate::dialogue::{Evaluate, Finding};
use crate::face::{Datum, Failure};
use crate::lesson_file::{LessonFile, LessonPlan};
use crate::person::Snapshot;
use cram::Handlers;
use sweep::pairs::Pairs;
use sweep::{Ending, Mark, Record};

/// Where a lesson's own mistakes are.
const LESSON: &str = "lesson";
/// Looks for an interrupt that the lesson's own forms may take.
const MAX_LESSON_LOOKS: u64 = 1_000_000;
/// Maximum number of characters of what a submission prints that are kept.
const MAX_KEPT: usize = 2000;
/// Share of the looks after which cleaning up is ended, too.
const CLEANING: u64 = 10;
/// The class of conditions that tell a plan of a limit to memory.
const HEAP_EXHAUSTED: &str = "HEAP-EXHAUSTED-ERROR";

/// What a submission may use in a world, besides the simulated time that the lesson allows.
#[derive(Clone, Copy, Debug)]
pub struct Allowance {
    /// Real time.
    pub wall_clock: Duration,
    /// Looks for an interrupt: what it may calculate.
    pub looks: u64,
    /// Bytes that it may print.
    pub output: usize,
}

/// Grades submissions to a lesson. Each is loaded and run in a closed copy of a session in which the world has
/// been set up; then the world is taken over into another copy, which judges it.
pub struct Grader {
    /// A session in which the lesson has been loaded, and nothing else done.
    loaded: Session,
    plan: LessonPlan,
    allowance: Allowance,
}

impl Grader {
    /// A grader for the lesson of a file, in a fresh session.
    ///
    /// # Errors
    ///
    /// What is wrong with the lesson.
    pub fn open(
        mut session: Session,
        file: &LessonFile,
        given: &[(String, String)],
        allowance: Allowance,
    ) -> Result<Grader, String> {
        let plan = file.load(&mut session)?;
        for (name, text) in given {
            let loaded = session.run(name, text);
            loaded.map_err(|failure| format!("{name}: {failure}"))?;
        }
        session.end_set_up();
        if let Err(what) = session.copied() {
            return Err(format!(
                "{}: what the lesson is given leaves {what}, which no world can have a copy of: leave that out",
                file.name
            ));
        }
        Ok(Grader {
            loaded: session,
            plan,
            allowance,
        })
    }

    /// What the lesson says.
    pub fn plan(&self) -> &LessonPlan {
        &self.plan
    }

    /// What `check` finds in a submission.
    pub fn check(&self, name: &str, text: &str) -> Vec<Finding> {
        let found = defect::caught(|| {
            let mut session = self.loaded.copied().ok()?;
            session.close();
            // Macros of the submission are expanded, which may take for ever.
            let polls = session.image_mut().polls();
            polls.begin(Some(self.allowance.looks));
            polls.set_again(Some((self.allowance.looks / CLEANING).max(1)));
            Some(session.check(name, text))
        });
        found.ok().flatten().unwrap_or_default()
    }

    /// What comes of a submission in a world. `keep` is where to write the run as a page.
    pub fn run(&self, name: &str, text: &str, seed: u64, world: u64, keep: Option<&Path>) -> Mark {
        let run = || self.run_in(name, text, seed, world, keep);
        match defect::caught(run) {
            Ok(Ok(mark)) => mark,
            Ok(Err(mistake)) => unrun(world, Ending::Mistake, mistake),
            Err(defect) => unrun(world, Ending::Defect, defect.to_string()),
        }
    }

    fn run_in(
        &self,
        name: &str,
        text: &str,
        seed: u64,
        world: u64,
        keep: Option<&Path>,
    ) -> Result<Mark, String> {
        let form = format!("(planwright::%begin-lesson {seed} {world})");
        let begun = || -> Result<(Session, Vec<Datum>), String> {
            let mut session = self.loaded.copied().map_err(str::to_owned)?;
            let told = ask(&mut session, &form)?;
            Ok((session, told))
        };
        let (mut judge, told) = begun()?;
        if let Some(Datum::List(invalid)) = told.first() {
            let texts = invalid.iter().filter_map(Datum::as_text);
            let why = texts.collect::<Vec<_>>().join(": ");
            return Ok(unrun(world, Ending::Invalid, why));
        }
        // The same once more: what a plan of the lesson's has left could not be copied.
        let (mut session, _) = begun()?;
        ask(&mut session, "(planwright::%inject-lesson-faults)")?;
        session.end_set_up();
        if let Some(path) = keep {
            let kept = session.keep_run(path);
            kept.map_err(|error| error.to_string())?;
        }
        session.close();
        let tried = self.try_out(&mut session, name, text);
        if keep.is_some() {
            let written = session.write_kept_run();
            written.map_err(|error| error.to_string())?;
        }
        let ended = tried.failure.as_ref().map(class_of);
        let mut deeds = tried.deeds.all();
        deeds.push(Deed::Ended(ended));
        // The submission cannot have seen the image that judges.
        let end = Snapshot::take(&session.evaluator.host.simulation);
        end.adopt(&mut judge.evaluator.host.simulation);
        Deeds::of(&mut judge.evaluator.image).set(deeds);
        let answers = ask(&mut judge, "(planwright::%judge-lesson)")?;
        let mut record = Record::new(world, Ending::Success);
        record.expectations = answers_of(&answers);
        record.handlers = {
            let image = &mut session.evaluator.image;
            Pairs(Handlers::of(image).counts(image))
        };
        session.evaluator.host.simulation.complete(&mut record);
        let mut steps = self.plan.steps.iter();
        let unmet = steps.find(|step| record.expectations.get(&step.name) != Some(&true));
        let mut mark = Mark {
            record,
            why: String::new(),
            line: None,
            printed: tried.printed,
        };
        if let Some(failure) = &tried.failure {
            self.explain(failure, tried.is_loud, name, &mut mark);
            if let Failure::Unhandled(_) = failure {
                let simulation = &session.evaluator.host.simulation;
                mark.record.cause = simulation.failed_by();
                mark.record.bodies = simulation.bodies_of_failure();
            }
        } else if let Some(step) = unmet {
            mark.record.outcome = Ending::Expectation;
            mark.record.class = Some(step.name.clone());
            mark.why = format!("It ends, but this was not done: {}", step.text);
        }
        Ok(mark)
    }

    /// Loads the submission and runs what the lesson asks for.
    fn try_out(&self, session: &mut Session, name: &str, text: &str) -> Tried {
        let deeds = Rc::new(Deeds::default());
        session.note_deeds(Rc::clone(&deeds));
        let (_, printed) = session.keep_output(MAX_KEPT, self.allowance.output);
        let began = session.time();
        session.evaluator.host.simulation.begin_tally();
        let limits = |simulated: f64| Limits {
            simulated_time: Some(simulated),
            wall_clock: Some(self.allowance.wall_clock),
            looks: Some(self.allowance.looks),
            grace: Duration::from_millis(200),
            ..Limits::NONE
        };
        let _ = session.evaluator.image.limits.heap.take_exhausted();
        let mut run = session.within(limits(self.plan.limit)).run(name, text);
        if run.is_ok() {
            let left = (self.plan.limit - (session.time() - began)).max(0.0);
            let asked = session.within(limits(left));
            run = { asked }.run(LESSON, "(planwright::%run-lesson)");
        }
        session.evaluator.host.simulation.end_tally();
        Tried {
            failure: run.err(),
            deeds,
            is_loud: printed.is_too_long(),
            printed: printed.take(),
        }
    }

    /// Says why a submission has ended.
    fn explain(&self, failure: &Failure, is_loud: bool, name: &str, mark: &mut Mark) {
        let record = &mut mark.record;
        record.outcome = Ending::Failure;
        record.class = Some(class_of(failure));
        mark.why = match failure {
            Failure::Unhandled(unhandled) => {
                let abort = &unhandled.abort;
                let place = [&abort.user_place, &abort.place];
                let place = place
                    .into_iter()
                    .flatten()
                    .find(|place| &*place.name == name);
                let actions = abort
                    .actions
                    .iter()
                    .filter_map(|action| action.place.as_ref());
                let place = place.or_else(|| actions.into_iter().find(|p| &*p.name == name));
                mark.line = place.map(|place| format!("{}:{}", place.name, place.line));
                let report = first_line(&abort.report);
                let class = &abort.class;
                match (&mark.line, class.as_str()) {
                    (_, HEAP_EXHAUSTED) => "It takes more memory than it may.".to_owned(),
                    (Some(line), _) => format!("It stops at {line} with {class}: {report}"),
                    (None, _) => format!("It stops with {class}: {report}"),
                }
            }
            Failure::LimitReached(Limit::SimulatedTime | Limit::Steps) => {
                record.outcome = Ending::Limit;
                record.class = None;
                format!(
                    "It takes more than {} s of simulated time.",
                    self.plan.limit
                )
            }
            Failure::LimitReached(Limit::Looks) => {
                record.outcome = Ending::Endless;
                record.class = None;
                "It calculates without end.".to_owned()
            }
            Failure::LimitReached(Limit::WallClock) => {
                record.outcome = Ending::Timeout;
                record.class = None;
                format!(
                    "It takes more than {} s of real time.",
                    self.allowance.wall_clock.as_secs_f64()
                )
            }
            Failure::Interrupted if is_loud => {
                format!("It prints more than {} bytes.", self.allowance.output)
            }
            Failure::Quit(_) => "It leaves planwright instead of ending.".to_owned(),
            Failure::Defect(report) => {
                record.outcome = Ending::Defect;
                first_line(report)
            }
            other => first_line(&other.to_string()),
        };
    }
}

/// What came of trying a submission out.
struct Tried {
    failure: Option<Failure>,
    deeds: Rc<Deeds>,
    is_loud: bool,
    printed: String,
}

/// The class by which failures are counted.
fn class_of(failure: &Failure) -> String {
    match failure {
        Failure::Unhandled(unhandled) => unhandled.abort.class.clone(),
        Failure::LimitReached(_) => "LIMIT".to_owned(),
        Failure::Quit(_) => "QUIT".to_owned(),
        Failure::Interrupted => "OUTPUT".to_owned(),
        _ => "DEFECT".to_owned(),
    }
}

/// The first line of a report, not too long.
fn first_line(report: &str) -> String {
    const MAX: usize = 300;
    let line = report.trim().lines().next().unwrap_or_default();
    match line.chars().count() > MAX {
        true => line.chars().take(MAX).chain(['…']).collect(),
        false => line.to_owned(),
    }
}

/// The values of a form of the lesson.
fn ask(session: &mut Session, form: &str) -> Result<Vec<Datum>, String> {
    let limits = Limits {
        looks: Some(MAX_LESSON_LOOKS),
        ..Limits::NONE
    };
    let asked = session.within(limits).run(LESSON, form);
    asked.map_err(|failure| match failure.unhandled() {
        Some(unhandled) => match unhandled.abort.main_place() {
            Some(place) => format!("{place}: {}", unhandled.abort.report.trim_end()),
            None => unhandled.abort.report.trim_end().to_owned(),
        },
        None => failure.to_string(),
    })
}

/// The answers about steps.
fn answers_of(told: &[Datum]) -> Pairs<bool> {
    let mut answers = Pairs::default();
    if let Some(Datum::List(all)) = told.first() {
        for answer in all {
            if let Datum::List(parts) = answer
                && let [name, holds] = parts.as_slice()
                && let Some(name) = name.as_text()
            {
                answers.set(name, holds.is_true());
            }
        }
    }
    answers
}

/// The mark of a world that was not run.
fn unrun(world: u64, ending: Ending, why: String) -> Mark {
    let mut record = Record::new(world, ending);
    record.cause = Some(why.clone());
    Mark {
        record,
        why,
        line: None,
        printed: String::new(),
    }
}
