//! From a value to a document: an explicit stack of what is still to be printed.

use crate::lisp::value::element_type::ElementType;
use std::rc::Rc;

use super::atom;
use super::calls::{Call, Calls};
use super::circle::{Label, Labels};
use super::dispatch;
use super::layout::lay_out;
use super::report;
use super::settings::Settings;
use super::shape::{self, Form, Layout, Shape, Style};
use super::symbol;
use crate::lisp::guard::Pace;
use crate::lisp::image::Image;
use crate::lisp::image::identity::identity;
use crate::lisp::value::Value;
use crate::lisp::value::array::{Array, Vector};
use crate::lisp::value::class::{ClassKind, Instance};
use crate::lisp::value::document::{Document, Newline};
use crate::lisp::value::known;

/// Prints one value.
pub(super) struct Printer<'a> {
    image: &'a Image,
    settings: &'a Settings,
    calls: &'a mut Calls,
    document: Document,
    labels: Labels,
    tasks: Vec<Task>,
    /// Is the next instance to be printed without its `print-object` method?
    skips_method: bool,
}

enum Task {
    /// Print a value at this depth of lists and vectors.
    Value(Value, Style, usize),
    /// Print the rest of a list.
    Rest(Rest),
    /// Print the elements of a vector from an index on.
    Elements {
        items: Rc<Vec<Value>>,
        next: usize,
        end: usize,
        depth: usize,
    },
    /// Print the sub-arrays of a dimension from an index on.
    Rows {
        array: Rc<Array>,
        dimension: usize,
        next: usize,
        /// Index of the next element.
        offset: usize,
        depth: usize,
    },
    /// Print the slots of a structure from an index on.
    Slots {
        instance: Rc<Instance>,
        next: usize,
        depth: usize,
    },
    /// End a block and write what closes it.
    Close(&'static str),
}

struct Rest {
    list: Value,
    /// Number of elements printed.
    index: usize,
    layout: ListLayout,
    depth: usize,
    /// Inner blocks to end with the list.
    inner: usize,
}

#[derive(Clone, Copy)]
enum ListLayout {
    Shape(&'static Shape),
    Macro(usize),
}

impl<'a> Printer<'a> {
    pub(super) fn new(
        image: &'a Image,
        settings: &'a Settings,
        calls: &'a mut Calls,
    ) -> Printer<'a> {
        Printer {
            image,
            settings,
            calls,
            document: Document::new(settings.pretty),
            labels: Labels::default(),
            tasks: Vec::new(),
            skips_method: false,
        }
    }

    /// Prints the value itself as if it had no `print-object` method.
    pub(super) fn without_own_method(self) -> Printer<'a> {
        Printer {
            skips_method: true,
            ..self
        }
    }

    /// The value's text, where the line already has `column` characters.
    pub(super) fn print(mut self, value: &Value, column: usize) -> String {
        self.run(value);
        if self.settings.pretty {
            lay_out(self.document, self.settings, column)
        } else {
            self.document.into_text()
        }
    }

    /// Prints the value as a part of a document.
    pub(super) fn print_into(mut self, document: &mut Document, value: &Value) {
        std::mem::swap(document, &mut self.document);
        self.run(value);
        std::mem::swap(document, &mut self.document);
    }

    fn run(&mut self, value: &Value) {
        self.labels = Labels::of(value, self.settings.circle);
        self.tasks.push(Task::Value(value.clone(), Style::Auto, 0));
        let mut pace = Pace::default();
        while let Some(task) = self.tasks.pop() {
            pace.step();
            match task {
                Task::Value(value, style, depth) => self.value(value, style, depth),
                Task::Rest(rest) => self.rest(rest),
                Task::Elements {
                    items,
                    next,
                    end,
                    depth,
                } => self.elements(items, next, end, depth),
                Task::Rows {
                    array,
                    dimension,
                    next,
                    offset,
                    depth,
                } => self.rows(array, dimension, next, offset, depth),
                Task::Slots {
                    instance,
                    next,
                    depth,
                } => self.slots(instance, next, depth),
                Task::Close(text) => {
                    self.document.end();
                    self.document.text(text);
                }
            }
        }
    }

