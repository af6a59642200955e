//! The plan being edited: its text, what is selected, what is being typed, and the way back.

use crossterm::event::{Event, KeyCode, KeyEvent};
use tui_input::Input;
use tui_input::backend::crossterm::EventHandler;

use crate::plan::fields::{self, Field};
use crate::plan::keys::Kind;
use crate::plan::{Layout, Plan};

/// What an edit came to.
#[derive(Clone, Debug)]
pub enum Edit {
    /// Nothing new.
    None,
    /// Another plan.
    Changed(Box<Plan>),
}

/// The text of a plan and its history.
#[derive(Clone, Debug)]
pub struct Editor {
    /// As it stands.
    pub text: String,
    /// As the file has it.
    pub saved: String,
    undone: Vec<String>,
    done: Vec<String>,
    /// What can be changed.
    pub fields: Vec<Field>,
    /// Index of the selected field.
    pub selected: usize,
    /// What is being typed in its place.
    pub input: Option<Input>,
    /// Blast rows being put in order, in place of the selected value.
    pub order: Option<Order>,
    /// What is wrong with it, or with the last change.
    pub problem: Option<String>,
}

/// Blast rows in their order of firing.
#[derive(Clone, Debug)]
pub struct Order {
    /// Their names.
    pub names: Vec<String>,
    /// Index of the selected one.
    pub selected: usize,
}

impl Order {
    fn select(&mut self, down: bool) {
        let last = self.names.len().saturating_sub(1);
        self.selected = self.selected.saturating_add_signed(if down { 1 } else { -1 }).min(last);
    }

    /// Moves the selected row one place.
    fn shift(&mut self, later: bool) {
        let from = self.selected;
        self.select(later);
        self.names.swap(from, self.selected);
    }

    /// As a plan writes it.
    fn text(&self) -> String {
        let names: Vec<String> = self.names.iter().map(|name| format!("{name:?}")).collect();
        format!("[{}]", names.join(", "))
    }
}

impl Editor {
    /// Of a plan's text as loaded.
    pub fn new(text: &str) -> Self {
        Self {
            text: text.to_owned(),
            saved: text.to_owned(),
            undone: Vec::new(),
            done: Vec::new(),
            fields: fields::fields(text),
            selected: 0,
            input: None,
            order: None,
            problem: None,
        }
    }

    /// Whether the file has another text.
    pub fn unsaved(&self) -> bool {
        self.text != self.saved
    }

    /// Selects a field so many places further.
    pub fn select(&mut self, places: isize) {
        let last = self.fields.len().saturating_sub(1);
        self.selected = self.selected.saturating_add_signed(places).min(last);
        self.problem = None;
    }

    /// The selected field.
    pub fn field(&self) -> Option<&Field> {
        self.fields.get(self.selected)
    }

    /// Selects the first field whose label or value contains a text, from the selected one on or from that behind it.
    pub fn find(&mut self, text: &str, next: bool) {
        let text = text.to_lowercase();
        let has = |field: &Field| {
            field.label.to_lowercase().contains(&text) || field.value.to_lowercase().contains(&text)
        };
        let from = self.selected + usize::from(next);
        let mut round = self.fields.iter().enumerate().cycle().skip(from).take(self.fields.len());
        self.selected = round.find(|(_, field)| has(field)).map_or(self.selected, |(n, _)| n);
    }

    /// Whether keys go into a value.
    pub fn typing(&self) -> bool {
        self.input.is_some() || self.order.is_some()
    }

    /// Begins to type in place of the selected value, or to put the rows in order.
    pub fn begin(&mut self) {
        self.problem = None;
        let Some(field) = self.field() else { return };
        if matches!(field.path.key.kind, Kind::RowNames) {
            let names = fields::order(&self.text, &field.path);
            self.order = (!names.is_empty()).then_some(Order { names, selected: 0 });
        } else {
            self.input = Some(Input::new(field.value.trim_matches('"').to_owned()));
        }
    }

