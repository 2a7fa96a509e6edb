//! What the robot's camera sees, for whoever asks.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use ros::{Value, message};
use session::{Datum, Session};

/// The answer to a question, as a message; poses are in the frame `map`.
pub(super) fn see(session: &mut Session, question: &Value, map: &str) -> Value {
    let wanted = |name: &str| {
        let text = question.get(name).and_then(Value::as_text);
        let text = text.filter(|text| !text.is_empty());
        text.map_or(Datum::Nil, |text| Datum::keyword(&text.to_uppercase()))
    };
    let arguments = [wanted("type"), wanted("name")];
    let seen = session.call("planwright-robot::see", &arguments);
    let stamp = SystemTime::now().duration_since(UNIX_EPOCH);
    let stamp = stamp.unwrap_or(Duration::ZERO);
    match seen.map(|values| values.into_iter().next()) {
        Ok(Some(Datum::List(seen))) => {
            let objects = seen
                .iter()
                .filter_map(|object| seen_object(object, stamp, map));
            Value::record([("objects", Value::list(objects))])
        }
        Ok(_) => Value::record([]),
        Err(failure) => {
            let report = match failure.unhandled() {
                Some(condition) => condition.abort.report.trim_end().to_owned(),
                None => failure.to_string(),
            };
            Value::record([("error", report.as_str().into())])
        }
    }
}

/// An object, given as a list of name, type and pose.
fn seen_object(object: &Datum, stamp: Duration, map: &str) -> Option<Value> {
    let Datum::List(parts) = object else {
        return None;
    };
    let [Datum::String(name), Datum::String(kind), Datum::Pose(pose)] = parts.as_slice() else {
        return None;
    };
    let pose = Value::record([
        ("header", message::header(stamp, map)),
        ("pose", message::pose(&pose.pose)),
    ]);
    Some(Value::record([
        ("type", kind.to_lowercase().as_str().into()),
        ("name", name.as_str().into()),
        ("pose", pose),
    ]))
}
