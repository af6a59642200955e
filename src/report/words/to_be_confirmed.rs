//! Assumed values of a plan, and the lines to confirm before its shot.

use std::collections::BTreeSet;

use itertools::Itertools;

use super::objections::of_other_shot;
use super::warnings::{far_limits, far_slide, turning};
use super::{false_names, plan_warnings};
use crate::plan::assumed::{AssumedValue, assumed_values};
use crate::plan::keys::uncertainty;
use crate::plan::observations::{Observations, fitted_files};
use crate::plan::usual::Unusual;
use crate::report::language::{phrase, say};
use crate::report::observed;
use crate::study::Case;
use crate::study::judge::Judgement;
use crate::study::observed::other_shot::other_shots;
use crate::study::observed::{AboveBand, Comparison};

/// Warning that comments of the plan still mark values as assumed; `None` where none does.
pub fn marked_as_assumed(case: &Case) -> Option<String> {
    let count = assumed_values(&case.source.text).count();
    let text = || {
        say!(
            "values marked `assumed` in the plan: {count}; find yours, and take the mark out of the line",
            count
        )
    };
    (count > 0).then(text)
}

/// Number of assumed values: values that the plan marks as assumed, leaves out, or takes as exact.
pub fn count_assumed(case: &Case) -> usize {
    let marked: Vec<AssumedValue<'_>> = assumed_values(&case.source.text).collect();
    marked.len() + case.plan.left_out.len() + assumed_exact(case, &marked).count()
}

/// Inputs of `[uncertainty]` that are exact, or nearly, and not marked as assumed. Only marks in that section count: other sections
/// have keys of the same names.
fn assumed_exact(case: &Case, marked: &[AssumedValue<'_>]) -> impl Iterator<Item = &'static str> {
    let own = marked.iter().filter(|value| value.section == uncertainty::SECTION.title);
    let marked: BTreeSet<String> = own.filter_map(AssumedValue::key).map(str::to_owned).collect();
    case.plan.nearly_exact_inputs().into_iter().filter(move |key| !marked.contains(*key))
}

/// A line that the signer confirms before the shot.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ToConfirm {
    /// What to do before the line can be confirmed.
    pub about: About,
    /// The line.
    pub text: String,
}

/// What to do before a line can be confirmed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum About {
    /// Find a value on site.
    AssumedValue,
    /// Film a launch.
    Film,
    /// Compare with films of other blasts.
    OtherBlasts,
    /// Look at the ground, or limit the slide.
    Slide,
    /// Keep tires from turning.
    Turning,
    /// Look at something else.
    More,
}

/// Lines with the same `about`.
fn all(about: About, lines: impl IntoIterator<Item = String>) -> impl Iterator<Item = ToConfirm> {
    lines.into_iter().map(move |text| ToConfirm { about, text })
}

/// Lines to confirm before the shot, each once: lines that [the plan](confirmed_of_plan) leaves open, lines from `files` of
/// observations, and lines from `compared`: values above their band, films that were not read, and films of other blasts.
pub fn to_be_confirmed(
    case: &Case,
    fired: Option<(usize, &Judgement)>,
    files: &[Observations],
    compared: &Comparison,
) -> Vec<ToConfirm> {
    let of_plan = confirmed_of_plan(case, fired).into_iter();
    let fitted: Vec<_> = files.iter().filter(|file| file.was_fitted(&case.plan.fitted_from)).collect();
    let of_files = fitted_elsewhere(case, files).into_iter().chain(observed::perhaps_one_shot(&fitted));
    let of_files = of_files.chain(other_shots_unknown(case, files)).chain(observed::remarks(files));
    let of_files = all(About::More, of_files).chain(all(About::OtherBlasts, other_blasts(compared)));
    let unread = compared.unread_films().iter();
    let unread = unread.map(|film| {
        say!("{film}: this page does not read it: compare it by --observed, or in the terminal by Fit", film)
    });
    let of_files = all(About::Film, seen_above(case, compared).chain(unread)).chain(of_files);
    of_plan.chain(of_files).unique_by(|line| line.text.clone()).collect()
}

