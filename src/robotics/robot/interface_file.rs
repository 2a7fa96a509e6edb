//! Reading by which names a robot is driven, from the records `(interface …)` of its description.

use super::interface::{RobotInterface, RobotPart};
use crate::sexp::{DataError, DataProblem, Node, Record};
use closest_name::closest_name;

/// What else than a part an interface may be of.
const OTHERS: [&str; 4] = ["map", "joint-states", "perception", "server"];

/// The interface that records describe.
pub(super) fn interface<'a, 'r: 'a>(
    records: impl Iterator<Item = &'a Record<'r>>,
) -> Result<RobotInterface, DataError> {
    let mut interface = RobotInterface::default();
    let mut seen: Vec<String> = Vec::new();
    for record in records {
        let thing = record.thing("what it is of")?;
        let of = thing.symbol()?;
        if seen.iter().any(|known| known == of) {
            let twice = format!("(interface {of} …)");
            return Err(thing.error(DataProblem::Repeated(twice)));
        }
        seen.push(of.to_owned());
        check_keys(record, of)?;
        let name = record.optional("name");
        let name = name.map(|node| full_name(node)).transpose()?;
        let positive = |key: &str| record.optional(key).map(|n| n.positive()).transpose();
        let time_out = positive("time-out")?;
        let [tolerance, turn] = [positive("tolerance")?, positive("turn-tolerance")?];
        if let Some(part) = interface.part_mut(of) {
            part.name = name.unwrap_or_else(|| part.name.clone());
            part.time_out = time_out.unwrap_or(part.time_out);
            part.tolerance = tolerance.unwrap_or(part.tolerance);
            part.turn_tolerance = turn.unwrap_or(part.turn_tolerance);
            continue;
        }
        match of {
            "map" => {
                let frame = name.map(|name| name.trim_start_matches('/').to_owned());
                interface.map = frame.unwrap_or(interface.map);
                let age = positive("max-age")?;
                interface.max_frame_age = age.unwrap_or(interface.max_frame_age);
            }
            "joint-states" => {
                if let Some(names) = record.optional("names") {
                    let names = names.list()?;
                    let names = names.iter().map(|node| full_name(*node));
                    interface.joint_states = names.collect::<Result<_, _>>()?;
                }
                let age = positive("max-age")?;
                interface.max_joint_age = age.unwrap_or(interface.max_joint_age);
            }
            "perception" => interface.perception = name.unwrap_or(interface.perception),
            "server" => {
                interface.server_time_out = time_out.unwrap_or(interface.server_time_out);
            }
            _ => {
                let known = RobotPart::ALL.map(RobotPart::name);
                let known = known.into_iter().chain(OTHERS);
                return Err(thing.unknown("part", of, closest_name(of, known)));
            }
        }
    }
    Ok(interface)
}

/// The keys that a record of an interface may have, whatever it is of.
pub(super) const INTERFACE_KEYS: &[&str] = &[
    "name",
    "names",
    "time-out",
    "tolerance",
    "turn-tolerance",
    "max-age",
];

/// The keys that the interface of something may have.
fn keys(of: &str) -> &'static [&'static str] {
    match of {
        "map" => &["name", "max-age"],
        "joint-states" => &["names", "max-age"],
        "perception" => &["name"],
        "server" => &["time-out"],
        "base" => &["name", "time-out", "tolerance", "turn-tolerance"],
        // Where the camera looks says only its server.
        "neck" => &["name", "time-out"],
        _ => &["name", "time-out", "tolerance"],
    }
}

/// Refuses keys that mean nothing for what a record is of.
fn check_keys(record: &Record<'_>, of: &str) -> Result<(), DataError> {
    let known = keys(of);
    match record.fields().iter().find(|(key, _)| !known.contains(key)) {
        None => Ok(()),
        Some((key, value)) => Err(value.error(DataProblem::UnknownKey {
            record: format!("interface {of}"),
            key: (*key).to_owned(),
            known: known.iter().map(|key| (*key).to_owned()).collect(),
            closest: closest_name(key, known.iter().copied()).map(|key| format!(":{key}")),
        })),
    }
}

/// A name of ROS, which begins at the root.
fn full_name(node: Node<'_>) -> Result<String, DataError> {
    let name = node.symbol()?.trim_start_matches('/');
    match name.is_empty() {
        true => Err(node.expected("a name such as /navigate_to_pose")),
        false => Ok(format!("/{name}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sexp::DataFile;

    fn read(text: &str) -> Result<RobotInterface, String> {
        let file = DataFile::read(text, "robot.sexp").unwrap();
        let records = file
            .nodes()
            .map(|node| node.record("record", &[("interface", INTERFACE_KEYS)]));
        let records = records.collect::<Result<Vec<_>, _>>().unwrap();
        interface(records.iter()).map_err(|error| error.to_string())
    }

    #[test]
    fn what_a_record_leaves_out_stays() {
        let interface =
            read("(interface base :name go :time-out 3)\n(interface map :max-age 2)").unwrap();
        let base = interface.part(RobotPart::Base).unwrap();
        assert_eq!(
            (base.name.as_str(), base.time_out, base.tolerance),
            ("/go", 3.0, 0.05)
        );
        assert_eq!(
            (interface.map.as_str(), interface.max_frame_age),
            ("map", 2.0)
        );
    }

    #[test]
    fn keys_that_mean_nothing_are_refused_where_they_stand() {
        let wrong = |text| read(text).unwrap_err();
        assert_eq!(
            wrong("(interface torso :name /lift)\n(interface base :max-age 1)"),
            "robot.sexp:2:26: (interface base …) has no key :max-age; it knows :name :time-out :tolerance :turn-tolerance"
        );
        assert!(
            wrong("(interface server :name /x)").contains("(interface server …) has no key :name")
        );
        assert!(wrong("(interface joint-states :name /x)").contains("did you mean :names?"));
        assert!(wrong("(interface neck :tolerance 1)").contains("has no key :tolerance"));
        assert!(
            wrong("(interface map :max-age 1)\n(interface map :max-age 1)")
                .contains("robot.sexp:2")
        );
        assert!(wrong("(interface leg :name /x)").contains("no part named leg"));
    }
}
