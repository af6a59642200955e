//! The plan being edited: its text, the selected field, and the history for undo. [`entry`] holds the ways to enter a value,
//! [`changes`] the changes made by single keys.

mod arrow_keys;
mod changes;
pub mod entry;
pub mod name_list;
pub mod order_editor;

use self::changes::is_of_file;
use self::entry::Entry;
use crate::plan::Plan;
use crate::plan::edit::fields::{self, EditField, Path};
use crate::plan::keys::{Key, blast_row, delay, plan, tire, uncertainty};

/// Keys that set the launch velocity of tires.
const LAUNCH: [&Key; 2] = [&blast_row::LAUNCH_M_S, &blast_row::FREE_FLIGHT_HEIGHT_M];

/// Outcome of an edit.
#[derive(Clone, Debug)]
pub enum EditOutcome {
    /// The plan has not changed.
    None,
    /// The plan after the edit.
    Changed(Box<Plan>),
}

/// The text of a plan and its history of edits.
#[derive(Clone, Debug)]
pub struct Editor {
    /// The text with all edits.
    pub text: String,
    /// The text in the file.
    saved: String,
    saved_fields: Vec<EditField>,
    undone: Vec<String>,
    done: Vec<String>,
    /// Whether the text, or the text that redo would restore, holds edits of an older text of the file.
    has_older_edits: bool,
    /// Fields of the text.
    pub fields: Vec<EditField>,
    /// Index of the selected field.
    pub selected: usize,
    /// The entry that replaces the selected value while the user edits it.
    pub entry: Option<Entry>,
    /// Message about the text being typed, or about the last edit.
    pub problem: Option<String>,
}

impl Editor {
    /// An editor for the text of a file.
    pub fn new(text: &str) -> Self {
        Self {
            text: text.to_owned(),
            saved: text.to_owned(),
            saved_fields: fields::fields(text),
            undone: Vec::new(),
            done: Vec::new(),
            has_older_edits: false,
            fields: fields::fields(text),
            selected: 0,
            entry: None,
            problem: None,
        }
    }

    /// Whether the text differs from the file.
    pub fn unsaved(&self) -> bool {
        self.text != self.saved
    }

    /// Whether the text holds edits of an older text of the file. Then the text must not overwrite the file.
    pub fn is_older_than_file(&self) -> bool {
        self.has_older_edits && self.unsaved()
    }

    /// Makes redo restore `text`, which holds edits of an older text of the file. Returns whether `text` is a valid plan; if not, drops it.
    pub fn keep_older_edits(&mut self, text: String) -> bool {
        self.has_older_edits = Self::checked(text.clone()).is_ok();
        if self.has_older_edits {
            self.undone.push(text);
        }
        self.has_older_edits
    }

    /// Moves the selection by `steps` fields.
    pub fn select(&mut self, steps: isize) {
        let last = self.fields.len().saturating_sub(1);
        self.selected = self.selected.saturating_add_signed(steps).min(last);
        self.problem = None;
    }

    /// Selects the times of a delay option, unless a field of this option is selected already.
    pub fn select_option(&mut self, option: usize) {
        let is_of_option =
            |field: &EditField| field.path.section == plan::DELAY.name && field.path.index == Some(option);
        if !self.field().is_some_and(is_of_option) {
            self.selected = self.times_of(option).unwrap_or(self.selected);
        }
    }

    /// Index of the field that holds the times of a delay option.
    pub fn times_of(&self, option: usize) -> Option<usize> {
        let is_of_option =
            |field: &EditField| field.path.section == plan::DELAY.name && field.path.index == Some(option);
        self.fields.iter().position(|field| is_of_option(field) && is_timing(field))
    }

    /// The selected field.
    pub fn field(&self) -> Option<&EditField> {
        self.fields.get(self.selected)
    }

    /// Selects the first field whose label or value contains `text`. The search begins at the selected field; with `next`, at the field
    /// after it.
    pub fn find(&mut self, text: &str, next: bool) {
        let text = text.to_lowercase();
        let has = |field: &EditField| {
            field.title().to_lowercase().contains(&text) || field.value.to_lowercase().contains(&text)
        };
        let first = self.selected + usize::from(next);
        let mut round = self.fields.iter().enumerate().cycle().skip(first).take(self.fields.len());
        self.selected = round.find(|(_, field)| has(field)).map_or(self.selected, |(n, _)| n);
    }

