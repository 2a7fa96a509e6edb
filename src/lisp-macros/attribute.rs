//! What stands in the parentheses of `#[builtin(…)]`.

use syn::parse::{Parse, ParseStream};
use syn::{LitStr, Token};

/// Name and lambda list, where they differ from those of the function.
#[derive(Default)]
pub(crate) struct Wording {
    pub(crate) name: Option<LitStr>,
    pub(crate) lambda_list: Option<LitStr>,
}

impl Parse for Wording {
    fn parse(input: ParseStream<'_>) -> syn::Result<Wording> {
        let mut wording = Wording::default();
        if input.is_empty() {
            return Ok(wording);
        }
        if input.peek(Token![_]) {
            input.parse::<Token![_]>()?;
        } else {
            let name: LitStr = input.parse()?;
            if name.value() != name.value().to_uppercase() || name.value().contains(' ') {
                return Err(syn::Error::new(
                    name.span(),
                    "the name of a builtin is one word in upper case",
                ));
            }
            wording.name = Some(name);
        }
        if input.is_empty() {
            return Ok(wording);
        }
        input.parse::<Token![,]>()?;
        if !input.is_empty() {
            wording.lambda_list = Some(input.parse()?);
        }
        Ok(wording)
    }
}
