//! Backquote: templates to forms that build them.

use crate::guard::descend;
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// The form that `(quasiquote template)` expands into.
pub(crate) fn expand_quasiquote(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let template = form.cdr_or_nil().car_or_nil();
    template_form(image, &template, 1)
}

fn template_form(image: &mut Image, template: &Value, depth: usize) -> Result<Value, Box<Raise>> {
    descend()?;
    match template {
        Value::Cons(_) => list_form(image, template, depth),
        Value::Vector(v) => {
            let list = Value::list(v.to_vec());
            let form = template_form(image, &list, depth)?;
            Ok(call(known::APPLY, [quote_function(known::VECTOR), form]))
        }
        other => Ok(quote(other.clone())),
    }
}

/// A run of neighbouring items in a list template.
enum Part {
    /// Forms of single elements.
    Elements(Vec<Value>),
    /// A form of a list that is spliced in.
    Spliced(Value),
}

fn list_form(image: &mut Image, template: &Value, depth: usize) -> Result<Value, Box<Raise>> {
    let mut parts: Vec<Part> = Vec::new();
    let mut rest = template.clone();
    let mut tail = loop {
        if let Some(form) = unquoted(image, &rest, depth)? {
            break Some(form);
        }
        let Value::Cons(cons) = &rest else {
            break (!rest.is_nil()).then(|| quote(rest.clone()));
        };
        let item = cons.car();
        if let Some(form) = splice(image, &item, depth)? {
            parts.push(Part::Spliced(form));
        } else {
            let form = match unquoted(image, &item, depth)? {
                Some(form) => form,
                None => template_form(image, &item, depth)?,
            };
            match parts.last_mut() {
                Some(Part::Elements(elements)) => elements.push(form),
                _ => parts.push(Part::Elements(vec![form])),
            }
        }
        let next = cons.cdr();
        rest = next;
    };
    // The last part is not copied.
    while let Some(part) = parts.pop() {
        tail = Some(match (part, tail) {
            (Part::Elements(elements), None) => constant_or_list(elements),
            (Part::Elements(elements), Some(tail)) => in_front(elements, tail),
            (Part::Spliced(form), None) => form,
            (Part::Spliced(form), Some(tail)) => call(known::APPEND, [form, tail]),
        });
    }
    Ok(tail.unwrap_or(Value::NIL))
}

/// The form for a list of the elements followed by a tail.
fn in_front(mut elements: Vec<Value>, tail: Value) -> Value {
    let name = match elements.len() {
        1 => known::CONS,
        _ => known::LIST_STAR,
    };
    elements.push(tail);
    call(name, elements)
}

/// `(list …)` of the forms, or one constant if all are constants.
fn constant_or_list(forms: Vec<Value>) -> Value {
    let constants: Option<Vec<Value>> = forms.iter().map(quoted_constant).collect();
    match constants {
        Some(items) => quote(Value::list(items)),
        None => call(known::LIST, forms),
    }
}

fn quoted_constant(form: &Value) -> Option<Value> {
    let cons = form.as_cons()?;
    (cons.car().as_symbol() == Some(known::QUOTE)).then(|| cons.cdr().car_or_nil())
}

/// The form for `,form` at this depth; inside a nested backquote, the template that rebuilds the
/// comma.
fn unquoted(image: &mut Image, item: &Value, depth: usize) -> Result<Option<Value>, Box<Raise>> {
    let Some(cons) = item.as_cons() else {
        return Ok(None);
    };
    let head = cons.car().as_symbol();
    let inner = cons.cdr().car_or_nil();
    match head {
        Some(known::UNQUOTE) if depth == 1 => Ok(Some(inner)),
        Some(known::UNQUOTE_SPLICING) if depth == 1 => Err(Raise::new(
            known::SIMPLE_READER_ERROR,
            "`,@' is meaningful only inside a list.",
        )),
        Some(known::UNQUOTE) => rebuild(image, known::UNQUOTE, &inner, depth - 1).map(Some),
        Some(known::QUASIQUOTE) => rebuild(image, known::QUASIQUOTE, &inner, depth + 1).map(Some),
        _ => Ok(None),
    }
}

/// The form for a list to splice in, if the item is `,@form` or one inside a deeper comma.
fn splice(image: &mut Image, item: &Value, depth: usize) -> Result<Option<Value>, Box<Raise>> {
    let Some(cons) = item.as_cons() else {
        return Ok(None);
    };
    let inner = cons.cdr().car_or_nil();
    match cons.car().as_symbol() {
        Some(known::UNQUOTE_SPLICING) if depth == 1 => Ok(Some(inner)),
        Some(known::UNQUOTE_SPLICING) => {
            let form = rebuild(image, known::UNQUOTE_SPLICING, &inner, depth - 1)?;
            Ok(Some(call(known::LIST, [form])))
        }
        // `,,@x`: several commas from one.
        Some(known::UNQUOTE) if depth > 1 => match splice(image, &inner, depth - 1)? {
            Some(forms) => {
                let unquote = quote(known::UNQUOTE.into());
                let item = image.gensym("ITEM");
                let each = call(known::LIST, [unquote, item.clone()]);
                let function = call(known::LAMBDA, [Value::list([item]), each]);
                Ok(Some(call(known::MAPCAR, [function, forms])))
            }
            None => Ok(None),
        },
        _ => Ok(None),
    }
}

fn rebuild(
    image: &mut Image,
    head: crate::Sym,
    inner: &Value,
    depth: usize,
) -> Result<Value, Box<Raise>> {
    descend()?;
    let form = match unquoted(image, inner, depth)? {
        Some(form) => form,
        None => template_form(image, inner, depth)?,
    };
    Ok(constant_or_list(vec![quote(head.into()), form]))
}

fn quote(value: Value) -> Value {
    Value::list([known::QUOTE.into(), value])
}

fn quote_function(name: crate::Sym) -> Value {
    Value::list([known::FUNCTION.into(), name.into()])
}

fn call<I>(name: crate::Sym, args: I) -> Value
where
    I: IntoIterator<Item = Value>,
    I::IntoIter: DoubleEndedIterator,
{
    Value::cons(name.into(), Value::list(args))
}
