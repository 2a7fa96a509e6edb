//! Somebody who works with the robot in the kitchen, for the tests of what plans do there.

use super::overlaps::Overlaps;
use nalgebra::Vector3;
use session::dialogue::{Evaluate, Event, Outcome};
use session::{Session, SessionOptions};
use spatial::Pose;

/// A session with the tutorial's skills loaded.
pub(crate) struct Cook {
    pub(crate) session: Session,
    /// What goes through what, if that is watched.
    overlaps: Option<Overlaps>,
}

/// What a text has printed, or the report and the class of the condition that ended it.
pub(crate) type Said = Result<String, (String, String)>;

/// A session that begins with the library as it was compiled with the program, which takes a quarter of the time.
fn opened(options: &SessionOptions) -> Session {
    crate::use_compiled_library();
    Session::new(options).unwrap()
}

impl Cook {
    pub(crate) fn new() -> Self {
        Self::with(&SessionOptions::default())
    }

    /// One who may be asked whether anything has gone through anything. To look after every step takes up to a third
    /// more time.
    pub(crate) fn watched() -> Self {
        Self::watched_with(&SessionOptions::default())
    }

    /// One in a session with options.
    pub(crate) fn with(options: &SessionOptions) -> Self {
        Self::in_session(opened(options), None)
    }

    /// One in a session with options, who may be asked whether anything has gone through anything.
    pub(crate) fn watched_with(options: &SessionOptions) -> Self {
        let mut session = opened(options);
        let overlaps = Overlaps::watch(&mut session);
        Self::in_session(session, Some(overlaps))
    }

    fn in_session(session: Session, overlaps: Option<Overlaps>) -> Self {
        let mut cook = Self { session, overlaps };
        cook.done("(in-package :pp-tut) (load \"plans/tutorial/skills.plan\")");
        cook
    }

    /// The robot at the table, with a bottle that it has detected as *BOTTLE*.
    pub(crate) fn at_table_with_bottle() -> Self {
        Self::at_table_with_bottle_of("")
    }

    /// As above, with further arguments for spawning the bottle.
    pub(crate) fn at_table_with_bottle_of(arguments: &str) -> Self {
        Self::new().with_bottle(arguments)
    }

    /// As above; may be asked whether anything has gone through anything.
    pub(crate) fn watched_at_table_with_bottle() -> Self {
        Self::watched().with_bottle("")
    }

    fn with_bottle(mut self, arguments: &str) -> Self {
        let cook = &mut self;
        cook.done(&format!(
            "(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.6 -0.9 0.82) (0 0 0 1)) {arguments})
             (with-simulated-robot (get-ready-at *place-at-table*))
             (defparameter *bottle* (with-simulated-robot (find-object :bottle)))"
        ));
        self
    }

    /// Evaluates a text.
    pub(crate) fn say(&mut self, text: &str) -> Said {
        let mut printed = String::new();
        let mut end = None;
        let outcome = self
            .session
            .evaluate("cook", text, &mut |event| match event {
                Event::Output(text) => printed.push_str(&text),
                Event::Values(values) => printed.push_str(&format!("{}\n", values.join("\n"))),
                Event::Aborted(abort) => {
                    end = Some((abort.report.clone(), abort.condition.clone()))
                }
                _ => {}
            });
        assert_eq!(outcome == Outcome::Aborted, end.is_some(), "{printed}");
        end.map_or(Ok(printed), Err)
    }

    /// Evaluates a text that has to work; what it has printed.
    pub(crate) fn done(&mut self, text: &str) -> String {
        self.say(text)
            .unwrap_or_else(|end| panic!("{text}\n{end:?}"))
    }

    /// Evaluates a text with the robot that has to fail with that class; the report.
    pub(crate) fn fails(&mut self, class: &str, text: &str) -> String {
        match self.say(&format!("(with-simulated-robot {text})")) {
            Err((report, condition)) if condition.contains(class) => report,
            other => panic!("{text}\ndid not fail with {class}, but: {other:?}"),
        }
    }

    /// Picks the bottle up with the right hand and brings it close to the body.
    pub(crate) fn take_bottle(&mut self) {
        self.done("(with-simulated-robot (pick-up-object *bottle* :right))");
        assert_eq!(self.in_right_hand(), "(BOTTLE-1)");
    }

    pub(crate) fn in_right_hand(&mut self) -> String {
        let shown = self.done("(pp-plans::objects-in-hand :right)");
        shown.trim().to_owned()
    }

    pub(crate) fn pose(&self, object: &str) -> Pose {
        self.session
            .simulation()
            .world()
            .object_pose(object)
            .unwrap()
    }

    /// How far (m) an object is from a pose.
    pub(crate) fn distance(&self, object: &str, from: &Pose) -> f64 {
        (self.pose(object).translation.vector - from.translation.vector).norm()
    }

    /// How much (degrees) an object leans.
    pub(crate) fn lean(&self, object: &str) -> f64 {
        let up = self.pose(object).rotation * Vector3::z();
        up.z.clamp(-1.0, 1.0).acos().to_degrees()
    }

    /// How much (degrees) the vertical axis of an object has tipped from where it was at a pose.
    pub(crate) fn turned_up(&self, object: &str, from: &Pose) -> f64 {
        let [was, is] = [from, &self.pose(object)].map(|pose| pose.rotation * Vector3::z());
        was.dot(&is).clamp(-1.0, 1.0).acos().to_degrees()
    }

    /// The first time that something has gone through something.
    pub(crate) fn overlap(&self) -> Option<String> {
        self.overlaps.as_ref().expect("they are watched").first()
    }

    /// Nothing went through anything so far.
    pub(crate) fn assert_no_overlap(&self) {
        assert_eq!(self.overlap(), None);
    }
}
