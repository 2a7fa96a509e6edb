//! Copies of functions and of their code.

use std::cell::OnceCell;
use std::rc::Rc;

use super::{Copied, Copier, address, is_fixed, is_shared};
use crate::value::Value;
use crate::value::code::{Code, Content};
use crate::value::function::{Body, Function, Native, NativeBody};
use crate::value::generic::GenericFunction;

/// How deep functions may hold each other: they cannot be filled later.
const MAX_NESTED: usize = 500;

impl Copier {
    /// The copy of a function.
    pub fn function(&mut self, function: &Rc<Function>) -> Rc<Function> {
        let is_shared = is_shared(function);
        if is_shared && let Some(Value::Function(copy)) = self.copies.get(&address(function)) {
            return copy.clone();
        }
        if self.depth == MAX_NESTED {
            self.refuse("functions that hold functions that hold functions");
            return function.clone();
        }
        self.depth += 1;
        let body = self.body(&function.body);
        self.depth -= 1;
        let copy = match body {
            Some(body) => Rc::new(Function::from(body)),
            None => function.clone(),
        };
        if is_shared {
            self.copies
                .insert(address(function), Value::Function(copy.clone()));
        }
        if let Body::Generic(_) = copy.body {
            let copy = Value::Function(copy.clone());
            self.pending.push((Value::Function(function.clone()), copy));
        }
        copy
    }

    /// The copy of what a function does; `None` if the function never changes.
    fn body(&mut self, body: &Body) -> Option<Body> {
        match body {
            Body::Closure { code, captured } => {
                let copy = self.code(code);
                if Rc::ptr_eq(&copy, code) && captured.iter().all(is_fixed) {
                    return None;
                }
                Some(Body::Closure {
                    code: copy,
                    captured: self.all(captured),
                })
            }
            Body::Deferred(_)
            | Body::Native(Native {
                body: NativeBody::Builtin(_),
                ..
            }) => None,
            Body::Native(Native {
                name,
                min,
                max,
                body: NativeBody::Made(made),
            }) => {
                let Some(made) = made.copied(self) else {
                    self.refuse("a function of something that runs");
                    return None;
                };
                Some(Body::Native(Native {
                    name: *name,
                    min: *min,
                    max: *max,
                    body: NativeBody::Made(made),
                }))
            }
            Body::Generic(generic) => {
                let name = self.value(&generic.name);
                let copy = GenericFunction::new(name, generic.parameters.borrow().clone());
                Some(Body::Generic(Box::new(copy)))
            }
        }
    }

    fn code(&mut self, code: &Rc<Code>) -> Rc<Code> {
        if code.is_fixed {
            return code.clone();
        }
        let is_shared = is_shared(code);
        if is_shared && let Some(copy) = self.codes.get(&address(code)) {
            return copy.clone();
        }
        let content = code.content().map(|content| self.content(content));
        let copy = Rc::new(Code {
            name: code.name.copied(self),
            parameters: code.parameters.clone(),
            exact_count: code.exact_count,
            room: code.room,
            is_fixed: false,
            content: content.map(OnceCell::from).unwrap_or_default(),
            unread: code.unread,
        });
        if is_shared {
            self.codes.insert(address(code), copy.clone());
        }
        copy
    }

    fn content(&mut self, content: &Content) -> Content {
        let inner = content.inner.iter();
        let inner = inner.map(|(code, captures)| (self.code(code), captures.clone()));
        Content {
            inner: inner.collect(),
            ops: content.ops.clone(),
            constants: self.all(&content.constants),
            tags: content.tags.clone(),
            places: content.places.clone(),
            locals: content.locals.clone(),
            free: content.free.clone(),
            lambda_list: content.lambda_list.copied(self),
            doc: content.doc.clone(),
        }
    }
}