    fn value(&mut self, value: Value, style: Style, depth: usize) {
        let is_dispatched = !self.skips_method && self.settings.pretty;
        self.skips_method &= matches!(value, Value::Instance(_));
        match self.labels.next(&value) {
            Label::None => {}
            Label::First(number) => self.document.text(&format!("#{number}=")),
            Label::Again(number) => {
                self.document.text(&format!("#{number}#"));
                return;
            }
        }
        if is_dispatched
            && let Some(function) = dispatch::function_for(self.image, &value, self.calls)
            && let Some(text) = self.calls.text(|| Call {
                function,
                before: Vec::new(),
                after: vec![value.clone()],
                bindings: self.settings.bindings(self.image, depth),
                is_pretty: true,
            })
        {
            self.document.append(&text);
            return;
        }
        match &value {
            Value::Cons(_) => self.list(value, style, depth),
            Value::Symbol(known::NIL, ..) if matches!(style, Style::List(_)) => {
                self.document.text("()");
            }
            Value::Vector(vector) => self.vector(&value, vector, depth),
            Value::Array(array) => self.array(&value, array, depth),
            Value::Instance(instance) => self.instance(&value, instance, depth),
            Value::Foreign(object) if !self.settings.escape => {
                let writer = object.object().writer();
                match writer.and_then(|writer| self.text_of_call(writer, Vec::new(), depth)) {
                    Some(text) => self.document.append(&text),
                    None => self.atom(&value),
                }
            }
            _ => self.atom(&value),
        }
    }

    /// Prints a value without parts.
    fn atom(&mut self, value: &Value) {
        let text = atom::atom(self.image, value, self.settings);
        if self.settings.readably {
            let is_readable = match value {
                Value::Foreign(object) => object.object().is_readable(),
                _ => true,
            };
            if !is_readable || text.starts_with("#<") {
                self.calls.note_unreadable(value);
            }
        }
        self.document.text(&text);
    }

    /// Is something at this depth left out? Then `#` is printed in its place.
    fn is_too_deep(&mut self, depth: usize) -> bool {
        let depth = self.settings.depth + depth;
        let is_too_deep = self.settings.level.is_some_and(|level| depth >= level);
        if is_too_deep {
            self.document.text("#");
        }
        is_too_deep
    }

    fn is_cut(&self, printed: usize) -> bool {
        self.settings.length.is_some_and(|most| printed >= most)
    }

    fn list(&mut self, list: Value, style: Style, depth: usize) {
        let form = match style {
            Style::List(shape) if self.settings.pretty && !shape::is_backquote_part(&list) => {
                Form::Shape(shape)
            }
            _ if self.settings.pretty => shape::form(self.image, &list),
            _ => match shape::prefix(&list) {
                // Backquotes are always printed with their prefix.
                Some(prefix) if !matches!(prefix, "'" | "#'") => Form::Prefix(prefix),
                _ => Form::Shape(&shape::FILL),
            },
        };
        let layout = match form {
            Form::Prefix(prefix) => {
                self.document.text(prefix);
                let argument = list.cdr_or_nil().car_or_nil();
                if prefix == ","
                    && let Value::Symbol(sym, ..) = argument
                    && self.image.name(sym).starts_with(['@', '.'])
                {
                    self.document.text(" ");
                }
                self.tasks.push(Task::Value(argument, Style::Auto, depth));
                return;
            }
            Form::Shape(shape) => ListLayout::Shape(shape),
            Form::Macro(count) => ListLayout::Macro(count),
        };
        if self.is_too_deep(depth) {
            return;
        }
        self.document.open("(", ")");
        self.tasks.push(Task::Rest(Rest {
            list,
            index: 0,
            layout,
            depth,
            inner: 0,
        }));
    }

    /// Writes what precedes an element; returns how the element is printed.
    fn before(&mut self, rest: &mut Rest, element: &Value) -> Style {
        let Some(position) = rest.index.checked_sub(1) else {
            return match rest.layout {
                ListLayout::Shape(shape) => shape.first,
                ListLayout::Macro(_) => Style::Auto,
            };
        };
        let shape = match rest.layout {
            ListLayout::Shape(shape) => shape,
            ListLayout::Macro(count) => {
                self.before_macro_argument(position, count);
                return Style::Auto;
            }
        };
        let step = shape.steps.get(position).or_else(|| {
            let position = position - shape.steps.len();
            shape.rest.get(position % shape.rest.len().max(1))
        });
        let Some(step) = step else {
            self.document.text(" ");
            return Style::Auto;
        };
        for layout in step.before {
            match layout {
                Layout::Space => self.document.text(" "),
                Layout::Break(newline) => self.document.newline(*newline),
                Layout::Block(columns) => self.document.indent_block(*columns),
                Layout::Current => self.document.indent_current(0),
                Layout::Inner => {
                    self.document.start();
                    rest.inner += 1;
                }
                Layout::TagIndent => {
                    let columns = i64::from(matches!(element, Value::Cons(_)));
                    self.document.indent_block(columns);
                }
                Layout::LoopBreak if shape::begins_loop_clause(self.image, element) => {
                    self.document.newline(Newline::Mandatory);
                }
                Layout::LoopBreak => {}
                Layout::ParameterBreak if shape::is_parameter_keyword(element) => {
                    self.document.newline(Newline::Linear);
                }
                Layout::ParameterBreak => self.document.newline(Newline::Fill),
            }
        }
        step.style
    }

