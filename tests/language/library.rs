//! The part of the language that is written in Lisp: every definition is compiled and shown.

use lisp::Image;
use lisp::builtin::arity;
use lisp::library::definition::Kind;
use lisp::library::definition_of;
use lisp::print;
use lisp::value::Value;
use lisp::value::function::{Body, Function};
use lisp::value::symbol::FunctionCell;
use session::{Session, SessionOptions};
use std::collections::BTreeMap;
use std::rc::Rc;

/// All functions and macros of the library in an image.
fn library_functions(image: &Image) -> Vec<Rc<Function>> {
    let symbols = image.symbols.iter();
    symbols
        .flat_map(|(_, data)| {
            let function = match &data.function {
                FunctionCell::Function(f) | FunctionCell::Macro(f) => Some(f.clone()),
                FunctionCell::Unbound | FunctionCell::Builtin => None,
            };
            [function, data.setf_function.clone()]
        })
        .flatten()
        .filter(|function| function.as_deferred().is_some())
        .collect()
}

fn session() -> Session {
    Session::new(&SessionOptions::default()).expect("the models are there")
}

#[test]
fn every_definition_can_be_compiled() {
    let mut session = session();
    let image = session.image_mut();
    let functions = library_functions(image);
    assert!(!functions.is_empty());
    for function in functions {
        let location = definition_of(image, &function).map(|d| d.location());
        let deferred = function.as_deferred().expect("only such were taken");
        let forced = image.force(deferred);
        let forced = forced.unwrap_or_else(|raise| {
            let condition = lisp::condition::make(image, &raise).unwrap_or(Value::NIL);
            let report = print::to_string(image, &condition, false);
            panic!("{location:?} fails: {report}")
        });
        assert!(matches!(forced.body, Body::Closure { .. }), "{location:?}");
    }
}

#[test]
fn no_form_of_the_library_fails() {
    let mut session = session();
    assert_eq!(session.image_mut().output.take(), "");
}

/// Helpers of all files belong to one package.
#[test]
fn no_two_helpers_have_one_name() {
    let session = session();
    let helpers = session.image().library.definitions.iter();
    let mut seen = BTreeMap::new();
    for helper in helpers.filter(|definition| definition.is_helper()) {
        let name = (&helper.name, helper.kind == Kind::Setter);
        let other = seen.insert(name, helper.location());
        assert_eq!(other, None, "{}: {}", helper.location(), helper.name);
    }
}

#[test]
fn every_definition_says_what_it_does() {
    let mut session = session();
    let image = session.image_mut();
    for function in library_functions(image) {
        let definition = definition_of(image, &function).expect("it is in the library");
        let signature = definition.signature();
        assert!(!signature.doc.is_empty(), "{}", definition.location());
        let deferred = function.as_deferred().expect("only such were taken");
        let Ok(forced) = image.force(deferred) else {
            continue;
        };
        let Body::Closure { code, .. } = &forced.body else {
            continue;
        };
        if definition.kind == Kind::Function {
            let content = code
                .content()
                .expect("the library is read when it is needed");
            assert!(content.doc.is_some(), "{}", definition.location());
            let (min, max) = arity(&signature.lambda_list);
            let parameters = &code.parameters;
            assert_eq!(min, parameters.required, "{}", definition.location());
            let takes_more = parameters.rest || parameters.has_keys;
            assert_eq!(max.is_none(), takes_more, "{}", definition.location());
        }
    }
}

/// Compiling a definition leaves no trace: no symbol in a package that people look into, no
/// number taken from the counter of `gensym`.
#[test]
fn compiling_a_definition_leaves_no_trace() {
    let mut session = session();
    let image = session.image_mut();
    let counts = |image: &Image| -> Vec<(String, usize)> {
        let packages = image.packages.ids().map(|id| image.packages.get(id));
        packages
            .map(|package| (package.name.to_string(), package.symbols.len()))
            .filter(|(name, _)| name != "SYSTEM" && name != "KEYWORD")
            .collect()
    };
    let counter = lisp::value::known::V_GENSYM_COUNTER;
    let before = (
        counts(image),
        print::to_string(image, image.special(counter), true),
    );
    for function in library_functions(image) {
        let deferred = function.as_deferred().expect("only such were taken");
        assert!(image.force(deferred).is_ok());
    }
    let after = (
        counts(image),
        print::to_string(image, image.special(counter), true),
    );
    assert_eq!(before, after);
}
