//! Designators: symbolic descriptions of actions, motions, objects and locations.
//!
//! A designator has its own identity. Equating two designators links them into a chain, whose
//! newest member holds the best knowledge; each end keeps the other alive.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

use crate::packages;
use lisp::image::Image;
use lisp::typed::FromValue;
use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};
use lisp::value::cycles;
use lisp::value::foreign::{Foreign, ForeignCopy, PrintContext};
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// What a designator describes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Class {
    /// Something to do.
    Action,
    /// An atomic movement of the robot.
    Motion,
    /// A thing.
    Object,
    /// A place.
    Location,
    /// A person.
    Human,
}

impl Class {
    /// All classes.
    pub const ALL: [Class; 5] = [
        Class::Action,
        Class::Motion,
        Class::Object,
        Class::Location,
        Class::Human,
    ];

    /// The name, as in `(a MOTION …)`.
    pub fn name(self) -> &'static str {
        match self {
            Class::Action => "ACTION",
            Class::Motion => "MOTION",
            Class::Object => "OBJECT",
            Class::Location => "LOCATION",
            Class::Human => "HUMAN",
        }
    }

    /// The name of the Lisp class.
    pub fn class_name(self) -> &'static str {
        match self {
            Class::Action => "ACTION-DESIGNATOR",
            Class::Motion => "MOTION-DESIGNATOR",
            Class::Object => "OBJECT-DESIGNATOR",
            Class::Location => "LOCATION-DESIGNATOR",
            Class::Human => "HUMAN-DESIGNATOR",
        }
    }

    /// The class with that name, ignoring case; `-DESIGNATOR` may follow.
    pub fn named(name: &str) -> Option<Class> {
        let name = name.to_uppercase();
        Class::ALL
            .into_iter()
            .find(|c| c.name() == name || c.class_name() == name)
    }
}

/// Whether one thing is described, or all that match.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Quantifier {
    /// One.
    A,
    /// All.
    All,
}

impl Quantifier {
    /// The word in the printed form.
    pub fn name(self) -> &'static str {
        match self {
            Quantifier::A => "A",
            Quantifier::All => "ALL",
        }
    }
}

/// A designator.
pub struct Designator {
    /// What it describes.
    pub class: Class,
    /// One, or all.
    pub quantifier: Quantifier,
    /// The list of properties `((:key value…) …)`.
    pub description: RefCell<Value>,
    /// The designator that this one was equated to, if any.
    pub parent: RefCell<Option<Value>>,
    /// The designator that was equated to this one, if any.
    pub successor: RefCell<Option<Value>>,
    /// What it refers to, once resolved.
    pub data: RefCell<Option<Value>>,
    /// Whether `data` comes from perception or another effect rather than from the description.
    pub(crate) is_effective: Cell<bool>,
    /// Of a location, further solutions after `data`: a list, or `NIL`. Of an action or a motion, how many
    /// groundings have been used.
    pub solutions: RefCell<Option<Value>>,
    /// What a search for solutions remembers; the first designator of a chain has it.
    pub memory: RefCell<Option<Value>>,
    class_symbol: Sym,
}

impl Designator {
    /// A designator with a list of properties.
    pub fn new(
        image: &mut Image,
        class: Class,
        quantifier: Quantifier,
        description: Value,
    ) -> Designator {
        Designator {
            class,
            quantifier,
            description: RefCell::new(description),
            parent: RefCell::default(),
            successor: RefCell::default(),
            data: RefCell::default(),
            is_effective: Cell::new(false),
            solutions: RefCell::default(),
            memory: RefCell::default(),
            class_symbol: packages::symbol(image, "CRAM-DESIGNATORS", class.class_name()),
        }
    }

    /// The properties: key and values.
    pub fn properties(&self) -> Vec<(Value, Value)> {
        self.description
            .borrow()
            .iter_list()
            .map(|p| (p.car_or_nil(), p.cdr_or_nil()))
            .collect()
    }

    /// The first value of the property whose key has the name (upper case).
    pub fn property_named(&self, image: &Image, name: &str) -> Option<Value> {
        self.properties()
            .into_iter()
            .find(|(k, _)| k.as_symbol().is_some_and(|s| image.name(s) == name))
            .map(|(_, values)| values.car_or_nil())
    }

    /// The type's name in upper case: the value of `:type`, if it is a symbol.
    pub fn type_name(&self, image: &Image) -> Option<String> {
        let sym = self.property_named(image, "TYPE")?.as_symbol()?;
        Some(image.name(sym).to_owned())
    }

    /// Whether it describes all things that match.
    pub fn is_all(&self) -> bool {
        self.quantifier == Quantifier::All
    }
}

/// The designator, if the value is one.
pub fn as_designator(value: &Value) -> Option<&Designator> {
    value.as_foreign::<Designator>()
}

