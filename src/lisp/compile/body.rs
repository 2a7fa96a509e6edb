//! Bodies with declarations, and functions.

use std::rc::Rc;

use super::analyze::{Compiled, Compiler};
use super::exits::Exits;
use super::lambda_list::{LambdaList, Optional};
use super::node::{Default, LambdaNode, Node, Prologue};
use super::scope::{Block, Entry, Scope, Var, VariableMeaning};
use crate::value::Value;
use crate::value::code::Parameters;
use crate::value::known;
use crate::value::symbol::Sym;

/// A body without its declarations and documentation.
pub(super) struct Body {
    pub forms: Value,
    /// Names declared special.
    pub(crate) specials: Vec<Sym>,
    /// Names that need not be read.
    pub(super) ignored: Vec<Sym>,
    /// The documentation string.
    pub doc: Option<Rc<str>>,
    /// The lambda list that was written, if the function has another one.
    written: Option<Value>,
}

/// Splits the declarations, and a documentation string if one is allowed, from a body.
pub(super) fn parse_body(body: &Value, allow_doc: bool) -> Body {
    let mut forms = body.clone();
    let mut specials = Vec::new();
    let mut ignored = Vec::new();
    let (mut doc, mut written) = (None, None);
    while let Value::Cons(cons) = &forms {
        let first = cons.car();
        match &first {
            Value::Str(text) if allow_doc && doc.is_none() && !cons.cdr().is_nil() => {
                doc = Some(text.text().into());
            }
            Value::Cons(c) if c.car().as_symbol() == Some(known::DECLARE) => {
                specials.extend(declared(&c.cdr(), &[known::SPECIAL]));
                ignored.extend(declared(&c.cdr(), &[known::IGNORE, known::IGNORABLE]));
                let own = c.cdr().car_or_nil();
                if own.car_or_nil().as_symbol() == Some(known::WRITTEN_LAMBDA_LIST) {
                    written = Some(own.cdr_or_nil().car_or_nil());
                }
            }
            _ => break,
        }
        let rest = cons.cdr();
        forms = rest;
    }
    Body {
        forms,
        specials,
        ignored,
        doc,
        written,
    }
}

/// The names that declarations of some kinds name.
fn declared(specifiers: &Value, kinds: &[Sym]) -> Vec<Sym> {
    let is_one = |s: &Value| {
        let kind = s.car_or_nil().as_symbol();
        kind.is_some_and(|kind| kinds.contains(&kind))
    };
    specifiers
        .iter_list()
        .filter(is_one)
        .flat_map(|s| s.cdr_or_nil().iter_list())
        .filter_map(|name| name.as_symbol())
        .collect()
}

