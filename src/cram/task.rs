//! Tasks as seen by programs: a name, a place in the task tree, a status, a result.
//!
//! The scheduler runs tasks; a task object only knows its entry in the scheduler while it is alive,
//! so that a reference to a dead task keeps nothing but its result in memory.

use std::cell::{Cell, OnceCell, RefCell};
use std::fmt;
use std::rc::{Rc, Weak};

use super::fluent::FluentRef;
use super::names::Names;
use super::state::Plan;
use super::tree::TreeNode;
use lisp::value::Value;
use lisp::value::cycles;
use lisp::value::foreign::{Foreign, ForeignBox, PrintContext};
use lisp::value::symbol::Sym;

/// Identifies tasks and orders them by creation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct TaskId(pub u64);

impl fmt::Display for TaskId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// The status of a task.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Status {
    /// It has not begun.
    Created,
    /// It runs, or waits for something.
    Running,
    /// It is suspended until it is woken up.
    Suspended,
    /// It has ended with values.
    Succeeded,
    /// It has ended with a failure.
    Failed,
    /// It was told to end.
    Evaporated,
}

impl Status {
    /// Whether the task has ended.
    pub(crate) fn is_dead(self) -> bool {
        matches!(
            self,
            Status::Succeeded | Status::Failed | Status::Evaporated
        )
    }

    /// Whether the task has ended without a failure.
    pub(crate) fn is_done(self) -> bool {
        matches!(self, Status::Succeeded | Status::Evaporated)
    }

    /// The keyword for it.
    pub fn keyword(self, names: &Names) -> Sym {
        match self {
            Status::Created => names.created,
            Status::Running => names.running,
            Status::Suspended => names.suspended,
            Status::Succeeded => names.succeeded,
            Status::Failed => names.failed,
            Status::Evaporated => names.evaporated,
        }
    }
}

/// The name of a task.
#[derive(Clone, Debug)]
pub enum TaskName {
    /// Given by the program.
    Given(Rc<str>),
    /// `[WHAT]-NUMBER`.
    Numbered(Rc<str>, u64),
    /// `[WHAT-CHILD-#i/n]-NUMBER`.
    Child(&'static str, usize, usize, u64),
}

impl fmt::Display for TaskName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TaskName::Given(name) => write!(f, "{name}"),
            TaskName::Numbered(what, n) => write!(f, "[{what}]-{n}"),
            TaskName::Child(what, i, of, n) => write!(f, "[{what}-CHILD-#{i}/{of}]-{n}"),
        }
    }
}

/// A task.
pub struct Task {
    /// Its name.
    pub name: TaskName,
    /// Its place in the task tree.
    pub node: Rc<TreeNode>,
    /// Whether it was told to suspend before it began.
    pub(super) is_held: Cell<bool>,
    /// The values with which it ended (`Value::Multiple` unless there is just one), or its failure.
    pub(super) result: RefCell<Value>,
    /// Fluents that must be true before it may begin.
    pub(super) constraints: RefCell<Vec<Value>>,
    /// Its entry in the scheduler while it is alive.
    pub(super) slot: Cell<Option<u32>>,
    status: Cell<Status>,
    status_fluent: OnceCell<FluentRef>,
    object: RefCell<Weak<ForeignBox>>,
    type_symbol: Sym,
    verbosity: Sym,
}

impl Task {
    /// The status of the task.
    pub fn status(&self) -> Status {
        self.status.get()
    }

    /// Its values, or its failure.
    pub fn result(&self) -> Value {
        self.result.borrow().clone().primary()
    }

    pub(super) fn set_status(&self, status: Status) {
        self.status.set(status);
    }

    /// The status fluent, if it has been requested before.
    pub(super) fn known_fluent(&self) -> Option<&FluentRef> {
        self.status_fluent.get()
    }

    /// The status fluent.
    pub(super) fn fluent(&self, plan: &Plan) -> &FluentRef {
        self.status_fluent.get_or_init(|| {
            let name = Value::string(format!("{}-STATUS", self.name));
            let status = self.status.get().keyword(&plan.names);
            FluentRef::with_value(plan, name, status.into())
        })
    }
}

impl Foreign for Task {
    fn type_symbol(&self) -> Sym {
        self.type_symbol
    }

    fn may_be_in_circle(&self) -> bool {
        true
    }

    fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        match self.result.try_borrow().as_deref() {
            // What holds them is no object whose references are followed.
            Ok(Value::Multiple(values)) if Rc::strong_count(values) == 1 => {
                values.iter().for_each(&mut *visit);
            }
            Ok(Value::Multiple(_)) | Err(_) => {}
            Ok(value) => visit(value),
        }
        if let Ok(constraints) = self.constraints.try_borrow() {
            constraints.iter().for_each(&mut *visit);
        }
        if let Some(fluent) = self.status_fluent.get() {
            visit(&fluent.value());
        }
    }

    fn let_go(&self) {
        self.result.take();
        self.constraints.take();
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        let identity = match self.object.borrow().upgrade() {
            Some(object) => context.identity(&Value::Foreign(object)),
            None => String::new(),
        };
        let is_verbose = matches!(context.special(self.verbosity), Value::Int(1..));
        let status = if is_verbose {
            format!(" :{:?}", self.status.get()).to_uppercase()
        } else {
            String::new()
        };
        format!(
            "#<{} \"{}\"{status} {identity}>",
            context.name(self.type_symbol),
            self.name
        )
    }
}

/// A counted reference to a task.
#[derive(Clone)]
pub struct TaskRef(Rc<ForeignBox>);

impl TaskRef {
    /// A task that has not begun.
    pub(super) fn new(
        plan: &Plan,
        name: TaskName,
        is_toplevel: bool,
        node: Rc<TreeNode>,
    ) -> TaskRef {
        let names = &plan.names;
        let object = Rc::new(ForeignBox::new(Task {
            name,
            node,
            is_held: Cell::new(false),
            result: RefCell::new(Value::NIL),
            constraints: RefCell::default(),
            slot: Cell::new(None),
            status: Cell::new(Status::Created),
            status_fluent: OnceCell::new(),
            object: RefCell::default(),
            type_symbol: if is_toplevel {
                names.toplevel_task
            } else {
                names.task
            },
            verbosity: names.pprint_verbosity,
        }));
        let task = TaskRef(object);
        *task.get().object.borrow_mut() = Rc::downgrade(&task.0);
        task
    }

    /// The task, if the value is one.
    pub fn from_value(value: &Value) -> Option<TaskRef> {
        match value {
            Value::Foreign(object) if object.downcast_ref::<Task>().is_some() => {
                Some(TaskRef(object.clone()))
            }
            _ => None,
        }
    }

    /// Notes that the task has been changed to hold a value, which may hold it.
    pub(super) fn note(&self) {
        cycles::note_foreign(&self.0);
    }

    /// The task as a value.
    pub fn value(&self) -> Value {
        Value::Foreign(self.0.clone())
    }

    /// The task.
    ///
    /// # Panics
    ///
    /// Never: both functions that make a reference check what it refers to.
    pub fn get(&self) -> &Task {
        match self.0.downcast_ref() {
            Some(task) => task,
            None => unreachable!("a task reference refers to a task"),
        }
    }

    /// Whether this is the same task.
    pub fn is(&self, other: &TaskRef) -> bool {
        Rc::ptr_eq(&self.0, &other.0)
    }
}
