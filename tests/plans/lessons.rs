//! The lessons that come with the program: what their solutions do solves them, step by step, and nothing else does.

use session::dialogue::{Evaluate, Event};
use session::{Datum, Session, SessionOptions};

/// A person who learns.
struct Learner {
    session: Session,
}

impl Learner {
    fn new() -> Learner {
        let session = Session::new(&SessionOptions::default()).unwrap();
        Learner { session }
    }

    /// Types a text; what is printed.
    fn say(&mut self, text: &str) -> String {
        let mut printed = String::new();
        self.session.evaluate("lesson", text, &mut |event| {
            if let Event::Output(text) = event {
                printed.push_str(&text);
            }
        });
        printed
    }

    /// The strings that a form returns as a list.
    fn strings(&mut self, form: &str) -> Vec<String> {
        let values = self.session.run("strings", form).unwrap();
        let [Datum::List(strings)] = values.as_slice() else {
            panic!("{form}: {values:?}");
        };
        let texts = strings.iter().map(|text| text.as_text().unwrap());
        texts.map(str::to_owned).collect()
    }

    /// The forms of the solution of the lesson at hand.
    fn solution(&mut self) -> Vec<String> {
        self.strings(
            "(let ((*package* (find-package :pp-tut)))
               (mapcar #'prin1-to-string (pw::%lesson-solution (first pw::*lessons*))))",
        )
    }
}

/// The names of the lessons with something to grade, or of those without.
fn lessons(has_run: bool) -> Vec<&'static str> {
    let names = plan_files::lesson_names().filter(|name| {
        let file = format!("plans/lessons/{name}.lesson");
        let text = plan_files::text_of(&file).unwrap();
        text.contains("\n  (run ") == has_run
    });
    names.collect()
}

/// The chapters and the exercises that are done at the prompt; the tour shows what to type.
fn typed() -> Vec<&'static str> {
    let names = lessons(false).into_iter();
    names.filter(|name| *name != "tour").collect()
}

fn is_solved(name: &str) {
    let mut learner = Learner::new();
    let begun = learner.say(&format!("(lesson '{name})"));
    assert!(begun.contains("Step "), "{name}: {begun}");
    assert!(!learner.say("(+ 1 2)").contains("Done"), "{name}");
    let mut told = String::new();
    for form in learner.solution() {
        told.push_str(&learner.say(&form));
    }
    assert!(told.contains("The lesson is done: "), "{name}:\n{told}");
}

#[test]
fn chapters_up_to_the_tenth_are_solved_by_their_solutions() {
    for name in &typed()[..10] {
        is_solved(name);
    }
}

#[test]
fn chapters_after_the_tenth_are_solved_by_their_solutions() {
    for name in &typed()[10..] {
        is_solved(name);
    }
}

#[test]
fn each_chapter_and_exercise_has_a_lesson_with_three_hints_for_a_step() {
    let mut learner = Learner::new();
    for chapter in 1..=19 {
        let begun = learner.say(&format!("(lesson {chapter})"));
        let title = format!("Chapter {chapter}: ");
        assert!(begun.contains(&title), "{begun}");
    }
    let titles: Vec<&str> = plan_files::lesson_names()
        .filter_map(plan_files::lesson_title)
        .collect();
    for exercise in ["1", "1b", "2", "3", "4", "5", "6", "7", "8", "9"] {
        let title = format!("Exercise {exercise}: ");
        assert!(titles.iter().any(|t| t.starts_with(&title)), "{title}");
    }
    for name in plan_files::lesson_names().filter(|name| *name != "tour") {
        learner.say(&format!("(lesson '{name})"));
        let hints = learner.strings(
            "(mapcar (lambda (step) (format nil \"~d\" (length (pw::%lesson-step-hints step))))
                     (pw::%lesson-steps (first pw::*lessons*)))",
        );
        assert!(hints.iter().all(|count| count == "3"), "{name}: {hints:?}");
    }
    let wrong = learner.say("(lesson 77)");
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn wrong_ways_do_not_solve_a_lesson() {
    let solved = |name: &str, forms: &[&str]| {
        let mut learner = Learner::new();
        learner.say(&format!("(lesson '{name})"));
        let told: Vec<String> = forms.iter().map(|form| learner.say(form)).collect();
        told.concat()
    };
    // One after the other is not at once.
    let told = solved(
        "at-once",
        &["(with-simulated-robot
             (let ((?place *place-at-table*))
               (perform (an action (type going) (target (a location (pose ?place)))))
               (perform (a motion (type moving-torso) (joint-angle 0.3)))
               (park-arms)))"],
    );
    assert!(!told.contains("Done: Raise the torso while"), "{told}");
    assert!(told.contains("Done: Its torso is at 0.3 m."), "{told}");
    // A bottle that is put there by a function is not put down by a hand.
    let told = solved(
        "putting-down",
        &["(spawn-object '((-0.8 2 0.95) (0 0 0 1)) :bottle 'bottle)"],
    );
    assert!(!told.contains("Done: Put the bottle down"), "{told}");
    // A failure that nothing handles is not handled.
    let torso = "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.5))))";
    let told = solved("failures", &[torso, torso]);
    assert!(told.contains("Done: Ask for a torso height"), "{told}");
    assert!(!told.contains("Done: Ask for it again"), "{told}");
    // The other arm's bottle, and an endless function that is asked about.
    let told = solved(
        "prompt",
        &["(defun area-of (a b) (+ a b))", "(defun area-of (a) a)"],
    );
    assert!(!told.contains("Done"), "{told}");
}
