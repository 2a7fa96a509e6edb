//! The code that the macros make.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::{Error, Ident, ItemFn, Path, Result, Type};

use crate::attribute::Wording;
use crate::conversion::{converted, passed};
use crate::doc::Doc;
use crate::lambda_list;
use crate::parameters::{Context, Parameters, names};

/// The function, and the constant with its entry for the table.
pub(crate) fn builtin(attribute: TokenStream, item: TokenStream) -> Result<TokenStream> {
    let wording: Wording = syn::parse2(attribute)?;
    let mut function: ItemFn = syn::parse2(item)?;
    let parameters = Parameters::take(&mut function.sig)?;
    let doc = Doc::of(&function.attrs);
    if doc.text.is_empty() {
        return Err(Error::new_spanned(
            &function.sig.ident,
            "a builtin has a doc comment, which is its documentation",
        ));
    }
    let name = match &wording.name {
        Some(name) => name.value(),
        None => lisp_name(&function.sig.ident),
    };
    let lambda_list = match &wording.lambda_list {
        Some(given) => {
            if let Some(why) = lambda_list::mismatch(&given.value(), &parameters.arguments) {
                return Err(Error::new(given.span(), why));
            }
            given.value()
        }
        None => lambda_list::of(&parameters.arguments),
    };
    if let (Some(edit), false) = (&wording.edit, parameters.has(Context::Owner)) {
        return Err(Error::new(
            edit.span(),
            "only a function that acts on an owner is an `edit`",
        ));
    }
    let call = call(&function, &parameters, &name, wording.edit.is_some())?;
    let entry = entry_name(&function.sig.ident);
    let visibility = &function.vis;
    let (text, examples) = (&doc.text, &doc.examples);
    let about = format!("The entry of `{name}`.");
    Ok(quote! {
        #[allow(clippy::too_many_arguments, reason = "a call has so many")]
        #function

        #[doc = #about]
        #visibility const #entry: typed::Builtin = {
            #call
            typed::Builtin {
                name: #name,
                lambda_list: #lambda_list,
                doc: #text,
                examples: &[#(#examples),*],
                call,
            }
        };
    })
}

