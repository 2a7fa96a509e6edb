//! What lessons ask of the session: what has happened, and which lessons are built in.

use crate::deeds::{Deed, Deeds};
use crate::host::SimulationHost;
use crate::person::{Done, Progress};
use crate::simulation::Simulation;
use cram::pose::value::pose_stamped;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use robotics::robot::Side;

/// Builtins of package `PLAN-SYSTEM`, which `PLANWRIGHT` imports.
pub(super) static TABLE: &[Builtin] =
    builtins![deeds, begin, names, title, axes, progress, keep_progress];

/// What has happened since a lesson began, in order: lists of a keyword and what it is about.
///
/// `(pw::%deeds)` => `NIL`
#[builtin("%DEEDS")]
fn deeds(image: &mut Image) -> Vec<Value> {
    let all = Deeds::of(image).all();
    let values = all.iter().map(|deed| {
        let (kind, parts): (&str, Vec<Value>) = match deed {
            Deed::Held { object, side } => ("HELD", vec![text(object), text(name_of(*side))]),
            Deed::Released { object, side } => {
                ("RELEASED", vec![text(object), text(name_of(*side))])
            }
            Deed::Began(name) => ("BEGAN", vec![text(name)]),
            Deed::Performed(name) => ("PERFORMED", vec![text(name)]),
            Deed::Failed { motion, class } => ("FAILED", vec![text(motion), text(class)]),
            Deed::Collided(bodies) => ("COLLIDED", bodies.iter().map(|b| text(b)).collect()),
            Deed::Ended(class) => {
                let class = class.as_deref().map_or(Value::NIL, text);
                ("ENDED", vec![class])
            }
        };
        let mut values = vec![Value::from(image.keyword(kind))];
        values.extend(parts);
        Value::list(values)
    });
    values.collect()
}

fn text(text: &str) -> Value {
    Value::string(text)
}

fn name_of(side: Side) -> &'static str {
    match side {
        Side::Left => "LEFT",
        Side::Right => "RIGHT",
    }
}

/// What happens is noted from now on.
#[builtin("%BEGIN-DEEDS", edit)]
fn begin(host: &mut SimulationHost, image: &mut Image) {
    let deeds = Deeds::of(image);
    deeds.set(Vec::new());
    if let Some(witness) = deeds.witness() {
        host.audience.remove_follower(witness);
    }
    let witness = Box::new(std::rc::Rc::clone(&deeds).observer());
    let (audience, simulation) = (&mut host.audience, &host.simulation);
    let witness = audience.add_follower(simulation, image, witness);
    deeds.set_witness(Some(witness));
}

/// The title of the built-in lesson with a name.
///
/// `(pw::%title-of-lesson "look-again")` => `"Look again"`
#[builtin("%TITLE-OF-LESSON")]
fn title(name: &Value) -> Option<Value> {
    let name = name.as_text().unwrap_or_default();
    plan_files::lesson_title(&name).map(text)
}

/// The pose and the length (m) of the coordinate axes that are shown, as a list; NIL if none are.
///
/// `(progn (pp-tut:init-projection) (pw::%axes))` => `NIL`
#[builtin("%AXES")]
fn axes(simulation: &mut Simulation) -> Option<Value> {
    let axes = simulation.axes()?;
    let pose = pose_stamped("map", &axes.pose);
    Some(Value::list([pose, Value::from(axes.size)]))
}

/// What has been done of lessons, in this session and earlier ones: lists of a name, the number of steps that
/// were done, and that of all steps.
///
/// `(pw::%lesson-progress)` => `NIL`
#[builtin("%LESSON-PROGRESS")]
fn progress(host: &mut SimulationHost) -> Vec<Value> {
    let kept = host.person.progress.as_ref().filter(|_| !host.is_closed);
    let all = kept.map(Progress::all).unwrap_or_default();
    let lists = all.into_iter().map(|done| {
        let numbers = [done.steps, done.all].map(Value::from);
        Value::list([vec![text(&done.lesson)], numbers.to_vec()].concat())
    });
    lists.collect()
}

/// Remembers how many steps of a lesson are done. Returns why that cannot be kept, or NIL.
///
/// `(pw::%keep-progress "tour" 1 6)` => `NIL`
#[builtin("%KEEP-PROGRESS")]
fn keep_progress(
    host: &mut SimulationHost,
    lesson: &Value,
    done: &Value,
    all: &Value,
) -> Option<String> {
    let number = |value: &Value| match value {
        Value::Int(number) => usize::try_from(*number).unwrap_or(0),
        _ => 0,
    };
    let kept = host.person.progress.as_ref().filter(|_| !host.is_closed)?;
    let result = kept.keep(Done {
        lesson: lesson.as_text()?,
        steps: number(done),
        all: number(all),
    });
    result.err().map(|error| error.to_string())
}

/// The names of the lessons that are built in.
///
/// `(first (pw::%lesson-names))` => `"tour"`
#[builtin("%LESSON-NAMES")]
fn names() -> Vec<Value> {
    plan_files::lesson_names().map(text).collect()
}
