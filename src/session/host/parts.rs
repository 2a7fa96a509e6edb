//! The parts of values for the inspector: every kind of value has named parts.

use super::SimulationHost;
use crate::simulation::motions::side_keyword;
use crate::simulation::names::{name_text, type_keyword};
use crate::simulation::properties::property;
use cram::TaskRef;
use cram::designator::value::as_designator;
use cram::pose::value::{as_placement, frame_of, pose_stamped};
use lisp::image::Image;
use lisp::print;
use lisp::types::type_of::type_of;
use lisp::value::Value;
use lisp::value::function::{Body, Deferred, Native};
use lisp::value::symbol::{FunctionCell, Sym};

/// Maximum number of parts shown.
const MAX_PARTS: usize = 60;
/// Maximum length of a part in characters.
const MAX_PART_LENGTH: usize = 100;

/// Longest list whose parts are its elements.
const MAX_LIST_LENGTH: usize = 100_000;

/// A value with its parts.
pub(crate) struct View {
    pub title: String,
    /// Names and values.
    pub parts: Vec<(String, Value)>,
}

impl View {
    /// The parts of a value. A symbol that names an object in the world stands for that object,
    /// and `:robot` for the robot.
    pub(crate) fn of(host: &SimulationHost, image: &mut Image, value: &Value) -> View {
        if let Some(view) = in_world(host, image, value) {
            return view;
        }
        let kind = type_of(image, value);
        let title = format!(
            "{}, of type {}",
            shown(image, value),
            print::to_string(image, &kind, true)
        );
        let parts = parts(image, value);
        View { title, parts }
    }

    /// The parts with numbers.
    pub(crate) fn text(&self, image: &Image) -> String {
        let mut text = format!("{}\n", self.title);
        let width = self
            .parts
            .iter()
            .map(|(name, _)| name.chars().count())
            .max();
        let width = width.unwrap_or(0).min(24);
        for (number, (name, value)) in self.parts.iter().enumerate().take(MAX_PARTS) {
            text.push_str(&format!(
                "{number:>3}: {name:<width$}  {}\n",
                shown(image, value)
            ));
        }
        if self.parts.len() > MAX_PARTS {
            text.push_str(&format!("     … {} more\n", self.parts.len() - MAX_PARTS));
        }
        text
    }
}

fn shown(image: &Image, value: &Value) -> String {
    if value.is_unbound() {
        return "(no value)".to_owned();
    }
    let text = print::to_string(image, value, true);
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(MAX_PART_LENGTH) {
        Some((end, _)) => format!("{} …", line.get(..end).unwrap_or(&line)),
        None => line,
    }
}

fn part(name: impl Into<String>, value: impl Into<Value>) -> (String, Value) {
    (name.into(), value.into())
}

/// Edge lengths (m) as a list, in whole millimetres.
fn size_value(size: &[f64; 3]) -> Value {
    let rounded = |edge: &f64| Value::from((edge * 1e3).round() / 1e3);
    Value::list(size.iter().map(rounded).collect::<Vec<_>>())
}

/// An object in the world, or the robot.
pub(crate) fn in_world(host: &SimulationHost, image: &mut Image, value: &Value) -> Option<View> {
    let simulation = &host.simulation;
    let Value::Symbol(sym, ..) = value else {
        return None;
    };
    let name = name_text(image, value)?;
    if image.is_keyword(*sym) && name == "ROBOT" {
        return Some(robot(host));
    }
    let object = simulation.world().object(&name).ok()?;
    let kind = object.type_name().to_owned();
    let mut parts = vec![part("type", type_keyword(image, &kind))];
    if let Ok(pose) = simulation.world().object_pose(&name) {
        parts.push(part("pose", pose_stamped("map", &pose)));
    }
    if let Some(known) = simulation.object_types().get(&kind) {
        parts.push(part("size (m)", size_value(&known.size())));
        parts.push(part("mass (kg)", known.mass));
    }
    let grasps: Vec<Value> = simulation
        .grasp_library()
        .grasps(&kind)
        .iter()
        .map(|grasp| type_keyword(image, grasp))
        .collect();
    parts.push(part("grasps", Value::list(grasps)));
    if let Some(side) = simulation.hand_of(&name) {
        parts.push(part("held by", side_keyword(image, side)));
    }
    Some(View {
        title: format!("{name}, an object in the world"),
        parts,
    })
}

fn robot(host: &SimulationHost) -> View {
    let simulation = &host.simulation;
    let mut parts = vec![part("base", pose_stamped("map", &simulation.base()))];
    for side in simulation.models.description.sides() {
        let name = format!("{side} hand");
        let held = simulation.held_by(side);
        let symbols: Vec<Value> = held.iter().map(|n| simulation.symbol_of(n)).collect();
        parts.push(part(format!("{name} holds"), Value::list(symbols)));
        let wrist = simulation.models.description.arm(side).wrist;
        let pose = simulation.world().link_pose(wrist);
        parts.push(part(format!("{name} at"), pose_stamped("map", &pose)));
    }
    let robot = &simulation.models.robot;
    let positions = &simulation.world().robot_configuration().joints;
    let joints: Vec<Value> = robot
        .joints()
        .map(|(id, joint)| {
            let position = Value::Double(robot.position(positions, id));
            Value::list([Value::string(&*joint.name), position])
        })
        .collect();
    parts.push(part("joints", Value::list(joints)));
    let kept: Vec<Value> = host
        .person
        .snapshots
        .kept_names()
        .map(Value::string)
        .collect();
    if !kept.is_empty() {
        parts.push(part("snapshots", Value::list(kept)));
    }
    View {
        title: "The robot".to_owned(),
        parts,
    }
}

