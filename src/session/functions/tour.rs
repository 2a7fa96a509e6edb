//! The tour, a first session for newcomers: a few steps, each with a form to type.

/// A step: an explanation, and a form to type.
pub struct Step {
    /// The explanation.
    pub text: &'static str,
    /// The form to type.
    pub form: &'static str,
}

/// The steps, in order.
pub static STEPS: &[Step] = &[
    Step {
        text: "Everything typed here is a form in parentheses: a function and its arguments.\n\
               Enter evaluates it, and shows its value. Names live in packages; first go to\n\
               the one of the tutorial. (tour) then tells the next step, each time.",
        form: "(in-package :pp-tut)",
    },
    Step {
        text: "The robot stands in the kitchen, at the origin of the map. Put a bottle on the\n\
               table: the lists are its position (m) and orientation. Type (spaw and press Tab\n\
               to have the name completed; while you type, the arguments are shown.",
        form: "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))",
    },
    Step {
        text: "Robots act inside plans. This one drives: a plan performs an action, which is\n\
               described by its type and what it needs. Tab also completes in there.",
        form: "(with-simulated-robot\n  \
                 (let ((?place (make-pose \"map\" '((-1.447 -0.15 0) (0 0 -0.7071 0.7071)))))\n    \
                   (perform (an action (type going) (target (a location (pose ?place)))))))",
    },
    Step {
        text: "Now look at the table and find the bottle. The value is a description of what\n\
               was seen; names that begin with ? are variables.",
        form: "(with-simulated-robot\n  \
                 (park-arms)\n  \
                 (let ((?spot (make-pose \"base_footprint\" '((0.65 0.08 0.76) (0 0 0 1)))))\n    \
                   (perform (an action (type looking) (target (a location (pose ?spot))))))\n  \
                 (defparameter *bottle*\n    \
                   (perform (an action (type detecting) (object (an object (type bottle)))))))",
    },
    Step {
        text: "Pick it up. A long motion shows how far it is; Ctrl-C stops the robot.",
        form: "(with-simulated-robot\n  \
                 (perform (a motion (type moving-torso) (joint-angle 0.3)))\n  \
                 (let ((?bottle *bottle*))\n    \
                   (perform (an action (type picking-up) (arm right) (grasp left-side)\n               \
                     (object ?bottle)))))",
    },
    Step {
        text: "What holds it now?",
        form: "(inspect :robot)",
    },
    Step {
        text: "Take the world back to before it was picked up. In a terminal, type q first to\n\
               leave the inspector. (rewind 2) goes back two steps, and so on.",
        form: "(rewind)",
    },
    Step {
        text: "Make a mistake: if nothing handles a failure, the plan stops, and you choose how\n\
               to continue: type a number, or q to give up.",
        form: "(with-simulated-robot\n  \
                 (let ((?place (make-pose \"map\" '((-1 1.5 0) (0 0 0 1)))))\n    \
                   (perform (an action (type going) (target (a location (pose ?place)))))))",
    },
];

/// The text of a step, counted from zero.
pub(crate) fn step_text(number: usize) -> String {
    match STEPS.get(number) {
        Some(step) => format!(
            "Step {} of {}. {}\n\n{}\n",
            number + 1,
            STEPS.len(),
            step.text,
            step.form
        ),
        None => "That was the tour. (help) tells what else there is, (list-actions) what the robot\ncan do; (tour 1) begins again.\n".to_owned(),
    }
}