/// Whether there is a line to confirm. Assumed values are counted first: screens ask at every repaint, and most plans have assumed
/// values.
pub fn is_anything_to_be_confirmed(
    case: &Case,
    fired: Option<(usize, &Judgement)>,
    files: impl FnOnce() -> Vec<Observations>,
    compared: &Comparison,
) -> bool {
    count_assumed(case) > 0 || !to_be_confirmed(case, fired, &files(), compared).is_empty()
}

/// Lines that a plan leaves to confirm before its shot: values that are assumed, exact or unusual, other possible slips, and
/// warnings of the option that is `fired`.
fn confirmed_of_plan(case: &Case, fired: Option<(usize, &Judgement)>) -> Vec<ToConfirm> {
    let unusual = case.plan.unusual();
    // Only that value counts as unusual. Another value of the same key is confirmed by itself.
    let is_unusual =
        |value: &&str| unusual.iter().any(|one| *value == format!("{} = {}", one.key.name, one.value));
    let all_marked: Vec<AssumedValue<'_>> = assumed_values(&case.source.text).collect();
    let is_launch = |key: Option<&str>| key == Some(uncertainty::LAUNCH_COMMON_PERCENT.name);
    let about_key = |key| match is_launch(key) && case.plan.takes_launch_as_filmed() {
        true => About::Film,
        false => About::AssumedValue,
    };
    let marked = all_marked.iter().filter(|value| !is_unusual(&value.line));
    let marked = marked.map(|value| ToConfirm { about: about_key(value.key()), text: value.line.to_owned() });
    let left_out = case.plan.left_out.iter().map(|key| ToConfirm {
        about: about_key(Some(*key)),
        text: say!("{key}: left out, a small value of the program", key),
    });
    let is_own = |one: &&Unusual| one.section.title == uncertainty::SECTION.title;
    let exact = assumed_exact(case, &all_marked)
        .filter(|key| unusual.iter().filter(is_own).all(|one| one.key.name != *key));
    let exact: Vec<String> = exact.map(|key| say!("{key}: exact, or nearly", key)).collect();
    let unusual = unusual.iter().map(|Unusual { key, value, usual: [low, high], is_gap, .. }| match is_gap {
        true => say!("{}: rows {value} ms apart", key.name, value),
        false => say!("{} = {value}: usual are {low} to {high}", key.name, value, low, high),
    });
    let values =
        marked.chain(left_out).chain(all(About::AssumedValue, exact)).chain(all(About::More, unusual));
    let film = all(About::Film, plan_warnings::without_film(case));
    let others = plan_warnings::to_be_looked_at(case)
        .into_iter()
        .chain(plan_warnings::kind_of_own_rope(case))
        .chain(plan_warnings::of_example(case));
    let of_fired = |about, told: fn(&Case, &Judgement) -> Option<String>| {
        all(about, fired.and_then(|(_, judged)| told(case, judged)))
    };
    let of_fired = of_fired(About::Turning, turning)
        .chain(of_fired(About::Slide, far_slide))
        .chain(all(About::More, fired.into_iter().flat_map(|(_, judged)| far_limits(case, judged))))
        .chain(all(About::More, fired.and_then(|(option, _)| false_names::own_words(&case.plan, option))));
    // The first of equal lines stays: the line about the film is among `others`, too.
    values
        .chain(film)
        .chain(all(About::More, others))
        .chain(of_fired)
        .unique_by(|line| line.text.clone())
        .collect()
}

/// Warning that `files` lack some of the films that were fitted into the plan: nobody sees what its launches stand on.
fn fitted_elsewhere(case: &Case, files: &[Observations]) -> Option<String> {
    let fitted_from = &case.plan.fitted_from;
    let given = files.iter().filter(|file| file.was_fitted(fitted_from)).count();
    let is_elsewhere = !fitted_from.is_empty() && given < fitted_files(fitted_from).max(1);
    let text = "films that the launches were fitted to are not given with this plan: are they of this site?";
    is_elsewhere.then(|| phrase(text).to_owned())
}

/// Lines for films of other blasts beside the plan, one per file, with its name: these films may speak against the launches, too.
fn other_blasts(compared: &Comparison) -> impl Iterator<Item = String> {
    let names = compared.other_blasts().iter();
    names.map(|file| say!("{file}: films of another blast, not compared: is the launch the same?", file))
}

