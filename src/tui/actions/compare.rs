//! Keys of the comparison: the selected option, sorting, filter.

use super::PAGE_LINES;
use crate::tui::app::{App, Request};
use crate::tui::keymap::Action;

/// Lines that a page key scrolls the sentences of an option.
const ZOOM_LINES: u16 = 3;

impl App {
    pub(super) fn act_on_compare(&mut self, action: Action) -> Request {
        if let Some(request) = self.act_on_remedies(action) {
            return request;
        }
        let page = PAGE_LINES as isize;
        match action {
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            // One option fills the screen: a page key scrolls its sentences and selects no other option.
            Action::PageUp if self.zoom => self.zoom_scroll = self.zoom_scroll.saturating_sub(ZOOM_LINES),
            Action::PageDown if self.zoom => self.zoom_scroll = self.zoom_scroll.saturating_add(ZOOM_LINES),
            Action::PageUp => self.select_listed(-page),
            Action::PageDown => self.select_listed(page),
            Action::First => self.select_listed(isize::MIN),
            Action::Last => self.select_listed(isize::MAX),
            Action::Open => (self.zoom, self.zoom_scroll) = (!self.zoom, 0),
            Action::Sort => {
                self.listing.sort = self.listing.sort.next();
                self.listing.reversed = false;
            }
            Action::Reverse => self.listing.reversed = !self.listing.reversed,
            Action::AddOption => return self.add_option(),
            Action::RemoveOption => return self.remove_option(),
            Action::Why | Action::Try => return self.ask_for_remedies(),
            Action::Baseline => {
                let same = self.listing.baseline == Some(self.selected);
                self.listing.baseline = (!same).then_some(self.selected);
            }
            other => return self.act_anywhere(other),
        }
        Request::None
    }
}
