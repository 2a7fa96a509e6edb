//! What the descriptions of robot and kitchen say, as variables for plans.

use std::rc::Rc;
use std::sync::Arc;

use crate::simulation::known_grasps::KnownGrasps;
use crate::simulation::transforms::MAP;
use cram::designator::vocabulary::{Domain, Vocabulary};
use cram::packages::symbol;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::value::Value;
use lisp::value::copy::Copier;
use robotics::location::{Direction, Orientation};
use robotics::robot::description::DriveKind;
use robotics::robot::{KinematicTree, Side};
use robotics::world::Models;
use robotics::world::kitchen_description::{
    KitchenDescription, PlaceProperty, PlaceRule, PlaceValue,
};

/// The package of the variables that hold the descriptions.
const PACKAGE: &str = "CRAM-ROBOT-INTERFACES";

/// Gives the variables their values. They are set, not defined by plans, since they depend on the
/// robot and the kitchen of a session.
pub(super) fn install(image: &mut Image, models: &Models) {
    describe_robot(image, models);
    name_things(image, models);
    describe_kitchen(image, models);
}

/// The robot that the variables describe.
struct DescribedRobot(Arc<KinematicTree>);

impl Extension for DescribedRobot {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        self
    }
}

fn describe_robot(image: &mut Image, models: &Models) {
    let frames = frames(models);
    for (name, frame) in frames {
        let sym = symbol(image, "CRAM-TF", name);
        image.define_special(sym, frame.map_or(Value::NIL, Value::string));
    }
    let robot = robot(image, models);
    let sym = symbol(image, PACKAGE, "*ROBOT*");
    image.define_special(sym, robot);
    let vocabulary = Vocabulary::of(image);
    vocabulary.forget(Domain::Arm);
    vocabulary.add(Domain::Arm, models.description.sides().map(Side::name));
    image.extend(DescribedRobot(Arc::clone(&models.robot)));
}

/// The kitchen that the variables describe.
struct DescribedKitchen(Arc<KinematicTree>);

impl Extension for DescribedKitchen {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        self
    }
}

fn describe_kitchen(image: &mut Image, models: &Models) {
    let kitchen = kitchen(image, &models.kitchen_description);
    let sym = symbol(image, PACKAGE, "*KITCHEN*");
    image.define_special(sym, kitchen);
    image.extend(DescribedKitchen(Arc::clone(&models.kitchen)));
}

/// Lets the variables describe the present robot and kitchen, if they describe others.
pub(crate) fn follow(image: &mut Image, models: &Models) {
    let robot = image.extension::<DescribedRobot>();
    let is_other = robot.is_none_or(|described| !Arc::ptr_eq(&described.0, &models.robot));
    if is_other {
        describe_robot(image, models);
    }
    let described = image.extension::<DescribedKitchen>();
    if !is_other && described.is_some_and(|described| Arc::ptr_eq(&described.0, &models.kitchen)) {
        return;
    }
    let vocabulary = Vocabulary::of(image);
    for domain in [Domain::Furniture, Domain::KitchenJoint, Domain::Frame] {
        vocabulary.forget(domain);
    }
    name_furniture(image, models);
    describe_kitchen(image, models);
}

/// Makes known what names there are, so that programs can be checked before they run.
fn name_things(image: &mut Image, models: &Models) {
    let vocabulary = Vocabulary::of(image);
    vocabulary.add_later(Domain::Grasp, KnownGrasps::built_in_names);
    vocabulary.add(Domain::ObjectType, models.objects.names());
    vocabulary.add(
        Domain::Direction,
        ["forward", "left", "right", "up", "down"],
    );
    vocabulary.add(Domain::Side, Direction::ALL.map(Direction::name));
    vocabulary.add(Domain::Level, ["topmost", "middle", "bottommost"]);
    vocabulary.add(Domain::Orientation, Orientation::ALL.map(Orientation::name));
    name_furniture(image, models);
}

/// Makes known what names there are of furniture and frames.
fn name_furniture(image: &mut Image, models: &Models) {
    let vocabulary = Vocabulary::of(image);
    let kitchen = &models.kitchen;
    let links = |tree: &KinematicTree| -> Vec<String> {
        let links = tree.links().map(|(_, link)| link.name.clone());
        let aliases = tree.aliases().iter().map(|alias| alias.name.clone());
        links.chain(aliases).collect()
    };
    let joints = kitchen.joints().map(|(_, joint)| joint.name.as_str());
    let odometry = models.description.base.odometry.as_deref();
    vocabulary.add(Domain::Furniture, links(kitchen));
    vocabulary.add(Domain::KitchenJoint, joints);
    vocabulary.add(Domain::Frame, links(&models.robot));
    vocabulary.add(Domain::Frame, links(kitchen));
    vocabulary.add(Domain::Frame, [MAP, "world"].into_iter().chain(odometry));
}

