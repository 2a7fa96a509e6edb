//! From a value to a document: an explicit stack of what is still to be printed.

mod array;
mod instance;
mod list;

use std::rc::Rc;

use super::atom;
use super::calls::{Call, Calls};
use super::circle::{Label, Labels};
use super::dispatch;
use super::layout::lay_out;
use super::settings::Settings;
use super::shape::Style;
use crate::guard::Pace;
use crate::image::Image;
use crate::value::Value;
use crate::value::array::Array;
use crate::value::class::Instance;
use crate::value::document::Document;
use crate::value::known;
use crate::value::symbol::Sym;
use list::Rest;

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
        self.labels = Labels::of(self.image, value, self.settings);
        if let Some(shared) = &self.settings.shared {
            self.labels = shared.with(std::mem::take(&mut self.labels));
        }
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
        if let Some(shared) = &self.settings.shared {
            shared.note(&self.labels, self.calls.are_made());
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
                bindings: bindings(self.image, self.settings, &self.labels, depth),
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

    /// What a function writes that gets arguments and then a stream.
    fn text_of_call(
        &mut self,
        function: Value,
        before: Vec<Value>,
        depth: usize,
    ) -> Option<Document> {
        let bindings = bindings(self.image, self.settings, &self.labels, depth);
        self.calls.text(|| Call {
            function,
            before,
            after: Vec::new(),
            bindings,
            is_pretty: self.settings.pretty,
        })
    }
}

/// The printer variables for a function that prints a part. Its logical blocks have labels only if there
/// are none around it, which would have the same numbers.
fn bindings(
    image: &Image,
    settings: &Settings,
    labels: &Labels,
    depth: usize,
) -> Vec<(Sym, Value)> {
    let mut bindings = settings.bindings(image, depth);
    if !labels.is_empty() {
        bindings.push((known::V_PRINT_LABELS, Value::T));
    } else if settings.shared.is_some() {
        bindings.push((known::V_PRINT_LABELS, Value::NIL));
    }
    bindings
}
