//! Lambda lists, ordinary and destructuring.

use std::collections::HashSet;

use crate::image::Image;
use crate::print;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// An optional parameter.
#[derive(Clone)]
pub struct Optional {
    /// Its name, or the pattern in a destructuring lambda list.
    pub pattern: Value,
    /// The form of its default.
    pub default: Value,
    /// The variable that tells whether it was supplied.
    pub supplied: Option<Sym>,
}

/// A keyword parameter.
#[derive(Clone)]
pub struct Key {
    /// The keyword (or other symbol) that names it in a call.
    pub keyword: Sym,
    pub parameter: Optional,
}

#[derive(Clone, Default)]
pub(crate) struct LambdaList {
    /// `&whole`.
    pub whole: Option<Value>,
    /// `&environment`.
    pub environment: Option<Sym>,
    /// Required parameters: names, or patterns.
    pub required: Vec<Value>,
    /// Optional parameters.
    pub optional: Vec<Optional>,
    /// `&rest` or `&body`, or a dotted tail.
    pub rest: Option<Value>,
    /// Is there a `&key`?
    pub has_keys: bool,
    /// Keyword parameters.
    pub keys: Vec<Key>,
    /// `&allow-other-keys`.
    pub allow_other_keys: bool,
    /// `&aux` variables and their forms.
    pub aux: Vec<(Sym, Value)>,
}

#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Section {
    Required,
    Optional,
    Rest,
    AfterRest,
    Key,
    AfterKey,
    Aux,
}

impl LambdaList {
    /// Parses a lambda list. `destructuring` allows patterns, `&whole`, `&environment` and
    /// a dotted tail.
    pub(crate) fn parse(
        image: &mut Image,
        list: &Value,
        destructuring: bool,
    ) -> Result<LambdaList, Box<Raise>> {
        let mut parsed = LambdaList::default();
        let mut section = Section::Required;
        let mut iter = list.iter_list();
        while let Some(item) = iter.next() {
            if let Value::Symbol(name, ..) = item {
                match name {
                    known::L_WHOLE if destructuring => {
                        parsed.whole = iter.next();
                        continue;
                    }
                    known::L_ENVIRONMENT if destructuring => {
                        parsed.environment = iter.next().and_then(|v| v.as_symbol());
                        continue;
                    }
                    known::L_OPTIONAL if section < Section::Optional => {
                        section = Section::Optional;
                        continue;
                    }
                    known::L_REST | known::L_BODY if section < Section::Rest => {
                        section = Section::Rest;
                        continue;
                    }
                    known::L_KEY if section < Section::Key && section != Section::Rest => {
                        section = Section::Key;
                        parsed.has_keys = true;
                        continue;
                    }
                    known::L_ALLOW_OTHER_KEYS if section == Section::Key => {
                        section = Section::AfterKey;
                        parsed.allow_other_keys = true;
                        continue;
                    }
                    known::L_AUX if section != Section::Rest => {
                        section = Section::Aux;
                        continue;
                    }
                    _ if image.name(name).starts_with('&') && is_lambda_keyword(name) => {
                        let text = format!("misplaced {} in lambda list", image.name(name));
                        return Err(malformed(image, &text, list));
                    }
                    _ => {}
                }
            }
            match section {
                Section::Required => parsed.required.push(item),
                Section::Optional => parsed.optional.push(optional(image, &item)?),
                Section::Rest => {
                    parsed.rest = Some(item);
                    section = Section::AfterRest;
                }
                Section::Key => {
                    let key = key(image, &item)?;
                    parsed.keys.push(key);
                }
                Section::Aux => {
                    let (name, form) = match &item {
                        Value::Cons(c) => (c.car(), c.cdr().car_or_nil()),
                        other => (other.clone(), Value::NIL),
                    };
                    let Some(name) = name.as_symbol() else {
                        return Err(malformed(image, "an &AUX variable must be a symbol", list));
                    };
                    parsed.aux.push((name, form));
                }
                Section::AfterRest | Section::AfterKey => {
                    return Err(malformed(image, "a misplaced parameter", list));
                }
            }
        }
        if !iter.rest.is_nil() {
            if !destructuring || parsed.rest.is_some() {
                return Err(malformed(image, "a dotted tail", list));
            }
            parsed.rest = Some(iter.rest);
        }
        if section == Section::Rest {
            return Err(malformed(image, "&REST without a variable", list));
        }
        if let Some(name) = repeated(parsed.variables()) {
            return Err(Raise::program(format!(
                "The variable {} occurs more than once in the lambda list {}.",
                image.name(name),
                print::to_string(image, list, true)
            )));
        }
        Ok(parsed)
    }

    /// The variables that are not part of a pattern, those of `&aux` left out: each of these may
    /// have the name of a parameter, which it hides.
    fn variables(&self) -> impl Iterator<Item = Sym> {
        let keys = self.keys.iter().map(|key| &key.parameter);
        let optional = self.optional.iter().chain(keys);
        let supplied = optional.clone().filter_map(|parameter| parameter.supplied);
        let patterns = self.required.iter().chain(&self.rest).chain(&self.whole);
        let patterns = patterns.chain(optional.map(|parameter| &parameter.pattern));
        let names = patterns.filter_map(Value::as_symbol);
        names
            .chain(self.environment)
            .chain(supplied)
            .filter(|name| *name != known::NIL)
    }
}

/// The first of the names that is there twice.
pub(super) fn repeated(names: impl IntoIterator<Item = Sym>) -> Option<Sym> {
    let mut seen = HashSet::new();
    names.into_iter().find(|name| !seen.insert(*name))
}

fn is_lambda_keyword(name: Sym) -> bool {
    matches!(
        name,
        known::L_OPTIONAL
            | known::L_REST
            | known::L_BODY
            | known::L_KEY
            | known::L_ALLOW_OTHER_KEYS
            | known::L_AUX
            | known::L_WHOLE
            | known::L_ENVIRONMENT
    )
}

fn malformed(image: &Image, what: &str, list: &Value) -> Box<Raise> {
    let shown = print::to_string(image, list, true);
    Raise::program(format!("{what}: {shown} is not a valid lambda list"))
}

fn optional(image: &Image, item: &Value) -> Result<Optional, Box<Raise>> {
    Ok(match item {
        Value::Cons(c) => {
            let rest = c.cdr();
            if rest.iter_list().count() > 2 {
                return Err(malformed(
                    image,
                    "more than three parts of a parameter",
                    item,
                ));
            }
            Optional {
                pattern: c.car(),
                default: rest.car_or_nil(),
                supplied: match rest.cdr_or_nil() {
                    Value::Cons(s) => s.car().as_symbol(),
                    _ => None,
                },
            }
        }
        name => Optional {
            pattern: name.clone(),
            default: Value::NIL,
            supplied: None,
        },
    })
}

fn key(image: &mut Image, item: &Value) -> Result<Key, Box<Raise>> {
    let mut parameter = optional(image, item)?;
    let keyword = match &parameter.pattern {
        // ((:keyword pattern) default supplied)
        Value::Cons(c) => {
            let keyword = c.car().as_symbol();
            let pattern = c.cdr().car_or_nil();
            parameter.pattern = pattern;
            keyword
        }
        Value::Symbol(name, ..) => {
            let name = image.name(*name).to_owned();
            Some(image.keyword(&name))
        }
        _ => None,
    };
    match keyword {
        Some(keyword) => Ok(Key { keyword, parameter }),
        None => Err(malformed(image, "a malformed &KEY parameter", item)),
    }
}
