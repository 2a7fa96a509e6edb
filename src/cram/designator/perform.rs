//! `perform`: an action calls its plan; a motion becomes a request to the host.

use std::collections::BTreeSet;
use std::rc::Rc;

use super::failure;
use super::failure::Unresolved;
use super::ground;
use super::ground::Refusal;
use super::location;
use super::reference::{groundings, solutions_of};
use super::request::MotionRequest;
use super::schema;
use super::value;
use super::value::{Class, Designator};
use crate::open_action::OpenAction;
use crate::{Result, packages};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::print;
use lisp::source::Place;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::function::Body;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::FunctionCell;
use lisp::vm::calls::{Annotation, Args, Calls, run};
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// Carries out an action or motion; only inside a plan, as in (with-simulated-robot (perform (an
/// action (type going) (target ?location)))).
#[builtin("PERFORM")]
fn perform_builtin(machine: &mut Machine<'_>, designator: &Value) -> Result<Step> {
    perform(machine, designator)
}

/// PERFORM without the methods of GENERIC-PERFORM.
#[builtin("%PERFORM-PLAINLY")]
fn perform_plainly(machine: &mut Machine<'_>, designator: &Value) -> Result<Step> {
    let class = class_to_perform(machine.image, designator)?;
    perform_as_traced(machine, class, designator)
}

/// PERFORM for what is not traced.
#[builtin("%PERFORM")]
fn perform3(machine: &mut Machine<'_>, designator: &Value) -> Result<Step> {
    let class = class_to_perform(machine.image, designator)?;
    perform_untraced(machine, class, designator)
}

/// Whether a plan is running, that is, whether this fiber is a task.
fn is_in_plan(image: &mut Image) -> bool {
    let task = packages::symbol(image, "CRAM-LANGUAGE-IMPLEMENTATION", "*CURRENT-TASK*");
    let value = image.special(task);
    !value.is_unbound() && value.is_true()
}

/// The types of actions and motions with that name or alias, as strings.
#[builtin("%TYPES-NAMED", "name")]
fn types_named(image: &mut Image, name_value: &Value) -> Result<Value> {
    let Some(name) = name_value.as_symbol() else {
        return Ok(Value::NIL);
    };
    let name = image.name(name).to_uppercase();
    let classes = [Class::Action, Class::Motion].into_iter();
    let rows = classes.flat_map(|class| schema::rows(image, class, &name));
    let names: BTreeSet<String> = rows.map(|row| row.name.to_string()).collect();
    Ok(Value::list(names.into_iter().map(Value::string)))
}

/// The class of what is to be performed.
fn class_to_perform(image: &mut Image, argument: &Value) -> Result<Class> {
    match value::as_designator(argument) {
        Some(d) if matches!(d.class, Class::Action | Class::Motion) => Ok(d.class),
        _ => Err(not_performable(image, argument)),
    }
}

/// Whether performances of any type are traced.
fn is_traced(image: &mut Image) -> bool {
    let types = packages::symbol(image, "SYSTEM", "%*TRACED-TYPES*");
    matches!(image.special(types), Value::Cons(_))
}

fn perform(machine: &mut Machine<'_>, argument: &Value) -> Result<Step> {
    let class = class_to_perform(machine.image, argument)?;
    let generic = packages::symbol(machine.image, "CRAM-EXECUTIVE", "GENERIC-PERFORM");
    let has_methods = match &machine.image.symbol(generic).function {
        // Besides the one that does it.
        FunctionCell::Function(function) => function
            .as_generic()
            .is_some_and(|generic| generic.methods.borrow().len() > 1),
        _ => false,
    };
    if has_methods {
        return Ok(Step::TailCall {
            function: generic.into(),
            args: vec![argument.clone()],
        });
    }
    perform_as_traced(machine, class, argument)
}

fn perform_as_traced(machine: &mut Machine<'_>, class: Class, argument: &Value) -> Result<Step> {
    if is_traced(machine.image) {
        let traced = packages::symbol(machine.image, "SYSTEM", "%PERFORM-TRACED");
        return Ok(Step::TailCall {
            function: traced.into(),
            args: vec![argument.clone()],
        });
    }
    perform_untraced(machine, class, argument)
}

