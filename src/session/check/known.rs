//! What the texts checked so far define or mention, apart from what their definitions,
//! which are evaluated, add to the image.

use std::collections::{BTreeMap, BTreeSet};

use super::goals;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::symbol::Sym;

/// Names that must not be reported as unknown.
#[derive(Clone, Default)]
pub(crate) struct KnownNames {
    /// Names of functions, macros and variables.
    pub defined: BTreeSet<Sym>,
    /// Names in rules and definitions for designators, in upper case.
    pub(crate) in_rules: BTreeSet<String>,
    /// Names of Prolog functors that rules and handlers define, in upper case, with the numbers of arguments that they
    /// have; none if these may be any.
    pub(crate) functors: BTreeMap<String, Option<BTreeSet<usize>>>,
    /// Whether anything may be defined, because another file is loaded or a form made at run
    /// time is evaluated.
    pub is_open: bool,
}

impl KnownNames {
    /// Notes what the definitions at any depth in a form define.
    pub(crate) fn note_form(&mut self, image: &Image, form: &Value) {
        let mut pending = vec![form.clone()];
        while let Some(form) = pending.pop() {
            let Some(head) = form.as_cons().map(|cons| cons.car()) else {
                continue;
            };
            if let Some(head) = head.as_symbol() {
                let name = image.name(head);
                if name.starts_with("DEF") {
                    self.note_definition(image, &form);
                }
                self.is_open |= matches!(name, "LOAD" | "REQUIRE" | "QUICKLOAD" | "LOAD-SYSTEM");
            }
            pending.extend(form.iter_list().filter(|v| v.as_cons().is_some()));
        }
    }

    /// Notes what one definition defines.
    pub(crate) fn note_definition(&mut self, image: &Image, form: &Value) {
        let head = form.car_or_nil().as_symbol();
        let name = form.cdr_or_nil().car_or_nil();
        let named = match &name {
            // `(defstruct (name …) …)`, `(defun (setf name) …)`.
            Value::Cons(cons) if cons.car().as_symbol() == Some(known::SETF) => {
                cons.cdr().car_or_nil().as_symbol()
            }
            Value::Cons(cons) => cons.car().as_symbol(),
            other => other.as_symbol(),
        };
        self.defined.extend(named);
        match head.map(|head| image.name(head)) {
            Some("DEFCLASS" | "DEFINE-CONDITION") => self.note_accessors(image, form),
            Some("DEF-FACT-GROUP") => {
                self.note_functors(image, form);
                self.note_rules(image, form);
            }
            Some("DEF-PROLOG-HANDLER") => {
                let name = name.as_symbol().map(|name| image.name(name).to_uppercase());
                self.functors.extend(name.map(|name| (name, None)));
            }
            Some("DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS") => {
                self.note_rules(image, form);
            }
            Some("DEF-OBJECT-TYPE") => self.note_object_type(image, form),
            Some("DEF-ACTION") => self.note_action(image, form),
            _ => {}
        }
    }

    fn note_accessors(&mut self, image: &Image, form: &Value) {
        let slots = form.cdr_or_nil().cdr_or_nil().cdr_or_nil().car_or_nil();
        for slot in slots.iter_list() {
            let mut options = slot.cdr_or_nil();
            while options.as_cons().is_some() {
                let key = options.car_or_nil().as_symbol().map(|key| image.name(key));
                options = options.cdr_or_nil();
                if matches!(key, Some("ACCESSOR" | "READER" | "WRITER")) {
                    self.defined.extend(options.car_or_nil().as_symbol());
                }
                options = options.cdr_or_nil();
            }
        }
    }

    /// A type of actions may be used above its definition.
    fn note_action(&mut self, image: &Image, form: &Value) {
        let definition = form.cdr_or_nil();
        let is_aliases = |option: &Value| {
            let head = option.car_or_nil().as_symbol();
            head.is_some_and(|head| image.name(head) == "ALIASES")
        };
        let options = definition.cdr_or_nil().cdr_or_nil();
        let aliases = options.iter_list().filter(is_aliases);
        let mut names: Vec<Value> = vec![definition.car_or_nil()];
        names
            .extend(aliases.flat_map(|option| option.cdr_or_nil().iter_list().collect::<Vec<_>>()));
        let names = names.iter().filter_map(Value::as_symbol);
        self.in_rules
            .extend(names.map(|name| image.name(name).to_uppercase()));
    }

    /// A type of objects, and its kind.
    fn note_object_type(&mut self, image: &Image, form: &Value) {
        let definition = form.cdr_or_nil();
        let name = definition.car_or_nil();
        let name = match name.as_cons() {
            Some(quoted) => quoted.cdr().car_or_nil(),
            None => name,
        };
        let mut names = vec![name];
        let properties = definition.cdr_or_nil();
        let properties: Vec<Value> = properties.iter_list().collect();
        for pair in properties.chunks_exact(2) {
            let key = pair[0].as_symbol().map(|key| image.name(key));
            if key == Some("KIND") {
                names.push(match pair[1].as_cons() {
                    Some(quoted) => quoted.cdr().car_or_nil(),
                    None => pair[1].clone(),
                });
            }
        }
        let names = names.iter().filter_map(Value::as_symbol);
        self.in_rules
            .extend(names.map(|name| image.name(name).to_uppercase()));
    }

    /// The functors of the heads of a fact group's rules.
    fn note_functors(&mut self, image: &Image, form: &Value) {
        let rules = form.cdr_or_nil().cdr_or_nil().cdr_or_nil();
        for rule in rules.iter_list() {
            let head = rule.cdr_or_nil().car_or_nil();
            let (functor, args) = match head.as_cons() {
                Some(cons) => (cons.car().as_symbol(), cons.cdr()),
                None => (head.as_symbol(), Value::NIL),
            };
            let Some(functor) = functor else {
                continue;
            };
            let name = image.name(functor).to_uppercase();
            let counts = self.functors.entry(name).or_insert(Some(BTreeSet::new()));
            match (goals::elements(&args), counts.as_mut()) {
                ((args, true), Some(counts)) => {
                    counts.insert(args.len());
                }
                _ => *counts = None,
            }
        }
    }

    fn note_rules(&mut self, image: &Image, form: &Value) {
        let mut pending = vec![form.clone()];
        while let Some(form) = pending.pop() {
            match &form {
                Value::Symbol(sym, ..) => {
                    self.in_rules.insert(image.name(*sym).to_uppercase());
                }
                Value::Cons(cons) => pending.extend([cons.car(), cons.cdr()]),
                _ => {}
            }
        }
    }
}
