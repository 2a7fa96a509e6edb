//! The parameters of a builtin's Rust function.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{
    Attribute, Error, Expr, FnArg, GenericArgument, Ident, LitStr, Meta, Pat, PatType,
    PathArguments, Result, Signature, Type, TypePath,
};

/// What a function works on besides its arguments.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Context {
    /// `&mut Image` or `&Image`.
    Image,
    /// `&mut Machine<'_>`.
    Machine,
    /// `Calls` of an asynchronous function.
    Calls,
    /// A reference to something else: what the function acts on.
    Owner,
}

/// How an argument comes to a parameter.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Shape {
    Required,
    Optional,
    Rest,
    Key,
}

/// A parameter for arguments of a call.
pub(crate) struct Argument {
    pub(crate) ident: Ident,
    /// The name of a keyword argument that is not that of the parameter.
    key: Option<LitStr>,
    pub(crate) ty: Type,
    pub(crate) shape: Shape,
    /// The value of an optional argument or a keyword argument that is not given.
    pub(crate) default: Option<Expr>,
}

impl Argument {
    /// The name in the lambda list.
    pub(crate) fn name(&self) -> String {
        if let Some(key) = &self.key {
            return key.value();
        }
        let name = self.ident.to_string();
        let name = name.trim_start_matches("r#").trim_matches('_');
        name.replace('_', "-")
    }

    /// Is it accepted only because calls written for others may have it? The lambda list of an
    /// attribute need not name such a keyword argument.
    pub(crate) fn is_ignored(&self) -> bool {
        self.ident.to_string().starts_with('_')
    }

    /// `T`, if the type is `Option<T>`.
    pub(crate) fn optional_type(&self) -> Option<&Type> {
        inner(&self.ty, "Option")
    }

    /// `T`, if the type is `Vec<T>`.
    pub(crate) fn element_type(&self) -> Option<&Type> {
        inner(&self.ty, "Vec")
    }
}

/// The parameters of a function.
pub(crate) struct Parameters {
    /// The first ones: what the function works on, with their types.
    pub(crate) contexts: Vec<(Context, Type)>,
    pub(crate) arguments: Arguments,
}

/// The parameters for arguments of a call.
pub(crate) struct Arguments {
    pub(crate) list: Vec<Argument>,
}

impl Arguments {
    /// Does a parameter take all further arguments?
    pub(crate) fn takes_rest(&self) -> bool {
        self.of_shape(Shape::Rest).next().is_some()
    }

    /// The parameters with this shape.
    pub(crate) fn of_shape(&self, shape: Shape) -> impl Iterator<Item = &Argument> {
        self.list.iter().filter(move |a| a.shape == shape)
    }
}

impl Parameters {
    /// Reads the parameters of a function, and takes away the attributes that are for the macro.
    pub(crate) fn take(signature: &mut Signature) -> Result<Parameters> {
        let mut contexts = Vec::new();
        let mut list: Vec<Argument> = Vec::new();
        for input in &mut signature.inputs {
            let FnArg::Typed(parameter) = input else {
                return Err(Error::new_spanned(input, "a builtin is no method"));
            };
            if list.is_empty()
                && let Some(context) = context(&parameter.ty)
            {
                contexts.push((context, (*parameter.ty).clone()));
                continue;
            }
            let argument = argument(parameter)?;
            if let Some(before) = list.last()
                && !may_follow(argument.shape, before.shape)
            {
                return Err(Error::new_spanned(
                    &argument.ident,
                    "required parameters come first, then optional ones, then the rest or keys",
                ));
            }
            list.push(argument);
        }
        let arguments = Arguments { list };
        Ok(Parameters {
            contexts,
            arguments,
        })
    }

    /// Is there a parameter with this context?
    pub(crate) fn has(&self, context: Context) -> bool {
        self.contexts.iter().any(|(other, _)| *other == context)
    }
}