impl Compiler<'_> {
    /// Analyses a body in a scope where its free special declarations hold.
    pub(crate) fn analyze_body(
        &mut self,
        body: &Body,
        bound: &[Sym],
        scope: &Scope,
    ) -> Compiled<Node> {
        let mut scope = scope.clone();
        for name in body.specials.iter().filter(|s| !bound.contains(s)) {
            scope = scope.with(Entry::Variable(*name, VariableMeaning::Special));
        }
        self.analyze_progn(&body.forms, &scope)
    }

    /// Analyses `(lambda-list body…)` as a function. With a block name, the body is inside a block
    /// of that name.
    pub(crate) fn analyze_lambda(
        &mut self,
        name: Value,
        lambda_list: &Value,
        body: &Value,
        block: Option<Sym>,
        scope: &Scope,
    ) -> Compiled<Rc<LambdaNode>> {
        let parsed =
            LambdaList::parse(self.image, lambda_list, false).map_err(|r| r.at(self.place))?;
        let body = parse_body(body, true);
        let id = self.enter_function();
        let result = self.analyze_lambda_parts(lambda_list, &parsed, &body, block, scope);
        let free = self.leave_function(id);
        let (parameters, slots, prologue, node) = result?;
        Ok(Rc::new(LambdaNode {
            name,
            parameters,
            slots,
            prologue,
            body: node,
            free,
            id,
            lambda_list: body.written.unwrap_or_else(|| lambda_list.clone()),
            doc: body.doc,
        }))
    }

    #[allow(clippy::type_complexity)]
    fn analyze_lambda_parts(
        &mut self,
        list: &Value,
        parsed: &LambdaList,
        body: &Body,
        block: Option<Sym>,
        scope: &Scope,
    ) -> Compiled<(Parameters, Vec<Rc<Var>>, Vec<Prologue>, Node)> {
        let mut parts = Parts {
            scope: scope.clone(),
            slots: Vec::new(),
            prologue: Vec::new(),
            bound: Vec::new(),
        };
        let count = |n: usize| u16::try_from(n).unwrap_or(u16::MAX);
        let parameters = Parameters {
            required: count(parsed.required.len()),
            optional: count(parsed.optional.len()),
            rest: parsed.rest.is_some(),
            keys: parsed.keys.iter().map(|k| k.keyword).collect(),
            has_keys: parsed.has_keys,
            allow_other_keys: parsed.allow_other_keys,
        };
        // All slots exist before any default is computed.
        let required = self.parameter_vars(&parsed.required)?;
        let optional_names: Vec<Value> =
            parsed.optional.iter().map(|o| o.pattern.clone()).collect();
        let optional = self.parameter_vars(&optional_names)?;
        let rest_names: Vec<Value> = parsed.rest.iter().cloned().collect();
        let rest = self.parameter_vars(&rest_names)?;
        let key_names: Vec<Value> = parsed
            .keys
            .iter()
            .map(|k| k.parameter.pattern.clone())
            .collect();
        let keys = self.parameter_vars(&key_names)?;
        parts.slots.extend(required.iter().cloned());
        parts.slots.extend(optional.iter().cloned());
        parts.slots.extend(rest.iter().cloned());
        parts.slots.extend(keys.iter().cloned());

        for var in &required {
            self.bind_parameter(var, body, &mut parts);
        }
        for (var, parameter) in optional.iter().zip(&parsed.optional) {
            self.bind_default(var, parameter, body, &mut parts)?;
        }
        for var in &rest {
            self.bind_parameter(var, body, &mut parts);
        }
        for (var, key) in keys.iter().zip(&parsed.keys) {
            self.bind_default(var, &key.parameter, body, &mut parts)?;
        }
        for (name, form) in &parsed.aux {
            let init = self.analyze(form, &parts.scope)?;
            self.check_bindable(&Value::symbol(*name))?;
            let (binding, scope) = self.bind(*name, body.specials.contains(name), &parts.scope);
            parts.scope = scope;
            parts.bound.push(*name);
            parts.prologue.push(Prologue::Aux(binding, init));
        }
        let node = match block {
            Some(name) => {
                let info = self.new_block(name);
                let scope = parts.scope.with(Entry::Block(info.clone()));
                let node = self.analyze_body(body, &parts.bound, &scope)?;
                if info.used.get() {
                    Node::Block(info, Box::new(node))
                } else {
                    node
                }
            }
            None => self.analyze_body(body, &parts.bound, &parts.scope)?,
        };
        self.note_unread_parameters(list, &parts.scope, body);
        Ok((parameters, parts.slots, parts.prologue, node))
    }

    fn parameter_vars(&mut self, names: &[Value]) -> Compiled<Vec<Rc<Var>>> {
        names
            .iter()
            .map(|name| self.check_bindable(name).map(|sym| self.new_var(sym)))
            .collect()
    }

    fn bind_parameter(&mut self, var: &Rc<Var>, body: &Body, parts: &mut Parts) {
        parts.bound.push(var.name);
        if body.specials.contains(&var.name) || self.is_special(var.name) {
            parts
                .prologue
                .push(Prologue::BindSpecial(var.name, var.clone()));
            parts.scope = parts
                .scope
                .with(Entry::Variable(var.name, VariableMeaning::Special));
        } else {
            parts.scope = parts.scope.with(Entry::Variable(
                var.name,
                VariableMeaning::Lexical(var.clone()),
            ));
        }
    }

    fn bind_default(
        &mut self,
        var: &Rc<Var>,
        parameter: &Optional,
        body: &Body,
        parts: &mut Parts,
    ) -> Compiled<()> {
        let init = self.analyze(&parameter.default, &parts.scope)?;
        let supplied = parameter.supplied.map(|name| {
            let (binding, scope) = self.bind(name, body.specials.contains(&name), &parts.scope);
            parts.scope = scope;
            parts.bound.push(name);
            binding
        });
        parts.prologue.push(Prologue::Default(Default {
            var: var.clone(),
            init,
            supplied,
        }));
        self.bind_parameter(var, body, parts);
        Ok(())
    }

    /// A new block of the current function.
    pub(crate) fn new_block(&mut self, name: Sym) -> Rc<Block> {
        Rc::new(Block {
            name,
            owner: self.function_id(),
            depth: self.dynamic_depth(),
            identity: self.new_var(name),
            dynamic: false.into(),
            used: false.into(),
            exits: Exits::default(),
        })
    }
}

struct Parts {
    scope: Scope,
    slots: Vec<Rc<Var>>,
    prologue: Vec<Prologue>,
    bound: Vec<Sym>,
}