/// The designator of a class, if the value is one.
pub fn as_class(value: &Value, class: Class) -> Option<&Designator> {
    as_designator(value).filter(|d| d.class == class)
}

impl<'a> FromValue<'a> for &'a Designator {
    fn from_value(image: &mut Image, value: &'a Value) -> Result<Self, Box<Raise>> {
        designator(image, value)
    }
}

/// The designator, or a type error.
pub fn designator<'a>(image: &mut Image, value: &'a Value) -> Result<&'a Designator, Box<Raise>> {
    match as_designator(value) {
        Some(d) => Ok(d),
        None => {
            let expected = packages::symbol(image, "CRAM-DESIGNATORS", "DESIGNATOR");
            Err(Raise::type_error(value, expected))
        }
    }
}

/// The newest designator of a chain.
pub fn current(value: &Value) -> Value {
    follow(value, |d| &d.successor)
}

/// The oldest designator of a chain.
pub fn first(value: &Value) -> Value {
    follow(value, |d| &d.parent)
}

fn follow(value: &Value, link: fn(&Designator) -> &RefCell<Option<Value>>) -> Value {
    let mut at = value.clone();
    while let Some(next) = as_designator(&at).and_then(|d| link(d).borrow().clone()) {
        at = next;
    }
    at
}

/// Whether two designators belong to the same chain.
pub fn equal(a: &Value, b: &Value) -> bool {
    as_designator(a).is_some() && as_designator(b).is_some() && first(a).is_eq(&first(b))
}

/// Links two chains: that of `successor` follows that of `parent`. False if they are the same.
pub fn equate(parent: &Value, successor: &Value) -> bool {
    if equal(parent, successor) {
        return false;
    }
    let (newest, oldest) = (current(parent), first(successor));
    if let (Some(before), Some(after)) = (as_designator(&newest), as_designator(&oldest)) {
        *before.successor.borrow_mut() = Some(oldest.clone());
        *after.parent.borrow_mut() = Some(newest.clone());
        note_changed(&newest);
    }
    true
}

/// Notes that a designator has been changed to hold something, which may hold it.
pub fn note_changed(designator: &Value) {
    if let Value::Foreign(object) = designator {
        cycles::note_foreign(object);
    }
}

/// A new designator as a value, from keyword names and values.
pub fn make(image: &mut Image, class: Class, properties: &[(&str, Value)]) -> Value {
    let list: Vec<Value> = properties
        .iter()
        .map(|(key, value)| Value::list([image.keyword(key).into(), value.clone()]))
        .collect();
    let designator = Designator::new(image, class, Quantifier::A, Value::list(list));
    Value::foreign(designator)
}

impl Drop for Designator {
    /// Frees nested designators with a loop: the depth of nesting costs no Rust stack.
    fn drop(&mut self) {
        let mut pending = Vec::new();
        self.release(&mut pending);
        while let Some(value) = pending.pop() {
            match &value {
                Value::Cons(cons) if Rc::strong_count(cons) == 1 => {
                    pending.push(cons.car());
                    pending.push(cons.cdr());
                    cons.set_car(Value::NIL);
                    cons.set_cdr(Value::NIL);
                }
                Value::Foreign(object) if Rc::strong_count(object) == 1 => {
                    if let Some(inner) = as_designator(&value) {
                        inner.release(&mut pending);
                    }
                }
                _ => {}
            }
        }
    }
}

impl Designator {
    /// Moves all the designator's references to `pending`.
    fn release(&self, pending: &mut Vec<Value>) {
        pending.push(self.description.replace(Value::NIL));
        pending.extend(self.links().into_iter().filter_map(|link| link.take()));
    }

    /// What it refers to besides its description.
    fn links(&self) -> [&RefCell<Option<Value>>; 5] {
        [
            &self.parent,
            &self.successor,
            &self.data,
            &self.solutions,
            &self.memory,
        ]
    }
}

/// Counts the nested designators being printed.
struct Level;

thread_local! {
    static LEVELS: Cell<usize> = const { Cell::new(0) };
}

/// Maximum depth of nested designators that are printed with their properties, so that printing one
/// that contains itself ends.
const MAX_LEVELS: usize = 32;

impl Level {
    fn enter() -> Option<Level> {
        LEVELS.with(|levels| {
            let level = levels.get();
            (level < MAX_LEVELS).then(|| {
                levels.set(level + 1);
                Level
            })
        })
    }
}

impl Drop for Level {
    fn drop(&mut self) {
        LEVELS.with(|levels| levels.set(levels.get().saturating_sub(1)));
    }
}

