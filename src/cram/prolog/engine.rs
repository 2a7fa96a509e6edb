//! The prover: proves one goal after the other and asks for calls of functions.

use std::collections::HashSet;
use std::rc::Rc;

use super::choice_point::{Alternative, Choice};
use super::facts;
use super::facts::Facts;
use super::functor::Call;
use super::goal::{Action, Goal};
use super::goal_chain::{GoalNode, Goals};
use super::term::{Bindings, Naming, Variable};
use super::warnings;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Steps between checks of the interrupt flag.
const INTERRUPT_INTERVAL: u32 = 1024;
/// Maximum number of open choice points.
const MAX_CHOICES: usize = 200_000;
/// Maximum number of goals that are still to be proved.
const MAX_GOALS: usize = 1_000_000;

/// What to do with the value of a call.
pub(super) enum Awaited {
    /// Unify it with a term.
    Result(Value),
    /// Continue if it is not `NIL`.
    Truth,
    /// Unify one of the items of the list with a term.
    OneOf(Value),
    /// Unify the variables with the values that one of several lists of pairs gives for their
    /// names.
    OneOfBindings(Vec<Value>),
    /// Continue.
    Nothing,
}

/// How far the prover has come.
pub enum Progress {
    /// A proof was found.
    Proved,
    /// There is no further proof.
    Failed,
    /// A function must be called; hand its value to [`Engine::deliver`].
    Call {
        /// The function.
        function: Value,
        /// The arguments.
        args: Vec<Value>,
    },
}

/// A prover for one query.
pub struct Engine {
    /// The bindings so far.
    pub(super) bindings: Bindings,
    pub(super) goals: Goals,
    pub(super) choices: Vec<Choice>,
    pub(super) collections: Vec<Vec<Value>>,
    pub(super) awaited: Option<Awaited>,
    pub(super) facts: Rc<Facts>,
    pub(super) query: Naming,
    pub(super) is_started: bool,
    pub(super) numbers: u64,
    /// In how many traced goals the proof is.
    pub(super) depth: usize,
    /// How many lines have been shown of traced goals.
    pub(super) lines: usize,
    /// Functors with numbers of arguments that a warning has been given of.
    pub(super) warned: HashSet<(Sym, usize)>,
}

impl Engine {
    /// A prover for a query whose variables are `?symbols`.
    pub fn new(image: &mut Image, query: &Value) -> Result<Engine> {
        Engine::with_bindings(image, query, &Value::NIL)
    }

    /// A prover for a query some of whose variables are bound already: a list of pairs, the last
    /// variable first.
    pub(crate) fn with_bindings(image: &mut Image, query: &Value, known: &Value) -> Result<Engine> {
        let mut bindings = Bindings::default();
        let mut naming = Naming::default();
        let Some(pairs) = known.list_to_vec() else {
            return Err(Raise::type_error(known, known::LIST));
        };
        let mut agrees = true;
        for pair in pairs.iter().rev() {
            let Value::Cons(pair) = pair else {
                return Err(Raise::type_error(pair, known::CONS));
            };
            let variable = bindings.rename(image, &pair.car(), &mut naming)?;
            let value = bindings.rename(image, &pair.cdr(), &mut naming)?;
            agrees &= bindings.unify(&variable, &value);
        }
        let goal = bindings.rename(image, query, &mut naming)?;
        let goal = if agrees {
            Goal::Prove(goal)
        } else {
            Goal::Fail
        };
        let goals = Some(Rc::new(GoalNode::before(None, goal, 0)));
        Ok(Engine {
            bindings,
            goals,
            choices: Vec::new(),
            collections: Vec::new(),
            awaited: None,
            facts: facts::of(image),
            query: naming,
            is_started: false,
            numbers: 0,
            depth: 0,
            lines: 0,
            warned: HashSet::new(),
        })
    }

    /// From now on, these are the facts.
    pub(super) fn attach(&mut self, facts: Rc<Facts>) {
        self.facts = facts;
    }

