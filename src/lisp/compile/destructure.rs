//! Destructuring lambda lists: `destructuring-bind` and the arguments of macros.

use super::lambda_list::LambdaList;
use crate::guard::descend;
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// Bindings for `let*` that destructure a list.
struct Bindings<'a> {
    image: &'a mut Image,
    list: Vec<Value>,
    /// What is being destructured, for messages: a name, or the operator.
    context: Value,
    /// The whole lambda list, for messages.
    lambda_list: Value,
    /// The form for an `&environment` parameter.
    environment: Value,
}

impl Bindings<'_> {
    fn bind(&mut self, var: impl Into<Value>, form: Value) {
        self.list.push(Value::list([var.into(), form]));
    }

    fn gensym(&mut self, prefix: &str) -> Value {
        self.image.gensym(prefix)
    }

    /// Binds a name or, through a temporary variable, the names of a pattern.
    fn bind_pattern(&mut self, pattern: &Value, form: Value) -> Result<(), Box<Raise>> {
        match pattern {
            Value::Symbol(known::NIL, ..) => {
                let var = self.gensym("IGNORED");
                self.bind(var, form);
                Ok(())
            }
            Value::Symbol(name, ..) => {
                self.bind(*name, form);
                Ok(())
            }
            Value::Cons(_) => {
                descend()?;
                let var = self.gensym("PART");
                self.bind(var.clone(), form);
                let parsed = LambdaList::parse(self.image, pattern, true)?;
                let outer = std::mem::replace(&mut self.lambda_list, pattern.clone());
                self.take_apart(&parsed, &var, 0)?;
                self.lambda_list = outer;
                Ok(())
            }
            other => {
                let shown = crate::print::to_string(self.image, other, true);
                Err(Raise::program(format!(
                    "{shown} cannot be bound: a symbol or a list of symbols was expected"
                )))
            }
        }
    }

    fn take_apart(
        &mut self,
        parsed: &LambdaList,
        whole: &Value,
        skip: usize,
    ) -> Result<(), Box<Raise>> {
        if let Some(name) = &parsed.whole {
            self.bind_pattern(name, whole.clone())?;
        }
        if let Some(name) = parsed.environment {
            self.bind(name, self.environment.clone());
        }
        let rest = self.gensym("REST");
        let mut start = whole.clone();
        for _ in 0..skip {
            start = call(known::CDR, [start]);
        }
        let least = Value::Int(i64::try_from(parsed.required.len()).unwrap_or(i64::MAX));
        let unbounded = parsed.rest.is_some() || parsed.has_keys;
        let most = if unbounded {
            Value::NIL
        } else {
            let n = parsed.required.len() + parsed.optional.len();
            Value::Int(i64::try_from(n).unwrap_or(i64::MAX))
        };
        let check = call(
            known::CHECK_ARGUMENTS,
            [
                start,
                least,
                most,
                quote(self.context.clone()),
                quote(self.lambda_list.clone()),
            ],
        );
        self.bind(rest.clone(), check);
        for pattern in &parsed.required {
            self.bind_pattern(pattern, call(known::CAR, [rest.clone()]))?;
            self.bind(rest.clone(), call(known::CDR, [rest.clone()]));
        }
        for parameter in &parsed.optional {
            if let Some(supplied) = parameter.supplied {
                let test = Value::list([known::IF.into(), rest.clone(), Value::T, Value::NIL]);
                self.bind(supplied, test);
            }
            let value = Value::list([
                known::IF.into(),
                rest.clone(),
                call(known::CAR, [rest.clone()]),
                parameter.default.clone(),
            ]);
            self.bind_pattern(&parameter.pattern, value)?;
            self.bind(rest.clone(), call(known::CDR, [rest.clone()]));
        }
        if let Some(pattern) = &parsed.rest {
            self.bind_pattern(pattern, rest.clone())?;
        }
        if parsed.has_keys {
            let keys: Vec<Value> = parsed.keys.iter().map(|k| k.keyword.into()).collect();
            if !parsed.allow_other_keys {
                let ignored = self.gensym("CHECKED");
                let check = call(known::CHECK_KEYS, [rest.clone(), quote(Value::list(keys))]);
                self.bind(ignored, check);
            }
            for key in &parsed.keys {
                let tail = self.gensym("TAIL");
                let found = call(known::KEY_TAIL, [rest.clone(), quote(key.keyword.into())]);
                self.bind(tail.clone(), found);
                if let Some(supplied) = key.parameter.supplied {
                    let test = Value::list([known::IF.into(), tail.clone(), Value::T, Value::NIL]);
                    self.bind(supplied, test);
                }
                let value = Value::list([
                    known::IF.into(),
                    tail.clone(),
                    call(known::CAR, [tail]),
                    key.parameter.default.clone(),
                ]);
                self.bind_pattern(&key.parameter.pattern, value)?;
            }
        }
        for (name, form) in &parsed.aux {
            self.bind(*name, form.clone());
        }
        Ok(())
    }
}

