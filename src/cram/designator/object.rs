//! Object designators after perception, and the data that they refer to.

use super::names;
use super::value;
use super::value::{Class, Designator, Quantifier};
use crate::packages;
use crate::pose::value::{pose_stamped, transform_stamped};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::foreign::{Foreign, ForeignCopy, PrintContext};
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use spatial::Pose;

/// The name in the world of what a perceived object's designator refers to.
#[builtin]
fn object_identifier(image: &mut Image, data: &Value) -> Result<Value, Box<Raise>> {
    Ok(object_data(image, data)?.identifier.clone())
}

/// The pose of a perceived object in the robot's base frame when it was seen.
#[builtin]
fn object_pose(image: &mut Image, data: &Value) -> Result<Value, Box<Raise>> {
    Ok(object_data(image, data)?.pose.clone())
}

/// The data that the designator of a perceived object refers to.
pub(crate) struct ObjectData {
    /// The object's name in the world.
    pub(crate) identifier: Value,
    /// Where it was seen, in the robot's base frame.
    pub pose: Value,
    class_symbol: Sym,
}

impl Foreign for ObjectData {
    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        ForeignCopy::New(Box::new(ObjectData {
            identifier: copier.value(&self.identifier),
            pose: copier.value(&self.pose),
            class_symbol: self.class_symbol,
        }))
    }

    fn type_symbol(&self) -> Sym {
        self.class_symbol
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        let name = names::name_text(context, &self.identifier).unwrap_or_default();
        format!("#<OBJECT-DESIGNATOR-DATA {name}>")
    }
}

/// The data itself, or that of a perceived object's designator.
fn object_data<'a>(image: &mut Image, argument: &'a Value) -> Result<&'a ObjectData, Box<Raise>> {
    match argument.as_foreign::<ObjectData>() {
        Some(data) => Ok(data),
        None => {
            let expected = packages::symbol(image, "CRAM-DESIGNATORS", "OBJECT-DESIGNATOR-DATA");
            Err(Raise::type_error(argument, expected))
        }
    }
}

/// A designator of a perceived object: type, name and poses, and the other properties of the query.
/// `name` is the name given when the object was spawned, `kind` the keyword of its type; the poses
/// are in the frame `base`, that of the robot's base, and in the map. It is not equated with the query.
pub fn perceived(
    image: &mut Image,
    query: &Value,
    name: Value,
    kind: Value,
    base: &str,
    pose_in_base: &Pose,
    pose_in_map: &Pose,
) -> Value {
    let frame = names::name_text(image, &name).unwrap_or_default();
    let frame = names::rosify(&frame);
    let pose = pose_stamped(base, pose_in_base);
    let poses = [
        ("POSE", pose.clone()),
        ("TRANSFORM", transform_stamped(base, &frame, pose_in_base)),
        ("POSE-IN-MAP", pose_stamped("map", pose_in_map)),
        (
            "TRANSFORM-IN-MAP",
            transform_stamped("map", &frame, pose_in_map),
        ),
    ];
    let poses: Vec<Value> = poses
        .into_iter()
        .map(|(key, value)| property(image, key, value))
        .collect();
    let mut properties = vec![
        property(image, "TYPE", kind),
        property(image, "NAME", name.clone()),
        property(image, "POSE", Value::list(poses)),
    ];
    if let Some(query) = value::as_designator(query) {
        for old in query.description.borrow().iter_list() {
            let key = old.car_or_nil();
            if !properties.iter().any(|p| p.car_or_nil().is_eql(&key)) {
                properties.push(old);
            }
        }
    }
    let class_symbol = packages::symbol(image, "CRAM-DESIGNATORS", "OBJECT-DESIGNATOR-DATA");
    let designator = Designator::new(image, Class::Object, Quantifier::A, Value::list(properties));
    *designator.data.borrow_mut() = Some(Value::foreign(ObjectData {
        identifier: name,
        pose,
        class_symbol,
    }));
    designator.is_effective.set(true);
    Value::foreign(designator)
}

fn property(image: &mut Image, key: &str, value: Value) -> Value {
    Value::list([image.keyword(key).into(), value])
}

/// One of the poses of a perceived object, by its key (`"POSE"`, `"POSE-IN-MAP"`, …).
pub(crate) fn pose_property(image: &Image, object: &Value, key: &str) -> Option<Value> {
    let designator = value::as_class(object, Class::Object)?;
    let poses = designator.property_named(image, "POSE")?;
    poses
        .iter_list()
        .find(|p| {
            p.car_or_nil()
                .as_symbol()
                .is_some_and(|s| image.name(s) == key)
        })
        .map(|p| p.cdr_or_nil().car_or_nil())
}

/// Functions of package `CRAM-DESIGNATORS`.
pub(crate) static TABLE: &[Builtin] = builtins![object_identifier, object_pose,];