/// CRAM's variables that hold names of the robot's frames.
fn frames(models: &Models) -> [(&'static str, Option<String>); 5] {
    let description = &models.description;
    let link = |link| models.robot.link(link).name.clone();
    let tool = |wanted| {
        let mut sides = description.sides();
        let side = sides.find(|side| *side == wanted)?;
        Some(link(description.arm(side).tool))
    };
    let odometry = description.base.odometry.as_deref().unwrap_or(MAP);
    [
        ("*ODOM-FRAME*", Some(odometry.to_owned())),
        ("*ROBOT-BASE-FRAME*", Some(link(description.base.frame))),
        ("*ROBOT-TORSO-FRAME*", Some(link(description.torso.link))),
        ("*ROBOT-LEFT-TOOL-FRAME*", tool(Side::Left)),
        ("*ROBOT-RIGHT-TOOL-FRAME*", tool(Side::Right)),
    ]
}

/// What else is known of the robot, as a property list.
fn robot(image: &mut Image, models: &Models) -> Value {
    let description = &models.description;
    let lift = description.torso.joint;
    let lift = lift.map(|joint| Value::string(models.robot.joint(joint).name.as_str()));
    let camera = &models.robot.link(description.camera().frame).name;
    let sides: Vec<Side> = description.sides().collect();
    let mut of_arms = |of_arm: &dyn Fn(&mut Image, Side) -> Value| {
        let all = sides.iter().map(|side| of_arm(image, *side));
        Value::list(all.collect::<Vec<_>>())
    };
    let wrists = of_arms(&|image, side| {
        let wrist = &models.robot.link(description.arm(side).wrist).name;
        Value::list([keyword(image, side.name()), Value::string(wrist.as_str())])
    });
    let links = of_arms(&|image, side| {
        let robot = &models.robot;
        let first = description.arm(side).shoulder(robot);
        let links = robot
            .links()
            .filter(|(link, _)| robot.carries(first, *link));
        let links = links.map(|(_, link)| Value::string(link.name.as_str()));
        let arm = std::iter::once(keyword(image, side.name()));
        Value::list(arm.chain(links).collect::<Vec<_>>())
    });
    let grippers = of_arms(&|image, side| {
        let joint = description.arm(side).gripper.joint;
        let joint = &models.robot.joint(joint).name;
        Value::list([keyword(image, side.name()), Value::string(joint.as_str())])
    });
    let joints = of_arms(&|image, side| {
        let joints = description.arm(side).joints();
        let names = joints.iter().map(|j| &models.robot.joint(*j).name);
        let names = names.map(|name| Value::string(name.as_str()));
        let arm = std::iter::once(keyword(image, side.name()));
        Value::list(arm.chain(names).collect::<Vec<_>>())
    });
    let entries = [
        ("name", keyword(image, &description.name)),
        ("torso-joint", lift.unwrap_or(Value::NIL)),
        ("camera-frame", Value::string(camera.as_str())),
        ("wrists", wrists),
        ("arm-links", links),
        ("arm-joints", joints),
        ("grippers", grippers),
        (
            "drives",
            Value::from(description.base.kind != DriveKind::Fixed),
        ),
    ];
    property_list(image, entries)
}

/// What is known of the kitchen, as a property list.
fn kitchen(image: &mut Image, kitchen: &KitchenDescription) -> Value {
    let places = kitchen.places.iter().map(|(name, properties)| {
        let name = keyword(image, name);
        let properties = properties.iter().map(|one| place_property(image, one));
        let properties: Vec<Value> = properties.collect();
        Value::list(std::iter::once(name).chain(properties))
    });
    let places = Value::list(places.collect::<Vec<_>>());
    let start = kitchen
        .start
        .map_or(Value::NIL, |start| Value::list(start.map(Value::Double)));
    let behind = kitchen
        .behind
        .iter()
        .map(|pair| Value::list(pair.each_ref().map(|link| Value::string(link.as_str()))));
    let behind = Value::list(behind.collect::<Vec<_>>());
    let stores = kitchen.stores.iter().map(|store| {
        Value::list([
            keyword(image, &store.kind),
            Value::string(store.link.as_str()),
            Value::list(store.position.map(Value::Double)),
            Value::Double(store.heading),
        ])
    });
    let stores = Value::list(stores.collect::<Vec<_>>());
    let margins = kitchen.margins.iter().map(|(link, margins)| {
        let margins = margins.iter().copied().map(single);
        Value::list(std::iter::once(Value::string(link.as_str())).chain(margins))
    });
    let margins = Value::list(margins.collect::<Vec<_>>());
    let entries = [
        ("name", keyword(image, &kitchen.name)),
        ("start", start),
        ("behind", behind),
        ("places", places),
        ("usually", rules(image, &kitchen.usually)),
        ("belongs", rules(image, &kitchen.belongs)),
        ("stores", stores),
        ("margins", margins),
    ];
    property_list(image, entries)
}

/// Rules, each as a list of contexts, types and the name of the place.
fn rules(image: &mut Image, rules: &[PlaceRule]) -> Value {
    let rules = rules.iter().map(|rule| {
        let contexts = keywords(image, &rule.contexts);
        let types = keywords(image, &rule.types);
        Value::list([contexts, types, keyword(image, &rule.place)])
    });
    Value::list(rules.collect::<Vec<_>>())
}

/// A property as designators have it, but for furniture, of which there is only the name.
fn place_property(image: &mut Image, property: &PlaceProperty) -> Value {
    let value = match &property.value {
        PlaceValue::Furniture(link) => Value::string(link.as_str()),
        PlaceValue::Word(word) => keyword(image, word),
        PlaceValue::Words(words) => keywords(image, words),
        PlaceValue::Number(number) => single(*number),
        PlaceValue::Count(count) => Value::from(*count as i64),
    };
    Value::list([keyword(image, property.key), value])
}

/// A number as the reader of plans makes it of a decimal fraction.
fn single(number: f64) -> Value {
    Value::Single(number as f32)
}

fn keyword(image: &mut Image, name: &str) -> Value {
    image.keyword(&name.to_uppercase()).into()
}

fn keywords(image: &mut Image, names: &[String]) -> Value {
    let keywords: Vec<Value> = names.iter().map(|name| keyword(image, name)).collect();
    Value::list(keywords)
}

fn property_list<const N: usize>(image: &mut Image, entries: [(&str, Value); N]) -> Value {
    let entries = entries.into_iter();
    let flat = entries.flat_map(|(key, value)| [keyword(image, key), value]);
    Value::list(flat.collect::<Vec<_>>())
}