    /// Is anything left to try after the proof that was found?
    pub(super) fn has_choices(&self) -> bool {
        let mut choices = self.choices.iter();
        choices.any(|choice| {
            !matches!(
                choice.alternative,
                Alternative::Forgotten | Alternative::Failed(_) | Alternative::Redone(_)
            )
        })
    }

    /// The bindings of the query's variables: a list of pairs, the last variable first.
    pub fn solution(&self) -> Result<Value> {
        let mut pairs = Vec::new();
        for (name, variable) in self.query.variables.iter().rev() {
            let value = self.bindings.resolve(variable)?;
            if value.as_foreign::<Variable>().is_none() {
                pairs.push(Value::cons((*name).into(), self.bindings.shown(variable)?));
            }
        }
        Ok(Value::list(pairs))
    }

    /// Searches for the next proof.
    pub fn run(&mut self, image: &mut Image) -> Result<Progress> {
        if self.is_started && self.awaited.is_none() && !self.backtrack(image)? {
            return Ok(Progress::Failed);
        }
        self.is_started = true;
        self.search(image)
    }

    /// Continues with the value of the requested call.
    pub fn deliver(&mut self, image: &mut Image, value: Value) -> Result<Progress> {
        let holds = match self.awaited.take() {
            None | Some(Awaited::Nothing) => true,
            Some(Awaited::Truth) => value.is_true(),
            Some(Awaited::Result(term)) => self.bindings.unify(&term, &value),
            Some(Awaited::OneOf(term)) => {
                let items = value.list_to_vec().unwrap_or_default();
                self.choose_item(term, items.into_iter())
            }
            Some(Awaited::OneOfBindings(variables)) => {
                let items: Vec<Value> = value
                    .iter_list()
                    .map(|pairs| {
                        Value::list(
                            variables
                                .iter()
                                .map(|v| bound_by(v, &pairs))
                                .collect::<Vec<_>>(),
                        )
                    })
                    .collect();
                self.choose_item(Value::list(variables.clone()), items.into_iter())
            }
        };
        if !holds && !self.backtrack(image)? {
            return Ok(Progress::Failed);
        }
        self.search(image)
    }

    fn search(&mut self, image: &mut Image) -> Result<Progress> {
        let mut budget = INTERRUPT_INTERVAL;
        loop {
            budget -= 1;
            if budget == 0 {
                budget = INTERRUPT_INTERVAL;
                if image.take_interrupt() {
                    return Err(Raise::new(known::INTERACTIVE_INTERRUPT, "Interrupted."));
                }
            }
            let Some(node) = self.goals.clone() else {
                return Ok(Progress::Proved);
            };
            self.goals = node.next.clone();
            let holds = match &node.goal {
                Goal::Cut(count) => {
                    self.choices.truncate(*count);
                    true
                }
                Goal::Forget(number) => {
                    if let Some(choice) = self.choices.iter_mut().find(|c| c.number == *number) {
                        choice.alternative = Alternative::Forgotten;
                    }
                    true
                }
                Goal::Collect(collection, template) => {
                    let item = self.bindings.resolve(template)?;
                    if let Some(items) = self.collections.get_mut(*collection) {
                        items.push(item);
                    }
                    false
                }
                Goal::Exit(goal) => {
                    self.trace_exit(image, goal)?;
                    true
                }
                Goal::Fail => false,
                Goal::Clauses(term) => {
                    let functor = term.car_or_nil().as_symbol();
                    match functor.and_then(|functor| self.facts.clauses(functor)) {
                        Some(clauses) => self.try_clauses(image, term.clone(), clauses, 0)?,
                        None => false,
                    }
                }
                Goal::Handler(term) => {
                    let functor = term.car_or_nil().as_symbol();
                    let args: Vec<Value> = term.cdr_or_nil().iter_list().collect();
                    match functor.and_then(|functor| self.facts.handler(functor)) {
                        Some(function) => {
                            let action = self.handled(image, function, &args)?;
                            match self.take(action, node.clause) {
                                Ok(holds) => holds,
                                Err(call) => return Ok(call),
                            }
                        }
                        None => false,
                    }
                }
                Goal::Prove(term) => {
                    let term = self.bindings.walk(term);
                    if self.facts.is_tracing() {
                        self.trace_call(image, &term)?;
                    }
                    match self.prove(image, &term, node.clause)? {
                        Ok(holds) => holds,
                        Err(call) => return Ok(call),
                    }
                }
            };
            if !holds && !self.backtrack(image)? {
                return Ok(Progress::Failed);
            }
            if self.choices.len() > MAX_CHOICES {
                return Err(Raise::simple(
                    "A Prolog goal has too many open choices: does a rule prove itself?",
                ));
            }
            if self.goals.as_ref().is_some_and(|g| g.count > MAX_GOALS) {
                return Err(Raise::simple(
                    "A Prolog goal needs more and more goals to be proved: does a rule prove itself?",
                ));
            }
        }
    }

