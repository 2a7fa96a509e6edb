//! How `setf` treats an operator, as defined by a program.

use crate::value::Value;
use crate::value::symbol::Sym;

/// How `setf` of a form with a certain operator is expanded if there is no function `(setf name)`.
#[derive(Clone)]
pub(crate) enum SetfExpander {
    /// `(defsetf access update)`: the update function takes the arguments, then the value.
    Update(Sym),
    /// `(defsetf access lambda-list (store…) body…)`: a function of the store variables
    /// (as a list) and the argument variables that returns the storing form.
    Long(Value, usize),
    /// `define-setf-expander`: a function of the whole place form that returns the five
    /// values of a setf expansion.
    Expander(Value),
}
