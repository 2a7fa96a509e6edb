//! The target that is what robots say: messages of ROS 2 on the wire.

use std::time::Duration;

use super::target::{Taken, Taker, Target};
use ros::cdr::{ByteOrder, decode, encode};
use ros::frames::Frames;
use ros::joints::Joints;
use ros::{Distribution, FieldType, Layouts, Multiplicity, Scalar, Value};

pub(super) fn targets() -> Vec<Target> {
    vec![Target {
        name: "ros2",
        share: 30,
        least_read: 95,
        words: &[
            "sensor_msgs/JointState\n",
            "tf2_msgs/TFMessage\n",
            "\0",
            "\0\0\0\0",
            "\u{1}\0\0\0",
            "\u{7f}\u{7f}\u{7f}\u{7f}",
            "\0\0\0\0\0\0\u{70}\u{7f}",
            "\u{2}\0\0\0a\0",
            "map\0",
        ],
        corpus: messages,
        open: message,
    }]
}

/// A message in which nothing is empty.
fn example(layouts: &Layouts, message: &str) -> Value {
    let fields = layouts.fields(message).unwrap_or_default().iter();
    let of = |kind: &FieldType| match kind {
        FieldType::Scalar(Scalar::Bool) => Value::Bool(true),
        FieldType::Scalar(Scalar::Integer { .. }) => Value::Integer(3),
        FieldType::Scalar(_) => Value::Float(0.5),
        FieldType::Text => Value::Text("map".to_owned()),
        FieldType::Message(name) => example(layouts, name),
    };
    let fields = fields.map(|field| {
        let value = match field.multiplicity {
            Multiplicity::One => of(&field.kind),
            Multiplicity::Array(count) => Value::list((0..count).map(|_| of(&field.kind))),
            Multiplicity::Sequence => Value::list((0..2).map(|_| of(&field.kind))),
        };
        (field.name.to_string().into(), value)
    });
    Value::Record(fields.collect())
}

/// Messages of all kinds, each behind a line with its name.
fn messages() -> Vec<Vec<u8>> {
    let layouts = Layouts::of(Distribution::DEFAULT).unwrap();
    let mut all = Vec::new();
    for name in layouts.messages() {
        for value in [example(&layouts, name), Value::Record(Vec::new())] {
            let bytes = encode(&layouts, name, &value).unwrap();
            all.push([name.as_bytes(), b"\n", &bytes].concat());
        }
    }
    super::corpus::small(all.into_iter())
}

/// Decodes a message in the layouts of all distributions and hears it as positions of joints and frames. What has
/// been decoded is encoded to bytes that are decoded to the same.
fn message() -> Taker {
    let all = Distribution::ALL.map(|distribution| Layouts::of(distribution).unwrap());
    Box::new(move |input| {
        let at = input.iter().position(|byte| *byte == b'\n');
        let (name, bytes) = input.split_at(at.unwrap_or(0));
        let name = String::from_utf8_lossy(name);
        let bytes = bytes.get(1..).unwrap_or_default();
        let mut is_read = false;
        for layouts in &all {
            for order in [ByteOrder::Little, ByteOrder::Big] {
                let Ok(value) = decode(layouts, &name, bytes, order) else {
                    continue;
                };
                is_read |= order == ByteOrder::Little;
                let now = Duration::from_secs(1);
                Joints::default().hear(&value, now);
                let mut frames = Frames::default();
                frames.hear(&value, false, now);
                frames.hear(&value, true, now);
                let encoded = encode(layouts, &name, &value).map_err(|error| error.to_string())?;
                let again = decode(layouts, &name, &encoded, ByteOrder::Little);
                let again = again.map_err(|error| error.to_string())?;
                let twice = encode(layouts, &name, &again).map_err(|error| error.to_string())?;
                if encoded != twice {
                    return Err(format!("{name} is decoded to another message"));
                }
            }
        }
        Ok(Taken::if_read(is_read))
    })
}
