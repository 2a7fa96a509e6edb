//! What a lambda list says about the arguments of a call.

use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::parameters::Parameters;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Required,
    Optional,
    Rest,
    Key,
    Aux,
}

impl Parameters {
    /// Reads a lambda list whose parameters may be specialized.
    pub fn parse(image: &mut Image, lambda_list: &Value) -> Result<Parameters, Box<Raise>> {
        let mut parameters = Parameters::default();
        let mut section = Section::Required;
        for item in lambda_list.iter_list() {
            match item.as_symbol() {
                Some(known::L_OPTIONAL) => section = Section::Optional,
                Some(known::L_REST | known::L_BODY) => {
                    section = Section::Rest;
                    parameters.has_rest = true;
                }
                Some(known::L_KEY) => {
                    section = Section::Key;
                    parameters.keys = Some(Vec::new());
                }
                Some(known::L_ALLOW_OTHER_KEYS) => parameters.allows_other_keys = true,
                Some(known::L_AUX) => section = Section::Aux,
                _ => match section {
                    Section::Required => parameters.required += 1,
                    Section::Optional => parameters.optional += 1,
                    Section::Key => {
                        let key = keyword_of(image, &item)?;
                        parameters.keys.get_or_insert_default().push(key);
                    }
                    Section::Rest | Section::Aux => {}
                },
            }
        }
        Ok(parameters)
    }
}

/// The keyword of a `&key` parameter: `k`, `(k …)` or `((:key var) …)`.
fn keyword_of(image: &mut Image, parameter: &Value) -> Result<Sym, Box<Raise>> {
    let first = match parameter {
        Value::Cons(c) => c.car(),
        other => other.clone(),
    };
    match first {
        Value::Symbol(sym, ..) => {
            let name = image.symbol(sym).name.clone();
            Ok(image.keyword(&name))
        }
        Value::Cons(pair) => pair.car().as_symbol().ok_or_else(bad_parameter),
        _ => Err(bad_parameter()),
    }
}

fn bad_parameter() -> Box<Raise> {
    Raise::program("A &KEY parameter is a symbol, (symbol default) or ((keyword symbol) default).")
}
