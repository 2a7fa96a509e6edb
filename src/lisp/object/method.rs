//! Methods as values, and adding them to generic functions.

use std::cell::RefCell;
use std::rc::{Rc, Weak};

use crate::image::Image;
use crate::image::locks::Meaning;
use crate::print::qualified;
use crate::value::Value;
use crate::value::class::Class;
use crate::value::copy::Copier;
use crate::value::dispatch::Dispatch;
use crate::value::foreign::{Foreign, ForeignBox, ForeignCopy, PrintContext};
use crate::value::function::{Body, Function};
use crate::value::generic::{Accessor, GenericFunction, Method, Specializer};
use crate::value::known;
use crate::value::parameters::Parameters;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym};

/// Functions of the standard that a program may add methods to. They are plain functions until it
/// does: then the plain function becomes the default method.
const EXTENSIBLE: &[Sym] = &[
    known::INITIALIZE_INSTANCE,
    known::SHARED_INITIALIZE,
    known::REINITIALIZE_INSTANCE,
    known::MAKE_INSTANCE,
    known::ALLOCATE_INSTANCE,
    known::PRINT_OBJECT,
    known::DESCRIBE_OBJECT,
    known::NO_APPLICABLE_METHOD,
    known::NO_NEXT_METHOD,
    known::SLOT_UNBOUND,
    known::SLOT_MISSING,
    known::CHANGE_CLASS,
    known::UPDATE_INSTANCE_FOR_REDEFINED_CLASS,
    known::UPDATE_INSTANCE_FOR_DIFFERENT_CLASS,
    known::MAKE_LOAD_FORM,
    known::CLASS_NAME,
    known::DOCUMENTATION,
    known::CLOSE,
    known::OPEN_STREAM_P,
    known::STREAM_ELEMENT_TYPE,
    known::INPUT_STREAM_P,
    known::OUTPUT_STREAM_P,
    known::INTERACTIVE_STREAM_P,
];

/// May a program add methods to the function of a symbol?
fn is_extensible(image: &Image, sym: Sym) -> bool {
    EXTENSIBLE.contains(&sym) || image.is_stream_function(sym)
}

/// A method as a value.
pub(crate) struct MethodObject(pub Rc<Method>);

impl Foreign for MethodObject {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Refused("a method that is a value")
    }

    fn type_symbol(&self) -> Sym {
        known::STANDARD_METHOD
    }

    fn print(&self, context: &dyn PrintContext, _escape: bool) -> String {
        let method = &self.0;
        let mut text = format!("#<STANDARD-METHOD {}", context.qualified(&method.name));
        for qualifier in &method.qualifiers {
            text.push(' ');
            text.push_str(&context.text(qualifier, true));
        }
        let specializers: Vec<String> = method
            .specializers
            .iter()
            .map(|s| match s {
                Specializer::Class(class) => context.text(&Value::symbol(class.name), true),
                Specializer::Eql(value) => format!("(EQL {})", context.text(value, true)),
            })
            .collect();
        format!("{text} ({})>", specializers.join(" "))
    }
}

/// The value that stands for a method: always the same one as long as it is referenced.
pub(crate) fn method_value(method: &Rc<Method>) -> Value {
    if let Some(object) = method.object.borrow().upgrade() {
        return Value::Foreign(object);
    }
    let object = Rc::new(ForeignBox::new(MethodObject(method.clone())));
    *method.object.borrow_mut() = Rc::downgrade(&object);
    Value::Foreign(object)
}

fn set_named_function(image: &mut Image, name: &Value, function: Rc<Function>) {
    match name {
        Value::Symbol(sym, ..) => image.set_function(*sym, function),
        other => {
            if let Some(sym) = other.setf_name() {
                image.symbols.get_mut(sym).setf_function = Some(function);
            }
        }
    }
}

/// The generic function with this name, made with these parameters if there is none.
pub(crate) fn ensure_generic(
    image: &mut Image,
    name: &Value,
    parameters: &Parameters,
) -> Result<Rc<Function>, Box<Raise>> {
    if name.as_symbol().is_none() && name.setf_name().is_none() {
        return Err(Raise::program(format!(
            "{} is not a function name.",
            super::text(image, name)
        )));
    }
    if let Some(sym) = name.as_symbol()
        && matches!(
            image.symbol(sym).function,
            FunctionCell::Macro(_) | FunctionCell::Builtin
        )
    {
        return Err(names_ordinary_function(image, name));
    }
    let function = match image.named_function(name) {
        Some(function) if function.as_generic().is_some() => return Ok(function),
        Some(function) => match (&function.body, name.as_symbol().or(name.setf_name())) {
            (Body::Native(native), Some(sym)) if is_extensible(image, sym) => {
                extended(image, name, native.min, native.max, function.clone())
            }
            // One of the library, which is written in Lisp, takes what the program says it does.
            (Body::Deferred(_) | Body::Closure { .. }, Some(sym)) if is_extensible(image, sym) => {
                let required = u16::try_from(parameters.required).unwrap_or(1);
                let all = required + u16::try_from(parameters.optional).unwrap_or(0);
                let max = (!parameters.has_rest && parameters.keys.is_none()).then_some(all);
                extended(image, name, required, max, function.clone())
            }
            _ => {
                return traced_generic(image, name)
                    .ok_or_else(|| names_ordinary_function(image, name));
            }
        },
        None => {
            if let Some(sym) = name.as_symbol() {
                image.check_lock(sym, Meaning::Function)?;
            }
            let mut parameters = parameters.clone();
            // The first method's own keywords do not restrict later methods.
            parameters.keys = parameters.keys.map(|_| Vec::new());
            new_generic(name, parameters)
        }
    };
    set_named_function(image, name, function.clone());
    Ok(function)
}