    /// The first argument follows the macro's name on its line, others are below it, then the body.
    fn before_macro_argument(&mut self, position: usize, count: usize) {
        self.document.text(" ");
        if position == 0 && count > 0 {
            return;
        }
        let indent = if position < count { 3 } else { 1 };
        self.document.indent_block(indent);
        self.document.newline(Newline::Mandatory);
    }

    fn rest(&mut self, mut rest: Rest) {
        let list = rest.list.clone();
        let depth = rest.depth;
        let is_first = rest.index == 0;
        let cons = match &list {
            Value::Cons(cons)
                if is_first
                    || !(self.labels.is_marked(&list) || shape::is_backquote_part(&list)) =>
            {
                cons
            }
            Value::Symbol(known::NIL, ..) => {
                self.close_list(rest.inner);
                return;
            }
            tail => {
                // A dotted tail, or one that is shared with another place.
                self.before(&mut rest, tail);
                self.document.text(". ");
                self.push_close(rest.inner);
                self.tasks
                    .push(Task::Value(tail.clone(), Style::Auto, depth + 1));
                return;
            }
        };
        let element = cons.car();
        let style = self.before(&mut rest, &element);
        if self.is_cut(rest.index) {
            self.document.text("...");
            self.close_list(rest.inner);
            return;
        }
        rest.list = cons.cdr();
        rest.index += 1;
        self.tasks.push(Task::Rest(rest));
        self.tasks.push(Task::Value(element, style, depth + 1));
    }

    fn push_close(&mut self, inner: usize) {
        self.tasks.push(Task::Close(")"));
        for _ in 0..inner {
            self.tasks.push(Task::Close(""));
        }
    }

    fn close_list(&mut self, inner: usize) {
        for _ in 0..inner {
            self.document.end();
        }
        self.document.end();
        self.document.text(")");
    }

    fn vector(&mut self, value: &Value, vector: &Rc<Vector>, depth: usize) {
        let items = vector.to_vec();
        if !self.settings.array {
            let kind = if vector.element_type == ElementType::Bit {
                "SIMPLE-BIT-VECTOR"
            } else {
                "SIMPLE-VECTOR"
            };
            let text = format!(
                "#<({kind} {}) {}>",
                items.len(),
                identity(self.image, value)
            );
            self.document.text(&text);
            return;
        }
        if vector.element_type == ElementType::Bit {
            let bits = items.iter().map(|bit| {
                if matches!(bit, Value::Int(0)) {
                    '0'
                } else {
                    '1'
                }
            });
            let text: String = "#*".chars().chain(bits).collect();
            self.document.text(&text);
            return;
        }
        if self.is_too_deep(depth) {
            return;
        }
        self.document.open("#(", ")");
        self.tasks.push(Task::Close(")"));
        self.tasks.push(Task::Elements {
            end: items.len(),
            items: Rc::new(items),
            next: 0,
            depth,
        });
    }

    fn elements(&mut self, items: Rc<Vec<Value>>, next: usize, end: usize, depth: usize) {
        if next >= end {
            return;
        }
        if next > 0 {
            self.document.text(" ");
            self.document.newline(Newline::Fill);
        }
        if self.is_cut(next) {
            self.document.text("...");
            return;
        }
        if let Some(item) = items.get(next).cloned() {
            self.tasks.push(Task::Elements {
                items,
                next: next + 1,
                end,
                depth,
            });
            self.tasks.push(Task::Value(item, Style::Auto, depth + 1));
        }
    }

