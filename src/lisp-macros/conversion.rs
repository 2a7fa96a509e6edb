//! The code that converts the arguments of a call to what a function takes.

use proc_macro2::{Literal, Span, TokenStream};
use quote::quote;
use syn::Ident;

use crate::parameters::{Argument, Parameters, Shape, names};

/// The variables with the converted arguments.
pub(crate) fn passed(parameters: &Parameters) -> Vec<Ident> {
    let arguments = parameters.arguments.list.iter();
    arguments.map(|a| variable("argument", &a.ident)).collect()
}

/// A variable that no user of the macro can name.
fn variable(prefix: &str, ident: &Ident) -> Ident {
    let name = ident.to_string();
    let name = name.trim_start_matches("r#");
    Ident::new(&format!("{prefix}_{name}"), Span::mixed_site())
}

/// Statements that convert `args`, a slice or, if `is_owned`, a vector.
pub(crate) fn converted(
    parameters: &Parameters,
    image: &TokenStream,
    is_owned: bool,
) -> TokenStream {
    let arguments = &parameters.arguments;
    let required: Vec<&Argument> = arguments.of_shape(Shape::Required).collect();
    let optional: Vec<&Argument> = arguments.of_shape(Shape::Optional).collect();
    let keys: Vec<&Argument> = arguments.of_shape(Shape::Key).collect();
    let rest = arguments.of_shape(Shape::Rest).next();
    let before = required.len() + optional.len();
    let mut statements = TokenStream::new();

    // The rest of an owned vector is moved out of it.
    let owned_rest =
        rest.filter(|rest| is_owned && rest.element_type().is_some_and(|ty| names(ty, "Value")));
    if let Some(rest) = owned_rest {
        let variable = variable("argument", &rest.ident);
        if before == 0 {
            return quote!(let #variable = args;);
        }
        let count = Literal::usize_unsuffixed(before);
        statements.extend(quote! {
            let mut args = args;
            let #variable = args.split_off(args.len().min(#count));
        });
    }
    let slice = if is_owned {
        quote!(args.as_slice())
    } else {
        quote!(args)
    };
    let names: Vec<Ident> = required
        .iter()
        .map(|a| variable("given", &a.ident))
        .collect();
    let is_open = !optional.is_empty() || !keys.is_empty() || rest.is_some();
    let pattern = if is_open {
        quote!([#(#names,)* more @ ..])
    } else {
        quote!([#(#names),*])
    };
    if names.is_empty() && is_open {
        statements.extend(quote!(let more = #slice;));
    } else if names.is_empty() {
        statements.extend(quote!(let _ = args;));
    } else {
        statements.extend(quote! {
            let #pattern = #slice else {
                return ::std::result::Result::Err(typed::wrong_count());
            };
        });
    }
    if !keys.is_empty() {
        let given: Vec<Ident> = keys.iter().map(|a| variable("given", &a.ident)).collect();
        let symbols = keys.iter().map(|key| key.name().to_uppercase());
        let count = Literal::usize_unsuffixed(before - required.len());
        statements.extend(quote! {
            let [#(#given),*] = typed::keys(
                #image,
                more.get(#count..).unwrap_or_default(),
                const { [#(typed::keyword(#symbols)),*] },
            )?;
        });
    }
    let mut index = 0_usize;
    for argument in &arguments.list {
        let variable_name = variable("argument", &argument.ident);
        let given = variable("given", &argument.ident);
        let ty = &argument.ty;
        let given = match argument.shape {
            Shape::Required | Shape::Key => quote!(#given),
            Shape::Optional => {
                let at = Literal::usize_unsuffixed(index);
                index += 1;
                quote!(more.get(#at))
            }
            Shape::Rest => {
                if owned_rest.is_some() {
                    continue;
                }
                let at = Literal::usize_unsuffixed(optional.len());
                if optional.is_empty() {
                    quote!(more)
                } else {
                    quote!(more.get(#at..).unwrap_or_default())
                }
            }
        };
        let value = match (argument.shape, argument.optional_type(), &argument.default) {
            (Shape::Rest, ..) => match argument.element_type() {
                Some(element) => {
                    quote!(typed::all::<#element>(#image, #given)?)
                }
                None => given,
            },
            (Shape::Required, ..) => {
                quote!(typed::required::<#ty>(#image, #given)?)
            }
            (_, Some(inner), _) => {
                quote!(typed::optional::<#inner>(#image, #given)?)
            }
            (_, None, default) => quote! {
                match #given {
                    ::std::option::Option::Some(given) => typed::required::<#ty>(#image, given)?,
                    ::std::option::Option::None => #default,
                }
            },
        };
        statements.extend(quote!(let #variable_name = #value;));
    }
    statements
}