/// The generic function of a name, though its calls may be shown.
pub(crate) fn generic_named(image: &Image, name: &Value) -> Option<Rc<Function>> {
    let function = image.named_function(name);
    function
        .filter(|function| function.as_generic().is_some())
        .or_else(|| traced_generic(image, name))
}

/// The generic function whose calls are shown by the function that has its name: see `trace`.
fn traced_generic(image: &Image, name: &Value) -> Option<Rc<Function>> {
    let traced = image.special(known::SYS_TRACED).iter_list();
    let mut functions = traced.filter_map(|entry| {
        let entry = entry.list_to_vec()?;
        match entry.as_slice() {
            [of, .., Value::Function(function)] if of.is_eql(name) => Some(function.clone()),
            _ => None,
        }
    });
    functions.find(|function| function.as_generic().is_some())
}

/// A generic function, also from the function that shows its calls: see `trace`.
pub(crate) fn generic_of(image: &Image, value: &Value) -> Result<Rc<Function>, Box<Raise>> {
    if let Value::Function(function) = value {
        if function.as_generic().is_some() {
            return Ok(function.clone());
        }
        let traced = image.special(known::SYS_TRACED).iter_list();
        let mut names = traced.map(|entry| entry.car_or_nil());
        let is_shown_by = |name: &Value| {
            let named = image.named_function(name);
            named.is_some_and(|named| Rc::ptr_eq(&named, function))
        };
        let behind = names.find(is_shown_by);
        if let Some(behind) = behind.and_then(|name| traced_generic(image, &name)) {
            return Ok(behind);
        }
    }
    Err(Raise::type_error(
        value,
        Value::symbol(known::GENERIC_FUNCTION),
    ))
}

fn new_generic(name: &Value, parameters: Parameters) -> Rc<Function> {
    let generic = GenericFunction::new(name.clone(), parameters);
    Rc::new(Body::Generic(Box::new(generic)).into())
}

/// A generic function whose default method is a plain function.
fn extended(
    image: &Image,
    name: &Value,
    min: u16,
    max: Option<u16>,
    plain: Rc<Function>,
) -> Rc<Function> {
    let required = usize::from(min);
    let parameters = match max {
        Some(max) => Parameters {
            optional: usize::from(max) - required,
            ..Parameters::required(required)
        },
        None => Parameters::required_and_rest(required),
    };
    let anything = image.class(known::T).cloned().map(Specializer::Class);
    let method = Method {
        is_builtin: true,
        specializers: anything.into_iter().cycle().take(required).collect(),
        ..plain_method(name, parameters.clone(), plain)
    };
    let generic = GenericFunction::new(name.clone(), parameters);
    generic.methods.borrow_mut().push(Rc::new(method));
    Rc::new(Body::Generic(Box::new(generic)).into())
}

/// A method without specializers that calls a plain function.
fn plain_method(name: &Value, parameters: Parameters, function: Rc<Function>) -> Method {
    Method {
        name: name.clone(),
        qualifiers: Vec::new(),
        specializers: Vec::new(),
        parameters,
        function,
        takes_next: false,
        accessor: None,
        is_builtin: false,
        doc: RefCell::default(),
        object: RefCell::new(Weak::new()),
    }
}

fn names_ordinary_function(image: &Image, name: &Value) -> Box<Raise> {
    Raise::program(format!(
        "{} already names an ordinary function or a macro.",
        qualified(image, name)
    ))
}

/// What a method definition says.
pub(crate) struct MethodDefinition {
    /// The name of the generic function.
    pub name: Value,
    pub(crate) qualifiers: Vec<Value>,
    /// One per required parameter.
    pub specializers: Vec<Specializer>,
    pub parameters: Parameters,
    /// The method function.
    pub function: Rc<Function>,
    /// Does the function take the next method?
    pub(crate) takes_next: bool,
    /// Set for slot accessors.
    pub accessor: Option<Accessor>,
    /// Documentation.
    pub doc: Option<Rc<str>>,
}

/// Adds a method to the generic function of its name, which is made if there is none.
pub(crate) fn define_method(
    image: &mut Image,
    definition: MethodDefinition,
) -> Result<Rc<Method>, Box<Raise>> {
    let function = ensure_generic(image, &definition.name, &definition.parameters)?;
    let method = Rc::new(Method {
        qualifiers: definition.qualifiers,
        specializers: definition.specializers,
        takes_next: definition.takes_next,
        accessor: definition.accessor,
        doc: RefCell::new(definition.doc),
        ..plain_method(&definition.name, definition.parameters, definition.function)
    });
    add_method(image, &function, method.clone())?;
    Ok(method)
}