    fn array(&mut self, value: &Value, array: &Rc<Array>, depth: usize) {
        if !self.settings.array {
            let text = format!("#<ARRAY {}>", identity(self.image, value));
            self.document.text(&text);
            return;
        }
        let rank = array.dimensions.borrow().len();
        self.document.text(&format!("#{rank}A"));
        self.tasks.push(Task::Rows {
            array: array.clone(),
            dimension: 0,
            next: 0,
            offset: 0,
            depth,
        });
    }

    fn rows(
        &mut self,
        array: Rc<Array>,
        dimension: usize,
        next: usize,
        offset: usize,
        depth: usize,
    ) {
        let Some(length) = array.dimensions.borrow().get(dimension).copied() else {
            let item = array.items.get(offset);
            let item = item.unwrap_or(Value::NIL);
            self.tasks.push(Task::Value(item, Style::Auto, depth));
            return;
        };
        if next == 0 {
            if self.is_too_deep(depth) {
                return;
            }
            self.document.open("(", ")");
        }
        let is_cut = next < length && self.is_cut(next);
        if next > 0 && next < length {
            self.document.text(" ");
            let is_last_dimension = dimension + 1 == array.dimensions.borrow().len();
            self.document.newline(if is_last_dimension {
                Newline::Fill
            } else {
                Newline::Linear
            });
        }
        if is_cut {
            self.document.text("...");
        }
        if is_cut || next >= length {
            self.document.end();
            self.document.text(")");
            return;
        }
        let step: usize = array
            .dimensions
            .borrow()
            .iter()
            .skip(dimension + 1)
            .product();
        self.tasks.push(Task::Rows {
            array: array.clone(),
            dimension,
            next: next + 1,
            offset: offset + step,
            depth,
        });
        self.tasks.push(Task::Rows {
            array,
            dimension: dimension + 1,
            next: 0,
            offset,
            depth: depth + 1,
        });
    }

    fn instance(&mut self, value: &Value, instance: &Rc<Instance>, depth: usize) {
        if let Some(text) = self.text_by_program(value, instance, depth) {
            self.document.append(&text);
            return;
        }
        match instance.class().kind {
            ClassKind::Structure => {
                if self.is_too_deep(depth) {
                    return;
                }
                self.document.open("#S(", ")");
                let settings = self.settings.clone().with_escape(true);
                let name = symbol::symbol(self.image, instance.class().name, &settings);
                self.document.text(&name);
                self.tasks.push(Task::Close(")"));
                self.tasks.push(Task::Slots {
                    instance: instance.clone(),
                    next: 0,
                    depth,
                });
            }
            ClassKind::Condition if !self.settings.escape => {
                let text = report::report(self.image, value);
                self.document.text(&text);
            }
            _ => self.atom(value),
        }
    }

    /// The text that the program's own printing function makes of an instance, if it has one.
    fn text_by_program(
        &mut self,
        value: &Value,
        instance: &Instance,
        depth: usize,
    ) -> Option<Document> {
        let skips_method = std::mem::take(&mut self.skips_method);
        if !skips_method && dispatch::has_print_method(self.image, instance) {
            return self.text_of_call(known::PRINT_OBJECT.into(), vec![value.clone()], depth);
        }
        if self.settings.escape {
            return None;
        }
        let report = report::function(instance)?;
        self.text_of_call(Value::Function(report), vec![value.clone()], depth)
    }

    /// What a function writes that gets arguments and then a stream.
    fn text_of_call(
        &mut self,
        function: Value,
        before: Vec<Value>,
        depth: usize,
    ) -> Option<Document> {
        let bindings = self.settings.bindings(self.image, depth);
        self.calls.text(|| Call {
            function,
            before,
            after: Vec::new(),
            bindings,
            is_pretty: self.settings.pretty,
        })
    }

    fn slots(&mut self, instance: Rc<Instance>, next: usize, depth: usize) {
        let class = instance.class();
        let Some(name) = class.slots.borrow().get(next).map(|slot| slot.name) else {
            return;
        };
        self.document.text(" ");
        self.document.newline(Newline::Linear);
        if self.is_cut(next) {
            self.document.text("...");
            return;
        }
        let name = symbol::name(self.image.name(name), self.settings);
        self.document.text(&format!(":{name} "));
        self.document.newline(Newline::Miser);
        let value = instance.slots.borrow().get(next).cloned();
        self.tasks.push(Task::Slots {
            instance,
            next: next + 1,
            depth,
        });
        let value = value.unwrap_or(Value::Unbound);
        self.tasks.push(Task::Value(value, Style::Auto, depth + 1));
    }
}
