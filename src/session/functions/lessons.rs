//! What lessons ask of the session: what has happened, and which lessons are built in.

use crate::deeds::{Deed, Deeds};
use crate::host::SimulationHost;
use crate::host::call::{done, edit, host};
use crate::person::{Done, Progress};
use cram::Reply;
use cram::pose::value::pose_stamped;
use lisp::builtin::{Builtin, control, pure};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::robot::Side;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLAN-SYSTEM`, which `PLANWRIGHT` imports.
pub(super) static TABLE: &[Builtin] = &[
    pure(
        "%DEEDS",
        "",
        "What has happened since a lesson began, in order: lists of a keyword and what it is about.",
        &["(pw::%deeds) => NIL"],
        deeds,
    ),
    control(
        "%BEGIN-DEEDS",
        "",
        "What happens is noted from now on.",
        &[],
        edit!(begin),
    ),
    pure(
        "%LESSON-NAMES",
        "",
        "The names of the lessons that are built in.",
        &["(first (pw::%lesson-names)) => \"tour\""],
        names,
    ),
    pure(
        "%TITLE-OF-LESSON",
        "name",
        "The title of the built-in lesson with a name.",
        &["(pw::%title-of-lesson \"look-again\") => \"Look again\""],
        title,
    ),
    control(
        "%AXES",
        "",
        "The pose and the length (m) of the coordinate axes that are shown, as a list; NIL if none are.",
        &["(progn (pp-tut:init-projection) (pw::%axes)) => NIL"],
        host!(axes),
    ),
    control(
        "%LESSON-PROGRESS",
        "",
        "What has been done of lessons, in this session and earlier ones: lists of a name, the number of steps that \
         were done, and that of all steps.",
        &["(pw::%lesson-progress) => NIL"],
        host!(progress),
    ),
    control(
        "%KEEP-PROGRESS",
        "lesson done all",
        "Remembers how many steps of a lesson are done. Returns why that cannot be kept, or NIL.",
        &["(pw::%keep-progress \"tour\" 1 6) => NIL"],
        host!(keep_progress),
    ),
];

fn deeds(image: &mut Image, _: &[Value]) -> Result<Value> {
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
    let values: Vec<Value> = values.collect();
    Ok(Value::list(values))
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

fn begin(host: &mut SimulationHost, image: &mut Image, _: &[Value]) -> Result<Reply> {
    let deeds = Deeds::of(image);
    deeds.set(Vec::new());
    if let Some(witness) = deeds.witness() {
        host.audience.remove_follower(witness);
    }
    let witness = Box::new(std::rc::Rc::clone(&deeds).observer());
    let (audience, simulation) = (&mut host.audience, &host.simulation);
    let witness = audience.add_follower(simulation, image, witness);
    deeds.set_witness(Some(witness));
    done(Value::NIL)
}

fn title(_: &mut Image, args: &[Value]) -> Result<Value> {
    let name = args.first().and_then(Value::as_text).unwrap_or_default();
    Ok(plan_files::lesson_title(&name).map_or(Value::NIL, text))
}

fn axes(host: &mut SimulationHost, _: &mut Image, _: &[Value]) -> Result<Reply> {
    let Some(axes) = host.simulation.axes() else {
        return done(Value::NIL);
    };
    let pose = pose_stamped("map", &axes.pose);
    done(Value::list(vec![pose, Value::from(axes.size)]))
}

fn progress(host: &mut SimulationHost, _: &mut Image, _: &[Value]) -> Result<Reply> {
    let kept = host.person.progress.as_ref().filter(|_| !host.is_closed);
    let all = kept.map(Progress::all).unwrap_or_default();
    let lists = all.into_iter().map(|done| {
        let numbers = [done.steps, done.all].map(Value::from);
        Value::list([vec![text(&done.lesson)], numbers.to_vec()].concat())
    });
    let lists: Vec<Value> = lists.collect();
    done(Value::list(lists))
}

fn keep_progress(host: &mut SimulationHost, _: &mut Image, args: &[Value]) -> Result<Reply> {
    let number = |at: usize| match args.get(at) {
        Some(Value::Int(number)) => usize::try_from(*number).unwrap_or(0),
        _ => 0,
    };
    let kept = host.person.progress.as_ref().filter(|_| !host.is_closed);
    let lesson = args.first().and_then(Value::as_text);
    let (Some(kept), Some(lesson)) = (kept, lesson) else {
        return done(Value::NIL);
    };
    let result = kept.keep(Done {
        lesson,
        steps: number(1),
        all: number(2),
    });
    done(match result {
        Ok(()) => Value::NIL,
        Err(error) => text(&error.to_string()),
    })
}

fn names(_: &mut Image, _: &[Value]) -> Result<Value> {
    let names: Vec<Value> = plan_files::lesson_names().map(text).collect();
    Ok(Value::list(names))
}
