//! Converting motion designators to motions.

use super::Simulation;
use super::names::{name_text, type_text};
use super::transforms::BASE;
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::motion::{
    CollisionMode, Detect, DetectQuery, DetectedObject, Drive, GripperCommand, Look, LookDirection,
    LookTarget, Motion, MoveGripper, MoveJoints, MoveTcp, MoveTorso, PoseGoal, ProcessModule, Put,
    TcpPath, Together,
};
use crate::plan::designator::MotionRequest;
use crate::plan::designator::failure::no_process_module;
use crate::plan::designator::object;
use crate::plan::designator::value::as_designator;
use crate::plan::designator::value::current;
use crate::plan::pose::value::frame_of;
use crate::robot::Side;
use crate::session::simulation::properties::property;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The sides that an arm or gripper argument names: `:LEFT`, `:RIGHT`, or a list of them.
pub(in crate::session) fn sides(image: &Image, value: &Value) -> Result<Vec<Side>> {
    match value {
        Value::Cons(_) => value.iter_list().map(|v| side(image, &v)).collect(),
        single => side(image, single).map(|s| vec![s]),
    }
}

/// The side that an argument names.
pub(in crate::session) fn side(image: &Image, value: &Value) -> Result<Side> {
    let text = name_text(image, value);
    match text.as_deref() {
        Some("LEFT") => Ok(Side::Left),
        Some("RIGHT") => Ok(Side::Right),
        _ => Err(Raise::simple(format!(
            "{} is no arm: the robot has the arms :LEFT and :RIGHT.",
            print::to_string(image, value, true)
        ))),
    }
}

/// `:LEFT` or `:RIGHT`.
pub(in crate::session) fn side_keyword(image: &mut Image, side: Side) -> Value {
    let name = match side {
        Side::Left => "LEFT",
        Side::Right => "RIGHT",
    };
    image.keyword(name).into()
}

/// The list of finite numbers.
fn numbers(value: &Value) -> Result<Vec<f64>> {
    value.iter_list().map(|v| real(&v)).collect()
}

fn real(value: &Value) -> Result<f64> {
    number::to_f64(value)
        .filter(|x| x.is_finite())
        .ok_or_else(|| Raise::type_error(value, known::REAL))
}

impl Simulation {
    /// The motion that a designator describes, and the designator named in its failures.
    pub(in crate::session) fn motion_for(
        &mut self,
        image: &mut Image,
        request: &MotionRequest,
    ) -> Result<(Box<dyn Motion>, Value)> {
        let designator = &request.designator;
        let get = |image: &mut Image, key: &str| property(image, designator, key);
        let required = |image: &mut Image, key: &str| {
            property(image, designator, key).ok_or_else(|| {
                Raise::simple(format!(
                    "{} lacks ({} …).",
                    print::to_string(image, designator, false),
                    key.to_lowercase()
                ))
            })
        };
        let motion: Box<dyn Motion> = match request.motion_type.as_str() {
            "GOING" => {
                let location = match get(image, "TARGET") {
                    Some(target) => target,
                    None => required(image, "POSE")?,
                };
                let pose = Simulation::location_pose(image, &location)?;
                let goal = self.pose_as_given(image, &pose)?;
                return Ok((Box::new(Drive::new(&goal)), location));
            }
            "MOVING-TORSO" => {
                let height = required(image, "JOINT-ANGLE")?;
                Box::new(MoveTorso::new(real(&height)?))
            }
            "LOOKING" => return self.looking(image, designator),
            "DETECTING" => {
                let object = required(image, "OBJECT")?;
                let query = self.detecting(image, &object);
                self.sought = Some(query.clone());
                return Ok((Box::new(Detect::new(query)), object));
            }
            "OPENING" | "OPENING-GRIPPER" => {
                self.gripper(image, designator, |_| Ok(GripperCommand::Open))?
            }
            "CLOSING" | "CLOSING-GRIPPER" => {
                self.gripper(image, designator, |_| Ok(GripperCommand::Close))?
            }
            "MOVING-GRIPPER-JOINT" => {
                let position = required(image, "JOINT-ANGLE")?;
                let position = real(&position)?;
                self.gripper(image, designator, |_| {
                    Ok(GripperCommand::Position(position))
                })?
            }
            "GRIPPING" => {
                let object = get(image, "OBJECT").map(|o| current(&o));
                let name = object.and_then(|o| property(image, &o, "NAME"));
                let object = match name {
                    Some(name) => Some(self.object_named(image, &name)?),
                    None => None,
                };
                self.gripper(image, designator, |_| {
                    Ok(GripperCommand::Grip {
                        object: object.clone(),
                    })
                })?
            }
            "MOVING-TCP" => {
                let mode = get(image, "COLLISION-MODE");
                let mode = mode.and_then(|m| name_text(image, &m));
                let (path, mode) = match mode.as_deref() {
                    Some("ALLOW-ALL") => (TcpPath::Straight, CollisionMode::AllowAll),
                    Some("ALLOW-HAND" | "ALLOW-FINGERS" | "ALLOW-ARM" | "ALLOW-ATTACHED") => {
                        (TcpPath::Straight, CollisionMode::AllowHand)
                    }
                    _ => (TcpPath::Free, CollisionMode::AvoidAll),
                };
                let mut goals = [None, None];
                for (goal, keys) in goals
                    .iter_mut()
                    .zip([["LEFT-TARGET", "LEFT-POSE"], ["RIGHT-TARGET", "RIGHT-POSE"]])
                {
                    for key in keys {
                        if let Some(target) = get(image, key) {
                            *goal = Some(self.tcp_goal(image, &target)?);
                        }
                    }
                }
                let [left, right] = goals;
                Box::new(MoveTcp::new(left, right, path, mode))
            }
            "PUTTING" => {
                let arm = required(image, "ARM")?;
                let target = required(image, "TARGET")?;
                let goal = self.tcp_goal(image, &target)?;
                Box::new(Put::new(side(image, &arm)?, goal))
            }
            "MOVING-ARM-JOINTS" => {
                let mut configurations = [None, None];
                for (configuration, keys) in configurations.iter_mut().zip([
                    ["LEFT-CONFIGURATION", "LEFT-JOINT-STATES"],
                    ["RIGHT-CONFIGURATION", "RIGHT-JOINT-STATES"],
                ]) {
                    for key in keys {
                        if let Some(list) = get(image, key) {
                            *configuration = Some(numbers(&list)?);
                        }
                    }
                }
                let [left, right] = configurations;
                Box::new(MoveJoints::new(left, right))
            }
            _ => {
                let shown = print::to_string(image, designator, false);
                return Err(no_process_module(image, &shown));
            }
        };
        Ok((motion, designator.clone()))
    }

