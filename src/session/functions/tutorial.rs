//! The functions of the tutorial's package that query or change the world.

use std::rc::Rc;

use super::objects::Spawning;
use crate::log_level::LogLevel;
use crate::simulation::motions::side;
use crate::simulation::names::{name_text, suggestion, type_keyword, type_text_of};
use crate::simulation::properties::property;
use crate::simulation::{Axes, Simulation};
use cram::designator::value::current;
use cram::pose::value::{as_placement, frame_of, pose_stamped, transform_stamped};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::foreign::{Foreign, ForeignCopy, PrintContext};
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use lisp::value::string::LispString;
use lisp::value::symbol::Sym;

/// Default length (m) of coordinate axes.
const AXES_SIZE: f64 = 0.3;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-PICK-PLACE-TUTORIAL`.
pub(super) static TABLE: &[Builtin] = builtins![
    init_projection,
    spawn_object,
    list_available_objects,
    list_defined_grasps,
    visualize_coordinates,
    get_kitchen_urdf,
    move_kitchen_joint,
    get_robot_transformation,
    get_current_pose_of_object,
    get_obj_name,
    get_object_name,
    look_up_transformation
];

/// Takes the world back to its start: no objects, the robot at the origin with its arms tucked.
///
/// `(pp-tut:init-projection)` => `T`
#[builtin(edit)]
fn init_projection(simulation: &mut Simulation) -> bool {
    simulation.restart();
    true
}

/// Puts an object (by default a red bottle named BOTTLE-1) into the world and lets it come to rest. An
/// existing object with that name is moved.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr-utils:object-exists 'bottle-1))` => `T`
#[builtin(_, "pose &optional type name color", edit)]
fn spawn_object(
    simulation: &mut Simulation,
    image: &mut Image,
    pose: &Value,
    kind: Option<&Value>,
    name: Option<&Value>,
    color: Option<&Value>,
) -> Result<()> {
    let pose = simulation.pose_in_map(image, pose)?;
    let kind = match kind {
        Some(kind) => kind.clone(),
        None => image.keyword("BOTTLE").into(),
    };
    let name = match name {
        Some(name) => name.clone(),
        None => {
            let package = image.packages.find("CRAM-PICK-PLACE-TUTORIAL");
            let package = package.unwrap_or_else(|| image.current_package());
            let kind = type_text_of(image, &kind)?;
            image
                .intern(package, &format!("{}-1", kind.to_uppercase()))
                .into()
        }
    };
    let is_new =
        name_text(image, &name).is_some_and(|name| simulation.world.object(&name).is_err());
    let red = is_new.then(|| Value::list([Value::Int(1), Value::Int(0), Value::Int(0)]));
    let color = color.cloned().or(red);
    simulation.spawn(
        image,
        &Spawning {
            name: &name,
            kind: &kind,
            pose,
            color: color.as_ref(),
            mass: None,
        },
    )
}

/// The types of objects that can be spawned.
///
/// `(first (pp-tut:list-available-objects))` => `:TRAY`
#[builtin]
fn list_available_objects(simulation: &mut Simulation, image: &mut Image) -> Vec<Value> {
    let types = simulation.models.objects.types();
    types.map(|kind| type_keyword(image, &kind.name)).collect()
}

/// The grasps that are defined for a type of objects; with an arm, those for that arm.
///
/// `(pp-tut:list-defined-grasps :cup)` => `(:BACK :FRONT :LEFT-SIDE :RIGHT-SIDE)`
/// `(pp-tut:list-defined-grasps :plate :left)` => `(:LEFT-SIDE :TOP :TOP-FRONT :TOP-LEFT :TOP-RIGHT)`
#[builtin(_, "type &optional arm")]
fn list_defined_grasps(
    simulation: &mut Simulation,
    image: &mut Image,
    kind: &Value,
    arm: Option<&Value>,
) -> Result<Vec<Value>> {
    let kind = type_text_of(image, kind)?;
    let arm = match arm.filter(|given| given.is_true()) {
        Some(arm) => Some(side(image, arm)?),
        None => None,
    };
    let library = &simulation.grasps;
    Ok(library
        .grasps(&kind)
        .iter()
        .filter(|name| arm.is_none_or(|arm| library.get(&kind, arm, name).is_some()))
        .map(|name| type_keyword(image, name))
        .collect())
}