    /// Whether a field has another value than the file.
    pub fn is_changed(&self, field: &EditField) -> bool {
        // The name of an option may follow its interval, so options match by index. After an option was added or removed, they match by
        // name.
        let same_fields = self.saved_fields.len() == self.fields.len();
        let same_place = |saved: &EditField| match same_fields {
            true => saved.path.section == field.path.section && saved.path.index == field.path.index,
            false => saved.group == field.group,
        };
        let in_file = |saved: &&EditField| same_place(saved) && saved.path.key.name == field.path.key.name;
        self.unsaved()
            && self.saved_fields.iter().find(in_file).map(|saved| &saved.value) != Some(&field.value)
    }

    /// Whether a launch velocity is selected.
    pub fn launch_is_selected(&self) -> bool {
        self.field().is_some_and(|field| LAUNCH.iter().any(|key| key.name == field.path.key.name))
    }

    /// Whether a launch velocity differs from the file but its uncertainty does not. A launch that only follows a changed mass of the tires
    /// does not count: nobody typed it.
    pub fn launch_is_retyped(&self) -> bool {
        let changed = |key: &Key| {
            self.fields.iter().any(|field| field.path.key.name == key.name && self.is_changed(field))
        };
        let is_changed = LAUNCH.into_iter().any(changed) && !changed(&uncertainty::LAUNCH_COMMON_PERCENT);
        is_changed && (!changed(&tire::MASS_KG) || self.has_typed_launch())
    }

    /// Whether any launch velocity differs from the file's launch velocity scaled to the mass of the tires.
    pub fn has_typed_launch(&self) -> bool {
        let plans = Plan::parse("", &self.text).ok().zip(self.plan_of_file());
        plans.is_some_and(|(plan, file)| {
            let law = Plan { uncertainty: plan.uncertainty, ..file };
            let factor = law.launch_factor_of_mass(plan.tire.mass_kg);
            let launches = plan
                .blast_rows
                .iter()
                .enumerate()
                .flat_map(|(n, row)| row.launches().into_iter().map(move |launch| (n, launch)));
            launches.into_iter().any(|(row, launch)| !is_of_file(&law, factor, row, launch.speed_m_s))
        })
    }

    /// How a field has changed since `before`: `row 1: launch, m/s: 6.0 → 7, row 2 stays 6.0, row 3 stays 6.0`. `None` if the value is the
    /// same or the field is gone. Names the rows with another launch, because usually all rows have the same launch.
    pub fn change_since(&self, before: &EditField) -> Option<String> {
        let EditField { path, .. } = before;
        let has_key =
            |field: &&EditField| field.path.section == path.section && field.path.key.name == path.key.name;
        let now = self.fields.iter().filter(has_key).find(|field| field.path.index == path.index)?;
        let old = if before.value.is_empty() { "not set" } else { &before.value };
        let change = format!("{}: {old} → {}", before.title(), now.value);
        let others = self.fields.iter().filter(has_key).filter(|field| field.path.index != path.index);
        let others = others
            .filter(|field| LAUNCH.iter().any(|key| key.name == path.key.name) && field.value != now.value);
        let stay = others.map(|field| format!("{} stays {}", field.group, field.value));
        let parts: Vec<String> = std::iter::once(change).chain(stay).collect();
        (now.value != before.value).then(|| parts.join(", "))
    }

    /// The plan in the file; `None` if the file holds no valid plan.
    pub fn plan_of_file(&self) -> Option<Plan> {
        Plan::parse("", &self.saved).ok()
    }

    /// A text with its plan, or the first mistake.
    pub(super) fn checked(text: String) -> Result<(String, Plan), String> {
        match Plan::parse("", &text) {
            Ok(plan) => Ok((text, plan)),
            Err(mistakes) => Err(mistakes.first()),
        }
    }

    /// Takes a checked text as the new text, or stores the mistake as `problem`.
    pub(super) fn adopt_if_valid(&mut self, checked: Result<(String, Plan), String>) -> EditOutcome {
        match checked {
            Ok((text, plan)) => self.replace(text, plan),
            Err(problem) => {
                self.problem = Some(problem);
                EditOutcome::None
            }
        }
    }

