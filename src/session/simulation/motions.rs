//! Converting motion designators to motions.

use nalgebra::Vector3;

use super::Simulation;
use super::names::{name_text, type_text};
use crate::log_level::LogLevel;
use crate::simulation::properties::property;
use cram::designator::MotionRequest;
use cram::designator::failure::no_process_module;
use cram::designator::value::current;
use cram::designator::vocabulary::{Domain, Vocabulary};
use cram::pose::value::frame_of;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::motion::command::{self, Argument, ArgumentKind, Arguments, MotionCommand};
use robotics::motion::{DetectQuery, Motion, PoseGoal};
use robotics::robot::Side;
use spatial::Pose;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Height (m) above or below the floor up to which a goal of the base counts as on it.
const OFF_FLOOR: f64 = 0.01;
/// Cosine of the tilt up to which a goal of the base counts as upright: one degree.
const UPRIGHT: f64 = 0.99985;

/// The sides that an arm or gripper argument names: `:LEFT`, `:RIGHT`, or a list of them.
pub(crate) fn sides(image: &Image, value: &Value) -> Result<Vec<Side>> {
    match value {
        Value::Cons(_) => value.iter_list().map(|v| side(image, &v)).collect(),
        single => side(image, single).map(|s| vec![s]),
    }
}

/// The side that an argument names.
pub(crate) fn side(image: &Image, value: &Value) -> Result<Side> {
    let arms = arms(image);
    let text = name_text(image, value);
    let mut named = arms
        .iter()
        .filter(|arm| Some(keyword_name(**arm)) == text.as_deref());
    named.next().copied().ok_or_else(|| {
        let arms: Vec<String> = arms
            .iter()
            .map(|arm| format!(":{}", keyword_name(*arm)))
            .collect();
        let plural = if arms.len() == 1 { "" } else { "s" };
        Raise::simple(format!(
            "{} is no arm: the robot has the arm{plural} {}.",
            print::to_string(image, value, true),
            arms.join(" and ")
        ))
    })
}

/// The arms that the robot of a session has, left first.
pub(crate) fn arms(image: &Image) -> Vec<Side> {
    let known = image.extension::<Vocabulary>();
    let has = |side: &Side| {
        let known = known.as_ref();
        known.is_none_or(|known| known.has(Domain::Arm, side.name()))
    };
    Side::BOTH.into_iter().filter(has).collect()
}

fn keyword_name(side: Side) -> &'static str {
    match side {
        Side::Left => "LEFT",
        Side::Right => "RIGHT",
    }
}

/// `:LEFT` or `:RIGHT`.
pub(crate) fn side_keyword(image: &mut Image, side: Side) -> Value {
    image.keyword(keyword_name(side)).into()
}

/// The list of finite numbers.
pub(crate) fn numbers(value: &Value) -> Result<Vec<f64>> {
    value.iter_list().map(|v| real(&v)).collect()
}

fn real(value: &Value) -> Result<f64> {
    number::to_f64(value)
        .filter(|x| x.is_finite())
        .ok_or_else(|| Raise::type_error(value, known::REAL))
}

impl Simulation {
    /// The motion that is requested, and what its failures are about.
    pub(crate) fn motion_for(
        &mut self,
        image: &mut Image,
        request: &MotionRequest,
    ) -> Result<(Box<dyn Motion>, Value)> {
        let refused = |image: &mut Image, text: &dyn std::fmt::Display| {
            let shown = print::to_string(image, &request.designator, false);
            no_process_module(image, &format!("{shown}\n{text}"))
        };
        let Some(known) = command::type_named(&request.motion_type) else {
            return Err(refused(
                image,
                &"No motion of this type can be carried out.",
            ));
        };
        let given = |name: &str| request.property(name).filter(|value| value.is_true());
        let mut arguments = Arguments::default();
        for key in known.keys {
            if let Some(value) = given(key.name) {
                let argument = self.argument(image, key.kind, value)?;
                arguments.insert(key.name, argument);
            }
        }
        let command = match MotionCommand::new(known.name, &arguments) {
            Some(Ok(command)) => command,
            Some(Err(error)) => return Err(Raise::simple(error.to_string())),
            None => {
                return Err(refused(
                    image,
                    &"No motion of this type can be carried out.",
                ));
            }
        };
        if let MotionCommand::Detecting(detecting) = &command {
            self.sought = Some(detecting.query.clone());
        }
        let subject = known.about.iter().find_map(|name| given(name));
        let subject = subject.unwrap_or(&request.designator).clone();
        Ok((command.job(), subject))
    }

    /// A value as an argument of the kind.
    fn argument(&self, image: &mut Image, kind: ArgumentKind, value: &Value) -> Result<Argument> {
        Ok(match kind {
            ArgumentKind::Number => Argument::Number(real(value)?),
            ArgumentKind::Numbers => Argument::Numbers(numbers(value)?),
            ArgumentKind::MapPose => {
                let pose = Simulation::location_pose(image, value)?;
                Argument::MapPose(self.pose_on_floor(image, &pose)?)
            }
            ArgumentKind::Place => {
                let pose = Simulation::location_pose(image, value)?;
                let frame = frame_of(&pose);
                Argument::Place(if frame.is_some_and(|frame| self.is_base(&frame)) {
                    PoseGoal::InBase(self.pose_as_given(image, &pose)?)
                } else {
                    PoseGoal::InMap(self.pose_in_map(image, &pose)?)
                })
            }
            ArgumentKind::Frame => {
                let name = value.as_text().unwrap_or_default();
                self.frame_in_map(image, &name)?;
                Argument::Word(name)
            }
            ArgumentKind::Word | ArgumentKind::Member(_) => {
                Argument::Word(name_text(image, value).unwrap_or_default())
            }
            ArgumentKind::Side => Argument::Sides(vec![side(image, value)?]),
            ArgumentKind::Sides => Argument::Sides(sides(image, value)?),
            ArgumentKind::Described => Argument::Described(self.detecting(image, value)),
            ArgumentKind::InWorld => {
                let newest = current(value);
                let name = property(image, &newest, "NAME");
                let name = name.map(|name| self.object_named(image, &name));
                Argument::InWorld(name.transpose()?)
            }
        })
    }

    /// The pose as coordinates of the map, whatever frame it names, as CRAM's projection takes
    /// goals of the base. Logs what of it the base will not do.
    fn pose_on_floor(&self, image: &mut Image, pose: &Value) -> Result<Pose> {
        let goal = self.pose_as_given(image, pose)?;
        let mut ignored = Vec::new();
        if let Some(frame) = frame_of(pose).filter(|frame| !self.is_map(frame)) {
            ignored.push(format!(
                "its frame {frame:?}: the numbers count as coordinates of the map"
            ));
        }
        let height = self.base().translation.z;
        if (goal.translation.z - height).abs() > OFF_FLOOR {
            ignored.push(format!("its height z {} m", goal.translation.z));
        }
        if (goal.rotation * Vector3::z()).z < UPRIGHT {
            ignored.push("its tilt".to_owned());
        }
        if !ignored.is_empty() {
            let text = format!(
                "The base drives on the floor of the map. Of the goal is ignored {}.",
                ignored.join(", and ")
            );
            self.log(image, LogLevel::Warn, "(PICK-AND-PLACE GO)", &text);
        }
        Ok(goal)
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
}
