//! What stands in the parentheses of `#[builtin(…)]`.

use syn::parse::{Parse, ParseStream};
use syn::{Ident, LitStr, Token};

/// Name and lambda list, where they differ from those of the function, and whether it is an edit.
#[derive(Default)]
pub(crate) struct Wording {
    pub(crate) name: Option<LitStr>,
    pub(crate) lambda_list: Option<LitStr>,
    /// The word `edit`, if it is there.
    pub(crate) edit: Option<Ident>,
}

impl Wording {
    /// Reads the word `edit`, which is the last part, if it comes next.
    fn take_edit(&mut self, input: ParseStream<'_>) -> syn::Result<()> {
        if !input.peek(Ident) {
            return Ok(());
        }
        let word: Ident = input.parse()?;
        if word != "edit" {
            return Err(syn::Error::new(word.span(), "the only word here is `edit`"));
        }
        self.edit = Some(word);
        Ok(())
    }
}

impl Parse for Wording {
    fn parse(input: ParseStream<'_>) -> syn::Result<Wording> {
        let mut wording = Wording::default();
        wording.take_edit(input)?;
        if wording.edit.is_some() || input.is_empty() {
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
        if input.peek(LitStr) {
            wording.lambda_list = Some(input.parse()?);
            if input.is_empty() {
                return Ok(wording);
            }
            input.parse::<Token![,]>()?;
        }
        wording.take_edit(input)?;
        Ok(wording)
    }
}