    fn tcp_goal(&self, image: &mut Image, target: &Value) -> Result<PoseGoal> {
        let pose = Simulation::location_pose(image, target)?;
        Ok(match frame_of(&pose).as_deref() {
            Some(BASE) => PoseGoal::InBase(self.pose_as_given(image, &pose)?),
            _ => PoseGoal::InMap(self.pose_in_map(image, &pose)?),
        })
    }

    fn gripper(
        &self,
        image: &mut Image,
        designator: &Value,
        command: impl Fn(Side) -> Result<GripperCommand>,
    ) -> Result<Box<dyn Motion>> {
        let Some(gripper) = property(image, designator, "GRIPPER") else {
            let shown = print::to_string(image, designator, false);
            return Err(no_process_module(image, &shown));
        };
        let mut motions: Vec<Box<dyn Motion>> = Vec::new();
        for side in sides(image, &gripper)? {
            motions.push(Box::new(MoveGripper::new(side, command(side)?)));
        }
        Ok(Box::new(Together::new(ProcessModule::Grippers, motions)))
    }

    fn looking(
        &mut self,
        image: &mut Image,
        designator: &Value,
    ) -> Result<(Box<dyn Motion>, Value)> {
        let get = |image: &mut Image, key: &str| property(image, designator, key);
        let target = get(image, "TARGET").or_else(|| get(image, "POSE"));
        if let Some(target) = target {
            let pose = Simulation::location_pose(image, &target)?;
            let look = match frame_of(&pose).as_deref() {
                Some(BASE) => LookTarget::InBase(self.pose_as_given(image, &pose)?),
                _ => LookTarget::InMap(self.pose_in_map(image, &pose)?),
            };
            return Ok((Box::new(Look::new(look)), target));
        }
        if let Some(frame) = get(image, "FRAME") {
            let name = frame.as_text().unwrap_or_default();
            self.frame_in_map(image, &name)?;
            return Ok((Box::new(Look::new(LookTarget::Frame(name))), frame));
        }
        if let Some(object) = get(image, "OBJECT") {
            let current = current(&object);
            let name = property(image, &current, "NAME").unwrap_or(Value::NIL);
            let name = self.object_named(image, &name)?;
            return Ok((Box::new(Look::new(LookTarget::Frame(name))), object));
        }
        let Some(direction) = get(image, "DIRECTION") else {
            let shown = print::to_string(image, designator, false);
            return Err(no_process_module(image, &shown));
        };
        let text = name_text(image, &direction).unwrap_or_default();
        let target = match text.as_str() {
            "FORWARD" => LookDirection::Forward,
            "LEFT" => LookDirection::Left,
            "RIGHT" => LookDirection::Right,
            "UP" => LookDirection::Up,
            "DOWN" => LookDirection::Down,
            _ => {
                return Err(Raise::simple(format!(
                    "{text} direction is unknown for PR2 projection PTU\n\
                     the head looks forward, left, right, up or down"
                )));
            }
        };
        Ok((
            Box::new(Look::new(LookTarget::Direction(target))),
            direction,
        ))
    }

    fn detecting(&self, image: &mut Image, object: &Value) -> DetectQuery {
        let name = property(image, object, "NAME");
        let types = property(image, object, "TYPE");
        DetectQuery {
            name: name.and_then(|n| name_text(image, &n)),
            types: types
                .and_then(|t| type_text(image, &t))
                .into_iter()
                .collect(),
            description: print::to_string(image, object, false),
        }
    }

    /// Designators of detected objects: the first one, or a list of all if all were requested.
    pub(in crate::session) fn detected(
        &mut self,
        image: &mut Image,
        objects: &[DetectedObject],
        query: &Value,
    ) -> Value {
        let found: Vec<Value> = objects
            .iter()
            .map(|object| {
                let kind = super::names::type_keyword(image, &object.type_name);
                let name = self.symbol_of(&object.name);
                object::perceived(
                    image,
                    query,
                    name,
                    kind,
                    &object.pose_in_base,
                    &object.pose_in_map,
                )
            })
            .collect();
        if as_designator(query).is_some_and(|d| d.is_all()) {
            return Value::list(found);
        }
        found.into_iter().next().unwrap_or(Value::NIL)
    }
}