    /// Begins to prove a term; returns whether it holds so far.
    fn prove(
        &mut self,
        image: &mut Image,
        term: &Value,
        clause: usize,
    ) -> Result<std::result::Result<bool, Progress>> {
        let (functor, args) = match term {
            Value::Cons(cons) => (self.bindings.walk(&cons.car()), cons.cdr()),
            other => (other.clone(), Value::NIL),
        };
        let Some(functor) = functor.as_symbol().filter(|_| functor.is_true()) else {
            return Err(Raise::simple(format!(
                "{} is not a Prolog goal: (functor argument…) was expected.",
                print::to_string(image, &self.bindings.shown(term)?, true)
            )));
        };
        let meant = self.facts.meant(image, functor);
        let renamed = Value::cons(meant.into(), args.clone());
        let term = if meant == functor { term } else { &renamed };
        let functor = meant;
        if let Some(clauses) = self.facts.clauses(functor) {
            // Rules may be added to a functor of `def-prolog-handler`.
            if self.facts.handler(functor).is_some() {
                let rules = vec![Goal::Clauses(term.clone())];
                let own = vec![Goal::Handler(term.clone())];
                return Ok(self.take(Action::Either(own, rules), clause));
            }
            if let Some(why) = warnings::of_rules(image, functor, &clauses, term) {
                self.warn(image, functor, args.iter_list().count(), &why);
                return Ok(Ok(false));
            }
            return Ok(Ok(self.try_clauses(image, term.clone(), clauses, 0)?));
        }
        let args: Vec<Value> = args.iter_list().collect();
        let known = self.facts.functor(image.name(functor));
        let action = match known.filter(|known| known.takes(args.len())) {
            Some(known) => {
                let call = Call {
                    image,
                    bindings: &mut self.bindings,
                    functor,
                    args: &args,
                    clause,
                    barrier: self.choices.len(),
                    next_choice: self.numbers,
                };
                (known.apply)(call)?
            }
            None => match (self.facts.handler(functor), known) {
                (Some(function), _) => self.handled(image, function, &args)?,
                (None, Some(known)) => {
                    let why = warnings::of_functor(image, functor, known, args.len());
                    self.warn(image, functor, args.len(), &why);
                    return Ok(Ok(false));
                }
                (None, None) => {
                    let shown = print::to_string(image, &self.bindings.shown(term)?, true);
                    let name = image.name(functor);
                    let near = self.facts.closest(image, name);
                    let near = near.map(|near| format!(" Did you mean {near}?"));
                    let why = format!(
                        "Trying to prove goal {shown} with undefined functor {name}.{}",
                        near.unwrap_or_default()
                    );
                    self.warn(image, functor, args.len(), &why);
                    return Ok(Ok(false));
                }
            },
        };
        Ok(self.take(action, clause))
    }

