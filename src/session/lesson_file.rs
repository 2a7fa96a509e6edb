//! The file that defines a lesson.

use crate::Session;
use crate::console::Ended;
use crate::dialogue::Event;
use crate::face::Datum;
use lisp::print;
use lisp::reader::Reader;
use lisp::source::Place;

/// The package in which a lesson is read, unless it names another one.
const PACKAGE: &str = "(in-package :pp-tut)";

/// A file that defines a lesson.
#[derive(Clone, Debug)]
pub struct LessonFile {
    /// Its name in places.
    pub name: String,
    /// What it contains.
    pub text: String,
}

/// What a lesson says.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonPlan {
    /// Its name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What is to be done.
    pub text: String,
    /// How many worlds it asks for.
    pub worlds: u64,
    /// Simulated time (s) that a plan may take.
    pub limit: f64,
    /// Files that are loaded before a submission.
    pub given: Vec<String>,
    /// What has to have happened, in order.
    pub steps: Vec<LessonStep>,
    /// The text of a solution.
    pub solution: Option<String>,
    /// Is there something to grade, a form that is evaluated after a submission?
    pub has_run: bool,
}

/// Something that has to have happened.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonStep {
    /// Its name.
    pub name: String,
    /// What is to be done.
    pub text: String,
}

impl LessonFile {
    /// Loads it into a fresh session. It is data: nothing but one lesson is in it, and a package before it.
    ///
    /// # Errors
    ///
    /// What is wrong with the file, with its place.
    pub fn load(&self, session: &mut Session) -> Result<LessonPlan, String> {
        let name = &self.name;
        let run = session.run("lesson", PACKAGE);
        run.map_err(|failure| failure.to_string())?;
        let evaluator = &mut session.evaluator;
        let source = evaluator.image.sources.add(name, &self.text);
        let mut reader = Reader::new(&evaluator.image, source);
        let mut found = 0;
        loop {
            let read = reader.next_form(&mut evaluator.image);
            let read = read.map_err(|error| {
                let abort = crate::printing::raised(&mut evaluator.image, error.raise());
                placed(name, &abort)
            })?;
            let Some((form, place)) = read else {
                break;
            };
            let head = form.car_or_nil();
            let head = head
                .as_symbol()
                .map(|sym| evaluator.image.name(sym).to_owned());
            match head.as_deref() {
                Some("IN-PACKAGE") => {}
                Some("DEFLESSON") if found == 0 => found += 1,
                Some("DEFLESSON") => {
                    let at = located(session, place, name);
                    return Err(format!(
                        "{at}: a file has one lesson: keep one (deflesson …)"
                    ));
                }
                _ => {
                    let shown = print::to_string(&evaluator.image, &form, true);
                    let shown: String = shown.chars().take(60).collect();
                    let at = located(session, place, name);
                    return Err(format!(
                        "{at}: {shown} is no part of a lesson file: (deflesson NAME …) was expected, and \
                         nothing else but (in-package …) before it"
                    ));
                }
            }
            let mut abort = None;
            let mut sink = |event| {
                if let Event::Aborted(aborted) = event {
                    abort = Some(aborted);
                }
            };
            if let Ended::Aborted(aborted) = evaluator.evaluate_form(&form, &mut sink) {
                abort = Some(aborted);
            }
            if let Some(abort) = abort {
                if abort.main_place().is_some_and(|at| *at.name == **name) {
                    return Err(placed(name, &abort));
                }
                let at = located(session, place, name);
                return Err(format!("{at}: {}", abort.report.trim_end()));
            }
        }
        if found == 0 {
            return Err(format!(
                "{name}: there is no lesson in it: (deflesson NAME (title \"…\") …) was expected"
            ));
        }
        self.described(session)
    }

    /// What the lesson that was loaded says.
    fn described(&self, session: &mut Session) -> Result<LessonPlan, String> {
        let told = session.run("lesson", "(planwright::%describe-lesson)");
        let told = told.map_err(|failure| format!("{}: {failure}", self.name))?;
        plan_of(&told).ok_or_else(|| format!("{}: the lesson cannot be described", self.name))
    }
}

/// What the description of a lesson says.
fn plan_of(told: &[Datum]) -> Option<LessonPlan> {
    let [Datum::List(parts)] = told else {
        return None;
    };
    let text = |at: usize| parts.get(at)?.as_text().map(str::to_owned);
    let list = |at: usize| match parts.get(at) {
        Some(Datum::List(items)) => items.clone(),
        _ => Vec::new(),
    };
    let step = |datum: &Datum| match datum {
        Datum::List(parts) => Some(LessonStep {
            name: parts.first()?.as_text()?.to_owned(),
            text: parts.get(1)?.as_text()?.to_owned(),
        }),
        _ => None,
    };
    Some(LessonPlan {
        name: text(0)?,
        title: text(1)?,
        text: text(2)?,
        worlds: u64::try_from(parts.get(3)?.as_integer()?).ok()?,
        limit: parts.get(4)?.as_float()?,
        given: list(5)
            .iter()
            .filter_map(|d| Some(d.as_text()?.to_owned()))
            .collect(),
        steps: list(6).iter().filter_map(step).collect(),
        solution: text(7),
        has_run: parts.get(8) == Some(&Datum::True),
    })
}

/// The report of a condition after its place.
fn placed(name: &str, abort: &crate::dialogue::Abort) -> String {
    let place = abort.main_place();
    let place = place.map_or_else(|| name.to_owned(), ToString::to_string);
    format!("{place}: {}", abort.report.trim_end())
}

/// A place as it is shown.
fn located(session: &Session, place: Place, name: &str) -> String {
    let location = session.evaluator.image.sources.locate(place);
    location.map_or_else(|| name.to_owned(), |location| location.to_string())
}
