//! Code that is compiled ahead: what starts from it is like what is made of the texts.

use crate::command::open_default;
use lisp::Image;
use lisp::print;
use lisp::source::Place;
use lisp::value::code::Code;
use lisp::value::function::{Body, Function};
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::symbol::{FunctionCell, Sym};
use session::{Session, SessionOptions};
use std::fmt::Write;

fn of_texts() -> Session {
    Session::of_texts(&SessionOptions::default()).expect("the plans can be loaded")
}

#[test]
fn what_is_compiled_ahead_is_always_the_same() {
    let code = of_texts().precompile().expect("all can be compiled");
    assert!(code == crate::precompiled::CODE, "{} bytes", code.len());
}

#[test]
fn all_forms_of_the_library_and_the_plans_are_compiled_ahead() {
    let session = open_default().expect("a session");
    let library = &session.image().library;
    let precompiled = library.precompiled.expect("it is provided");
    for (name, _) in plan_files::LIBRARY {
        let forms = precompiled.file(&format!("plans/lib/{name}"));
        let forms = forms.expect("it has been compiled");
        assert!(!forms.is_empty(), "{name}");
        for form in forms {
            assert!(form.is_compiled(), "plans/lib/{name}, byte {}", form.start);
        }
    }
    assert!(library.definitions.len() > 700);
    for definition in &library.definitions {
        let form = precompiled.form(definition.file.name, definition.start);
        let is_compiled = form.is_some_and(|form| form.is_compiled());
        assert!(is_compiled, "{}", definition.location());
    }
}

#[test]
fn a_session_from_code_knows_what_one_from_texts_knows() {
    let mut of_texts = of_texts();
    let mut of_code = open_default().expect("a session");
    assert!(of_code.image().library.precompiled.is_some());
    let (texts, code) = (known_names(&mut of_texts), known_names(&mut of_code));
    assert!(texts.len() > 4000, "{}", texts.len());
    for (of_texts, of_code) in texts.iter().zip(&code) {
        assert_eq!(of_texts, of_code);
    }
    assert_eq!(texts.len(), code.len());
}

#[test]
fn functions_are_read_when_they_are_needed_whichever_copy_needs_them_first() {
    let mut first = open_default().expect("a session");
    let mut second = first.copied().expect("nothing runs");
    let (unread, all) = unread(&first);
    assert!(unread > 1000 && 10 * unread > 9 * all, "{unread} of {all}");
    // What the first reads, the second has; then both know what a session knows that has no copy.
    let (of_first, of_second) = (known_names(&mut first), known_names(&mut second));
    assert_eq!(self::unread(&first).0, 0);
    assert_eq!(self::unread(&second).0, 0);
    let alone = known_names(&mut open_default().expect("a session"));
    assert!(of_first == of_second && of_first == alone);
    // What each reads for itself, since it could be changed, has the same places, however many copies there are.
    let (places, own) = places_of_contents(&first, &second);
    assert!(
        places > 5000 && own > 300,
        "{places} places, {own} contents"
    );
}

/// How many places the contents of functions have that are the same in two sessions, and how many contents both have
/// read for themselves.
fn places_of_contents(first: &Session, second: &Session) -> (usize, usize) {
    let (mut places, mut own) = (0, 0);
    for (one, two) in codes(first).zip(codes(second)) {
        let contents = one.content().zip(two.content());
        let (of_one, of_two) = contents.expect("all has been read");
        assert!(
            *of_one.places == *of_two.places,
            "{:?} {:?}",
            of_one.places,
            of_two.places
        );
        places += of_one.places.len();
        own += usize::from(!std::ptr::eq(one, two));
    }
    (places, own)
}

/// How many of the functions of the plans have not been read, and how many there are.
fn unread(session: &Session) -> (usize, usize) {
    let unread = codes(session).filter(|code| code.content().is_none());
    (unread.count(), codes(session).count())
}

/// The code of the functions and macros of the plans, in the order of packages and names.
fn codes(session: &Session) -> impl Iterator<Item = &Code> {
    let image = session.image();
    let at_home = image.packages.ids().flat_map(move |id| {
        let symbols = image.packages.get(id).symbols.values();
        let data = symbols.map(|(sym, _)| image.symbol(*sym));
        data.filter(move |data| data.package == Some(id))
    });
    at_home.filter_map(|data| match &data.function {
        FunctionCell::Function(function) | FunctionCell::Macro(function) => match &function.body {
            Body::Closure { code, .. } => Some(&**code),
            _ => None,
        },
        FunctionCell::Unbound | FunctionCell::Builtin => None,
    })
}

