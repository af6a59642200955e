//! Keys of the accuracy screen.

use crate::study::question::StudyKind;
use crate::tui::app::{App, Request};
use crate::tui::keymap::Action;

impl App {
    pub(super) fn act_on_accuracy(&mut self, action: Action) -> Request {
        match action {
            Action::Open | Action::Rerun => return self.begin_study(StudyKind::Accuracy),
            Action::Cancel => return self.cancel_study(StudyKind::Accuracy),
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            other => return self.act_anywhere(other),
        }
        Request::None
    }
}
