//! Choices that concern the robot: to repeat an action, with another grasp or arm, from
//! another base pose, to the nearest free place, or with the world as it was before the action.

use super::choice::Choice;
use super::evaluator::Evaluator;
use super::stack_frames::Told;
use crate::printing::on_one_line;
use cram::designator::perform::Performance;
use cram::designator::value::{Class, Designator, Quantifier, as_class};
use cram::packages;
use cram::pose::value::pose_stamped;
use lisp::compile;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use spatial::pose::from_xy_yaw;

/// Maximum number of actions for which a repetition is offered.
const MAX_ACTIONS: usize = 3;

/// An action being performed.
struct Action {
    frame: (usize, usize),
    designator: Value,
    shown: String,
    motions_before: u64,
}

impl Evaluator {
    /// The choices for the actions being performed, with labels.
    pub(super) fn robot_choices(&mut self) -> Vec<(Choice, String)> {
        let actions = self.actions_to_retry();
        let perform: Value = packages::symbol(&mut self.image, "CRAM-EXECUTIVE", "PERFORM").into();
        let again = |action: &Action, designator: &Value, motion| Choice::Call {
            frame: action.frame,
            function: perform.clone(),
            args: vec![designator.clone()],
            motion,
        };
        let mut choices = Vec::new();
        for action in actions.iter().take(MAX_ACTIONS) {
            let choice = again(action, &action.designator, None);
            choices.push((choice, format!("[RETRY] Retry {}.", action.shown)));
        }
        choices.extend(actions.first().and_then(|action| {
            let (designator, place) = self.driving_to_nearest_place(action)?;
            let label =
                format!("[NEAREST] Drive to the nearest free place with this heading: {place}.");
            Some((again(action, &designator, None), label))
        }));
        if let Some(picking) = actions
            .iter()
            .find(|a| self.type_of_action(a) == "PICKING-UP")
        {
            let simulation = &mut self.host.simulation;
            let grasps = simulation.reachable_grasps(&mut self.image, &picking.designator);
            for (arm, grasp) in grasps {
                let others = [("ARM", arm.clone()), ("GRASP", grasp.clone())];
                let designator = self.with_properties(&picking.designator, &others);
                let shown = |value: &Value| print::to_string(&self.image, value, true);
                let label = format!(
                    "[GRASP] Pick it up with {} and {}.",
                    shown(&arm),
                    shown(&grasp)
                );
                choices.push((again(picking, &designator, None), label));
            }
            choices.extend(self.base_choice(picking));
        }
        // A motion of another task would continue in a world that is not its own.
        if !self.scheduler.has_requests() {
            for action in actions.iter().take(MAX_ACTIONS) {
                let first = action.motions_before + 1;
                if self.host.person.snapshots.has_motion_snapshot(first) {
                    let choice = again(action, &action.designator, Some(first));
                    let label = format!(
                        "[BEFORE] Restore the world to before {} and retry it.",
                        action.shown
                    );
                    choices.push((choice, label));
                }
            }
        }
        choices
    }

    fn actions_to_retry(&self) -> Vec<Action> {
        let frames = self.frames();
        let action = |told: &Told| {
            let annotation = told.view.annotation.as_ref()?;
            let performance = annotation.note.downcast_ref::<Performance>()?;
            let designator = annotation.subject.clone();
            let text = print::to_string(&self.image, &designator, false);
            Some(Action {
                frame: (told.link, told.view.index),
                shown: shortened(&on_one_line(&text)),
                designator,
                motions_before: performance.motions_before,
            })
        };
        frames.iter().filter_map(action).collect()
    }

    fn type_of_action(&self, action: &Action) -> String {
        as_class(&action.designator, Class::Action)
            .and_then(|designator| designator.type_name(&self.image))
            .unwrap_or_default()
    }

