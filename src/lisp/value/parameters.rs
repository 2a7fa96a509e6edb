//! What a lambda list says about the arguments of a call.

use super::symbol::Sym;

/// Numbers of parameters and keywords of a lambda list.
#[derive(Clone, Default, PartialEq, Eq, Debug)]
pub struct Parameters {
    /// Number of required parameters.
    pub required: usize,
    /// Number of optional parameters.
    pub optional: usize,
    /// Is there a rest parameter?
    pub(crate) has_rest: bool,
    /// The keywords, if there is `&key`.
    pub keys: Option<Vec<Sym>>,
    /// Are keywords beyond those allowed?
    pub(crate) allows_other_keys: bool,
}

impl Parameters {
    /// Only required parameters.
    pub fn required(count: usize) -> Parameters {
        Parameters {
            required: count,
            ..Parameters::default()
        }
    }

    /// Required parameters and any number of further arguments.
    pub(crate) fn required_and_rest(count: usize) -> Parameters {
        Parameters {
            required: count,
            has_rest: true,
            ..Parameters::default()
        }
    }

    /// May a call have more than the required and optional arguments?
    pub fn has_more(&self) -> bool {
        self.has_rest || self.keys.is_some()
    }

    /// Is this number of arguments acceptable?
    pub(crate) fn accepts(&self, count: usize) -> bool {
        count >= self.required && (self.has_more() || count <= self.required + self.optional)
    }
}