    pub(super) fn replace(&mut self, text: String, plan: Plan) -> EditOutcome {
        if text == self.text {
            return EditOutcome::None;
        }
        // An edit that starts from the file's own text no longer holds edits of an older text.
        self.has_older_edits &= self.unsaved();
        self.done.push(std::mem::replace(&mut self.text, text));
        self.undone.clear();
        self.refresh();
        EditOutcome::Changed(Box::new(plan))
    }

    /// Merges the last two edits into one.
    pub(super) fn forget_edit_before(&mut self) {
        self.done.pop();
    }

    /// Takes the new text of the file after another program changed the file. Undo restores the text before.
    pub fn reload(&mut self, text: &str) {
        self.done.push(std::mem::replace(&mut self.text, text.to_owned()));
        self.undone.clear();
        self.set_saved(text);
        self.end_typing();
        self.refresh();
    }

    /// The text of the file.
    pub fn saved(&self) -> &str {
        &self.saved
    }

    /// Notes that the file holds this text now.
    pub fn set_saved(&mut self, text: &str) {
        text.clone_into(&mut self.saved);
        self.has_older_edits = false;
        self.saved_fields = fields::fields(text);
    }

    fn refresh(&mut self) {
        self.fields = fields::fields(&self.text);
        self.select(0);
    }

    /// Whether there is a change to undo.
    pub fn has_undo(&self) -> bool {
        !self.done.is_empty()
    }

    /// Undoes the last change.
    pub fn undo(&mut self) -> EditOutcome {
        let Some(before) = self.done.pop() else { return EditOutcome::None };
        self.undone.push(std::mem::replace(&mut self.text, before));
        self.restored()
    }

    /// Redoes the change that was undone last.
    pub fn redo(&mut self) -> EditOutcome {
        let Some(after) = self.undone.pop() else { return EditOutcome::None };
        self.done.push(std::mem::replace(&mut self.text, after));
        self.restored()
    }

    fn restored(&mut self) -> EditOutcome {
        self.refresh();
        Plan::parse("", &self.text).map_or(EditOutcome::None, |plan| EditOutcome::Changed(Box::new(plan)))
    }

    /// Selects the first value of the group `groups` further down. In the group of a delay option, selects its times.
    pub fn select_group(&mut self, groups: isize) {
        let firsts: Vec<usize> = (0..self.fields.len())
            .filter(|&n| n == 0 || self.fields[n - 1].group != self.fields[n].group)
            .collect();
        let own = firsts.iter().rposition(|&first| first <= self.selected).unwrap_or(0);
        let next = own.saturating_add_signed(groups).min(firsts.len().saturating_sub(1));
        if let Some(&first) = firsts.get(next) {
            self.selected = self.place_in_group(first);
        }
        self.problem = None;
    }

    /// Index of the field to select first in the group that begins at `first`: the times of a delay option, otherwise `first`.
    pub fn place_in_group(&self, first: usize) -> usize {
        let group = &self.fields[first].group;
        let of_group =
            self.fields.iter().enumerate().skip(first).take_while(|(_, field)| field.group == *group);
        of_group.into_iter().find(|(_, field)| is_timing(field)).map_or(first, |(n, _)| n)
    }

    /// Checks a changed text and takes it, or stores the mistake as `problem`.
    pub fn adopt(&mut self, changed: Result<String, String>) -> EditOutcome {
        self.adopt_if_valid(changed.and_then(Self::checked))
    }
}

/// Whether a field holds the times of a delay option.
fn is_timing(field: &EditField) -> bool {
    let Path { key, .. } = field.path;
    [delay::INTERVAL_MS.name, delay::AT_MS.name].contains(&key.name) && !field.value.is_empty()
}

#[cfg(test)]
mod tests {
    use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

    use super::entry::Entry;
    use super::order_editor::OrderEditor;
    use super::*;
    use crate::tui::keymap::Action;
    use crate::tui::typed_line::TypedLine;

    fn editor() -> Editor {
        Editor::new(include_str!("../../../tests/fixtures/amur-three-rows.toml"))
    }

    fn type_text(editor: &mut Editor, text: &str) {
        for letter in text.chars() {
            editor.type_key(&KeyEvent::new(KeyCode::Char(letter), KeyModifiers::NONE));
        }
    }

