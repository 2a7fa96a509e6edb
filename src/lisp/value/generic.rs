//! Generic functions and their methods.

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};

use super::Value;
use super::class::Class;
use super::dispatch::Dispatch;
use super::foreign::ForeignBox;
use super::function::Function;
use super::parameters::Parameters;
use super::symbol::{Sym, known};

/// What an argument must be for a method to apply.
#[derive(Clone)]
pub enum Specializer {
    /// An instance of the class or of a subclass.
    Class(Rc<Class>),
    /// `eql` to the value.
    Eql(Value),
}

impl Specializer {
    /// Do both accept the same values?
    pub fn is_same(&self, other: &Specializer) -> bool {
        match (self, other) {
            (Specializer::Class(a), Specializer::Class(b)) => Rc::ptr_eq(a, b),
            (Specializer::Eql(a), Specializer::Eql(b)) => a.is_eql(b),
            _ => false,
        }
    }
}

/// How a generic function combines its methods.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Combination {
    /// The name, which is also the qualifier of methods unless it is `STANDARD`.
    pub name: Sym,
    /// The operator that the values of all methods are given to.
    pub operator: Sym,
    /// Is the value of a single method the value of the call?
    pub(crate) is_identity: bool,
}

impl Combination {
    /// Before, after and around methods, `call-next-method`.
    pub(crate) const STANDARD: Combination = Combination {
        name: known::STANDARD,
        operator: known::STANDARD,
        is_identity: true,
    };

    /// Does a function of the program make the effective method of all that apply?
    pub fn is_long(self) -> bool {
        self.operator == known::SYS_CALL_COMBINED
    }

    /// Is this the standard one?
    pub(crate) fn is_standard(self) -> bool {
        self.name == known::STANDARD
    }
}

/// A method that only reads or writes a slot of its instance.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Accessor {
    /// Returns the value of the slot of the first argument.
    Reader(Sym),
    /// Stores the first argument in the slot of the second.
    Writer(Sym),
}

pub struct Method {
    /// The name of its generic function: a symbol, or the list `(setf name)`.
    pub name: Value,
    /// Qualifiers as written: none, `:before`, `+`, a number, …
    pub(crate) qualifiers: Vec<Value>,
    /// One per required argument.
    pub specializers: Vec<Specializer>,
    /// The parameters, required ones included.
    pub parameters: Parameters,
    /// The method function. It takes the arguments of the call, after a function that
    /// calls the next method (or `NIL`) if `takes_next`.
    pub function: Rc<Function>,
    /// Does the function take the next method?
    pub(crate) takes_next: bool,
    /// Set if the method is a slot's reader or writer: such a call needs no function.
    pub accessor: Option<Accessor>,
    /// Was the method made by the implementation?
    pub(crate) is_builtin: bool,
    /// Documentation.
    pub doc: RefCell<Option<Rc<str>>>,
    /// The value that stands for the method, as long as it is referenced.
    pub object: RefCell<Weak<ForeignBox>>,
}

pub struct GenericFunction {
    /// Its name: a symbol, or the list `(setf name)`.
    pub name: Value,
    /// The parameters that every method must agree with.
    pub parameters: RefCell<Parameters>,
    /// Did a `defgeneric` fix the parameters?
    pub(crate) is_declared: Cell<bool>,
    /// The methods in order of definition.
    pub methods: RefCell<Vec<Rc<Method>>>,
    /// Methods that the `defgeneric` itself made; evaluating it again replaces them.
    pub(crate) own_methods: RefCell<Vec<Rc<Method>>>,
    /// Documentation.
    pub doc: RefCell<Option<Rc<str>>>,
    /// How the values of methods are combined.
    pub(crate) combination: Cell<Combination>,
    /// Does the combination run the most specific method last?
    pub(crate) most_specific_last: Cell<bool>,
    /// The required arguments in the order in which they rank methods; empty for that from left to
    /// right.
    pub(crate) precedence: RefCell<Vec<usize>>,
    /// Which arguments decide, and the effective methods found so far.
    pub dispatch: RefCell<Dispatch>,
}

impl GenericFunction {
    /// A generic function without methods, with the standard combination.
    pub fn new(name: Value, parameters: Parameters) -> GenericFunction {
        GenericFunction {
            name,
            parameters: RefCell::new(parameters),
            is_declared: Cell::new(false),
            methods: RefCell::default(),
            own_methods: RefCell::default(),
            doc: RefCell::default(),
            combination: Cell::new(Combination::STANDARD),
            most_specific_last: Cell::new(false),
            precedence: RefCell::default(),
            dispatch: RefCell::default(),
        }
    }
}
