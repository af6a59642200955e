//! Schema `shelter.ropes/1`.

use serde::Serialize;

use crate::ropes::{Catalogue, Rope, Termination};

/// The catalogue as a document.
#[derive(Serialize)]
pub struct RopesDocument<'a> {
    schema: &'static str,
    ropes: &'a [Rope],
    terminations: &'a [Termination],
}

impl<'a> RopesDocument<'a> {
    /// The document of a catalogue.
    pub fn new(catalogue: &'a Catalogue) -> Self {
        Self { schema: "shelter.ropes/1", ropes: &catalogue.ropes, terminations: &catalogue.terminations }
    }
}