    #[test]
    fn rows_are_put_in_order_by_moving_them() {
        let mut editor = editor();
        editor.find("20 ms: order", false);
        editor.begin();
        for action in [Action::Down, Action::Left, Action::Open] {
            if let EditOutcome::Changed(plan) = editor.act_on_order(action) {
                assert_eq!(
                    plan.delays[2].timing.fire_at(),
                    [20.0, 0.0, 40.0].map(crate::plan::Time::from_ms)
                );
                assert!(editor.text.contains("order = [\"2\", \"1\", \"3\"]"), "{}", editor.text);
                return;
            }
        }
        panic!("{:?}", editor.problem);
    }

    /// The names contain quotation marks, and letters that Rust and TOML escape differently.
    #[test]
    fn names_of_any_letters_stay_themselves() {
        let slow = "20 ms \\\"slow\\\"";
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml")
            .replace("\"20 ms\"", &format!("\"{slow}\""));
        let mut editor = Editor::new(&text);
        editor.find("slow", false);
        editor.begin();
        assert_eq!(editor.typed().map(TypedLine::value), Some("20 ms \"slow\""));
        editor.type_key(&KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE));
        let plan = Plan::parse("", &editor.text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        assert_eq!(plan.delays[2].name, "20 ms \"slow\"");
        let decomposed = "\u{438}\u{306} \"\u{a0}";
        let order = OrderEditor { names: vec![decomposed.to_owned()], selected: 0 };
        let parsed: toml_edit::Value = order.text().parse().expect("TOML");
        assert_eq!(parsed.as_array().and_then(|names| names.get(0)?.as_str()), Some(decomposed));
    }