/// The entries of functions.
pub(crate) fn builtins(mut functions: Vec<Path>) -> TokenStream {
    for function in &mut functions {
        if let Some(last) = function.segments.last_mut() {
            last.ident = entry_name(&last.ident);
        }
    }
    quote!(&[#(#functions),*])
}

/// `code_char` is `CODE-CHAR`.
fn lisp_name(function: &Ident) -> String {
    let name = function.to_string();
    name.trim_start_matches("r#")
        .replace('_', "-")
        .to_uppercase()
}

/// The name of the constant for a function.
fn entry_name(function: &Ident) -> Ident {
    let name = function.to_string();
    let name = name.trim_start_matches("r#").to_uppercase();
    format_ident!("{name}_BUILTIN", span = function.span())
}

/// A function `wrapper` as the machine calls it, and the constant `call` of it.
fn call(
    function: &ItemFn,
    parameters: &Parameters,
    name: &str,
    is_edit: bool,
) -> Result<TokenStream> {
    let ident = &function.sig.ident;
    let is_async = function.sig.asyncness.is_some();
    if is_async != parameters.has(Context::Calls) {
        return Err(Error::new_spanned(
            &function.sig,
            "an `async` builtin has the parameter `calls: Calls`, and no other has it",
        ));
    }
    let owner = parameters
        .contexts
        .iter()
        .find(|(context, _)| *context == Context::Owner);
    if let Some((_, owner)) = owner {
        return acting(function, parameters, owner, is_edit);
    }
    let is_control =
        is_async || parameters.has(Context::Machine) || names(&function.sig.output, "Step");
    let contexts = parameters
        .contexts
        .iter()
        .map(|(context, _)| match context {
            Context::Image if is_control => quote!(&mut *machine.image),
            Context::Image => quote!(image),
            Context::Machine => quote!(machine),
            Context::Calls | Context::Owner => quote!(calls),
        });
    let passed = passed(parameters);
    let called = quote!(#ident(#(#contexts,)* #(#passed),*));
    if !is_control {
        let converted = converted(parameters, &quote!(&mut *image), false);
        return Ok(quote! {
            fn wrapper(
                image: &mut typed::Image,
                args: &[typed::Value],
            ) -> ::std::result::Result<typed::Value, ::std::boxed::Box<typed::Raise>> {
                let _ = &image;
                #converted
                typed::Returned::returned(#called)
            }
            let call = typed::BuiltinCall::Pure(wrapper);
        });
    }
    let converted = converted(parameters, &quote!(&mut *machine.image), true);
    let called = if is_async {
        quote!(typed::run(machine, #name, |calls| #called))
    } else {
        called
    };
    Ok(quote! {
        fn wrapper(
            machine: &mut typed::Machine<'_>,
            args: ::std::vec::Vec<typed::Value>,
        ) -> ::std::result::Result<typed::Step, ::std::boxed::Box<typed::Raise>> {
            let _ = &machine;
            #converted
            #called
        }
        let call = typed::BuiltinCall::Control(wrapper);
    })
}

/// The same for a function that acts on an owner: the machine requests that the host calls it.
fn acting(
    function: &ItemFn,
    parameters: &Parameters,
    owner: &Type,
    is_edit: bool,
) -> Result<TokenStream> {
    let Type::Reference(owner) = owner else {
        return Err(Error::new_spanned(owner, "a reference is expected"));
    };
    let owner = &owner.elem;
    let ident = &function.sig.ident;
    let other = parameters
        .contexts
        .iter()
        .find(|(context, _)| !matches!(context, Context::Image | Context::Owner));
    if let Some((_, ty)) = other {
        return Err(Error::new_spanned(
            ty,
            "a function that acts on an owner works on the image, and on nothing else",
        ));
    }
    let contexts = parameters
        .contexts
        .iter()
        .map(|(context, _)| match context {
            Context::Image => quote!(image),
            _ => quote!(owner),
        });
    let passed = passed(parameters);
    let converted = converted(parameters, &quote!(&mut *image), false);
    let called = quote!(#ident(#(#contexts,)* #(#passed),*));
    let called = if names(&function.sig.output, "Reply") {
        called
    } else {
        quote!(typed::Returned::returned(#called).map(::std::convert::Into::into))
    };
    Ok(quote! {
        fn act(
            host: &mut typed::HostOf<#owner>,
            image: &mut typed::Image,
            args: &[typed::Value],
        ) -> ::std::result::Result<typed::ReplyTo<#owner>, ::std::boxed::Box<typed::Raise>> {
            let _ = &image;
            #converted
            let owner = <#owner as typed::Owner>::of(host);
            #called
        }
        fn wrapper(
            _: &mut typed::Machine<'_>,
            args: ::std::vec::Vec<typed::Value>,
        ) -> ::std::result::Result<typed::Step, ::std::boxed::Box<typed::Raise>> {
            ::std::result::Result::Ok(typed::Step::request(typed::HostCall {
                call: act,
                args,
                is_edit: #is_edit,
            }))
        }
        let call = typed::BuiltinCall::Control(wrapper);
    })
}

#[cfg(test)]
mod tests {
    use super::builtin;
    use quote::quote;

    /// The expansion without spaces.
    fn expansion(attribute: proc_macro2::TokenStream, item: proc_macro2::TokenStream) -> String {
        match builtin(attribute, item) {
            Ok(tokens) => tokens.to_string().replace(' ', ""),
            Err(error) => format!("error: {error}"),
        }
    }

    #[track_caller]
    fn holds(expansion: &str, part: &str) {
        assert!(expansion.contains(part), "{part} is not in {expansion}");
    }

    #[test]
    fn names_and_lambda_lists_come_from_the_function() {
        let code = expansion(
            quote!(),
            quote! {
                /// Doc.
                fn digit_char(weight: usize, _given: Option<u32>, #[key] from_end: Option<bool>) {}
            },
        );
        holds(&code, "name:\"DIGIT-CHAR\"");
        holds(&code, "lambda_list:\"weight&optionalgiven&keyfrom-end\"");
        holds(&code, "constDIGIT_CHAR_BUILTIN:typed::Builtin");
        holds(&code, "BuiltinCall::Pure(wrapper)");
    }

    #[test]
    fn the_attribute_replaces_them() {
        let item = quote! {
            /// Doc.
            fn add(args: &[Value]) -> Outcome {}
        };
        let code = expansion(quote!("+", "number &rest numbers"), item.clone());
        holds(&code, "name:\"+\",lambda_list:\"number&restnumbers\"");
        let code = expansion(quote!(_, "number &rest numbers"), item);
        holds(&code, "name:\"ADD\",lambda_list:\"number&restnumbers\"");
    }

    #[test]
    fn a_step_or_the_machine_makes_a_control_builtin() {
        let code = expansion(
            quote!(),
            quote! {
                /// Doc.
                fn f(x: Value) -> Result<Step, Box<Raise>> {}
            },
        );
        holds(&code, "BuiltinCall::Control(wrapper)");
        let code = expansion(
            quote!(),
            quote! {
                /// Doc.
                fn f(machine: &mut Machine<'_>, x: &Value, more: Vec<Value>) -> Outcome {}
            },
        );
        holds(&code, "BuiltinCall::Control(wrapper)");
        holds(&code, "args.split_off(args.len().min(1))");
        holds(&code, "f(machine,argument_x,argument_more)");
    }

    #[test]
    fn an_asynchronous_function_is_run() {
        let code = expansion(
            quote!("FIND"),
            quote! {
                /// Doc.
                async fn find(calls: Calls, item: Value) -> Outcome {}
            },
        );
        holds(
            &code,
            "typed::run(machine,\"FIND\",|calls|find(calls,argument_item))",
        );
        let wrong = expansion(
            quote!(),
            quote! {
                /// Doc.
                async fn find(item: Value) -> Outcome {}
            },
        );
        holds(&wrong, "error: an `async` builtin");
    }

    #[test]
    fn a_function_on_something_else_is_a_request() {
        let code = expansion(
            quote!(),
            quote! {
                /// Doc.
                fn spawn(world: &mut World, image: &mut Image, name: &Value) -> Result<Reply> {}
            },
        );
        holds(&code, "typed::HostCall{call:act,args,is_edit:false,}");
        holds(&code, "host:&muttyped::HostOf<World>");
        holds(&code, "letowner=<Worldastyped::Owner>::of(host);");
        holds(&code, "spawn(owner,image,argument_name)");
        holds(&code, "BuiltinCall::Control(wrapper)");
    }

    #[test]
    fn what_is_no_reply_is_converted() {
        let code = expansion(
            quote!(),
            quote! {
                /// Doc.
                fn count(world: &mut World) -> usize {}
            },
        );
        holds(&code, "typed::Returned::returned(count(owner,)).map(");
        let code = expansion(
            quote!(),
            quote! {
                /// Doc.
                fn wait(world: &mut World) -> Result<Reply> {}
            },
        );
        holds(&code, "wait(owner,)}");
    }

    #[test]
    fn an_edit_is_marked() {
        let item = quote! {
            /// Doc.
            fn spawn(world: &mut World, name: &Value) {}
        };
        let attributes = [
            (quote!(edit), "SPAWN", "name"),
            (quote!(_, edit), "SPAWN", "name"),
            (quote!("PUT", edit), "PUT", "name"),
            (quote!("PUT", "thing", edit), "PUT", "thing"),
        ];
        for (attribute, name, lambda_list) in attributes {
            let code = expansion(attribute, item.clone());
            holds(&code, "is_edit:true");
            let entry = format!("name:\"{name}\",lambda_list:\"{lambda_list}\"");
            holds(&code, &entry);
        }
    }

    #[test]
    fn defaults_replace_what_is_not_given() {
        let code = expansion(
            quote!(),
            quote! {
                /// Doc.
                fn last(list: &Value, #[default(1)] n: usize, #[key] #[default(None)] x: u8) {}
            },
        );
        holds(&code, "None=>1,");
        holds(&code, "fnlast(list:&Value,n:usize,x:u8){}");
        holds(&code, "const{[typed::keyword(\"X\")]}");
    }

    #[test]
    fn a_keyword_argument_may_have_another_name() {
        let code = expansion(
            quote!(),
            quote! {
                /// Doc.
                fn f(#[key("2nd-x")] second: Option<u8>) {}
            },
        );
        holds(&code, "lambda_list:\"&key2nd-x\"");
        holds(&code, "const{[typed::keyword(\"2ND-X\")]}");
        holds(&code, "f(argument_second)");
    }

    #[test]
    fn a_lambda_list_may_leave_out_a_keyword_argument_without_a_meaning() {
        let code = expansion(
            quote!(_, "&key a"),
            quote! {
                /// Doc.
                fn f(#[key] a: Option<u8>, #[key] _b: Option<&Value>) {}
            },
        );
        holds(&code, "lambda_list:\"&keya\"");
        holds(
            &code,
            "const{[typed::keyword(\"A\"),typed::keyword(\"B\")]}",
        );
    }

    #[test]
    fn what_does_not_fit_is_an_error() {
        let errors = [
            (
                quote!(),
                quote! { fn f() {} },
                "a builtin has a doc comment",
            ),
            (
                quote!("f"),
                quote! { #[doc = "D"] fn f() {} },
                "one word in upper case",
            ),
            (
                quote!("F", "a b"),
                quote! { #[doc = "D"] fn f(a: &Value) {} },
                "1 required and 0",
            ),
            (
                quote!("F", "a &rest b"),
                quote! { #[doc = "D"] fn f(a: &Value) {} },
                "the rest",
            ),
            (
                quote!("F", "a"),
                quote! { #[doc = "D"] fn f(a: u8, b: u8, c: &[Value]) {} },
                "more",
            ),
            (
                quote!("F", "&key a"),
                quote! { #[doc = "D"] fn f(#[key] b: Option<u8>) {} },
                "&key b",
            ),
            (
                quote!(),
                quote! { #[doc = "D"] fn f(a: Option<u8>, b: u8) {} },
                "come first",
            ),
            (
                quote!(),
                quote! { #[doc = "D"] fn f(#[key] a: u8) {} },
                "is an `Option`",
            ),
            (
                quote!(),
                quote! { #[doc = "D"] fn f((a, b): u8) {} },
                "is a name",
            ),
            (
                quote!(),
                quote! { #[doc = "D"] fn f(&self) {} },
                "no method",
            ),
            (
                quote!(edit),
                quote! { #[doc = "D"] fn f(a: u8) {} },
                "acts on an owner",
            ),
            (
                quote!(edit "F"),
                quote! { #[doc = "D"] fn f(world: &mut World) {} },
                "unexpected token",
            ),
            (
                quote!("F", "a", change),
                quote! { #[doc = "D"] fn f(world: &mut World, a: u8) {} },
                "is `edit`",
            ),
            (
                quote!(),
                quote! { #[doc = "D"] fn f(world: &mut World, machine: &mut Machine<'_>) {} },
                "on nothing else",
            ),
        ];
        for (attribute, item, part) in errors {
            let error = expansion(attribute, item);
            assert!(error.starts_with("error: "), "{error}");
            holds(&error, part);
        }
    }
}