fn call<I>(name: Sym, args: I) -> Value
where
    I: IntoIterator<Item = Value>,
    I::IntoIter: DoubleEndedIterator,
{
    Value::cons(name.into(), Value::list(args))
}

fn quote(value: Value) -> Value {
    Value::list([known::QUOTE.into(), value])
}

/// `(destructuring-bind lambda-list form body…)` as `let*`.
pub(super) fn expand_destructuring_bind(
    image: &mut Image,
    form: &Value,
) -> Result<Value, Box<Raise>> {
    let args = form.cdr_or_nil();
    let lambda_list = args.car_or_nil();
    let rest = args.cdr_or_nil();
    let whole = image.gensym("WHOLE");
    let parsed = LambdaList::parse(image, &lambda_list, true)?;
    let mut bindings = Bindings {
        image,
        list: vec![Value::list([whole.clone(), rest.car_or_nil()])],
        context: known::DESTRUCTURING_BIND.into(),
        lambda_list,
        environment: Value::NIL,
    };
    bindings.take_apart(&parsed, &whole, 0)?;
    Ok(Value::list_with_tail(
        [known::LET_STAR.into(), Value::list(bindings.list)],
        rest.cdr_or_nil(),
    ))
}

/// The `lambda` expression of a macro function: it takes the whole form and an environment.
pub(crate) fn macro_function(
    image: &mut Image,
    name: Sym,
    lambda_list: &Value,
    body: &Value,
) -> Result<Value, Box<Raise>> {
    let whole = image.gensym("FORM");
    let environment = image.gensym("ENVIRONMENT");
    let parsed = LambdaList::parse(image, lambda_list, true)?;
    let mut bindings = Bindings {
        image,
        list: Vec::new(),
        context: name.into(),
        lambda_list: lambda_list.clone(),
        environment: environment.clone(),
    };
    bindings.take_apart(&parsed, &whole, 1)?;
    let parts = crate::value::form::split_body(body);
    let block = Value::list_with_tail([known::BLOCK.into(), name.into()], parts.forms);
    let mut let_form = vec![known::LET_STAR.into(), Value::list(bindings.list)];
    let_form.extend(parts.declarations);
    let_form.push(block);
    let ignored = Value::list([known::IGNORE.into(), environment.clone()]);
    let written = Value::list([known::WRITTEN_LAMBDA_LIST.into(), lambda_list.clone()]);
    let mut lambda = vec![
        known::LAMBDA.into(),
        Value::list([whole, environment]),
        Value::list([known::DECLARE.into(), ignored]),
        Value::list([known::DECLARE.into(), written]),
    ];
    lambda.extend(parts.doc.map(|doc| Value::string(doc.as_ref())));
    lambda.push(Value::list(let_form));
    Ok(Value::list(lambda))
}
