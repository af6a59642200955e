//! A firing order that the user edits by moving its rows.

/// A firing order being edited.
#[derive(Clone, Debug)]
pub struct OrderEditor {
    /// Names of the blast rows in their order of firing.
    pub names: Vec<String>,
    /// Index of the selected row.
    pub selected: usize,
}

impl OrderEditor {
    /// Selects the row that fires before or after.
    pub fn select(&mut self, down: bool) {
        let last = self.names.len().saturating_sub(1);
        self.selected = self.selected.saturating_add_signed(if down { 1 } else { -1 }).min(last);
    }

    /// Moves the selected row one place earlier or later.
    pub fn shift(&mut self, later: bool) {
        let selected = self.selected;
        self.select(later);
        self.names.swap(selected, self.selected);
    }

    /// The order in the notation of the plan's file.
    pub fn text(&self) -> String {
        self.names.iter().collect::<toml_edit::Array>().to_string()
    }
}
