//! What a `defstruct` form says: its options and slots.

use std::rc::Rc;

use crate::image::Image;
use crate::object::text;
use crate::value::Value;
use crate::value::class::StructureSlot;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// One constructor.
pub(crate) struct Constructor {
    pub name: Sym,
    /// Its lambda list; keywords for all slots if none.
    pub lambda_list: Option<Value>,
}

/// How the slots of a structure are stored.
#[derive(Clone)]
pub(crate) enum Representation {
    /// In an instance of a class of their own.
    Instance,
    /// In a list.
    List,
    /// In a vector for elements of a type.
    Vector(Value),
}

pub struct StructureDefinition {
    pub name: Sym,
    /// The prefix of the accessors.
    pub(crate) conc_name: String,
    /// Is there a prefix, if only an empty one?
    has_prefix: bool,
    pub(crate) constructors: Vec<Constructor>,
    /// The function that copies a structure.
    pub copier: Option<Sym>,
    /// The function that recognises one.
    pub predicate: Option<Sym>,
    /// The structure included, and new defaults of its slots.
    pub include: Option<(Sym, Vec<StructureSlot>)>,
    /// A function of structure and stream that prints.
    pub(crate) print_object: Option<Value>,
    /// A function of structure, stream and depth that prints.
    pub(crate) print_function: Option<Value>,
    /// How the slots are stored.
    pub(crate) representation: Representation,
    /// Does a list or vector begin with the structure's name?
    pub is_named: bool,
    /// Unused elements of a list or vector before the name.
    pub(crate) initial_offset: usize,
    /// The slots, without included ones.
    pub slots: Vec<StructureSlot>,
    /// The documentation.
    pub doc: Option<Rc<str>>,
}

/// Which options have been given.
#[derive(Default)]
struct Given {
    conc_name: Option<String>,
    constructors: Vec<Constructor>,
    has_constructors: bool,
    copier: Option<Option<Sym>>,
    predicate: Option<Option<Sym>>,
}

impl StructureDefinition {
    /// Reads `(defstruct name-and-options [documentation] slots…)`.
    pub fn read(image: &mut Image, whole: &Value) -> Result<StructureDefinition, Box<Raise>> {
        let parts = whole.list_to_vec().unwrap_or_default();
        let [_, head, rest @ ..] = parts.as_slice() else {
            return Err(Raise::program("DEFSTRUCT takes a name and slots."));
        };
        let (name, options) = match head {
            Value::Cons(cons) => (cons.car(), cons.cdr().iter_list().collect()),
            other => (other.clone(), Vec::new()),
        };
        let Some(name) = name.as_symbol().filter(|n| *n != known::NIL) else {
            return Err(Raise::program(format!(
                "{} is not a name of a structure.",
                text(image, &name)
            )));
        };
        let mut definition = StructureDefinition {
            name,
            conc_name: String::new(),
            has_prefix: true,
            constructors: Vec::new(),
            copier: None,
            predicate: None,
            include: None,
            print_object: None,
            print_function: None,
            representation: Representation::Instance,
            is_named: false,
            initial_offset: 0,
            slots: Vec::new(),
            doc: None,
        };
        let mut given = Given::default();
        for option in &options {
            definition.read_option(image, option, &mut given)?;
        }
        definition.complete(image, given);
        let slots = match rest {
            [Value::Str(doc), slots @ ..] => {
                definition.doc = Some(doc.text().into());
                slots
            }
            slots => slots,
        };
        for slot in slots {
            let slot = read_slot(image, slot)?;
            let is_duplicate = definition
                .slots
                .iter()
                .any(|s| image.name(s.name) == image.name(slot.name));
            if is_duplicate {
                return Err(Raise::program(format!(
                    "The structure {} has two slots named {}.",
                    image.name(name),
                    image.name(slot.name)
                )));
            }
            definition.slots.push(slot);
        }
        Ok(definition)
    }

