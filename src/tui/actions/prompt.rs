//! The line at the foot of the screen: the effects of its keys, of a paste and of Enter.

use crate::tui::app::{App, Request};
use crate::tui::plan_side::PlanOption;
use crate::tui::prompt::{Prompt, Purpose, Typed};
use crate::tui::screen::Screen;
use crate::tui::typed_line::TypedLine;
use crossterm::event::{KeyCode, KeyEvent};

impl App {
    /// Passes a key to the line being typed at the foot of the screen.
    pub fn type_in_prompt(&mut self, key: &KeyEvent) -> Request {
        let Some(mut prompt) = self.prompt.take() else { return Request::None };
        if prompt.purpose == Purpose::Forget {
            return self.answer_forget(key);
        }
        let typed = prompt.key(key, self.choices(&prompt));
        let text = prompt.line.value().to_owned();
        match (prompt.purpose, typed) {
            (Purpose::Find, Typed::Cancelled) => self.find("", false),
            (Purpose::Find, Typed::Changed) => self.find(&text, key.code == KeyCode::Down),
            (Purpose::Palette, Typed::Done) => {
                let chosen = prompt.selected.and_then(|at| prompt.commands().get(at).copied());
                let Some(chosen) = chosen else { return Request::None };
                // If the command belongs to another screen, show that screen first.
                if let Some(&screen) = chosen.on.first().filter(|_| !chosen.is_on(self.screen)) {
                    self.show(screen);
                }
                return self.act(chosen.action);
            }
            (Purpose::Export, Typed::Done) if !text.is_empty() => return Request::Export(text.into()),
            (Purpose::PageOf(best), Typed::Done) => {
                match prompt.selected {
                    Some(0) => self.select_option(PlanOption { side: self.side, option: best }),
                    Some(_) => {}
                    None => {
                        self.prompt = Some(prompt);
                        return Request::None;
                    }
                }
                return self.name_page();
            }
            (Purpose::Page, Typed::Done) if !text.is_empty() => return Request::Page(text.into()),
            (Purpose::Fired, Typed::Done) => {
                let fired = prompt.selected.and_then(|at| self.fired_options(&text).get(at).copied());
                self.fired = fired.or(self.fired);
                self.prompt = Some(match fired {
                    Some(option) => Prompt::new(Purpose::Observe(option), TypedLine::default()),
                    None => prompt,
                });
                return Request::None;
            }
            (Purpose::Observe(option), Typed::Done) if text.trim().is_empty() => {
                self.notice = Some("nothing was typed".to_owned());
                self.prompt = Some(Prompt::new(Purpose::Observe(option), TypedLine::default()));
                return Request::None;
            }
            (Purpose::Observe(option), Typed::Done) => return self.observe(option, text.trim()),
            (Purpose::SaveAs, Typed::Done) if !text.is_empty() => return Request::SaveAs(text.into()),
            _ => {}
        }
        if typed == Typed::Changed {
            self.prompt = Some(prompt);
        }
        Request::None
    }

    /// Withdraws the last observation if the key is `y`. Any other key leaves it.
    fn answer_forget(&mut self, key: &KeyEvent) -> Request {
        if key.code == KeyCode::Char('y') {
            return self.forget_last();
        }
        self.notice = Some("observations stay".to_owned());
        Request::None
    }

    /// Number of choices that a line offers.
    fn choices(&self, prompt: &Prompt) -> usize {
        match prompt.purpose {
            Purpose::Palette => prompt.commands().len(),
            Purpose::Fired => self.fired_options(prompt.line.value()).len(),
            Purpose::PageOf(_) => 2,
            _ => 0,
        }
    }

    /// Puts a pasted text into the line being typed, if there is one.
    pub fn paste(&mut self, text: &str) {
        self.notice = if let Some(prompt) = &mut self.prompt {
            let note = prompt.line.paste(text);
            prompt.select_first();
            if prompt.purpose == Purpose::Find {
                let typed = prompt.line.value().to_owned();
                self.find(&typed, false);
            }
            note
        } else if self.editor.entry.is_some() {
            self.editor.paste(text)
        } else {
            Some("nothing was pasted: no value is being typed".to_owned())
        };
    }

    /// Finds a text. Plan selects the value that contains the text; the other screens list only the options or lines that contain it.
    pub(super) fn find(&mut self, text: &str, next: bool) {
        match self.screen {
            Screen::Plan => {
                self.editor.find(text, next);
                self.follow_field();
            }
            Screen::Studies => self.studies.filter = text.to_owned(),
            Screen::Compare | Screen::Flight | Screen::Accuracy => {
                self.listing.filter = text.to_owned();
                self.select_listed(0);
            }
        }
    }
}
