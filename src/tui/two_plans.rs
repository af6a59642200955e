//! Two plans side by side.
//!
//! Each plan is an [`App`] of its own, with its file, edits and jobs. The screens show the plan of the selected option. The other plan
//! waits in [`App::beside`]. Compare lists the options of both plans.

use std::mem;
use std::path::Path;

use super::app::App;
use super::compare::{PlanOptions, listed};
use super::plan_side::{PlanOption, PlanSide};
use crate::plan::edit::differences::differences;
use crate::sorting::sort_by_key;
use crate::verdict::{Verdict, VerdictWord};

impl App {
    /// Shows a second plan beside this plan. This plan stays in front.
    pub fn put_beside(&mut self, second: App) {
        self.beside = Some(Box::new(App { side: PlanSide::B, ..second }));
        self.find_differences();
        self.share_screen();
    }

    /// The plans shown, in the order of the command line.
    pub fn plans(&self) -> Vec<&App> {
        let mut plans: Vec<&App> = [self].into_iter().chain(self.beside.as_deref()).collect();
        sort_by_key(&mut plans, |app| app.side);
        plans
    }

    /// The plan of a side, if it is shown.
    pub fn of_side(&self, side: PlanSide) -> Option<&App> {
        self.plans().into_iter().find(|app| app.side == side)
    }

    /// The letter of the plan in front and a space; empty if there is only one plan.
    pub fn letter(&self) -> String {
        self.beside.as_ref().map_or_else(String::new, |_| format!("{} ", self.side.letter()))
    }

    /// The letter of the plan and the name of its file: `A rows.toml`.
    pub fn file_of_letter(&self) -> String {
        let path = Path::new(&self.case.source.path);
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        format!("{} {name}", self.side.letter())
    }

    /// Options that both plans have by name but judge differently: `42 ms A PASS, B FAIL`. Options with a pass in either plan come first.
    pub fn verdicts_that_differ(&self) -> Vec<String> {
        let [first, second] = self.plans()[..] else { return Vec::new() };
        let word = |app: &App, name: &str| {
            let option = app.case.plan.delays.iter().position(|delay| delay.name == name)?;
            app.judgement(option).map(|_| app.word(option))
        };
        let names = first.case.plan.delays.iter().map(|delay| delay.name.as_str());
        let differ = |name: &str| {
            let [a, b] = [first, second].map(|app| word(app, name));
            let both = [a?, b?];
            let is_minor = both.iter().all(|word| word.verdict() != Verdict::Pass);
            let [a, b] = both.map(VerdictWord::for_people);
            (a != b).then(|| (is_minor, format!("{name} A {a}, B {b}")))
        };
        let mut all: Vec<(bool, String)> = names.filter_map(differ).collect();
        sort_by_key(&mut all, |(is_minor, _)| *is_minor);
        all.into_iter().map(|(_, words)| words).collect()
    }

    /// Letter of the plan beside and its verdict on the option with the selected option's name; `None` if both verdicts are the same.
    pub fn verdict_beside(&self) -> Option<[&'static str; 2]> {
        let (beside, name) = (self.beside.as_deref()?, &self.case.plan.delays.get(self.selected)?.name);
        let option = beside.case.plan.delays.iter().position(|delay| delay.name == *name)?;
        let here = self.judgement(self.selected).map(|_| self.word(self.selected))?;
        let there = beside.judgement(option).map(|_| beside.word(option))?;
        (here != there).then(|| [beside.side.letter(), there.for_people()])
    }

    /// The listed options of all plans, in order.
    pub fn listed_options(&self) -> Vec<PlanOption> {
        let plans = self.plans();
        let options: Vec<PlanOptions<'_>> = plans.iter().map(|app| app.to_list()).collect();
        let options = listed(&self.listing, &options).into_iter();
        options.map(|(plan, option)| PlanOption { side: plans[plan].side, option }).collect()
    }

    /// The selected option.
    pub fn selected_option(&self) -> PlanOption {
        PlanOption { side: self.side, option: self.selected }
    }

    /// Selects an option, and brings its plan to the front.
    pub fn select_option(&mut self, at: PlanOption) {
        if at.side != self.side {
            self.swap_plans();
            // The user continues to work, so the next request to quit warns again.
            self.quit_warned = false;
        }
        (self.selected, self.has_selected, self.zoom_scroll) = (at.option, true, 0);
    }

    /// Brings the plan beside to the front. The screen stays.
    pub fn swap_plans(&mut self) {
        self.share_screen();
        let Some(mut other) = self.beside.take() else { return };
        mem::swap(&mut self.quit_warned, &mut other.quit_warned);
        mem::swap(&mut self.areas, &mut other.areas);
        mem::swap(&mut self.prompt, &mut other.prompt);
        mem::swap(&mut self.notice, &mut other.notice);
        mem::swap(&mut self.differences, &mut other.differences);
        mem::swap(self, &mut other);
        self.beside = Some(other);
    }

    /// Finds the differences between both plans again.
    pub fn find_differences(&mut self) {
        let texts = self.plans().into_iter().map(|app| app.editor.text.as_str()).collect::<Vec<_>>();
        self.differences = <[&str; 2]>::try_from(texts).map_or_else(|_| Vec::new(), differences);
    }

    /// Copies the state of the screen to the plan beside: everything that does not belong to one plan.
    pub fn share_screen(&mut self) {
        let Some(mut other) = self.beside.take() else { return };
        other.screen = self.screen;
        let [here, there] = [&self.record, &other.record];
        (self.other_plan_has_more_observations, other.other_plan_has_more_observations) =
            (!there.is_within(here), !here.is_within(there));
        other.zoom = self.zoom;
        other.help = self.help;
        other.help_scroll = self.help_scroll;
        other.shows_differences = self.shows_differences;
        other.theme = self.theme;
        other.beat = self.beat;
        other.shown_shot = self.shown_shot;
        other.listing.sort = self.listing.sort;
        other.listing.reversed = self.listing.reversed;
        other.listing.filter.clone_from(&self.listing.filter);
        self.beside = Some(other);
    }
}
