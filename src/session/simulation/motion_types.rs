//! The motions that the robot can make, as rows of the table of types that plans see.

use cram::designator::schema::{self, Key, Kind, Text, TypeRow};
use cram::designator::value::Class;
use lisp::image::Image;
use lisp::value::known;
use robotics::motion::command::{ArgumentKind, MotionKey, MotionType, TYPES};

/// Makes all types of motions known.
pub(crate) fn install(image: &Image) {
    for motion in TYPES {
        schema::define(image, row(motion));
    }
}

fn row(motion: &MotionType) -> TypeRow {
    TypeRow {
        class: Class::Motion,
        name: Text::Borrowed(motion.name),
        variant: None,
        aliases: texts(motion.aliases),
        plan: known::NIL,
        keys: motion.keys.iter().map(key).collect(),
        one_of: texts(motion.one_of),
        is_known_by_keys: motion.is_known_by_keys,
        doc: Text::Borrowed(motion.doc),
        example: Some(Text::Borrowed(motion.example)),
    }
}

fn texts(names: &[&'static str]) -> Vec<Text> {
    names.iter().map(|name| Text::Borrowed(*name)).collect()
}

fn key(key: &MotionKey) -> Key {
    Key {
        name: Text::Borrowed(key.name),
        aliases: texts(key.aliases),
        kind: kind(key.kind),
        is_required: key.is_required,
        doc: Text::Borrowed(key.doc),
    }
}

fn kind(kind: ArgumentKind) -> Kind {
    match kind {
        ArgumentKind::Number => Kind::Number,
        ArgumentKind::Numbers => Kind::List,
        ArgumentKind::MapPose | ArgumentKind::Place => Kind::Place,
        ArgumentKind::Frame => Kind::Text,
        ArgumentKind::Word | ArgumentKind::Side | ArgumentKind::Sides => Kind::Keywords,
        ArgumentKind::Member(words) => Kind::Member(texts(words)),
        ArgumentKind::Described => Kind::Objects,
        ArgumentKind::InWorld => Kind::Object,
    }
}