fn perform_untraced(machine: &mut Machine<'_>, class: Class, argument: &Value) -> Result<Step> {
    let image = &mut *machine.image;
    if !is_in_plan(image) {
        let expected = packages::symbol(image, "CRAM-LANGUAGE-IMPLEMENTATION", "TASK-TREE-NODE");
        let text = "There is no plan for PERFORM to be a part of: \
                    write it inside (with-simulated-robot …).";
        return Err(Raise::new(known::SIMPLE_TYPE_ERROR, text)
            .with(known::K_DATUM, Value::NIL)
            .with(known::K_EXPECTED_TYPE, expected.into()));
    }
    let designator = argument.clone();
    run(machine, "PERFORM", |calls| async move {
        match class {
            Class::Action => perform_action(&calls, &designator).await.map(Step::Return),
            _ => perform_motion(&calls, &designator).await,
        }
    })
}

fn not_performable(image: &mut Image, argument: &Value) -> Box<Raise> {
    let shown = print::to_string(image, argument, true);
    let generic = packages::symbol(image, "CRAM-EXECUTIVE", "GENERIC-PERFORM");
    let text = format!(
        "There is no applicable method for the generic function {} when called with arguments ({shown}): an action or a motion was expected.",
        print::to_string(image, &generic.into(), true)
    );
    let k_arguments = image.keyword("ARGUMENTS");
    Raise::new(known::NO_APPLICABLE_METHOD_ERROR, text)
        .with(k_arguments, Value::list([argument.clone()]))
}

/// Performs an action. If it has a goal that already holds, does nothing; if the goal does not
/// hold afterwards, that is noted.
async fn perform_action(calls: &Calls, designator: &Value) -> Result<Value> {
    let action = designator.clone();
    let goal = calls.with(move |machine| goal_of(machine.image, &action));
    let Some(Goal { goal, holds, note }) = goal.await else {
        return run_action(calls, designator).await;
    };
    if calls.call1(&holds, goal.clone()).await.is_true() {
        note_goal(calls, note, "ACHIEVED", goal, designator).await;
        return Ok(Value::NIL);
    }
    let value = run_action(calls, designator).await?;
    if !calls.call1(&holds, goal.clone()).await.is_true() {
        note_goal(calls, note, "MISSED", goal, designator).await;
    }
    Ok(value)
}

/// What an action is to bring about.
struct Goal {
    /// The occasion.
    goal: Value,
    /// The function that tests it.
    holds: Value,
    /// The function that tells people how it stands.
    note: Option<Value>,
}

/// The goal of an action, if goals can be tested.
fn goal_of(image: &mut Image, action: &Value) -> Option<Goal> {
    let goal = crate::designator::property(image, action, "GOAL")?;
    let [holds, note] =
        ["HOLDS", "NOTE-GOAL"].map(|name| packages::symbol(image, "CRAM-OCCASIONS-EVENTS", name));
    image.function(holds)?;
    Some(Goal {
        goal,
        holds: holds.into(),
        note: image.function(note).map(|_| note.into()),
    })
}

/// Tells people that a goal was achieved before its action, or missed by it.
async fn note_goal(
    calls: &Calls,
    note: Option<Value>,
    how: &'static str,
    goal: Value,
    action: &Value,
) {
    if let Some(note) = note {
        let how = calls.with(move |machine| machine.image.keyword(how));
        let how = how.await.into();
        let args = Args::Many(vec![how, goal, action.clone()]);
        calls.call(&note, args).await;
    }
}

/// Resolves an action and calls its plan.
async fn run_action(calls: &Calls, designator: &Value) -> Result<Value> {
    let known = value::as_designator(designator).and_then(|d| d.data.borrow().clone());
    let (plan, args) = match known {
        Some(Value::Cons(command)) => commanded(calls, command.car(), command.cdr()).await,
        _ => resolve_action(calls, designator).await?,
    };
    call_plan(calls, designator, plan, args).await
}

