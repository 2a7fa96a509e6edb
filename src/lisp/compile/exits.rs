//! Notes about exits: forms that are never reached, and loops that are never left although somebody
//! has written a `(return)`.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use super::analyze::Compiler;
use super::node::{Node, Target};
use super::scope::{Block, Entry, Scope, Tagbody};
use crate::image::notes::NoteKind;
use crate::source::Place;
use crate::value::Value;
use crate::value::known;
use crate::value::package::PackageTable;
use crate::value::symbol::Sym;

/// What is noticed about the exits of a block.
#[derive(Default)]
pub(super) struct Exits {
    /// The macro outside the language that has made it.
    operator: Option<Sym>,
    /// Is it that of a `loop` that only an exit ends?
    is_endless: bool,
    /// Does anything within it leave it for something further out?
    is_crossed: Cell<bool>,
    /// Each `(return)` within it that leaves only a form of a macro, with that macro.
    caught: RefCell<Vec<(Place, Sym)>>,
}

impl Compiler<'_> {
    /// A new block; a macro may have made it.
    pub(super) fn new_block_of_macro(&mut self, name: Sym) -> Rc<Block> {
        let from = self.expanded_from.take();
        let mut block = self.new_block(name);
        if self.image.notes.is_none() {
            return block;
        }
        if let (Some(call), Some(block)) = (from, Rc::get_mut(&mut block)) {
            let operator = call.car_or_nil().as_symbol();
            let is_of_language =
                |sym: &Sym| self.image.symbol(*sym).package == Some(PackageTable::CL);
            block.exits.is_endless = operator == Some(known::LOOP) && self.is_endless(&call);
            block.exits.operator = operator.filter(|sym| !is_of_language(sym));
        }
        block
    }

    /// Does nothing but an exit end a `loop`: is it `(loop form…)` or `(loop do form…)`?
    fn is_endless(&self, call: &Value) -> bool {
        let clauses = call.cdr_or_nil();
        let first = clauses.car_or_nil().as_symbol();
        let is_do = first.is_some_and(|sym| matches!(self.image.name(sym), "DO" | "DOING"));
        let forms = if is_do { clauses.cdr_or_nil() } else { clauses };
        forms.as_cons().is_some() && forms.iter_list().all(|form| form.as_cons().is_some())
    }

    /// Notices an exit from a block.
    pub(super) fn note_exit_to(&mut self, block: &Rc<Block>, scope: &Scope) {
        if self.image.notes.is_none() {
            return;
        }
        let mut blocks = scope.blocks();
        for left in blocks.by_ref() {
            if Rc::ptr_eq(left, block) {
                break;
            }
            left.exits.is_crossed.set(true);
        }
        let Some(operator) = block.exits.operator.filter(|_| block.name == known::NIL) else {
            return;
        };
        let around = blocks.find(|outer| outer.name == known::NIL);
        if let Some(outer) = around.filter(|outer| outer.exits.is_endless) {
            let caught = (self.place, operator);
            outer.exits.caught.borrow_mut().push(caught);
        }
    }

    /// Notices a jump to a tag.
    pub(super) fn note_jump_to(&mut self, tagbody: &Rc<Tagbody>, scope: &Scope) {
        for entry in scope.entries() {
            match entry {
                Entry::Block(block) => block.exits.is_crossed.set(true),
                Entry::Tagbody(found) if Rc::ptr_eq(found, tagbody) => break,
                _ => {}
            }
        }
    }

    /// Notices an exit whose end is not known.
    pub(super) fn note_exit_of_all(&self, scope: &Scope) {
        for block in scope.blocks() {
            block.exits.is_crossed.set(true);
        }
    }

    /// Notices a call of a function that signals an error or a failure.
    pub(super) fn note_failing_call(&self, function: Sym, scope: &Scope) {
        if self.image.notes.is_some() && matches!(self.image.name(function), "ERROR" | "FAIL") {
            self.note_exit_of_all(scope);
        }
    }

    /// Takes a note of each `(return)` that was meant to leave an endless loop, but does not.
    pub(super) fn note_caught_returns(&mut self, block: &Block) {
        let exits = &block.exits;
        if block.used.get() || exits.is_crossed.get() {
            return;
        }
        for (place, operator) in exits.caught.take() {
            self.image.note(place, || NoteKind::CaughtReturn(operator));
        }
    }

    /// Takes a note of the first form of a body that is never reached.
    pub(super) fn note_unreachable(&mut self, forms: &Value, nodes: &[Node]) {
        if self.image.notes.is_none() {
            return;
        }
        let last = nodes.iter().position(never_returns);
        let next = last.and_then(|last| forms.iter_list().nth(last + 1));
        self.note_unreachable_form(next);
    }

    /// The same for the statements of a `tagbody`, which tags make reachable.
    pub(super) fn note_unreachable_statements(
        &mut self,
        items: &[Value],
        is_tag: impl Fn(&Value) -> bool,
        nodes: &[Node],
    ) {
        if self.image.notes.is_none() {
            return;
        }
        let mut nodes = nodes.iter();
        for pair in items.windows(2) {
            let [statement, next] = pair else { continue };
            if is_tag(statement) || !nodes.next().is_some_and(never_returns) {
                continue;
            }
            if !is_tag(next) {
                return self.note_unreachable_form(Some(next.clone()));
            }
        }
    }

    fn note_unreachable_form(&mut self, form: Option<Value>) {
        if let Some(Value::Cons(cons)) = form
            && self.is_written(cons.place())
        {
            self.image.note(cons.place(), || NoteKind::Unreachable);
        }
    }
}

/// Does control never come to what is after a piece of program?
fn never_returns(node: &Node) -> bool {
    match node {
        Node::LocalReturn(..)
        | Node::DynamicReturn(..)
        | Node::LocalGo(..)
        | Node::DynamicGo(..)
        | Node::Throw(..) => true,
        Node::Call(Target::Global(known::ERROR), ..) => true,
        Node::Progn(nodes) => nodes.iter().any(never_returns),
        Node::Let { body, .. } => never_returns(body),
        Node::If(_, one, other) => never_returns(one) && never_returns(other),
        _ => false,
    }
}
