//! What followers learn of tasks, actions and motions, as texts.

use crate::printing::on_line_of;
use cram::designator::value::as_designator;
use cram::journal::{ActionEnd, BegunAction, Change, Starter};
use cram::{Plan, Status, TaskId as PlanTask};
use lisp::image::Image;
use lisp::image::identity::aside;
use lisp::print;
use lisp::source::Place;
use lisp::value::Value;
use view::watch::{About, TaskId, TaskNews, TaskState};

/// Maximum number of characters shown of a value.
const LONGEST: usize = 400;

/// Maximum number of keys shown.
const MAX_KEYS: usize = 24;

/// A change in the journal, with its simulated time (s).
pub(super) fn of_change(image: &Image, change: Change) -> (f64, TaskNews) {
    let report = |failure: &Value| aside(image, || print::report::report(image, failure));
    let class = |failure: &Value| class_name(image, failure);
    match change {
        Change::Task(change) => {
            let news = TaskNews {
                id: TaskId::Task(change.id.0),
                parent: change.starter.map(starter),
                name: change.name,
                state: state(change.status),
                failure: change.failure.as_ref().map(report).unwrap_or_default(),
                class: change.failure.as_ref().map(class).unwrap_or_default(),
                result: String::new(),
                about: None,
            };
            (change.time, news)
        }
        Change::Begun(begun) => {
            let about = about(image, &begun.designator, begun.place);
            let news = TaskNews {
                about: Some(about.into()),
                ..of_action(image, &begun, TaskState::Running)
            };
            (begun.time, news)
        }
        Change::Ended(ended) => {
            let of = |state| of_action(image, &ended.begun, state);
            let news = match &ended.end {
                ActionEnd::Succeeded(value) => TaskNews {
                    result: text(image, value),
                    ..of(TaskState::Succeeded)
                },
                ActionEnd::Failed(failure) => TaskNews {
                    failure: report(failure),
                    class: class(failure),
                    ..of(TaskState::Failed)
                },
                ActionEnd::Evaporated => of(TaskState::Evaporated),
            };
            (ended.time, news)
        }
    }
}

/// The name of the class of a condition.
pub(crate) fn class_name(image: &Image, condition: &Value) -> String {
    match condition {
        Value::Instance(instance) => image.name(instance.class().name).to_owned(),
        _ => String::new(),
    }
}

/// What starts something that a task starts now.
pub(crate) fn starter_in(image: &Image, task: PlanTask) -> TaskId {
    starter(Plan::of(image).starter(task))
}

fn of_action(image: &Image, action: &BegunAction, state: TaskState) -> TaskNews {
    let name = as_designator(&action.designator).and_then(|d| d.type_name(image));
    TaskNews {
        id: TaskId::Action(action.id.0),
        parent: action.starter.map(starter),
        name: name.unwrap_or_else(|| "action".to_owned()).to_lowercase(),
        state,
        failure: String::new(),
        class: String::new(),
        result: String::new(),
        about: None,
    }
}

fn starter(starter: Starter) -> TaskId {
    match starter {
        Starter::Task(id) => TaskId::Task(id.0),
        Starter::Action(id) => TaskId::Action(id.0),
    }
}

fn state(status: Status) -> TaskState {
    match status {
        Status::Created | Status::Running => TaskState::Running,
        Status::Suspended => TaskState::Suspended,
        Status::Succeeded => TaskState::Succeeded,
        Status::Failed => TaskState::Failed,
        Status::Evaporated => TaskState::Evaporated,
    }
}

/// What the designator of an action or motion says, and where it is performed.
pub(crate) fn about(image: &Image, designator: &Value, place: Place) -> About {
    let properties = as_designator(designator).map(|d| d.properties());
    let keys = properties.unwrap_or_default().into_iter().take(MAX_KEYS);
    let keys = keys.map(|(key, values)| {
        let name = key.as_symbol().map(|sym| image.name(sym).to_lowercase());
        let name = name.unwrap_or_else(|| text(image, &key));
        (name, text(image, &values.car_or_nil()))
    });
    let location = image.sources.locate(place);
    About {
        keys: keys.filter(|(name, _)| name != "type").collect(),
        place: location
            .as_ref()
            .map(ToString::to_string)
            .unwrap_or_default(),
        line: location.map(|l| l.line_text).unwrap_or_default(),
        module: String::new(),
    }
}

/// A value on one line.
fn text(image: &Image, value: &Value) -> String {
    let shown = aside(image, || print::to_string(image, value, false));
    on_line_of(&shown, LONGEST)
}
