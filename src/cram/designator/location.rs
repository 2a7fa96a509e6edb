//! Locations: poses that are given, generated or sampled, and checked by validators.
//!
//! Generators run in ascending order of priority; each returns a list of poses, or a function that
//! returns one pose after another. A pose is a solution if no validator rejects it. After a number
//! of rejections in a row (`*location-generator-max-retries*`) the search ends.

use indexmap::IndexMap;

use super::check;
use super::failure;
use super::failure::Unresolved;
use super::location_registry::{GENERATORS, VALIDATORS, enabled, most_retries, variable};
use super::object;
use super::reference::{same_description, solutions_of};
use super::value;
use super::value::{Class, Designator};
use crate::Result;
use crate::pose::value::as_placement;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::vm::calls::{Args, Calls};

/// The result of a search.
enum Found {
    /// A pose.
    Pose(Value),
    /// Nothing, for this reason.
    Nothing(String),
}

/// Resolves a location to its pose.
pub async fn reference(calls: &Calls, designator: &Value) -> Result<Value> {
    match first_solution(calls, designator).await? {
        Found::Pose(pose) => Ok(pose),
        Found::Nothing(reason) => {
            let designator = designator.clone();
            let error = calls.with(move |machine| {
                let shown = print::to_string(machine.image, &designator, false);
                let text = format!("Unable to resolve designator `{shown}'");
                let why = Unresolved::new(reason);
                failure::designator_error(machine.image, &designator, &text, &why)
            });
            Err(error.await)
        }
    }
}

/// Like [`reference()`], but with a plan failure if there is no solution; its text is the message, if
/// there is one, instead of the reason.
pub(crate) async fn try_reference(
    calls: &Calls,
    designator: &Value,
    message: String,
) -> Result<Value> {
    match first_solution(calls, designator).await? {
        Found::Pose(pose) => Ok(pose),
        Found::Nothing(reason) => {
            let reason = if message.is_empty() { reason } else { message };
            let designator = designator.clone();
            let failure = calls.with(move |machine| {
                let why = Unresolved::new(reason);
                failure::reference_failure(machine.image, &designator, &why)
            });
            Err(failure.await)
        }
    }
}

/// The pose that a location was resolved to or specifies, or else the first one found.
async fn first_solution(calls: &Calls, designator: &Value) -> Result<Found> {
    let location = designator.clone();
    let known = calls.with(move |machine| known_pose(machine.image, &location));
    if let Some(pose) = known.await? {
        return Ok(Found::Pose(pose));
    }
    let mut generators = calls
        .with(|machine| enabled(machine.image, GENERATORS))
        .await;
    generators.reverse();
    let mut search = Search {
        designator: designator.clone(),
        owner: designator.clone(),
        samples: Vec::new(),
        generators,
        causes: Causes::default(),
    };
    search.run(calls).await
}

/// The poses that a location lists, and those that rules give.
pub(super) async fn groundings(calls: &Calls, designator: &Value) -> Result<Value> {
    let location = designator.clone();
    let listed = calls.with(move |machine| {
        let target = value::designator(machine.image, &location)?;
        let poses = target.property_named(machine.image, "POSES");
        Ok::<_, Box<Raise>>(poses.unwrap_or(Value::NIL))
    });
    let listed = listed.await?;
    let functor = calls.with(|machine| variable(machine.image, "LOCATION-GROUNDING"));
    let grounded = solutions_of(calls, functor.await, None, designator).await?;
    let mut poses: Vec<Value> = match &listed {
        single if as_placement(single).is_some() => vec![listed],
        list => list.iter_list().collect(),
    };
    poses.extend(grounded.iter_list());
    Ok(Value::list(poses))
}

/// Forgets what a location was resolved to, the search for it, and what follows it.
pub(super) fn reset(image: &mut Image, designator: &Value) -> Result<()> {
    let target = value::designator(image, designator)?;
    *target.data.borrow_mut() = None;
    *target.solutions.borrow_mut() = None;
    target.is_effective.set(false);
    let next = target.successor.take();
    if let Some(next) = next.as_ref().and_then(value::as_designator) {
        *next.parent.borrow_mut() = None;
    }
    if let Some(first) = value::as_designator(&value::first(designator)) {
        *first.memory.borrow_mut() = None;
    }
    Ok(())
}