    /// Warns of a goal, once for all that are wrong like it.
    fn warn(&mut self, image: &mut Image, functor: Sym, count: usize, why: &str) {
        if self.warned.insert((functor, count)) {
            warnings::warn(image, why);
        }
    }

    /// The call of a functor of `def-prolog-handler`. Its function knows variables by their names, so
    /// each has another one.
    fn handled(&mut self, image: &mut Image, function: Value, terms: &[Value]) -> Result<Action> {
        let mut variables: Vec<Value> = Vec::new();
        for term in terms {
            let term = self.bindings.resolve(term)?;
            self.bindings.unbound_in(&term, &mut variables);
        }
        let mut names: Vec<Sym> = Vec::new();
        for place in &mut variables {
            let Some(name) = place.as_foreign::<Variable>().map(|v| v.name) else {
                continue;
            };
            let mut own = name;
            let mut number = 1;
            while names.contains(&own) {
                number += 1;
                let text = format!("{}-{number}", image.name(name));
                own = image.intern(PackageTable::USER, &text);
            }
            names.push(own);
            if own != name {
                let renamed = self.bindings.fresh(own);
                self.bindings.unify(place, &renamed);
                *place = renamed;
            }
        }
        let mut args = vec![self.solution()?];
        for term in terms {
            args.push(self.bindings.shown(term)?);
        }
        Ok(Action::CallBindings {
            function,
            args,
            variables,
        })
    }

    fn take(&mut self, action: Action, clause: usize) -> std::result::Result<bool, Progress> {
        let (awaited, function, args) = match action {
            Action::Succeed => return Ok(true),
            Action::Fail => return Ok(false),
            Action::Then(goals) => {
                self.push_goals(goals, clause);
                return Ok(true);
            }
            Action::Either(first, second) => {
                let rest = self.goals.clone();
                self.push_goals(second, clause);
                let alternative = std::mem::replace(&mut self.goals, rest);
                self.push_choice(alternative, Alternative::Goals);
                self.push_goals(first, clause);
                return Ok(true);
            }
            Action::Items(term, items) => {
                return Ok(self.choose_item(term, items.into_iter()));
            }
            Action::Collect {
                template,
                goal,
                result,
                kind,
            } => {
                let collection = self.collections.len();
                self.collections.push(Vec::new());
                let rest = self.goals.clone();
                let alternative = Alternative::Collected {
                    collection,
                    result,
                    kind,
                };
                self.push_choice(rest, alternative);
                let barrier = self.choices.len();
                self.goals = None;
                self.push_goals(
                    vec![Goal::Prove(goal), Goal::Collect(collection, template)],
                    barrier,
                );
                return Ok(true);
            }
            Action::CallFor {
                function,
                args,
                result,
            } => (Awaited::Result(result), function, args),
            Action::CallTest { function, args } => (Awaited::Truth, function, args),
            Action::CallItems {
                function,
                args,
                term,
            } => (Awaited::OneOf(term), function, args),
            Action::CallBindings {
                function,
                args,
                variables,
            } => (Awaited::OneOfBindings(variables), function, args),
            Action::CallOnly { function, args } => (Awaited::Nothing, function, args),
        };
        self.awaited = Some(awaited);
        Err(Progress::Call { function, args })
    }

    pub(super) fn push_goals(&mut self, goals: Vec<Goal>, clause: usize) {
        for goal in goals.into_iter().rev() {
            let next = self.goals.take();
            self.goals = Some(Rc::new(GoalNode::before(next, goal, clause)));
        }
    }
}

/// The value that a list of pairs gives for a variable's name, or the variable itself.
fn bound_by(variable: &Value, pairs: &Value) -> Value {
    let Some(name) = variable.as_foreign::<Variable>().map(|v| v.name) else {
        return variable.clone();
    };
    pairs
        .iter_list()
        .find(|pair| pair.car_or_nil().as_symbol() == Some(name))
        .map_or_else(|| variable.clone(), |pair| pair.cdr_or_nil())
}
