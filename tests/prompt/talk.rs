//! A session and a person who talks to it, without a terminal.

use session::dialogue::screen::input_name;
use session::dialogue::{Converse, Evaluate, Outcome, Repeat, Screen};
use session::{Session, SessionOptions};

/// A session that a person talks to.
pub(super) struct Talk {
    pub(super) session: Session,
    number: usize,
}

impl Talk {
    pub(super) fn new() -> Talk {
        let mut session = Session::new(&SessionOptions::default()).expect("the session starts");
        session.set_interactive(true);
        let mut talk = Talk { session, number: 0 };
        talk.say("(in-package :pp-tut)");
        talk
    }

    /// What is shown for an input.
    pub(super) fn say(&mut self, input: &str) -> String {
        self.take(input).0
    }

    pub(super) fn take(&mut self, input: &str) -> (String, Outcome) {
        self.number += 1;
        let name = input_name(self.number);
        let mut screen = Screen::new(Vec::new());
        screen.begin_input(&name, input);
        let outcome = self.session.evaluate(&name, input, &mut |event| {
            screen.show(&event).expect("memory can be written");
        });
        let text = String::from_utf8(screen.into_inner()).expect("text");
        (text, outcome)
    }

    /// Chooses the first restart whose label contains the text.
    pub(super) fn choose(&mut self, label: &str) -> String {
        let shown = self.say(":r");
        let line = shown.lines().find(|line| line.contains(label));
        let line = line.unwrap_or_else(|| panic!("{label} is not in\n{shown}"));
        let number = line.trim().split(':').next().expect("a number").to_owned();
        self.say(&number)
    }

    pub(super) fn hash(&self) -> u64 {
        self.session.world_hash()
    }

    pub(super) fn completions(&self, text: &str) -> Vec<String> {
        let found = self.session.completions(text, text.len());
        found.candidates.into_iter().map(|c| c.text).collect()
    }

    pub(super) fn hint(&self, text: &str) -> String {
        self.session.hint(text, text.len()).unwrap_or_default()
    }
}

pub(super) const BOTTLE: &str = "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))";

/// Drives, looks at the table and remembers the bottle that is there.
pub(super) const FIND_BOTTLE: &str = "(progn (defvar *bottle* nil)
  (with-simulated-robot
    (let ((?place (make-pose \"map\" '((-1.447 -0.15 0) (0 0 -0.7071 0.7071))))
          (?spot (make-pose \"base_footprint\" '((0.65335 0.076 0.758) (0 0 0 1)))))
      (cpl:par
        (perform (an action (type going) (target (a location (pose ?place)))))
        (perform (a motion (type moving-torso) (joint-angle 0.3)))
        (park-arms))
      (perform (an action (type looking) (target (a location (pose ?spot)))))
      (setf *bottle* (perform (an action (type detecting) (object (an object (type bottle))))))
      :found)))";

pub(super) const NOWHERE: &str = "(with-simulated-robot
  (let ((?place (make-pose \"map\" '((-1 1.5 0) (0 0 0 1)))))
    (perform (an action (type going) (target (a location (pose ?place)))))
    :there))";
