//! First pass: forms to nodes.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use super::emit;
use super::environment::Environment;
use super::node::{Binding, LambdaNode, Node, Target};
use super::scope::{
    DynamicKind, Entry, FunctionContext, FunctionMeaning, Scope, Var, VariableMeaning,
};
use super::special_forms;
use crate::evaluator::nested;
use crate::guard::{Pace, Stopped, descend, leave, look_patiently, patient_reason};
use crate::image::Image;
use crate::image::notes::NoteKind;
use crate::source::Place;
use crate::value::Value;
use crate::value::code::{Code, Parameters};
use crate::value::function::Function;
use crate::value::known;
use crate::value::number::is_number;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym, VariableKind};
use closest_name::closest_name;

/// Result of compiling.
pub(super) type Compiled<T> = Result<T, Box<Raise>>;

/// The compiler at work on one top-level form.
pub(super) struct Compiler<'a> {
    /// The image that the form belongs to.
    pub image: &'a mut Image,
    functions: Vec<FunctionContext>,
    current: usize,
    pace: Pace,
    /// Why the compiler is to be left.
    stopped: Option<Stopped>,
    /// The place of the innermost enclosing form that has one.
    pub place: Place,
    /// The macro call that the next form is the expansion of.
    pub(super) expanded_from: Option<Value>,
    /// What is to last until the code is made, since that may refer to symbols in it.
    held: RefCell<Vec<Value>>,
}

