//! Cross references: who calls, reads, assigns, binds, expands or specializes what.

use super::definitions::location;
use super::engine::Engine;
use super::hub::Request;
use super::package_text::package_name;
use super::sexp::Sexp;
use session::dialogue::{Relation, Unrecorded};

/// The relation that a client names so.
fn relation(name: &str) -> Option<Relation> {
    Some(match name.to_lowercase().as_str() {
        ":calls" | ":callers" => Relation::Calls,
        ":calls-who" | ":callees" => Relation::Callees,
        ":references" => Relation::References,
        ":sets" => Relation::Sets,
        ":binds" => Relation::Binds,
        ":macroexpands" => Relation::Expands,
        ":specializes" => Relation::Specializes,
        _ => return None,
    })
}

impl Engine<'_> {
    /// `xref`: the uses of one kind.
    pub(super) fn xref(&mut self, request: &Request) {
        let kind = request.argument(0).and_then(Sexp::as_name);
        let Some(relation) = kind.and_then(relation) else {
            let kind = kind.unwrap_or("that").trim_start_matches(':');
            return request.abort(&format!("planwright has no cross references for {kind}"));
        };
        match self.uses(request, relation) {
            Ok(uses) => request.ok(uses),
            Err(why) => request.abort(&why.to_string()),
        }
    }

    /// `xrefs`: the uses of several kinds, those without any left out.
    pub(super) fn xrefs(&mut self, request: &Request) {
        let kinds = request.argument(0).map_or(&[][..], Sexp::items);
        let told = kinds.iter().filter_map(|kind| {
            let uses = self.uses(request, relation(kind.as_name()?)?).ok()?;
            let uses = uses.items().iter().cloned();
            (uses.len() > 0).then(|| Sexp::List([kind.clone()].into_iter().chain(uses).collect()))
        });
        let told: Vec<Sexp> = told.collect();
        request.ok(Sexp::List(told));
    }

    /// The uses of the name that a request has second: lists of a label and a place.
    fn uses(&mut self, request: &Request, relation: Relation) -> Result<Sexp, Unrecorded> {
        let usual = self.client(request).package.clone();
        let package = request
            .package
            .as_deref()
            .map_or(usual.as_str(), package_name);
        let name = request
            .argument(1)
            .and_then(Sexp::as_name)
            .unwrap_or_default();
        let uses = self.session.uses(relation, package, name)?.into_iter();
        Ok(Sexp::list(uses.map(|usage| {
            Sexp::list([usage.label.into(), location(usage.place.as_ref())])
        })))
    }
}