    /// A key while typing; the value is checked at every one.
    pub fn type_key(&mut self, key: &KeyEvent) -> Edit {
        match key.code {
            KeyCode::Esc => {
                self.leave();
                return Edit::None;
            }
            KeyCode::Enter => return self.commit(),
            _ => {}
        }
        if let Some(order) = &mut self.order {
            match key.code {
                KeyCode::Up | KeyCode::Char('k') => order.select(false),
                KeyCode::Down | KeyCode::Char('j') => order.select(true),
                KeyCode::Left | KeyCode::Char('h' | 'K') => order.shift(false),
                KeyCode::Right | KeyCode::Char('l' | 'J') => order.shift(true),
                _ => {}
            }
        } else if let Some(input) = &mut self.input
            && input.handle_event(&Event::Key(*key)).is_some_and(|change| change.value)
        {
            self.problem = self.candidate().err();
        }
        Edit::None
    }

    fn leave(&mut self) {
        self.input = None;
        self.order = None;
        self.problem = None;
    }

    /// The text and plan with what is typed.
    fn candidate(&self) -> Result<(String, Plan), String> {
        let Some(field) = self.field() else { return Err("no value is selected".to_owned()) };
        let typed = match (&self.order, &self.input) {
            (Some(order), _) => order.text(),
            (None, Some(input)) => input.value().to_owned(),
            (None, None) => return Err("nothing is typed".to_owned()),
        };
        Self::checked(fields::set(&self.text, &field.path, &typed)?)
    }

    /// A text with its plan, or the first thing wrong with it.
    fn checked(text: String) -> Result<(String, Plan), String> {
        match Plan::parse("", &text) {
            Ok(plan) => Ok((text, plan)),
            Err(mistakes) => Err(mistakes.first()),
        }
    }

    fn commit(&mut self) -> Edit {
        let candidate = self.candidate();
        if candidate.is_ok() {
            self.leave();
        }
        self.settle(candidate)
    }

    /// Takes a checked text, or keeps what stands against it.
    fn settle(&mut self, checked: Result<(String, Plan), String>) -> Edit {
        match checked {
            Ok((text, plan)) => self.replace(text, plan),
            Err(problem) => {
                self.problem = Some(problem);
                Edit::None
            }
        }
    }

    fn replace(&mut self, text: String, plan: Plan) -> Edit {
        if text == self.text {
            return Edit::None;
        }
        self.done.push(std::mem::replace(&mut self.text, text));
        self.undone.clear();
        self.refresh();
        Edit::Changed(Box::new(plan))
    }

    /// Another program has changed the file; the way back leads to what stood here.
    pub fn reload(&mut self, text: &str) {
        self.done.push(std::mem::replace(&mut self.text, text.to_owned()));
        self.undone.clear();
        text.clone_into(&mut self.saved);
        self.leave();
        self.refresh();
    }

    fn refresh(&mut self) {
        self.fields = fields::fields(&self.text);
        self.select(0);
    }

    /// Takes the last change back.
    pub fn undo(&mut self) -> Edit {
        let Some(before) = self.done.pop() else { return Edit::None };
        self.undone.push(std::mem::replace(&mut self.text, before));
        self.restored()
    }

    /// Makes the last change taken back again.
    pub fn redo(&mut self) -> Edit {
        let Some(after) = self.undone.pop() else { return Edit::None };
        self.done.push(std::mem::replace(&mut self.text, after));
        self.restored()
    }

    fn restored(&mut self) -> Edit {
        self.refresh();
        Plan::parse("", &self.text).map_or(Edit::None, |plan| Edit::Changed(Box::new(plan)))
    }

    /// The next smaller or larger choice: a rope of the catalogue, or a number a tenth of its size away.
    pub fn step(&mut self, up: bool) -> Edit {
        let Some(field) = self.field() else { return Edit::None };
        let value = field.value.trim_matches('"');
        let next = match &field.path.key.kind {
            Kind::Whole(_) => moved(value, if up { 1.0 } else { -1.0 }),
            Kind::ShelterRow(_) => {
                let plan = Plan::parse("", &self.text);
                let centres = plan.is_ok_and(|plan| matches!(plan.layout, Layout::Quincunx(_)));
                let step = if centres { 0.5 } else { 1.0 };
                moved(value, if up { step } else { -step })
            }
            Kind::Number { .. } | Kind::NumberOrSection(..) => {
                value.parse().ok().map(|number| stepped(number, up).to_string())
            }
            kind => beside(&kind.names(), value, up),
        };
        let Some(next) = next else { return Edit::None };
        let changed = fields::set(&self.text, &field.path, &next).and_then(Self::checked);
        self.settle(changed)
    }