/// The pose of a location, if no search is needed.
fn known_pose(image: &mut Image, designator: &Value) -> Result<Option<Value>> {
    let target = value::designator(image, designator)?;
    if let Some(data) = target.data.borrow().clone() {
        return Ok(Some(data));
    }
    check::check_inside(image, designator, 2)?;
    let pose = given_pose(image, target);
    if let Some(pose) = &pose {
        *target.data.borrow_mut() = Some(pose.clone());
        value::note_changed(designator);
        *target.solutions.borrow_mut() = Some(Value::NIL);
    }
    Ok(pose)
}

/// The pose that a location specifies, or that of the object whose location it is.
fn given_pose(image: &Image, target: &Designator) -> Option<Value> {
    if let Some(pose) = target.property_named(image, "POSE") {
        return Some(pose);
    }
    let object = value::current(&target.property_named(image, "OF")?);
    if let Some(pose) = object::pose_property(image, &object, "POSE-IN-MAP") {
        return Some(pose);
    }
    let at = value::as_class(&object, Class::Object)?.property_named(image, "AT")?;
    match value::as_class(&at, Class::Location) {
        Some(location) => location.property_named(image, "POSE"),
        None => as_placement(&at).map(|_| at.clone()),
    }
}

/// Why samples were rejected or are no longer generated.
#[derive(Default)]
struct Causes {
    rejections: i64,
    /// Texts of validators, with the numbers of samples that they rejected for it.
    rejected: IndexMap<String, i64>,
    /// Texts of generators.
    ended: Vec<String>,
}

impl Causes {
    fn reject(&mut self, why: Option<String>) {
        self.rejections += 1;
        if let Some(why) = why {
            *self.rejected.entry(why).or_default() += 1;
        }
    }
}

impl std::fmt::Display for Causes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.rejections, self.ended.is_empty()) {
            (0, true) => {
                let remedy = "write (a location (pose ?pose))";
                return write!(f, "Nothing generates such a location: {remedy}.");
            }
            (0, false) => {}
            (1, _) => f.write_str("1 candidate was rejected")?,
            (n, _) => write!(f, "{n} candidates were rejected")?,
        }
        let mut rejected: Vec<_> = self.rejected.iter().collect();
        rejected.sort_by_key(|(_, n)| std::cmp::Reverse(**n));
        for (i, (why, n)) in rejected.into_iter().enumerate() {
            let lead = if i == 0 { ": " } else { ", " };
            write!(f, "{lead}{n} {why}")?;
        }
        if self.rejections > 0 {
            f.write_str(".")?;
        }
        for (i, why) in self.ended.iter().enumerate() {
            let lead = if i == 0 && self.rejections == 0 {
                ""
            } else {
                "\n"
            };
            write!(f, "{lead}{why}")?;
        }
        Ok(())
    }
}

/// A validator's judgement of a sample.
enum Verdict {
    Accepted,
    /// With the reason, if the validator gives one.
    Rejected(Option<String>),
}

/// A search for solutions of one location.
struct Search {
    /// The designator that describes the location.
    designator: Value,
    /// The designator that receives the solution.
    owner: Value,
    /// Poses that were generated but not checked yet, and functions that generate more; the next
    /// one last.
    samples: Vec<Value>,
    /// Generators that have not run yet, the next one last.
    generators: Vec<Value>,
    causes: Causes,
}

impl Search {
    /// Checks samples, running generators for more, until one is accepted.
    async fn run(&mut self, calls: &Calls) -> Result<Found> {
        loop {
            let Some(sample) = self.next_sample(calls).await else {
                return Ok(Found::Nothing(self.causes.to_string()));
            };
            match self.judge(calls, &sample).await {
                Verdict::Accepted => return Ok(Found::Pose(self.settle(sample))),
                Verdict::Rejected(why) => self.causes.reject(why),
            }
            let most = calls.with(|machine| most_retries(machine.image)).await;
            if self.causes.rejections >= most {
                return Ok(Found::Nothing(self.causes.to_string()));
            }
        }
    }