/// All symbols with what they mean; without the helpers of the language, and without keywords, which
/// reading the library leaves behind.
fn known_names(session: &mut Session) -> Vec<String> {
    let image = session.image_mut();
    let mut names = Vec::new();
    for id in image.packages.ids() {
        if let PackageTable::SYSTEM | PackageTable::KEYWORD = id {
            continue;
        }
        let package = image.packages.get(id);
        for (name, (sym, is_external)) in package.symbols.iter() {
            let (home, meaning) = (image.symbol(*sym).package, meaning(image, *sym));
            let package = &package.name;
            names.push(format!("{package}:{name} {is_external} {home:?} {meaning}"));
        }
    }
    let counter = image.special(known::V_GENSYM_COUNTER);
    names.push(print::to_string(image, counter, true));
    names
}

fn meaning(image: &Image, sym: Sym) -> String {
    let data = image.symbol(sym);
    let mut text = format!("{:?}", data.kind);
    for value in [&data.value, &data.plist] {
        if !value.is_unbound() {
            text += &format!(" {}", print::to_string(image, value, true));
        }
    }
    text += &format!(" {:?}", data.variable_doc);
    match &data.function {
        FunctionCell::Unbound => {}
        FunctionCell::Builtin => text += " builtin",
        FunctionCell::Function(function) => write_function(image, "function", function, &mut text),
        FunctionCell::Macro(function) => write_function(image, "macro", function, &mut text),
    }
    if let Some(function) = &data.setf_function {
        write_function(image, "setter", function, &mut text);
    }
    if let Some(class) = image.class(sym) {
        let slots = class.slots.borrow();
        let slots = slots.iter().map(|slot| image.name(slot.name));
        text += &format!(" class {:?} {:?}", slots.collect::<Vec<_>>(), class.doc);
    }
    text
}

fn write_function(image: &Image, what: &str, function: &Function, text: &mut String) {
    *text += &format!(" {what}");
    match &function.body {
        Body::Closure { code, captured } => {
            *text += &format!(" {}", captured.len());
            write_code(image, code, text);
        }
        Body::Generic(generic) => {
            for method in generic.methods.borrow().iter() {
                write_function(image, "method", &method.function, text);
            }
        }
        Body::Native(_) => *text += " native",
        Body::Deferred(_) => *text += " deferred",
    }
}

/// Everything that code consists of, with names instead of the numbers of symbols and places.
fn write_code(image: &Image, code: &Code, text: &mut String) {
    let shown = |value| print::to_string(image, value, true);
    let located = |place: Place| image.sources.locate(place).map(|l| l.to_string());
    let name = |sym: &Sym| image.name(*sym);
    let content = image.content_to_look_at(code).expect("it can be read");
    let (own, list) = (shown(code.name.shown()), shown(content.lambda_list.shown()));
    let _ = write!(text, "\n({own} {list} {:?} {}", content.doc, code.room);
    let parameters = &code.parameters;
    let keys: Vec<&str> = parameters.keys.iter().map(name).collect();
    let (required, optional) = (parameters.required, parameters.optional);
    let (rest, others) = (parameters.rest, parameters.allow_other_keys);
    let _ = write!(
        text,
        " {required} {optional} {rest} {others} {keys:?} {:?}",
        content.tags
    );
    for op in content.ops.iter() {
        let mut op = *op;
        let symbol = op.symbol_mut().map(|sym| std::mem::replace(sym, Sym(0)));
        let _ = write!(text, " {op:?}{:?}", symbol.as_ref().map(name));
    }
    for constant in &content.constants {
        let _ = write!(text, " {}", shown(constant));
    }
    for (first, place) in content.places.iter() {
        let _ = write!(text, " {first}@{:?}", located(*place));
    }
    for local in content.locals.iter() {
        let (slot, from, to) = (local.slot, local.from, local.to);
        let _ = write!(text, " {}={slot}:{from}-{to}", name(&local.name));
    }
    let free: Vec<&str> = content.free.iter().map(name).collect();
    let _ = write!(text, " {free:?}");
    for (inner, captures) in &content.inner {
        let _ = write!(text, " {captures:?}");
        write_code(image, inner, text);
    }
    text.push(')');
}