/// Adds a method; one with the same qualifiers and specializers is replaced.
pub(crate) fn add_method(
    image: &Image,
    function: &Rc<Function>,
    method: Rc<Method>,
) -> Result<(), Box<Raise>> {
    let Some(generic) = function.as_generic() else {
        return Err(Raise::type_error(
            &Value::Function(function.clone()),
            Value::symbol(known::GENERIC_FUNCTION),
        ));
    };
    check_congruent(image, function, generic, &method)?;
    {
        let mut methods = generic.methods.borrow_mut();
        methods.retain(|m| !is_same(m, &method));
        methods.push(method);
    }
    changed(generic);
    Ok(())
}

pub(crate) fn remove_method(generic: &GenericFunction, method: &Rc<Method>) {
    generic
        .methods
        .borrow_mut()
        .retain(|m| !Rc::ptr_eq(m, method));
    changed(generic);
}

/// Clears the dispatch cache.
pub fn changed(generic: &GenericFunction) {
    let dispatch = Dispatch::for_methods(&generic.methods.borrow());
    *generic.dispatch.borrow_mut() = dispatch;
}

/// Whether these are the qualifiers of a method.
pub(crate) fn has_qualifiers(method: &Method, qualifiers: &[Value]) -> bool {
    let own = &method.qualifiers;
    own.len() == qualifiers.len() && own.iter().zip(qualifiers).all(|(a, b)| a.is_eql(b))
}

fn is_same(a: &Method, b: &Method) -> bool {
    has_qualifiers(a, &b.qualifiers)
        && a.specializers.len() == b.specializers.len()
        && a.specializers
            .iter()
            .zip(&b.specializers)
            .all(|(a, b)| a.is_same(b))
}

/// Checks that a method and its generic function agree about their arguments.
fn check_congruent(
    image: &Image,
    function: &Rc<Function>,
    generic: &GenericFunction,
    method: &Rc<Method>,
) -> Result<(), Box<Raise>> {
    let wanted = generic.parameters.borrow();
    let given = &method.parameters;
    let more_or_fewer = |a: usize, b: usize| if a > b { "more" } else { "fewer" };
    let problem = if given.required != wanted.required {
        let word = more_or_fewer(given.required, wanted.required);
        format!("the method has {word} required arguments than the generic function.")
    } else if given.optional != wanted.optional {
        let word = more_or_fewer(given.optional, wanted.optional);
        format!("the method has {word} optional arguments than the generic function.")
    } else if given.has_more() != wanted.has_more() {
        "the method and generic function differ in whether they accept\n&REST or &KEY arguments."
            .to_owned()
    } else {
        return accepts_keys(image, generic, method, &wanted);
    };
    Err(Raise::program(format!(
        "attempt to add the method\n  {}\nto the generic function\n  {};\nbut {problem}",
        super::text(image, &method_value(method)),
        super::text(image, &Value::Function(function.clone())),
    )))
}

/// Does the method accept every keyword that its generic function lists?
fn accepts_keys(
    image: &Image,
    generic: &GenericFunction,
    method: &Method,
    wanted: &Parameters,
) -> Result<(), Box<Raise>> {
    let (Some(listed), Some(accepted)) = (&wanted.keys, &method.parameters.keys) else {
        return Ok(());
    };
    let missing = listed.iter().find(|k| !accepted.contains(k));
    match missing {
        Some(key) if generic.is_declared.get() && !method.parameters.allows_other_keys => {
            Err(Raise::program(format!(
                "the method does not accept the keyword argument {} of the generic function {}.",
                super::text(image, &Value::symbol(*key)),
                qualified(image, &generic.name)
            )))
        }
        _ => Ok(()),
    }
}

/// The generic version of a standard function, if a program has added methods to it.
pub(crate) fn extended_function(image: &Image, name: Sym) -> Option<Value> {
    let function = image.function(name)?;
    function.as_generic()?;
    Some(Value::Function(function.clone()))
}

/// A specializer from its value: a class, the name of one, or `(eql value)`.
pub fn specializer(image: &Image, value: &Value) -> Result<Specializer, Box<Raise>> {
    match value {
        Value::Class(class) => Ok(Specializer::Class(class.clone())),
        Value::Symbol(name, ..) => class_named(image, *name).map(Specializer::Class),
        other => match other.list_to_vec().as_deref() {
            Some([Value::Symbol(known::EQL, ..), object]) => Ok(Specializer::Eql(object.clone())),
            _ => Err(Raise::program(format!(
                "{} is not a legal specializer: it must be a class name or (EQL object).",
                super::text(image, other)
            ))),
        },
    }
}

fn class_named(image: &Image, name: Sym) -> Result<Rc<Class>, Box<Raise>> {
    image
        .class(name)
        .cloned()
        .ok_or_else(|| super::define::no_class(image, name))
}
