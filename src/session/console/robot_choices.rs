//! Choices that concern the robot: to repeat an action, with another grasp or arm, from
//! another base pose, to the nearest free place, or with the world as it was before the action.

use super::choice::Choice;
use super::evaluator::Evaluator;
use super::stack_frames::Told;
use crate::printing::on_one_line;
use cram::designator::perform::Performance;
use cram::designator::value::{Class, as_class};
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
        if let Some(innermost) = actions.first() {
            choices.extend(self.nearest_choice(innermost));
        }
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
        let copy = cram::designator::value::Designator::new(
            &mut self.image,
            class,
            quantifier,
            description,
        );
        Value::foreign(copy)
    }

    /// Driving to the nearest free place in place of an action of driving that has stopped because its goal is
    /// occupied.
    fn nearest_choice(&mut self, driving: &Action) -> Option<(Choice, String)> {
        let text = match self.type_of_action(driving).as_str() {
            "GOING" => {
                "(lambda (?pose)
                   (perform (an action (type going) (target (a location (pose ?pose))))))"
            }
            "NAVIGATING" => {
                "(lambda (?pose)
                   (perform (an action (type navigating) (location (a location (pose ?pose))))))"
            }
            _ => return None,
        };
        let report = &self.console.levels.last()?.abort.report;
        let [x, y, heading] = self.host.simulation.free_place_instead(report)?;
        let choice = Choice::Call {
            frame: driving.frame,
            function: self.plan_function(text)?,
            args: vec![pose_stamped("map", &from_xy_yaw(x, y, heading))],
            motion: None,
        };
        let label = format!(
            "[NEAREST] Drive to the nearest free place with this heading: x {x:.3}, y {y:.3}."
        );
        Some((choice, label))
    }

    /// Driving to where the object can be grasped, then repeating the action.
    fn base_choice(&mut self, picking: &Action) -> Option<(Choice, String)> {
        let simulation = &mut self.host.simulation;
        let found = simulation.place_to_grasp_from(&mut self.image, &picking.designator);
        let (pose, arm, grasp) = found?;
        let others = [("ARM", arm.clone()), ("GRASP", grasp.clone())];
        let designator = self.with_properties(&picking.designator, &others);
        let function = self.plan_function(
            "(lambda (?pose action)
               (park-arms)
               (perform (an action (type going) (target (a location (pose ?pose)))))
               (perform action))",
        )?;
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

    /// The function that a lambda expression in the package of the plans says.
    fn plan_function(&mut self, text: &str) -> Option<Value> {
        let package = self.image.packages.find("CRAM-MOBILE-PICK-PLACE-PLANS")?;
        let before = self.image.special(known::V_PACKAGE).clone();
        self.image
            .set_special(known::V_PACKAGE, Value::Package(package));
        let lambda = self.form_of("debugger", text);
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