    fn read_option(
        &mut self,
        image: &mut Image,
        option: &Value,
        given: &mut Given,
    ) -> Result<(), Box<Raise>> {
        let (keyword, args) = match option {
            Value::Cons(cons) => (cons.car(), cons.cdr().iter_list().collect::<Vec<_>>()),
            other => (other.clone(), Vec::new()),
        };
        let first = args.first().cloned();
        let symbol = |value: &Option<Value>| {
            value
                .as_ref()
                .and_then(Value::as_symbol)
                .filter(|s| *s != known::NIL)
        };
        match keyword.as_symbol() {
            Some(known::K_CONC_NAME) => {
                self.has_prefix = first.as_ref().is_some_and(Value::is_true);
                given.conc_name = Some(match &first {
                    Some(Value::Symbol(known::NIL, ..)) | None => String::new(),
                    Some(Value::Symbol(sym, ..)) => image.name(*sym).to_owned(),
                    Some(Value::Char(c)) => c.to_string(),
                    Some(other) => other.as_text().unwrap_or_default(),
                });
            }
            Some(known::K_CONSTRUCTOR) => {
                given.has_constructors = true;
                let lambda_list = args.get(1).cloned();
                let name = match &first {
                    // Without a name, the one that there is without the option, too.
                    None => Some(self.usual_constructor(image)),
                    Some(_) => symbol(&first),
                };
                if let Some(name) = name {
                    given.constructors.push(Constructor { name, lambda_list });
                }
            }
            Some(known::K_COPIER) if first.is_some() => given.copier = Some(symbol(&first)),
            Some(known::K_PREDICATE) if first.is_some() => given.predicate = Some(symbol(&first)),
            Some(known::K_COPIER | known::K_PREDICATE) => {}
            Some(known::K_INCLUDE) => {
                let Some(parent) = symbol(&first) else {
                    return Err(bad_option(image, option));
                };
                let mut overrides = Vec::new();
                for slot in args.iter().skip(1) {
                    overrides.push(read_slot(image, slot)?);
                }
                self.include = Some((parent, overrides));
            }
            Some(known::K_PRINT_FUNCTION) => self.print_function = first,
            Some(known::K_PRINT_OBJECT) => self.print_object = first,
            Some(known::K_TYPE) => {
                let kind = match &first {
                    Some(Value::Cons(cons)) => cons.car().as_symbol(),
                    other => other.as_ref().and_then(Value::as_symbol),
                };
                self.representation = match kind {
                    Some(known::LIST) => Representation::List,
                    Some(known::VECTOR) => Representation::Vector(match &first {
                        Some(Value::Cons(cons)) => cons.cdr().car_or_nil(),
                        _ => Value::T,
                    }),
                    _ => return Err(bad_option(image, option)),
                };
            }
            Some(known::K_NAMED) => self.is_named = true,
            Some(known::K_INITIAL_OFFSET) => match first {
                Some(Value::Int(n)) if (0..=1000).contains(&n) => {
                    self.initial_offset = usize::try_from(n).unwrap_or_default();
                }
                _ => return Err(bad_option(image, option)),
            },
            _ => return Err(bad_option(image, option)),
        }
        Ok(())
    }

    /// Fills in what the options leave to defaults.
    fn complete(&mut self, image: &mut Image, given: Given) {
        let name = image.name(self.name).to_owned();
        let package = image.current_package();
        self.conc_name = given.conc_name.unwrap_or_else(|| format!("{name}-"));
        self.constructors = given.constructors;
        if !given.has_constructors {
            self.constructors.push(Constructor {
                name: self.usual_constructor(image),
                lambda_list: None,
            });
        }
        self.copier = match given.copier {
            Some(copier) => copier,
            None => Some(image.intern(package, &format!("COPY-{name}"))),
        };
        let is_instance = matches!(self.representation, Representation::Instance);
        let is_recognisable = is_instance || self.is_named;
        self.predicate = match given.predicate {
            Some(predicate) => predicate,
            None if is_recognisable => Some(image.intern(package, &format!("{name}-P"))),
            None => None,
        };
    }

    fn usual_constructor(&self, image: &mut Image) -> Sym {
        let name = format!("MAKE-{}", image.name(self.name));
        let package = image.current_package();
        image.intern(package, &name)
    }

    /// The name of the accessor of a slot: that of the slot itself if there is no prefix.
    pub fn accessor(&self, image: &mut Image, slot: Sym) -> Sym {
        if !self.has_prefix {
            return slot;
        }
        let name = format!("{}{}", self.conc_name, image.name(slot));
        let package = image.current_package();
        image.intern(package, &name)
    }
}

/// Reads a slot: `name` or `(name default :type type :read-only flag)`.
fn read_slot(image: &Image, slot: &Value) -> Result<StructureSlot, Box<Raise>> {
    let parts = match slot {
        Value::Symbol(..) => vec![slot.clone()],
        other => other.list_to_vec().unwrap_or_default(),
    };
    let malformed = || {
        Raise::program(format!(
            "{} is not a slot of a structure: it must be a name or (name default :type type :read-only flag).",
            text(image, slot)
        ))
    };
    let Some(name) = parts.first().and_then(Value::as_symbol) else {
        return Err(malformed());
    };
    let options = parts.get(2..).unwrap_or_default();
    if !options.len().is_multiple_of(2) {
        return Err(malformed());
    }
    let mut result = StructureSlot {
        name,
        initform: parts.get(1).cloned().unwrap_or(Value::NIL),
        slot_type: Value::T,
        read_only: false,
    };
    for pair in options.chunks_exact(2) {
        match pair[0].as_symbol() {
            Some(known::K_TYPE) => result.slot_type = pair[1].clone(),
            Some(known::K_READ_ONLY) => result.read_only = pair[1].is_true(),
            _ => return Err(malformed()),
        }
    }
    Ok(result)
}

fn bad_option(image: &Image, option: &Value) -> Box<Raise> {
    Raise::program(format!(
        "{} is not an option of DEFSTRUCT.",
        text(image, option)
    ))
}