    /// A copy of an action with other values for some keys.
    fn with_properties(&mut self, action: &Value, others: &[(&str, Value)]) -> Value {
        let Some(designator) = as_class(action, Class::Action) else {
            return action.clone();
        };
        let is_other = |key: &Value, image: &Image| {
            let name = key.as_symbol().map(|sym| image.name(sym).to_owned());
            name.is_some_and(|name| others.iter().any(|(other, _)| *other == name))
        };
        let mut properties: Vec<Value> = designator
            .properties()
            .into_iter()
            .filter(|(key, _)| !is_other(key, &self.image))
            .map(|(key, values)| Value::cons(key, values))
            .collect();
        let (class, quantifier) = (designator.class, designator.quantifier);
        for (name, value) in others {
            let key = self.image.keyword(name).into();
            properties.push(Value::list([key, value.clone()]));
        }
        let description = Value::list(properties);
        Value::foreign(Designator::new(
            &mut self.image,
            class,
            quantifier,
            description,
        ))
    }

    /// The innermost action with the nearest free place as its goal, and that place, if the action is one of
    /// driving and has stopped because its goal is occupied.
    fn driving_to_nearest_place(&mut self, action: &Action) -> Option<(Value, String)> {
        let key = match self.type_of_action(action).as_str() {
            "GOING" => "TARGET",
            "NAVIGATING" => "LOCATION",
            _ => return None,
        };
        let report = &self.console.levels.last()?.abort.report;
        let [x, y, heading] = self.host.simulation.free_place_instead(report)?;
        let pose = pose_stamped("map", &from_xy_yaw(x, y, heading));
        let driving = as_class(&action.designator, Class::Action)?;
        let location = self.designator(Class::Location, driving.quantifier, &[("POSE", pose)]);
        let kind = driving.property_named(&self.image, "TYPE")?;
        let properties = [("TYPE", kind), (key, location)];
        let designator = self.designator(Class::Action, driving.quantifier, &properties);
        Some((designator, format!("x {x:.3}, y {y:.3}")))
    }

    /// A designator with some properties, by the names of their keys.
    fn designator(
        &mut self,
        class: Class,
        quantifier: Quantifier,
        properties: &[(&str, Value)],
    ) -> Value {
        let properties: Vec<Value> = properties
            .iter()
            .map(|(name, value)| {
                let key = self.image.keyword(name).into();
                Value::list([key, value.clone()])
            })
            .collect();
        let description = Value::list(properties);
        Value::foreign(Designator::new(
            &mut self.image,
            class,
            quantifier,
            description,
        ))
    }

    /// Driving to where the object can be grasped, then repeating the action.
    fn base_choice(&mut self, picking: &Action) -> Option<(Choice, String)> {
        let simulation = &mut self.host.simulation;
        let found = simulation.place_to_grasp_from(&mut self.image, &picking.designator);
        let (pose, arm, grasp) = found?;
        let others = [("ARM", arm.clone()), ("GRASP", grasp.clone())];
        let designator = self.with_properties(&picking.designator, &others);
        let function = self.drive_and_perform()?;
        let shown = |value: &Value| print::to_string(&self.image, value, true);
        let label = format!(
            "[BASE] Park, drive to where {} reaches it with {}, and pick it up from there.",
            shown(&arm),
            shown(&grasp)
        );
        let choice = Choice::Call {
            frame: picking.frame,
            function,
            args: vec![pose, designator],
            motion: None,
        };
        Some((choice, label))
    }

    fn drive_and_perform(&mut self) -> Option<Value> {
        const TEXT: &str = "(lambda (?pose action)
            (park-arms)
            (perform (an action (type going) (target (a location (pose ?pose)))))
            (perform action))";
        let package = self.image.packages.find("CRAM-MOBILE-PICK-PLACE-PLANS")?;
        let before = self.image.special(known::V_PACKAGE).clone();
        self.image
            .set_special(known::V_PACKAGE, Value::Package(package));
        let lambda = self.form_of("debugger", TEXT);
        self.image.set_special(known::V_PACKAGE, before);
        let function = compile::compile_lambda(&mut self.image, &lambda?).ok()?;
        Some(Value::Function(function))
    }
}

/// Maximum length of an action in a label, in characters.
const MAX_ACTION_LENGTH: usize = 70;

fn shortened(text: &str) -> String {
    match text.char_indices().nth(MAX_ACTION_LENGTH) {
        Some((end, _)) => format!("{} …)", text.get(..end).unwrap_or(text)),
        None => text.to_owned(),
    }
}