/// Shows coordinate axes, as long as SIZE (m), at an object, given by its name or type, or at a pose; x is
/// red, y green, z blue. They stay until others are shown.
///
/// `(pp-tut:visualize-coordinates (pp-tut:make-pose "map" '((0 1 0) (0 0 0 1))) 0.5)` => `NIL`
#[builtin]
fn visualize_coordinates(
    simulation: &mut Simulation,
    image: &mut Image,
    object_or_pose: &Value,
    size: Option<&Value>,
) -> Result<()> {
    let size = match size {
        Some(size) => number::to_f64(size)
            .filter(|size| size.is_finite() && *size > 0.0)
            .ok_or_else(|| {
                let shown = print::to_string(image, size, true);
                Raise::simple(format!(
                    "{shown} is no length of axes: a number of metres above 0 was expected."
                ))
            })?,
        None => AXES_SIZE,
    };
    let pose = match as_placement(object_or_pose) {
        Some(placement) => {
            if frame_of(object_or_pose).is_some_and(|frame| &*frame != "map") {
                image.output.fresh_line();
                image.output.write(
                    "WARNING: Pose is not in MAP frame. It is visualized with respect to the MAP though.\n",
                );
            }
            placement.to_pose()
        }
        None => {
            let Some(name) = name_text(image, object_or_pose) else {
                let shown = print::to_string(image, object_or_pose, true);
                return Err(Raise::simple(format!(
                    "{shown} cannot be visualized: the name or type of an object, or a pose as make-pose makes it, was expected."
                )));
            };
            let named = simulation.world.object_pose(&name).ok();
            let typed = || {
                let kind = name.to_lowercase();
                let object = simulation.world.objects().find(|o| o.type_name() == kind)?;
                simulation.world.object_pose(object.name()).ok()
            };
            match named.or_else(typed) {
                Some(pose) => pose,
                None => {
                    image.output.fresh_line();
                    image.output.write(
                        "WARNING: Unknown object, please either give an object name or object type.\n",
                    );
                    return Ok(());
                }
            }
        }
    };
    simulation.axes = Some(Axes { pose, size });
    Ok(())
}

/// The kitchen's description as a value.
struct KitchenUrdf {
    name: String,
    symbol: Sym,
}

impl Foreign for KitchenUrdf {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Same
    }

    fn type_symbol(&self) -> Sym {
        self.symbol
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        format!("#<CL-URDF:ROBOT {:?}>", self.name)
    }
}

/// The description of the kitchen.
#[builtin]
fn get_kitchen_urdf(simulation: &mut Simulation, image: &mut Image) -> Value {
    let symbol = image.keyword("ROBOT");
    Value::foreign(KitchenUrdf {
        name: simulation.models.kitchen_description.urdf_name.clone(),
        symbol,
    })
}

/// The joint of the kitchen that is meant where none is named.
fn usual_joint(simulation: &Simulation) -> Result<String> {
    let models = &simulation.models;
    let joint = models.kitchen_description.usual_joint;
    let name = joint.map(|joint| models.kitchen.joint(joint).name.clone());
    name.ok_or_else(|| {
        Raise::simple(
            "This kitchen has no usual joint: give a :joint-name, or say in its description, \
             (kitchen NAME :usual-joint JOINT), which one is meant.",
        )
    })
}

/// Opens or closes a drawer or a door, with what is in it; an error if anything is in the way.
///
/// `(pp-tut:move-kitchen-joint)` => `NIL`
#[builtin(edit)]
fn move_kitchen_joint(
    simulation: &mut Simulation,
    #[key] joint_name: Option<&Value>,
    #[key] joint_angle: Option<&Value>,
    #[key] _kitchen_name: Option<&Value>,
) -> Result<()> {
    let name = match joint_name {
        Some(Value::Str(name)) => name.text(),
        Some(other) => return Err(Raise::type_error(other, known::STRING)),
        None => usual_joint(simulation)?,
    };
    let angle = joint_angle.and_then(number::to_f64).unwrap_or(0.2);
    if simulation.models.kitchen.joint_named(&name).is_none() {
        let joints = simulation.models.kitchen.joints();
        let near = suggestion(&name, joints.map(|(_, joint)| joint.name.as_str()), |n| {
            format!("{n:?}")
        });
        return Err(Raise::simple(format!(
            "The kitchen has no joint {name:?}{near}{}",
            if near.is_empty() { "." } else { "" }
        )));
    }
    let in_the_way = simulation.world.way_of_kitchen_joint(&name, angle);
    if let Some((at, hit)) = in_the_way.map_err(Raise::reporting)? {
        return Err(Raise::simple(format!(
            "{name} is not moved to {angle:.2}: at {at:.2}, {} and {} would be in each other.",
            hit.moving, hit.other
        )));
    }
    simulation
        .world
        .teleport_kitchen_joint(&name, angle)
        .map_err(Raise::reporting)?;
    simulation.world.settle(2.0);
    Ok(())
}

