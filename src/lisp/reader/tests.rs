//! Forms read from texts, compared by their structure.

use super::*;
use crate::image::Image;
use crate::print::test_image;
use crate::value::Value;
use crate::value::known;

fn read(image: &mut Image, text: &str) -> Result<Vec<Value>, ReadError> {
    let source = image.sources.add("test", text);
    Ok(read_all(image, source)?
        .into_iter()
        .map(|(form, _)| form)
        .collect())
}

fn problem(text: &str) -> String {
    let mut image = test_image::image();
    match read(&mut image, text) {
        Ok(_) => "no error".to_owned(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_list_knows_its_place() {
    let mut image = test_image::image();
    let forms = read(&mut image, "\n (car\n   '(1 2))").unwrap();
    let place = forms[0].as_cons().unwrap().place();
    let location = image.sources.locate(place).unwrap();
    assert_eq!((location.line, location.column), (2, 2));
    let quoted = forms[0].cdr_or_nil().car_or_nil();
    let location = image
        .sources
        .locate(quoted.as_cons().unwrap().place())
        .unwrap();
    assert_eq!((location.line, location.column, location.width), (3, 4, 6));
}

#[test]
fn deep_nesting_needs_no_stack() {
    let mut image = test_image::image();
    let depth = 200_000;
    let text = format!("{}{}", "(".repeat(depth), ")".repeat(depth));
    let forms = read(&mut image, &text).unwrap();
    assert_eq!(forms.len(), 1);
    let quotes = format!("{}a", "'".repeat(depth));
    assert_eq!(read(&mut image, &quotes).unwrap().len(), 1);
}

#[test]
fn features_choose_forms() {
    let mut image = test_image::image();
    let feature = image.keyword("SIM");
    image.set_special(known::V_FEATURES, Value::list([feature.into()]));
    let forms = read(
        &mut image,
        "(#+sim 1 #-sim 2 #+(and sim (not x)) 3 #+x (nowhere:y . .) #+x #+x 5 6 7)",
    )
    .unwrap();
    let numbers: Vec<i64> = forms[0]
        .iter_list()
        .filter_map(|v| match v {
            Value::Int(n) => Some(n),
            _ => None,
        })
        .collect();
    assert_eq!(numbers, vec![1, 3, 7]);
}

#[test]
fn read_time_evaluation_is_the_callers_business() {
    let mut image = test_image::image();
    let source = image.sources.add("test", "(a #.(f) b)");
    let mut reader = Reader::new(&image, source);
    let Ok(Outcome::Evaluate(form)) = reader.next(&mut image) else {
        panic!("the form after #. is expected");
    };
    assert!(form.as_cons().is_some());
    let Ok(Outcome::Form(form, _)) = reader.supply(&mut image, Value::Int(7)) else {
        panic!("the whole form is expected");
    };
    let items = form.list_to_vec().unwrap();
    assert!(items[1].is_eql(&Value::Int(7)));
    assert_eq!(items.len(), 3);
    assert!(matches!(reader.next(&mut image), Ok(Outcome::End)));
}

#[test]
fn labels_make_circles() {
    let mut image = test_image::image();
    let forms = read(&mut image, "#1=(a . #1#) (#2=(b) #2#)").unwrap();
    assert!(forms[0].cdr_or_nil().is_eq(&forms[0]));
    // The circle is cut so that it can be freed.
    forms[0].as_cons().unwrap().set_cdr(Value::NIL);
    let items = forms[1].list_to_vec().unwrap();
    assert!(items[0].is_eq(&items[1]));
}

#[test]
fn errors_say_what_is_wrong() {
    assert_eq!(problem("(foo:bar)"), "Package FOO does not exist.");
    assert_eq!(
        problem("cl:zork"),
        "Symbol \"ZORK\" not found in the COMMON-LISP package."
    );
    assert_eq!(
        problem("cl:lits"),
        "Symbol \"LITS\" not found in the COMMON-LISP package. Did you mean COMMON-LISP:LIST?"
    );
    assert_eq!(
        problem("cl-user::x cl-user:x"),
        "The symbol \"X\" is not external in the COMMON-LISP-USER package."
    );
    assert_eq!(problem("a)"), "unmatched close parenthesis");
    assert_eq!(
        problem("\n(a (b"),
        "end of file in a list that starts on line 2"
    );
    assert_eq!(
        problem("(a \"b"),
        "end of file in a string that starts on line 1"
    );
    assert_eq!(problem("."), "dot context error");
    assert_eq!(problem("(a .. b)"), "too many dots");
    assert_eq!(problem("(a . )"), "Nothing appears after . in list.");
    assert_eq!(problem("( . a)"), "Nothing appears before . in list.");
    assert_eq!(
        problem("(a . b c)"),
        "More than one object follows . in list."
    );
    assert_eq!(problem(",x"), "Comma not inside a backquote.");
    assert_eq!(problem("`(a ,b) `,c `(a `(b ,,c))"), "no error");
    assert_eq!(problem("#\\NoSuch"), "unrecognized character name: NoSuch");
    assert_eq!(
        problem("(print “hi”)"),
        "“ is a typographic quotation mark; Lisp text uses \" around strings"
    );
}

#[test]
fn a_reader_goes_on_after_an_error() {
    let mut image = test_image::image();
    let source = image.sources.add("test", "foo:bar 2");
    let mut reader = Reader::new(&image, source);
    assert!(reader.next_form(&mut image).is_err());
    let (form, _) = reader.next_form(&mut image).unwrap().unwrap();
    assert!(form.is_eql(&Value::Int(2)));
}