    /// The name of the option follows its interval, so both differ from the file. The other values of the option do not.
    #[test]
    fn only_what_differs_from_the_file_is_marked() {
        let mut editor = editor();
        editor.find("20 ms: interval", false);
        editor.begin();
        editor.type_key(&KeyEvent::new(KeyCode::Char('u'), KeyModifiers::CONTROL));
        type_text(&mut editor, "21");
        editor.type_key(&KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE));
        let changed = editor.fields.iter().filter(|field| editor.is_changed(field));
        let keys: Vec<&str> = changed.map(|field| field.path.key.name).collect();
        assert_eq!(keys, ["name", "interval_ms"]);
    }

    #[test]
    fn what_is_typed_is_checked_committed_and_undone() {
        let mut editor = editor();
        editor.find("flight height", false);
        editor.begin();
        editor.type_key(&KeyEvent::new(KeyCode::Char('u'), KeyModifiers::CONTROL));
        type_text(&mut editor, "-2");
        assert!(editor.problem.is_some(), "checked while typing");
        let enter = KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE);
        assert!(matches!(editor.type_key(&enter), EditOutcome::None), "a bad value is not taken");
        editor.type_key(&KeyEvent::new(KeyCode::Char('u'), KeyModifiers::CONTROL));
        type_text(&mut editor, "2.5");
        let EditOutcome::Changed(plan) = editor.type_key(&enter) else { panic!("{:?}", editor.problem) };
        assert_eq!(plan.limits.flight_height_m, 2.5);
        assert!(editor.unsaved());
        let EditOutcome::Changed(plan) = editor.undo() else { panic!("nothing to undo") };
        assert_eq!(plan.limits.flight_height_m, 2.35);
        assert!(!editor.unsaved());
        assert!(matches!(editor.redo(), EditOutcome::Changed(_)));
        assert!(matches!(editor.redo(), EditOutcome::None));
    }

    /// A lighter tire may leave faster; a heavier tire may leave as fast as before. The order of the changes does not matter, and a mass
    /// that is changed back restores the launches. A launch typed in between follows, too.
    #[test]
    fn launches_follow_the_mass_of_the_tires() {
        let mut editor = editor();
        let speeds = |editor: &Editor| -> Vec<f64> {
            let plan = Plan::parse("", &editor.text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            plan.launches().map(|launch| launch.speed_m_s).collect()
        };
        let typed = |editor: &mut Editor, label: &str, value: &str| {
            editor.find(label, false);
            editor.begin();
            editor.type_key(&KeyEvent::new(KeyCode::Char('u'), KeyModifiers::CONTROL));
            type_text(editor, value);
            let enter = KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE);
            assert!(matches!(editor.type_key(&enter), EditOutcome::Changed(_)), "{:?}", editor.problem);
            speeds(editor)
        };
        assert_eq!(typed(&mut editor, "tire mass", "240"), [7.0; 3]);
        assert_eq!(typed(&mut editor, "tire mass", "350"), [6.0; 3]);
        assert_eq!(typed(&mut editor, "tire mass", "210"), [8.0; 3]);
        assert_eq!(typed(&mut editor, "row 2: launch", "4"), [8.0, 4.0, 8.0]);
        // The typed launch belongs to the mass at that time. Heavier tires may leave as fast.
        assert_eq!(typed(&mut editor, "tire mass", "280"), [6.0, 4.0, 6.0]);
        // A plan that was fitted follows, too, although it otherwise belongs to its tires.
        let kept = "fitted_from = [\"ab12\", \"tires 280 kg\"]\nlaunch_cv_percent";
        let fitted = editor.text.replacen("launch_cv_percent", kept, 1);
        assert_ne!(fitted, editor.text, "a test that can fail");
        let mut fitted = Editor::new(&fitted);
        typed(&mut fitted, "tire mass", "240");
        assert!(fitted.problem.is_none() && fitted.text.contains("tires 240 kg"), "{}", fitted.text);
        editor.find("tire mass", false);
        for up in [false, true] {
            assert!(matches!(editor.step(up), EditOutcome::Changed(_)), "{:?}", editor.problem);
        }
        let speeds = speeds(&editor);
        assert!([speeds[0], speeds[2]] == [6.0; 2] && speeds[1] >= 4.0, "{}", editor.text);
    }

    #[test]
    fn a_rope_is_found_by_its_letters() {
        let mut editor = editor();
        editor.find("rope: rope", false);
        editor.begin();
        type_text(&mut editor, "2688 16 1770");
        let enter = KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE);
        let Some(Entry::Name(names)) = editor.entry.clone() else { panic!("no list") };
        assert!(names.matches().len() < names.names.len());
        let EditOutcome::Changed(plan) = editor.type_key(&enter) else { panic!("{:?}", editor.problem) };
        assert!(plan.cable.rope.is_some_and(|rope| rope.starts_with("GOST 2688-80 16")));
        editor.begin();
        type_text(&mut editor, "qqqq");
        assert!(matches!(editor.type_key(&enter), EditOutcome::None) && editor.problem.is_some());
    }

    /// If a stray arrow key could raise a limit, a failing option could pass.
    #[test]
    fn limits_are_only_typed() {
        let mut editor = editor();
        for label in ["flight height", "safety factor", "accepted risk"] {
            editor.find(label, false);
            assert!(matches!(editor.step(true), EditOutcome::None), "{label}");
            assert!(editor.problem.is_some() && !editor.unsaved());
        }
    }

    #[test]
    fn the_copy_of_an_option_asks_for_its_interval_and_d_removes_what_is_selected() {
        let mut editor = editor();
        assert!(matches!(editor.copy_option(2), EditOutcome::Changed(_)));
        type_text(&mut editor, "33");
        let enter = KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE);
        let EditOutcome::Changed(plan) = editor.type_key(&enter) else { panic!("{:?}", editor.problem) };
        assert_eq!(plan.delays[3].name, "33 ms");
        assert!(editor.is_changed(&editor.fields[editor.selected]));
        let EditOutcome::Changed(plan) = editor.remove() else { panic!("{:?}", editor.problem) };
        assert!(plan.delays.iter().all(|delay| delay.name != "33 ms"));
        editor.find("termination", false);
        let EditOutcome::Changed(plan) = editor.remove() else { panic!("{:?}", editor.problem) };
        assert_eq!(plan.cable.termination, None);
        editor.find("friction", false);
        assert!(matches!(editor.remove(), EditOutcome::None) && editor.problem.is_some());
    }

    #[test]
    fn whole_numbers_are_stepped_by_one() {
        let mut editor = editor();
        for (label, stepped) in [("shelter rows", "6"), ("row 1: under row", "2")] {
            editor.find(label, false);
            assert!(matches!(editor.step(true), EditOutcome::Changed(_)), "{:?}", editor.problem);
            assert_eq!(editor.field().map(|field| field.value.as_str()), Some(stepped));
        }
    }
}