    /// The next sample; generators run when there are none left.
    async fn next_sample(&mut self, calls: &Calls) -> Option<Value> {
        loop {
            match self.samples.pop() {
                Some(more @ Value::Function(_)) => {
                    let sample = calls.call(&more, Args::Many(Vec::new())).await;
                    match sample {
                        Value::Symbol(known::NIL, ..) => {}
                        Value::Str(why) => self.causes.ended.push(why.text()),
                        sample => {
                            self.samples.push(more);
                            return Some(sample);
                        }
                    }
                }
                Some(sample) => return Some(sample),
                None => {
                    let generator = self.generators.pop()?;
                    let poses = calls.call1(&generator, self.designator.clone()).await;
                    self.samples = match &poses {
                        Value::Cons(_) => poses.iter_list().collect(),
                        Value::Symbol(known::NIL, ..) => Vec::new(),
                        single => vec![single.clone()],
                    };
                    self.samples.reverse();
                }
            }
        }
    }

    /// What the validators say of a sample.
    async fn judge(&self, calls: &Calls, sample: &Value) -> Verdict {
        let validators = calls.with(|machine| enabled(machine.image, VALIDATORS));
        let mut is_sure = false;
        let mut is_doubtful = false;
        for validator in validators.await {
            let args = Args::Two([self.designator.clone(), sample.clone()]);
            let answer = calls.call(&validator, args).await;
            if let Value::Str(why) = &answer {
                return Verdict::Rejected(Some(why.text()));
            }
            let answer = calls.with(move |machine| {
                let sym = answer.as_symbol();
                sym.map(|sym| machine.image.name(sym).to_owned())
            });
            match answer.await.as_deref() {
                Some("ACCEPT") => is_sure = true,
                Some("MAYBE-REJECT") => is_doubtful = true,
                Some("UNKNOWN") => {}
                _ => return Verdict::Rejected(None),
            }
        }
        match is_sure || !is_doubtful {
            true => Verdict::Accepted,
            false => Verdict::Rejected(None),
        }
    }

    /// Makes a sample the value of the owner, and keeps what has not been checked. If another task has
    /// resolved the owner while this search waited, its value stays and is the result.
    fn settle(&mut self, sample: Value) -> Value {
        let rest = self.rest();
        let Some(target) = value::as_designator(&self.owner) else {
            return sample;
        };
        let mut data = target.data.borrow_mut();
        if let Some(earlier) = &*data {
            return earlier.clone();
        }
        *data = Some(sample.clone());
        value::note_changed(&self.owner);
        *target.solutions.borrow_mut() = Some(rest);
        sample
    }

    /// What has not been checked, in reverse order: samples and generators.
    fn rest(&mut self) -> Value {
        let samples = std::mem::take(&mut self.samples);
        let generators = std::mem::take(&mut self.generators);
        Value::cons(Value::list(samples), Value::list(generators))
    }
}

/// The next solution, as a designator equated with this one; `NIL` if there is none.
pub(crate) async fn next_solution(calls: &Calls, designator: &Value) -> Result<Value> {
    if let Found::Nothing(_) = first_solution(calls, designator).await? {
        return Ok(Value::NIL);
    }
    let Some(target) = value::as_designator(designator) else {
        return Ok(Value::NIL);
    };
    if let Some(next) = target.successor.borrow().clone() {
        return Ok(next);
    }
    let rest = target.solutions.borrow().clone().unwrap_or(Value::NIL);
    let location = designator.clone();
    let owner = calls.with(move |machine| {
        let target = value::designator(machine.image, &location)?;
        Ok::<_, Box<Raise>>(same_description(machine.image, target))
    });
    let owner = owner.await?;
    let mut search = Search {
        designator: designator.clone(),
        owner: owner.clone(),
        // Both are kept in reverse order.
        samples: rest.car_or_nil().iter_list().collect(),
        generators: rest.cdr_or_nil().iter_list().collect(),
        causes: Causes::default(),
    };
    let found = search.run(calls).await?;
    // Another task may have asked meanwhile; all get the same answer.
    if let Some(next) = target.successor.borrow().clone() {
        return Ok(next);
    }
    Ok(match found {
        Found::Pose(_) => {
            value::equate(designator, &owner);
            owner
        }
        Found::Nothing(_) => {
            // What was rejected is not judged again.
            *target.solutions.borrow_mut() = Some(search.rest());
            value::note_changed(designator);
            Value::NIL
        }
    })
}