/// The plan of an unresolved action, and its arguments: from a rule, or else from the table.
async fn resolve_action(calls: &Calls, designator: &Value) -> Result<PlanCall> {
    let found = groundings(calls, designator, 1).await?;
    let action = designator.clone();
    if let Value::Cons(found) = &found {
        if let Some(target) = value::as_designator(&action) {
            value::note_changed(&action);
            *target.data.borrow_mut() = Some(found.car());
            *target.solutions.borrow_mut() = Some(Value::Int(1));
        }
        let command = found.car();
        return Ok(commanded(calls, command.car_or_nil(), command.cdr_or_nil()).await);
    }
    calls
        .with(move |machine| {
            let target = value::designator(machine.image, &action)?;
            match ground::ground(machine.image, target) {
                Ok(grounding) => Ok(ground::plan_call(machine.image, &grounding)),
                Err(refusal) => {
                    let why = refusal.reason()?;
                    Err(failure::reference_failure(machine.image, &action, &why))
                }
            }
        })
        .await
}

/// The function of a plan, and its arguments.
type PlanCall = (Value, Vec<Value>);

/// The call that a rule's `(plan argument…)` specifies. A plan that takes only keywords and is
/// given a single action receives that action's properties.
async fn commanded(calls: &Calls, plan: Value, args: Value) -> PlanCall {
    let args: Vec<Value> = args.iter_list().collect();
    let [only] = args.as_slice() else {
        return (plan, args);
    };
    let Some(action) = value::as_class(only, Class::Action) else {
        return (plan, args);
    };
    let function = plan.clone();
    let takes_keywords = calls.with(move |machine| takes_keywords(machine.image, &function));
    if !takes_keywords.await {
        return (plan, args);
    }
    let properties = action.properties().into_iter();
    let keywords = properties.flat_map(|(key, values)| [key, values.car_or_nil()]);
    (plan, keywords.collect())
}

/// Whether the function takes keyword arguments and no others.
fn takes_keywords(image: &Image, plan: &Value) -> bool {
    let Ok(function) = image.coerce_to_function(plan) else {
        return false;
    };
    match &function.body {
        Body::Closure { code, .. } => {
            let p = &code.parameters;
            p.required == 0 && p.optional == 0 && (p.allow_other_keys || !p.keys.is_empty())
        }
        _ => false,
    }
}

/// Number of motions begun so far; the image keeps it for [`Performance`].
pub struct MotionsBegun(pub u64);

impl Extension for MotionsBegun {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        // It is replaced, never changed.
        self
    }
}

/// What is known about a call of an action's plan.
pub struct Performance {
    /// Number of motions begun before it.
    pub motions_before: u64,
    /// What the journal knows of it, if it is kept.
    action: Option<Rc<OpenAction>>,
}

/// Calls the function of a plan. The stack frame of the call records the action.
async fn call_plan(
    calls: &Calls,
    designator: &Value,
    plan: Value,
    args: Vec<Value>,
) -> Result<Value> {
    let (function, action) = (plan.clone(), designator.clone());
    let performance = calls.with(move |machine| {
        let image = &mut *machine.image;
        check_defined(image, &action, &function)?;
        let motions_before = image.extension::<MotionsBegun>().map_or(0, |begun| begun.0);
        let action = OpenAction::begin(machine.image, &action, machine.place());
        Ok::<_, Box<Raise>>(Performance {
            motions_before,
            action,
        })
    });
    let performance = performance.await?;
    let open = performance.action.clone();
    let annotation = Annotation {
        note: Box::new(performance),
        subject: designator.clone(),
    };
    let value = calls.call_about(annotation, &plan, args).await;
    if let Some(action) = open {
        action.succeed(&value);
    }
    Ok(value)
}

fn check_defined(image: &mut Image, designator: &Value, plan: &Value) -> Result<()> {
    let Some(name) = plan.as_symbol() else {
        return Ok(());
    };
    if matches!(image.symbol(name).function, FunctionCell::Function(_)) {
        return Ok(());
    }
    let shown = print::to_string(image, designator, false);
    let name = image.name(name).to_owned();
    Err(failure::simple_failure(
        image,
        format!(
            "Action designator `{shown}' resolved to cram function `{name}', but it isn't defined. Cannot perform action."
        ),
    ))
}