fn parts(image: &mut Image, value: &Value) -> Vec<(String, Value)> {
    match value {
        Value::Cons(_) if is_proper(value) => {
            let items = value.iter_list().enumerate();
            items.map(|(at, item)| part(at.to_string(), item)).collect()
        }
        Value::Cons(cons) => vec![part("car", cons.car()), part("cdr", cons.cdr())],
        Value::Vector(vector) => {
            let items = vector.to_vec().into_iter().enumerate();
            items.map(|(at, item)| part(at.to_string(), item)).collect()
        }
        Value::Hash(table) => {
            let pairs = table.pairs().into_iter();
            pairs
                .map(|(key, item)| part(shown(image, &key), item))
                .collect()
        }
        Value::Instance(instance) => {
            let class = instance.class();
            let names: Vec<Sym> = class.slots.borrow().iter().map(|s| s.name).collect();
            let mut parts = vec![part("class", Value::Class(class))];
            parts.extend(names.into_iter().map(|name| {
                let slot = instance.slot(name).unwrap_or(Value::Unbound);
                part(image.name(name).to_lowercase(), slot)
            }));
            parts
        }
        Value::Symbol(sym, ..) => of_symbol(image, *sym),
        Value::Function(function) => match &function.body {
            Body::Closure { code, .. } => {
                let mut parts = vec![part("name", code.name.value())];
                if let Some(content) = image.content_to_look_at(code) {
                    let doc = content.doc.as_deref().map_or(Value::NIL, Value::string);
                    parts.push(part("lambda list", content.lambda_list.value()));
                    parts.push(part("documentation", doc));
                }
                parts
            }
            Body::Native(Native { name, .. }) | Body::Deferred(Deferred { name, .. }) => {
                vec![part("name", *name)]
            }
            Body::Generic(_) => Vec::new(),
        },
        Value::Foreign(_) => of_foreign(image, value),
        _ => Vec::new(),
    }
}

/// Whether it is a proper list, and not too long.
fn is_proper(value: &Value) -> bool {
    let mut rest = value.clone();
    for _ in 0..MAX_LIST_LENGTH {
        match &rest {
            Value::Cons(cons) => {
                let next = cons.cdr();
                rest = next;
            }
            end => return !end.is_true(),
        }
    }
    false
}

fn of_symbol(image: &Image, sym: Sym) -> Vec<(String, Value)> {
    let data = image.symbol(sym);
    let mut parts = vec![part("name", Value::string(&*data.name))];
    if let Some(package) = data.package {
        parts.push(part("package", Value::Package(package)));
    }
    if !data.value.is_unbound() {
        parts.push(part("value", data.value.clone()));
    }
    if let FunctionCell::Function(function) = &data.function {
        parts.push(part("function", Value::Function(function.clone())));
    }
    if data.plist.is_true() {
        parts.push(part("property list", data.plist.clone()));
    }
    parts
}

fn of_foreign(image: &mut Image, value: &Value) -> Vec<(String, Value)> {
    if let Some(task) = TaskRef::from_value(value) {
        let task = task.get();
        return vec![
            part("name", Value::string(task.name.to_string())),
            part(
                "status",
                Value::string(format!("{:?}", task.status()).to_lowercase()),
            ),
            part("path", task.node.path.clone()),
            part("result", task.result()),
        ];
    }
    if let Some(designator) = as_designator(value) {
        let mut parts: Vec<(String, Value)> = designator
            .properties()
            .into_iter()
            .map(|(key, values)| {
                let name = key.as_symbol().map(|sym| image.name(sym).to_lowercase());
                let single = !values.cdr_or_nil().is_true();
                let shown = if single { values.car_or_nil() } else { values };
                (name.unwrap_or_else(|| shown_key(image, &key)), shown)
            })
            .collect();
        if let Some(data) = designator.data.borrow().clone() {
            parts.push(part("refers to", data));
        }
        if let Some(successor) = designator.successor.borrow().clone() {
            parts.push(part("equated to", successor));
        }
        if let Some(name) = property(image, value, "NAME") {
            parts.push(part("object in the world", name));
        }
        return parts;
    }
    if let Some(placement) = as_placement(value) {
        let pose = placement.to_pose();
        let mut parts = Vec::new();
        if let Some(frame) = frame_of(value) {
            parts.push(part("frame", Value::string(&*frame)));
        }
        let t = pose.translation.vector;
        let q = pose.rotation.coords;
        for (name, number) in [("x (m)", t.x), ("y (m)", t.y), ("z (m)", t.z)] {
            parts.push(part(name, number));
        }
        let quaternion = [q.x, q.y, q.z, q.w].map(Value::Double);
        parts.push(part("quaternion x y z w", Value::list(quaternion)));
        parts.push(part("heading (rad)", spatial::pose::yaw(&pose)));
        return parts;
    }
    Vec::new()
}

fn shown_key(image: &Image, key: &Value) -> String {
    print::to_string(image, key, true).to_lowercase()
}