    /// Copies an option.
    pub fn copy_option(&mut self, option: usize) -> Edit {
        self.with_option(option, fields::copy_delay)
    }

    /// Removes an option.
    pub fn remove_option(&mut self, option: usize) -> Edit {
        self.with_option(option, fields::remove_delay)
    }

    fn with_option(&mut self, option: usize, change: fn(&str, usize) -> Option<String>) -> Edit {
        let changed = change(&self.text, option).ok_or_else(|| "the plan needs a delay option".to_owned());
        let changed = changed.and_then(Self::checked);
        self.settle(changed)
    }
}

/// The name before or after `name` in a list; the first where the list has no such name.
fn beside(names: &[&str], name: &str, up: bool) -> Option<String> {
    let index = names.iter().position(|known| *known == name);
    let next = index.map_or(0, |index| index.saturating_add_signed(if up { 1 } else { -1 }));
    names.get(next).map(|name| (*name).to_owned())
}

/// A number moved by `step`, at least 0.
fn moved(number: &str, step: f64) -> Option<String> {
    number.parse::<f64>().ok().map(|number| (number + step).max(0.0).to_string())
}

/// A tenth of the leading digit's place further: 20 to 21, 6 to 6.1, 280 to 290.
fn stepped(number: f64, up: bool) -> f64 {
    if number == 0.0 {
        return if up { 1.0 } else { 0.0 };
    }
    let place = 10_f64.powf(number.abs().log10().floor() - 1.0);
    let steps = (number / place).round() + if up { 1.0 } else { -1.0 };
    // Not through `place`, which may have no exact value.
    if place < 1.0 { steps / (1.0 / place).round() } else { steps * place }
}

#[cfg(test)]
mod tests {
    use crossterm::event::KeyModifiers;

    use super::*;

    fn editor() -> Editor {
        Editor::new(include_str!("../../plans/amur-three-rows.toml"))
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
        for code in [KeyCode::Down, KeyCode::Left, KeyCode::Enter] {
            if let Edit::Changed(plan) = editor.type_key(&KeyEvent::new(code, KeyModifiers::NONE)) {
                assert_eq!(plan.delays[2].timing.fire_at_ms(), [20.0, 0.0, 40.0]);
                assert!(editor.text.contains("order = [\"2\", \"1\", \"3\"]"), "{}", editor.text);
                return;
            }
        }
        panic!("{:?}", editor.problem);
    }

    #[test]
    fn what_is_typed_is_checked_committed_and_undone() {
        let mut editor = editor();
        editor.begin();
        editor.type_key(&KeyEvent::new(KeyCode::Char('u'), KeyModifiers::CONTROL));
        type_text(&mut editor, "-2");
        assert!(editor.problem.is_some(), "checked while typing");
        let enter = KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE);
        assert!(matches!(editor.type_key(&enter), Edit::None), "a bad value is not taken");
        editor.type_key(&KeyEvent::new(KeyCode::Char('u'), KeyModifiers::CONTROL));
        type_text(&mut editor, "2.5");
        let Edit::Changed(plan) = editor.type_key(&enter) else { panic!("{:?}", editor.problem) };
        assert_eq!(plan.limits.flight_height_m, 2.5);
        assert!(editor.unsaved());
        let Edit::Changed(plan) = editor.undo() else { panic!("nothing to undo") };
        assert_eq!(plan.limits.flight_height_m, 1.8);
        assert!(!editor.unsaved());
        assert!(matches!(editor.redo(), Edit::Changed(_)));
        assert!(matches!(editor.redo(), Edit::None));
    }

    #[test]
    fn whole_numbers_are_stepped_by_one() {
        let mut editor = editor();
        for (label, stepped) in [("shelter rows", "6"), ("row 1: under row", "2")] {
            editor.find(label, false);
            assert!(matches!(editor.step(true), Edit::Changed(_)), "{:?}", editor.problem);
            assert_eq!(editor.field().map(|field| field.value.as_str()), Some(stepped));
        }
    }

    #[test]
    fn steps_follow_the_leading_digit() {
        assert_eq!([20.0, 6.0, 280.0, 1.8].map(|n| stepped(n, true)), [21.0, 6.1, 290.0, 1.9]);
        assert_eq!([20.0, 0.0].map(|n| stepped(n, false)), [19.0, 0.0]);
    }
}
