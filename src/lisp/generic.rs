//! Generic functions and their methods.

use std::cell::RefCell;
use std::rc::Rc;

use super::class::Class;
use super::function::Function;
use super::symbol::Sym;
use super::value::Value;

/// What an argument must be for a method to apply.
#[derive(Clone)]
pub enum Specializer {
    /// An instance of the class or of a subclass.
    Class(Rc<Class>),
    /// `eql` to the value.
    Eql(Value),
}

/// Where a method stands in the standard method combination.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Qualifier {
    /// No qualifier.
    Primary,
    /// `:before`.
    Before,
    /// `:after`.
    After,
    /// `:around`.
    Around,
}

/// A method.
pub struct Method {
    /// One per required argument.
    pub specializers: Vec<Specializer>,
    /// Its place in the combination.
    pub qualifier: Qualifier,
    /// The method function: it takes a next-method function (or `NIL`) followed by the
    /// arguments of the call.
    pub function: Rc<Function>,
    /// Documentation.
    pub doc: Option<Rc<str>>,
}

/// A generic function.
pub struct GenericFunction {
    /// Its name: a symbol, or the list `(setf name)`.
    pub name: Value,
    /// Number of required arguments.
    pub required: RefCell<usize>,
    /// May a call have more arguments than the required ones?
    pub has_more: RefCell<bool>,
    /// The methods in order of definition.
    pub methods: RefCell<Vec<Rc<Method>>>,
    /// Documentation.
    pub doc: RefCell<Option<Rc<str>>>,
    /// `STANDARD`, or the name of another combination (`+`, `AND`, `LIST`, …).
    pub combination: RefCell<Option<Sym>>,
}