impl Foreign for Designator {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::New(Box::new(Designator {
            class: self.class,
            quantifier: self.quantifier,
            description: RefCell::new(Value::NIL),
            parent: RefCell::default(),
            successor: RefCell::default(),
            data: RefCell::default(),
            is_effective: self.is_effective.clone(),
            solutions: RefCell::default(),
            memory: RefCell::default(),
            class_symbol: self.class_symbol,
        }))
    }

    fn fill_copy(&self, copy: &dyn Any, copier: &mut Copier) {
        let Some(copy) = copy.downcast_ref::<Designator>() else {
            return;
        };
        let description = copier.value(&self.description.borrow());
        copy.description.replace(description);
        for (link, copy) in self.links().into_iter().zip(copy.links()) {
            copy.replace(link.borrow().copied(copier));
        }
    }

    fn type_symbol(&self) -> Sym {
        self.class_symbol
    }

    fn print(&self, context: &dyn PrintContext, escape: bool) -> String {
        if !is_description_printed(context) {
            return "#<>".to_owned();
        }
        let Some(_level) = Level::enter() else {
            return format!("#<{} {} …>", self.quantifier.name(), self.class.name());
        };
        let mut text = format!("#<{} {}", self.quantifier.name(), self.class.name());
        for (key, values) in self.properties() {
            let key = bare(context, &key, escape);
            let lead = format!("    ({key} ");
            let value = indented_value(context, &values.car_or_nil(), escape, width(&lead));
            text.push_str(&format!("\n{lead}{value})"));
        }
        text.push('>');
        text
    }

    fn may_be_in_circle(&self) -> bool {
        true
    }

    fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        // What is being changed appears to hold nothing.
        if let Ok(description) = self.description.try_borrow() {
            visit(&description);
        }
        for link in self.links() {
            if let Ok(link) = link.try_borrow() {
                link.iter().for_each(&mut *visit);
            }
        }
    }

    fn let_go(&self) {
        self.release(&mut Vec::new());
    }

    fn describe(&self, context: &dyn PrintContext) -> String {
        let mut lines = Vec::new();
        if let Some(data) = &*self.data.borrow() {
            lines.push(format!("Refers to: {}", context.text(data, true)));
        }
        // The first designator of the chain has what the search remembers.
        let oldest = self.parent.borrow().as_ref().map(first);
        let oldest = oldest.as_ref().and_then(as_designator).unwrap_or(self);
        if let Some(Value::Foreign(memory)) = &*oldest.memory.borrow() {
            lines.push(memory.object().describe(context));
        }
        lines.join("\n")
    }
}

/// The text of a value that begins at a column: its further lines are indented so far. Pairs of keys
/// and values have a line each; transforms that a pose beside them says, too, are left out.
fn indented_value(
    context: &dyn PrintContext,
    value: &Value,
    escape: bool,
    column: usize,
) -> String {
    let Some(pairs) = pairs_of(context, value) else {
        return indented(&bare(context, value, escape), column);
    };
    let has = |name: &str| pairs.iter().any(|(key, _)| *key == name);
    let shown = pairs.iter().filter(|(key, _)| match key.as_str() {
        "TRANSFORM" => !has("POSE"),
        "TRANSFORM-IN-MAP" => !has("POSE-IN-MAP"),
        _ => true,
    });
    let lines: Vec<String> = shown
        .map(|(key, value)| {
            let lead = format!("(:{key} ");
            let text = context.text(value, true);
            format!("{lead}{})", indented(&text, width(&lead)))
        })
        .collect();
    format!("({})", indented(&lines.join("\n"), column + 1))
}

/// The keys and values of a list of lists `(keyword value)`.
fn pairs_of(context: &dyn PrintContext, value: &Value) -> Option<Vec<(String, Value)>> {
    let items = value.list_to_vec().filter(|items| !items.is_empty())?;
    let pair = |item: &Value| match item.list_to_vec()?.as_slice() {
        [Value::Symbol(key, ..), value] if context.is_keyword(*key) => {
            Some((context.name(*key).to_owned(), value.clone()))
        }
        _ => None,
    };
    items.iter().map(pair).collect()
}

/// A text whose lines after the first one are indented.
fn indented(text: &str, column: usize) -> String {
    text.replace('\n', &format!("\n{}", " ".repeat(column)))
}

fn width(text: &str) -> usize {
    text.chars().count()
}

/// Keywords without their colon, everything else as printed.
fn bare(context: &dyn PrintContext, value: &Value, escape: bool) -> String {
    match value {
        Value::Symbol(sym, ..) if context.is_keyword(*sym) => context.name(*sym).to_owned(),
        // Inside lists, keywords keep their colon.
        Value::Cons(_) => context.text(value, true),
        other => context.text(other, escape),
    }
}

fn is_description_printed(context: &dyn PrintContext) -> bool {
    let variable = context.find_symbol("CRAM-DESIGNATORS", "*DESIGNATOR-PPRINT-DESCRIPTION*");
    variable.is_none_or(|sym| !context.special(sym).is_nil())
}