/// Performs a motion: by a process module that the program defines, or else by a request to the
/// host.
async fn perform_motion(calls: &Calls, designator: &Value) -> Result<Step> {
    let symbols = calls.with(|machine| {
        let names = [
            "MATCHING-PROCESS-MODULE",
            "AVAILABLE-PROCESS-MODULE",
            "PM-EXECUTE",
        ];
        names.map(|name| packages::symbol(machine.image, "CRAM-PROCESS-MODULES", name))
    });
    let [matching, available, execute] = symbols.await;
    let modules = solutions_of(calls, matching, Some(available), designator).await?;
    let module = calls.with(move |machine| {
        modules.iter_list().find(|module| {
            let name = module.as_symbol();
            name.is_some_and(|s| machine.image.function(s).is_some())
        })
    });
    if let Some(module) = module.await {
        let execute = Value::from(execute);
        let value = calls.call2(&execute, module, designator.clone()).await;
        return Ok(Step::Return(value));
    }
    let motion = designator.clone();
    let mut request = calls
        .with(move |machine| {
            let place = machine.place();
            motion_request(machine.image, &motion, place)
        })
        .await?;
    resolve_places(calls, &mut request).await?;
    Ok(Step::request(request))
}

fn motion_request(image: &mut Image, designator: &Value, place: Place) -> Result<MotionRequest> {
    let motion = value::designator(image, designator)?;
    let grounding = match ground::ground(image, motion) {
        Ok(grounding) => grounding,
        Err(Refusal::Error(raise)) => return Err(raise),
        Err(Refusal::UnknownType(why)) => return Err(no_module(image, designator, &why)),
        Err(Refusal::Incomplete(why)) => {
            let why = Unresolved {
                reason: format!("Cannot perform motion.\n{}", why.reason),
                ..why
            };
            return Err(failure::reference_failure(image, designator, &why));
        }
    };
    Ok(MotionRequest {
        designator: designator.clone(),
        motion_type: grounding.row.name.to_string(),
        place,
        properties: grounding.properties,
    })
}

fn no_module(image: &mut Image, designator: &Value, why: &Unresolved) -> Box<Raise> {
    let shown = print::to_string(image, designator, false);
    failure::no_process_module(image, &format!("{shown}\n{}", why.reason))
}

/// Replaces locations that must be searched for by the poses found.
async fn resolve_places(calls: &Calls, request: &mut MotionRequest) -> Result<()> {
    for (_, place) in &mut request.properties {
        let location = place.clone();
        let is_symbolic = calls.with(move |machine| {
            value::as_class(&location, Class::Location)
                .is_some_and(|l| l.property_named(machine.image, "POSE").is_none())
        });
        if !is_symbolic.await {
            continue;
        }
        let pose = location::try_reference(calls, place, String::new()).await?;
        let (motion, symbolic) = (request.designator.clone(), place.clone());
        (*place, request.designator) = calls
            .with(move |machine| {
                let found = value::make(machine.image, Class::Location, &[("POSE", pose)]);
                let resolved = match value::as_designator(&motion) {
                    Some(d) => with_place(machine.image, d, &symbolic, &found),
                    None => motion.clone(),
                };
                (found, resolved)
            })
            .await;
    }
    Ok(())
}

/// The motion with one location replaced by another.
fn with_place(image: &mut Image, motion: &Designator, old: &Value, new: &Value) -> Value {
    let properties: Vec<Value> = motion
        .properties()
        .into_iter()
        .map(|(key, values)| match values.car_or_nil().is_eq(old) {
            true => Value::list([key, new.clone()]),
            false => Value::cons(key, values),
        })
        .collect();
    let description = Value::list(properties);
    let resolved = Designator::new(image, motion.class, motion.quantifier, description);
    Value::foreign(resolved)
}

/// Functions of package `CRAM-EXECUTIVE`.
pub(crate) static TABLE: &[Builtin] = builtins![perform_builtin,];

/// Functions of package `SYSTEM`, for `plan/library/tracing.lisp`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![perform3, perform_plainly, types_named,];