/// The transform from the map to the robot's base.
///
/// `(progn (pp-tut:init-projection) (pp-tut:get-robot-transformation))` => `#<"map" "base_footprint" ((0.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn get_robot_transformation(simulation: &mut Simulation) -> Value {
    transform_stamped("map", simulation.base_frame(), &simulation.believed_base())
}

/// The pose of an object in the map frame.
#[builtin]
fn get_current_pose_of_object(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
) -> Result<Value> {
    let name = simulation.object_named(image, name)?;
    let pose = simulation
        .world
        .object_pose(&name)
        .map_err(Raise::reporting)?;
    Ok(pose_stamped("map", &pose))
}

/// The name of a perceived object.
#[builtin]
fn get_obj_name(simulation: &mut Simulation, image: &mut Image, object: &Value) -> Option<Value> {
    let name = property(image, &current(object), "NAME");
    if name.is_none() {
        simulation.log(
            image,
            LogLevel::Debug,
            "(PP-TUT GET-OBJ-NAME)",
            "an object has no name before it is perceived",
        );
    }
    name
}

/// The name of a perceived object.
#[builtin]
fn get_object_name(
    simulation: &mut Simulation,
    image: &mut Image,
    object: &Value,
) -> Option<Value> {
    get_obj_name(simulation, image, object)
}

/// The transform from one frame to another.
#[builtin]
fn look_up_transformation(
    simulation: &mut Simulation,
    image: &mut Image,
    parent: &Rc<LispString>,
    child: &Rc<LispString>,
) -> Result<Value> {
    let (parent, child) = (parent.text(), child.text());
    let from = simulation.frame_in_map(image, &parent)?;
    let to = simulation.frame_in_map(image, &child)?;
    Ok(transform_stamped(&parent, &child, &(from.inverse() * to)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialogue::Evaluate;
    use crate::{Session, SessionOptions};
    use spatial::Pose;

    fn session() -> Session {
        let mut session = Session::new(&SessionOptions::default()).expect("a session");
        run(&mut session, "(in-package :pp-tut)");
        session
    }

    fn run(session: &mut Session, text: &str) {
        session.evaluate("test", text, &mut |_| {});
    }

    fn axes(session: &Session) -> Option<Axes> {
        session.simulation().axes().cloned()
    }

    #[test]
    fn axes_are_in_the_world_until_others_are_shown_or_it_begins_anew() {
        let mut session = session();
        run(
            &mut session,
            "(spawn-object '((1.5 1 1) (0 0 0 1)) :cup 'cup-1)",
        );
        let cup = session.simulation().world().object_pose("CUP-1");
        let pose = cup.expect("there is a cup");
        let size = AXES_SIZE;
        run(&mut session, "(visualize-coordinates 'cup-1)");
        assert_eq!(axes(&session), Some(Axes { pose, size }));
        let text = "(visualize-coordinates (make-pose \"base_footprint\" '((1 2 0) (0 0 0 1))) 1)";
        run(&mut session, text);
        let pose = Pose::translation(1.0, 2.0, 0.0);
        let elsewhere = Some(Axes { pose, size: 1.0 });
        assert_eq!(axes(&session), elsewhere);
        run(&mut session, "(visualize-coordinates 'saucer-1)");
        run(&mut session, "(visualize-coordinates 'cup-1 -1)");
        assert_eq!(axes(&session), elsewhere);
        run(&mut session, "(init-projection)");
        assert_eq!(axes(&session), None);
    }
}