/// Observations above the height, force or other value that 19 of 20 shots of the plan reach: too few to contradict the plan, and
/// on the side of danger.
fn seen_above(case: &Case, compared: &Comparison) -> impl Iterator<Item = String> {
    compared.above_bands().iter().map(|AboveBand { seen, end }| {
        let place = observed::place(case, seen.option, &seen.watched);
        let [value, end] = [seen.value, *end].map(|value| observed::value_by_sd(value, seen.sd));
        say!(
            "{place}: {value} was seen, above what 19 of 20 shots of this plan reach, {end}",
            place,
            value,
            end
        )
    })
}

/// Lines for a charge, stemming or mass that an earlier shot may have had otherwise: the plan or the file of that shot does not
/// state it.
pub fn other_shots_unknown(case: &Case, files: &[Observations]) -> impl Iterator<Item = String> {
    let others = other_shots(case, files).into_iter().filter(|other| !other.differs());
    others.map(|other| of_other_shot(&other))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PlanSource;

    fn lines(case: &Case) -> Vec<String> {
        let all = to_be_confirmed(case, None, &[], &Comparison::nothing_seen());
        all.into_iter().map(|line| line.text).collect()
    }

    /// A value written as 0 gets a line like a value left out, and counts as assumed once, marked or not.
    #[test]
    fn what_is_taken_as_exact_is_confirmed() {
        let listed = |old: &str, new: &str| {
            let text = include_str!("../../../plans/amur-three-rows.toml");
            assert!(text.contains(old), "{old}");
            let text = text.replacen(old, new, 1);
            let case = Case::parse(PlanSource { text, ..PlanSource::default() }).expect("a plan");
            let listed = lines(&case);
            assert_eq!(listed.len(), count_assumed(&case), "{listed:?}");
            listed.into_iter().filter(|line| line.contains("hole_position_m")).collect::<Vec<_>>()
        };
        let line = "hole_position_m = 0.05           # of a hole off the middle of its tire, along each axis; assumed: measure some";
        assert_eq!(listed(line, "hole_position_m = 0"), ["hole_position_m: exact, or nearly"]);
        assert_eq!(listed(line, "hole_position_m = 0 # assumed"), ["hole_position_m = 0"]);
        assert_eq!(listed(line, ""), ["hole_position_m: left out, a small value of the program"]);
        assert_eq!(listed(line, "hole_position_m = 0.05"), [""; 0]);
    }

    /// Other sections have keys of the same names, friction and slack, which a new plan marks. Such marks take no line away.
    #[test]
    fn a_namesake_takes_no_box_of_what_is_exact() {
        let text = include_str!("../../../plans/amur-three-rows.toml");
        for (own, exact, other, marked, key) in [
            (
                "friction = [0.4, 0.6] ",
                "friction = [0.5, 0.5] ",
                "friction = 0.5 ",
                "friction = 0.5 # assumed ",
                "friction",
            ),
            (
                "slack_percent = [1.5, 2.5] ",
                "slack_percent = [16, 16] #",
                "slack_percent = 2\n",
                "slack_percent = 16\n",
                "slack_percent",
            ),
        ] {
            assert!(text.contains(own) && text.contains(other), "{own}");
            let text = text.replacen(own, exact, 1).replacen(other, marked, 1);
            let case = Case::parse(PlanSource { text, ..PlanSource::default() }).expect("a plan");
            let listed = lines(&case);
            let is_told = |line: &String| {
                line.starts_with(&format!("{key}: exact")) || line.starts_with(&format!("{key} = [16"))
            };
            assert!(listed.iter().any(is_told), "{listed:?}");
        }
    }

    /// A value that is assumed and unusual has one line. An assumed value under the same key of another section keeps its own line.
    #[test]
    fn an_unusual_value_takes_the_box_of_no_other() {
        let text = include_str!("../../../plans/amur-three-rows.toml");
        let text = text.replacen("slack_percent = 2\n", "slack_percent = 40 # assumed\n", 1);
        let case = Case::parse(PlanSource { text, ..PlanSource::default() }).expect("a plan");
        let listed = lines(&case);
        let of_slack: Vec<&String> = listed.iter().filter(|line| line.contains("slack_percent")).collect();
        assert_eq!(of_slack, ["slack_percent = [1.5, 2.5]", "slack_percent = 40: usual are 0 to 15"]);
    }
}