impl<'a> Compiler<'a> {
    pub(crate) fn new(image: &'a mut Image) -> Compiler<'a> {
        Compiler {
            image,
            functions: Vec::new(),
            current: 0,
            pace: Pace::default(),
            stopped: None,
            place: Place::NONE,
            expanded_from: None,
            held: RefCell::default(),
        }
    }

    /// Compiles a form as the body of a function without parameters.
    pub(crate) fn compile_toplevel(self, form: &Value) -> Compiled<Rc<Code>> {
        self.compile_within(form, &Scope::default())
    }

    /// The same, within definitions of macros.
    pub(super) fn compile_within(mut self, form: &Value, scope: &Scope) -> Compiled<Rc<Code>> {
        let id = self.enter_function();
        let body = self.analyze(form, scope);
        if let Some(reason) = self.stopped {
            drop(body);
            leave(reason);
        }
        let body = body?;
        let free = self.leave_function(id);
        let lambda = LambdaNode {
            name: Value::NIL,
            parameters: Parameters::default(),
            slots: Vec::new(),
            prologue: Vec::new(),
            body,
            free,
            id,
            lambda_list: Value::NIL,
            doc: None,
        };
        emit::emit_function(&lambda, &self.image.symbols)
    }

    /// Lets a passing symbol last until the code is made, which holds those that it refers to.
    fn hold(&self, name: Sym) {
        self.held
            .borrow_mut()
            .extend(self.image.symbols.held_value(name));
    }

    /// The same for the symbols in a macro's expansion.
    fn hold_expansion(&self, expansion: &Value) {
        if matches!(expansion, Value::Cons(_)) {
            self.held.borrow_mut().push(expansion.clone());
        }
    }

    /// Starts a function; returns its number.
    pub(crate) fn enter_function(&mut self) -> usize {
        let id = self.functions.len();
        self.functions.push(FunctionContext {
            outer: (id > 0).then_some(self.current),
            free: RefCell::default(),
            dynamic: RefCell::default(),
        });
        self.current = id;
        id
    }

    /// Ends the function and returns its free variables.
    pub(crate) fn leave_function(&mut self, id: usize) -> Vec<Rc<Var>> {
        let context = &self.functions[id];
        self.current = context.outer.unwrap_or(0);
        context.free.take()
    }

    fn function(&self) -> &FunctionContext {
        &self.functions[self.current]
    }

    /// Number of the function that is being compiled.
    pub(crate) fn function_id(&self) -> usize {
        self.current
    }

    /// Number of open dynamic entries in the current function.
    pub(crate) fn dynamic_depth(&self) -> usize {
        self.function().dynamic.borrow().len()
    }

    /// Would an exit to `depth` run cleanup forms?
    pub(crate) fn crosses_cleanup(&self, depth: usize) -> bool {
        let dynamic = self.function().dynamic.borrow();
        dynamic
            .iter()
            .skip(depth)
            .any(|k| *k == DynamicKind::Unwind)
    }

    /// Analyses something inside `count` dynamic entries of a kind.
    pub(crate) fn inside<R>(
        &mut self,
        kind: DynamicKind,
        count: usize,
        analyze: impl FnOnce(&mut Self) -> Compiled<R>,
    ) -> Compiled<R> {
        let depth = self.dynamic_depth();
        self.function()
            .dynamic
            .borrow_mut()
            .extend(std::iter::repeat_n(kind, count));
        let result = analyze(self);
        self.function().dynamic.borrow_mut().truncate(depth);
        result
    }

    /// Records that a dynamic entry is open from here on.
    pub(crate) fn open_dynamic(&self, kind: DynamicKind) {
        self.function().dynamic.borrow_mut().push(kind);
    }

    /// Records that only the outermost `depth` dynamic entries are still open.
    pub(crate) fn close_dynamic(&self, depth: usize) {
        self.function().dynamic.borrow_mut().truncate(depth);
    }

    /// A new variable of the current function.
    pub(crate) fn new_var(&self, name: Sym) -> Rc<Var> {
        self.hold(name);
        Rc::new(Var {
            name,
            owner: self.current,
            captured: Cell::new(false),
            assigned: Cell::new(false),
            slot: Cell::new(0),
            used: Cell::new(false),
            read: Cell::new(false),
        })
    }

    /// Records a reference to a variable from the current function.
    pub(crate) fn refer(&self, var: &Rc<Var>) {
        var.used.set(true);
        if var.owner == self.current {
            return;
        }
        var.captured.set(true);
        let mut id = self.current;
        while id != var.owner {
            let context = &self.functions[id];
            let mut free = context.free.borrow_mut();
            if !free.iter().any(|v| Rc::ptr_eq(v, var)) {
                free.push(var.clone());
            }
            match context.outer {
                Some(outer) => id = outer,
                None => break,
            }
        }
    }

    /// Is every binding of the name dynamic?
    pub(crate) fn is_special(&self, name: Sym) -> bool {
        self.image.symbol(name).kind == VariableKind::Special
    }

    /// Checks that a name can be bound as a variable.
    pub(crate) fn check_bindable(&self, name: &Value) -> Compiled<Sym> {
        let Some(sym) = name.as_symbol() else {
            let shown = crate::print::to_string(self.image, name, true);
            return Err(self.program_error(format!(
                "{shown} is not a symbol and cannot be used as a local variable."
            )));
        };
        if self.image.symbol(sym).kind == VariableKind::Constant {
            let shown = crate::print::to_string(self.image, name, true);
            let what = if self.image.is_keyword(sym) {
                "a keyword"
            } else {
                "a constant"
            };
            return Err(self.program_error(format!(
                "{shown} is {what} and cannot be used as a local variable."
            )));
        }
        Ok(sym)
    }

    /// The error for a symbol that cannot stand for a form since it is a special variable.
    pub(crate) fn special_symbol_macro(&self, name: Sym) -> Box<Raise> {
        let shown = crate::print::to_string(self.image, &name.into(), true);
        self.program_error(format!(
            "{shown} is a special variable and cannot be a symbol macro."
        ))
    }

    /// A program error at the current place.
    pub(crate) fn program_error(&self, text: impl Into<String>) -> Box<Raise> {
        Raise::program(text).at(self.place)
    }

    /// An error if forms are nested too deeply: for functions that call themselves.
    pub(crate) fn descend(&self) -> Compiled<()> {
        descend().map_err(|deep| Box::<Raise>::from(deep).at(self.place))
    }

    /// An error if there is a reason to stop: to unwind many thousands of levels would take long.
    fn look(&mut self) -> Compiled<()> {
        if self.stopped.is_none() && self.pace.is_due() {
            self.stopped = patient_reason();
        }
        self.stopped.map_or(Ok(()), |stopped| Err(stopped.into()))
    }

    /// Analyses a form.
    pub(crate) fn analyze(&mut self, form: &Value, scope: &Scope) -> Compiled<Node> {
        self.descend()?;
        self.look()?;
        match form {
            Value::Symbol(name, ..) => self.analyze_variable(*name, scope),
            Value::Cons(cons) => {
                let outer = self.place;
                if cons.place().is_some() {
                    self.place = cons.place();
                }
                let node = self.analyze_compound(form, &cons.car(), &cons.cdr(), scope);
                self.place = outer;
                node
            }
            constant => Ok(Node::Const(constant.clone())),
        }
    }

    fn analyze_variable(&mut self, name: Sym, scope: &Scope) -> Compiled<Node> {
        match scope.variable(name) {
            Some(VariableMeaning::Lexical(var)) => {
                self.refer(var);
                var.read.set(true);
                return Ok(Node::Local(var.clone()));
            }
            Some(VariableMeaning::SymbolMacro(expansion)) => {
                let expansion = expansion.clone();
                return self.analyze(&expansion, scope);
            }
            Some(VariableMeaning::Special) => return Ok(Node::Global(name, self.place)),
            None => {}
        }
        self.hold(name);
        let data = self.image.symbol(name);
        if let Some(expansion) = data.symbol_macro.clone() {
            return self.analyze(&expansion, scope);
        }
        if data.kind == VariableKind::Constant {
            return Ok(Node::Const(data.value.clone()));
        }
        if data.kind == VariableKind::Lexical && data.value.is_unbound() {
            self.note_variable(name, scope);
        }
        Ok(Node::Global(name, self.place))
    }

    /// Takes a note of a reference to a variable that has no binding so far.
    fn note_variable(&mut self, name: Sym, scope: &Scope) {
        if self.image.notes.is_none() {
            return;
        }
        let image = &*self.image;
        let bound: Vec<Sym> = scope.variables().collect();
        let wanted = image.name(name);
        // Any two names of one or two letters are close to each other.
        let is_long = wanted.chars().count() > 2;
        let names = bound.iter().map(|sym| image.name(*sym));
        let near = closest_name(wanted, names).filter(|_| is_long);
        let near = near.and_then(|near| bound.iter().copied().find(|sym| image.name(*sym) == near));
        let place = self.place;
        self.image.note(place, || NoteKind::Variable(name, near));
    }

    fn analyze_compound(
        &mut self,
        form: &Value,
        head: &Value,
        rest: &Value,
        scope: &Scope,
    ) -> Compiled<Node> {
        let expanded_from = self.expanded_from.take();
        let name = match head {
            Value::Symbol(name, ..) => *name,
            Value::Cons(c) if c.car().as_symbol() == Some(known::LAMBDA) => {
                let function = self.analyze(head, scope)?;
                let args = self.analyze_list(rest, scope)?;
                return Ok(Node::Call(
                    Target::Computed(Box::new(function)),
                    args,
                    self.place,
                ));
            }
            _ => {
                let shown = crate::print::to_string(self.image, head, true);
                let instead = match (rest.car_or_nil().as_symbol(), head) {
                    (Some(operator), number) if is_arithmetic(operator) && is_number(number) => {
                        let operator = self.image.name(operator);
                        format!("the operator comes first: ({operator} {shown} …)")
                    }
                    _ => "a list that is data needs a quote: '(…)".to_owned(),
                };
                return Err(self.program_error(format!(
                    "illegal function call\n{shown} is not the name of a function; {instead}"
                )));
            }
        };
        match scope.function(name, false) {
            Some(FunctionMeaning::Local(var)) => {
                self.refer(var);
                let function = Node::Local(var.clone());
                let args = self.analyze_list(rest, scope)?;
                return Ok(Node::Call(
                    Target::Computed(Box::new(function)),
                    args,
                    self.place,
                ));
            }
            Some(FunctionMeaning::Macro(function)) => {
                let function = function.clone();
                let expansion = self.expand_with(&function, form, scope)?;
                return self.analyze_expansion(form, &expansion, scope);
            }
            None => {}
        }
        if let Some(guarded) = super::locks::guarded_definition(self.image, form, self.place) {
            self.hold_expansion(&guarded);
            return self.analyze(&guarded, scope);
        }
        match &self.image.symbol(name).function {
            FunctionCell::Macro(function) => {
                let function = function.clone();
                let is_of_library = function.as_deferred().is_some();
                if is_of_library {
                    self.note_definition(name, form);
                }
                let expansion = match self.expand_with(&function, form, scope) {
                    Err(raise) if is_of_library => {
                        Err(super::shape::explained(self.image, name, form, raise).at(self.place))
                    }
                    expansion => expansion,
                }?;
                self.analyze_expansion(form, &expansion, scope)
            }
            FunctionCell::Builtin => {
                if let Some(operator) = self.image.operator(name) {
                    super::shape::check(self.image, name, operator.lambda_list, form)
                        .map_err(|r| r.at(self.place))?;
                }
                if let Some(special) = special_forms::lookup(name) {
                    self.expanded_from = expanded_from;
                    return special(self, rest, scope);
                }
                self.note_definition(name, form);
                let expander = self.image.operator(name).and_then(|o| o.expand);
                match expander {
                    Some(expand) => {
                        let environment = Environment::value(scope);
                        let expansion = self
                            .image
                            .expand_with(expand, form, environment)
                            .map_err(|r| r.at(self.place))?;
                        self.analyze_expansion(form, &expansion, scope)
                    }
                    None => {
                        Err(self
                            .program_error(format!("{} is not a function.", self.image.name(name))))
                    }
                }
            }
            FunctionCell::Function(_) | FunctionCell::Unbound => {
                let place = self.place;
                self.image
                    .note(place, || NoteKind::Call(name, form.clone()));
                self.note_failing_call(name, scope);
                let args = self.analyze_list(rest, scope)?;
                Ok(Node::Call(Target::Global(name), args, self.place))
            }
        }
    }

    /// Analyses the expansion of a macro call.
    fn analyze_expansion(
        &mut self,
        call: &Value,
        expansion: &Value,
        scope: &Scope,
    ) -> Compiled<Node> {
        self.hold_expansion(expansion);
        self.expanded_from = Some(call.clone());
        let node = self.analyze(expansion, scope);
        self.expanded_from = None;
        node
    }

    /// Takes a note of a form with an operator of the language that defines something.
    fn note_definition(&mut self, operator: Sym, form: &Value) {
        if self.image.notes.is_some() && self.image.name(operator).starts_with("DEF") {
            let place = self.place;
            self.image
                .note(place, || NoteKind::Definition(form.clone()));
        }
    }

    /// Runs a macro function on a form.
    pub(crate) fn expand_with(
        &mut self,
        function: &Rc<Function>,
        form: &Value,
        scope: &Scope,
    ) -> Compiled<Value> {
        look_patiently();
        let args = vec![form.clone(), Environment::value(scope)];
        let expansion = nested::call_nested(self.image, Value::Function(function.clone()), args)
            .map_err(|r| r.at(self.place))?;
        keep_place(form, &expansion);
        Ok(expansion)
    }

    /// Analyses the elements of a list.
    pub(crate) fn analyze_list(&mut self, forms: &Value, scope: &Scope) -> Compiled<Vec<Node>> {
        let Some(forms) = forms.list_to_vec() else {
            return Err(self.program_error("a call's arguments must be a proper list"));
        };
        forms.iter().map(|f| self.analyze(f, scope)).collect()
    }

    /// Analyses forms as a `progn`.
    pub(crate) fn analyze_progn(&mut self, forms: &Value, scope: &Scope) -> Compiled<Node> {
        let mut nodes = self.analyze_list(forms, scope)?;
        self.note_unreachable(forms, &nodes);
        Ok(match nodes.len() {
            0 => Node::NIL,
            1 => nodes.pop().unwrap_or(Node::NIL),
            _ => Node::Progn(nodes),
        })
    }

    /// Binds a name; returns the binding and the scope in which it is visible.
    pub(crate) fn bind(
        &mut self,
        name: Sym,
        declared_special: bool,
        scope: &Scope,
    ) -> (Binding, Scope) {
        if declared_special || self.is_special(name) {
            let scope = scope.with(Entry::Variable(name, VariableMeaning::Special));
            (Binding::Special(name), scope)
        } else {
            let var = self.new_var(name);
            let scope = scope.with(Entry::Variable(name, VariableMeaning::Lexical(var.clone())));
            (Binding::Lexical(var), scope)
        }
    }
}

/// Gives an expansion the place of the form that it comes from, unless it has one.
pub(crate) fn keep_place(form: &Value, expansion: &Value) {
    if let (Value::Cons(from), Value::Cons(to)) = (form, expansion)
        && !to.place().is_some()
    {
        to.set_place(from.place());
    }
}

/// Is it an operator that other languages write between numbers?
fn is_arithmetic(name: Sym) -> bool {
    matches!(
        name,
        known::PLUS
            | known::MINUS
            | known::TIMES
            | known::DIVIDE
            | known::LESS
            | known::GREATER
            | known::LESS_EQUAL
            | known::GREATER_EQUAL
            | known::NUM_EQUAL
    )
}