/// May a parameter come after another one?
fn may_follow(shape: Shape, before: Shape) -> bool {
    match before {
        Shape::Required => true,
        Shape::Optional => shape != Shape::Required,
        Shape::Rest => false,
        Shape::Key => shape == Shape::Key,
    }
}

/// What a parameter is, if it is none for an argument.
fn context(ty: &Type) -> Option<Context> {
    if last_segment(ty).is_some_and(|name| name == "Calls") {
        return Some(Context::Calls);
    }
    let Type::Reference(reference) = ty else {
        return None;
    };
    let name = last_segment(&reference.elem)?;
    match name.to_string().as_str() {
        "Image" => Some(Context::Image),
        "Machine" => Some(Context::Machine),
        _ => reference.mutability.is_some().then_some(Context::Owner),
    }
}

fn argument(parameter: &mut PatType) -> Result<Argument> {
    let key_attribute = take_attribute(&mut parameter.attrs, "key");
    let is_key = key_attribute.is_some();
    let key = match key_attribute {
        Some(attribute) if matches!(attribute.meta, Meta::List(_)) => {
            Some(attribute.parse_args::<LitStr>()?)
        }
        _ => None,
    };
    let default = match take_attribute(&mut parameter.attrs, "default") {
        Some(attribute) => Some(attribute.parse_args::<Expr>()?),
        None => None,
    };
    let Pat::Ident(pattern) = &*parameter.pat else {
        return Err(Error::new_spanned(
            &parameter.pat,
            "a parameter of a builtin is a name",
        ));
    };
    let ty = (*parameter.ty).clone();
    let is_slice = matches!(&ty, Type::Reference(r) if matches!(*r.elem, Type::Slice(_)));
    let is_option = inner(&ty, "Option").is_some();
    let shape = match () {
        () if is_key => Shape::Key,
        () if is_slice || inner(&ty, "Vec").is_some() => Shape::Rest,
        () if is_option || default.is_some() => Shape::Optional,
        () => Shape::Required,
    };
    if shape == Shape::Key && !is_option && default.is_none() {
        return Err(Error::new_spanned(
            &parameter.ty,
            "a keyword argument is an `Option`, or it has a `#[default(value)]`",
        ));
    }
    if default.is_some() && is_option {
        return Err(Error::new_spanned(
            &parameter.ty,
            "an argument with a default value is no `Option`",
        ));
    }
    Ok(Argument {
        ident: pattern.ident.clone(),
        key,
        ty,
        shape,
        default,
    })
}

/// The attribute of this name, which is there no more afterwards.
fn take_attribute(attributes: &mut Vec<Attribute>, name: &str) -> Option<Attribute> {
    let at = attributes.iter().position(|a| a.path().is_ident(name))?;
    Some(attributes.remove(at))
}

fn last_segment(ty: &Type) -> Option<&Ident> {
    match ty {
        Type::Path(TypePath { path, .. }) => path.segments.last().map(|segment| &segment.ident),
        Type::Group(group) => last_segment(&group.elem),
        _ => None,
    }
}

/// `T` of the type `Name<T>`.
fn inner<'a>(ty: &'a Type, name: &str) -> Option<&'a Type> {
    let Type::Path(TypePath { path, .. }) = ty else {
        return None;
    };
    let segment = path.segments.last().filter(|s| s.ident == name)?;
    let PathArguments::AngleBracketed(arguments) = &segment.arguments else {
        return None;
    };
    match arguments.args.first()? {
        GenericArgument::Type(ty) => Some(ty),
        _ => None,
    }
}

/// Does a type name a step of the machine?
pub(crate) fn names(tokens: &impl ToTokens, name: &str) -> bool {
    fn any(tokens: TokenStream, name: &str) -> bool {
        tokens.into_iter().any(|token| match token {
            proc_macro2::TokenTree::Ident(ident) => ident == name,
            proc_macro2::TokenTree::Group(group) => any(group.stream(), name),
            _ => false,
        })
    }
    any(tokens.to_token_stream(), name)
}
