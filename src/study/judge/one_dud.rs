//! One dud: judges the planned shot with each single hole left out, like a power grid with each single line out (N − 1).
//!
//! 1. Holes that are mirror images of each other, by a mirror plane of shelter and shot, are judged once. So are holes whose duds take the
//!    same holes along.
//! 2. Every place gets a quick check, and the worst place a full one. If neither that place nor the option fails, every other place without
//!    a pass in the quick check gets a full check, too. Nothing else varies.
//! 3. Samples follow if the plan says `withstands_one_dud`, the option does not fail, and the worst place does not fail as planned. Every
//!    place gets [`LOOK`] samples. The place that fails most often need not be the place nearest to a limit as planned.
//! 4. The [`WORST_PLACES`] worst places are sampled until they are sure. So is every place whose first samples do not show that surely few
//!    enough shots fail.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use itertools::Itertools;

use super::grounds::Evidence;
use crate::scene::{Firing, Mirror, Shot, Wiring};
use crate::sorting::{sort_by, sorted};
use crate::study::as_planned::check_many::{check_summary, or_failed_run};
use crate::study::as_planned::quick_check::quick_check;
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::run_sample::ShotToSample;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sample_until_sure::{RISK_OF_USUAL, USUAL_OF_PASS, sample_shots};
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::work::batch::run_batch;
use crate::study::{Case, Computed, Context, NoResult, ShotSummary};
use crate::verdict::{Limits, Quantity, Verdict};

/// Least number of places of a dud that are sampled until they are sure, the worst first, if the plan asks for it.
const WORST_PLACES: usize = 3;
/// Samples of every place in the first look.
const LOOK: usize = 50;

/// Expected number of samples with one hole left out; 0 if the plan does not ask for them.
pub fn expected_dud_samples(case: &Case, shot: &Shot) -> usize {
    let limits = &case.plan.limits;
    // If the plan accepts more risk, a verdict takes fewer samples.
    let of_place = USUAL_OF_PASS as f64 * RISK_OF_USUAL / (1e-2 * limits.dud_risk_percent);
    match limits.withstands_one_dud {
        true => LOOK * shot.firings.len() + WORST_PLACES * of_place as usize,
        false => 0,
    }
}

/// The planned shot with one dud, at the worst place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneDud {
    /// Index of the blast row of the hole.
    pub row: usize,
    /// Number of the hole in its row, from 0.
    pub number: usize,
    /// The planned shot without that hole.
    pub planned: ShotSummary,
    /// Number of places where a dud leaves no pass: the shot fails or is open.
    pub not_passing: usize,
    /// Number of places where a dud makes the shot exceed a limit.
    pub failing: usize,
    /// Number of all places: the number of holes.
    pub places: usize,
    /// Samples of the worst place; `None` if the plan does not ask for them, or the option fails without them.
    pub sampled: Option<SampledDud>,
}

/// Result of the samples of a shot without one hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledDud {
    /// Index of the blast row of the hole.
    pub row: usize,
    /// Number of the hole in its row, from 0.
    pub number: usize,
    /// How many of the shots fail.
    pub risk: RiskSummary,
}

impl OneDud {
    /// Whether the option withstands any one dud, as far as asked for. There is no pass while any place does not pass.
    pub fn verdict(&self) -> Verdict {
        let sampled = self.sampled.map_or(Verdict::Pass, |sampled| sampled.risk.verdict);
        let places = if self.not_passing > 0 { Verdict::Undecided } else { Verdict::Pass };
        self.planned.verdict.max(sampled).max(places)
    }

    /// The quantity that uses the greatest share of its limit without the hole.
    pub fn nearest_limit(&self, case: &Case) -> Quantity {
        let share = |quantity: &Quantity| {
            case.limits.get(*quantity).map_or(-1.0, |limit| self.planned.get(*quantity).value / limit)
        };
        let all = Quantity::ALL.into_iter().rev();
        all.max_by(|a, b| share(a).total_cmp(&share(b))).unwrap_or(Quantity::Height)
    }
}

/// A hole that does not fire, by its index, and how other holes depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Dud {
    hole: usize,
    wiring: Wiring,
}

impl Dud {
    /// The shot without the dud.
    fn of(self, shot: &Shot) -> Shot {
        shot.with_dud(self.hole, self.wiring)
    }
}

/// The duds that differ. Each has the holes whose duds make the same motion, mirror images included. A hole has several duds if the plan
/// leaves open which holes a dud takes along.
fn places(case: &Case, shot: &Shot) -> Vec<(Dud, Vec<usize>)> {
    // Two holes may lie under one tire, and the launches of a row vary together.
    let causes = |firings: &[Firing]| sorted(firings.iter().map(|hole| (hole.row, hole.cause())));
    let reflected = |firings: &[Firing], mirror: &Mirror| -> Vec<Firing> {
        firings.iter().map(|firing| firing.mirrored(mirror)).collect()
    };
    let all = causes(&shot.firings);
    let is_own_image = |mirror: &Mirror| causes(&reflected(&shot.firings, mirror)) == all;
    let mirrors: Vec<_> = case.scene().mirrors_with_slope().filter(|mirror| is_own_image(mirror)).collect();
    let mut alike: BTreeMap<_, (Dud, Vec<usize>)> = BTreeMap::new();
    let wirings = Wiring::all().take(if shot.fired_through { usize::MAX } else { 1 });
    for (wiring, hole) in wirings.cartesian_product(0..shot.firings.len()) {
        let lost = shot.lost_with((0..shot.firings.len()).map(|n| n == hole).collect(), wiring);
        let lost = shot.firings.iter().zip(lost).filter(|(_, lost)| *lost).map(|(firing, _)| *firing);
        let mut images = vec![lost.collect_vec()];
        for mirror in &mirrors {
            let of_all = images.iter().map(|image| reflected(image, mirror)).collect_vec();
            images.extend(of_all);
        }
        let first = images.iter().map(|image| causes(image)).min().unwrap_or_default();
        let (_, holes) = alike.entry(first).or_insert((Dud { hole, wiring }, Vec::new()));
        if !holes.contains(&hole) {
            holes.push(hole);
        }
    }
    sorted(alike.into_values())
}

/// What is known of one place of a dud.
#[derive(Clone, Debug, PartialEq)]
struct Place {
    /// The hole that is left out.
    dud: Dud,
    /// Holes whose duds make the same motion.
    holes: Vec<usize>,
    /// The shot without the dud.
    planned: ShotSummary,
    /// Whether the place got a full check after the quick one.
    is_checked: bool,
}

/// Whether a shot that otherwise passes withstands any one dud, if the plan makes that part of the verdict. `None` if the time was up.
pub fn withstands_one_dud(
    context: &Context<'_>,
    shot: &Shot,
    sampling: &Sampling,
) -> Result<Option<Evidence<Verdict>>, NoResult> {
    if !context.case.plan.limits.withstands_one_dud {
        return Ok(Some(Evidence::NotAsked));
    }
    match judge_one_dud(context, shot, Some(sampling), false) {
        Err(NoResult::Failed(_)) => Ok(Some(Evidence::Known(Verdict::Undecided))),
        found => Ok(found?.map(|one_dud| Evidence::Known(one_dud.verdict()))),
    }
}

/// Judges a shot with any one hole left out. With a `sampling`, places are also sampled, unless the worst place fails as planned. If the
/// shot `fails_anyway`, only the worst place gets a full check. `None` if the time was up, or the shot has no hole.
pub fn judge_one_dud(
    context: &Context<'_>,
    shot: &Shot,
    sampling: Option<&Sampling>,
    fails_anyway: bool,
) -> Result<Option<OneDud>, NoResult> {
    let &Context { case, control, .. } = context;
    let places = places(case, shot);
    let checked = run_batch(&places, control, |(dud, _)| or_failed_run(quick_check(context, &dud.of(shot))))?;
    let Some(checked) = checked.into_iter().collect::<Option<Vec<_>>>() else { return Ok(None) };
    let place = |((dud, holes), planned)| Place { dud, holes, planned, is_checked: false };
    let mut places: Vec<Place> = places.into_iter().zip(checked).map(place).collect();
    let check = |duds: &[Dud]| {
        let check = |dud: &Dud| or_failed_run(check_summary(context, &dud.of(shot)));
        Ok(run_batch(duds, control, check)?.into_iter().collect())
    };
    if check_worst_places(case, &mut places, fails_anyway, check)?.is_none() {
        return Ok(None);
    }
    let Some(&Place { dud: Dud { hole: worst, .. }, planned, .. }) =
        places.iter().find(|place| place.is_checked)
    else {
        return Ok(None);
    };
    let mut sampled = None;
    if let Some(sampling) = sampling.filter(|_| planned.verdict != Verdict::Fail) {
        sampled = sample_worst(context, shot, &places, sampling)?;
        if sampled.is_none() {
            return Ok(None);
        }
    }
    let count = |is_counted: fn(Verdict) -> bool| {
        let counted = places.iter().filter(|place| is_counted(place.planned.verdict));
        counted.flat_map(|place| &place.holes).unique().count()
    };
    Ok(Some(OneDud {
        row: shot.firings[worst].row,
        number: shot.firings[worst].number,
        planned,
        not_passing: count(|verdict| verdict != Verdict::Pass),
        failing: count(|verdict| verdict == Verdict::Fail),
        places: shot.firings.len(),
        sampled,
    }))
}

/// Checks places in full with `check` and sorts all places, the worst first. The worst place by the quick checks comes first. If that place
/// does not fail, and the shot does not fail anyway, all other places that do not pass follow. `None` if the time was up.
fn check_worst_places(
    case: &Case,
    places: &mut [Place],
    fails_anyway: bool,
    check: impl Fn(&[Dud]) -> Result<Option<Vec<ShotSummary>>, NoResult>,
) -> Result<Option<()>, NoResult> {
    let utilization = |place: &Place| place.planned.utilization(&case.limits);
    let worst_first = |a: &Place, b: &Place| {
        b.planned.verdict.cmp(&a.planned.verdict).then(utilization(b).total_cmp(&utilization(a)))
    };
    sort_by(places, worst_first);
    let (worst, others) = places.split_at_mut(places.len().min(1));
    let check_all = |due: Vec<&mut Place>| {
        let duds: Vec<Dud> = due.iter().map(|place| place.dud).collect();
        let checked = check(&duds)?;
        Ok(checked.map(|checked| {
            for (place, planned) in due.into_iter().zip(checked) {
                (place.planned, place.is_checked) = (planned, true);
            }
        }))
    };
    let mut done = check_all(worst.iter_mut().collect())?;
    let fails = worst.iter().any(|place| place.planned.verdict == Verdict::Fail);
    if done.is_some() && !fails && !fails_anyway {
        done = check_all(others.iter_mut().filter(|place| place.planned.verdict != Verdict::Pass).collect())?;
    }
    sort_by(places, worst_first);
    Ok(done)
}

/// Samples the worst places, each with its hole left out, until surely fewer or surely more than `dud_risk_percent` fail. Returns the
/// result of the worst place; `None` if the time was up.
fn sample_worst(
    context: &Context<'_>,
    shot: &Shot,
    places: &[Place],
    sampling: &Sampling,
) -> Result<Option<SampledDud>, NoResult> {
    let mut case = context.case.clone();
    case.limits.accepted_risk = case.plan.limits.dud_risk_percent * 1e-2;
    let context = Context { case: &case, ..*context };
    let all = places.iter().collect_vec();
    let look = Sampling::exactly(LOOK.min(sampling.most), sampling.seed);
    let Some(looks) = sample_without(&context, shot, &all, look)? else { return Ok(None) };
    let worst = places_to_sample(all.into_iter().zip(looks).collect(), &case.limits);
    let sampled = sample_without(&context, shot, &worst, Sampling { least: 0, ..*sampling })?;
    let of_place = |(place, sampled): (&&Place, &SampledShot)| {
        let Firing { row, number, .. } = shot.firings[place.dud.hole];
        SampledDud { row, number, risk: RiskSummary::of(sampled) }
    };
    let duds = worst.iter().zip(sampled.iter().flatten()).map(of_place);
    let share = |dud: &SampledDud| dud.risk.failing_share();
    Ok(duds.max_by(|a, b| a.risk.verdict.cmp(&b.risk.verdict).then(share(a).total_cmp(&share(b)))))
}

/// The places to sample until they are sure: the worst places by a first look, and those for which the look is not sure.
fn places_to_sample<P>(mut looks: Vec<(P, SampledShot)>, limits: &Limits) -> Vec<P> {
    let by_look = |sampled: &SampledShot| {
        let runs = || sampled.samples.iter().map(|sample| sample.finest());
        let most = runs().map(|run| run.utilization(limits)).fold(0.0, f64::max);
        (runs().filter(|run| run.verdict != Verdict::Pass).count(), most)
    };
    sort_by(&mut looks, |(_, a), (_, b)| by_look(b).partial_cmp(&by_look(a)).unwrap_or(Ordering::Equal));
    let is_sure = |sampled: &SampledShot| sampled.bounds.interval[1] < sampled.bounds.accepted;
    let ranked = looks.into_iter().enumerate();
    let due = ranked.filter(|(rank, (_, sampled))| *rank < WORST_PLACES || !is_sure(sampled));
    due.map(|(_, (place, _))| place).collect()
}

/// Samples a shot without the hole of each of these places; `None` if the time was up.
fn sample_without(
    context: &Context<'_>,
    shot: &Shot,
    places: &[&Place],
    sampling: Sampling,
) -> Result<Option<Vec<SampledShot>>, NoResult> {
    let &Context { case, compute, control, .. } = context;
    let shots: Vec<Shot> = places.iter().map(|place| place.dud.of(shot)).collect();
    let target = |(shot, place): (_, &&Place)| {
        ShotToSample::new(case, shot, compute, sampling).with_planned(place.planned)
    };
    let targets: Vec<ShotToSample<'_>> = shots.iter().zip(places).map(target).collect();
    let Computed { value, partial } = sample_shots(&targets, control)?;
    Ok(Some(value).filter(|_| !partial))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::study::samples::failure_bounds::{ErrorShare, FailureBounds};
    use crate::study::standing::tests::{case as standing_case, sampled};
    use crate::study::{ComputeSettings, StudyControl, ValueWithError};
    use crate::verdict::PerQuantity;

    fn case(more: &str) -> Case {
        let text =
            include_str!("../../../tests/fixtures/amur-three-rows.toml").replace("name = \"42 ms\"", more);
        Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    /// Five holes a row under a shelter that is its own mirror image across x: three places a row, of 2, 2 and 1 holes.
    #[test]
    fn places_that_are_mirror_images_are_judged_once() {
        let case = case("name = \"42 ms\"");
        let option = case.plan.delays.iter().position(|delay| delay.name == "42 ms").expect("an option");
        let shot = &case.shots[option];
        let places = places(&case, shot);
        assert_eq!(places.iter().map(|(_, holes)| holes.len()).sum::<usize>(), shot.firings.len());
        let columns = shot.firings.len() / 3;
        assert_eq!(places.len(), 3 * columns.div_ceil(2), "{places:?}");
    }

    /// Two holes under one tire fire together. A weak and a strong hole are two places, whichever is listed first. Two equal holes are one
    /// place.
    #[test]
    fn holes_under_one_tire_are_places_of_their_own() {
        let counted = |launches: [f64; 2]| {
            let hole = |launch| format!("{{ x_m = 0, y_m = 0, launch_m_s = {launch} }}");
            let text = format!(
                "shelter = {{ layout = \"grid\", rows = 1, columns = 2, spacing_m = 2 }}\ntire = {{ mass_kg = 280 }}\n\
                 cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}\nground = {{ friction = 0.5 }}\n\
                 blast_row = [{{ name = \"1\", holes = [{}] }}]\nlimits = {{ flight_height_m = 2, cable_safety_factor = 1 }}\n\
                 delay = [{{ name = \"1\", interval_ms = 0 }}]\n",
                launches.map(hole).join(", ")
            );
            let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
            places(&case, &case.shots[0]).into_iter().map(|(_, holes)| holes.len()).collect::<Vec<_>>()
        };
        assert_eq!(counted([1.0, 5.0]), [1, 1]);
        assert_eq!(counted([5.0, 1.0]), [1, 1]);
        assert_eq!(counted([5.0, 5.0]), [2]);
    }

    /// A row is fired through from the left. A dud of its first hole takes along the row and the later rows. A dud of its last hole takes
    /// nothing along.
    #[test]
    fn a_dud_takes_along_what_it_would_have_fired() {
        let case = case("name = \"42 ms\"\nhole_interval_ms = 5\nfired_through = true");
        let option = case.plan.delays.iter().position(|delay| delay.name == "42 ms").expect("an option");
        let shot = &case.shots[option];
        let (rows, columns) = (3, shot.firings.len() / 3);
        let left = |row: usize, number: usize| {
            let hole = shot.firings.iter().position(|f| f.row == row && f.number == number).expect("a hole");
            shot.with_dud(hole, Wiring::default()).firings.len()
        };
        for row in 0..rows {
            assert_eq!(left(row, 0), row * columns, "the row and all later rows");
            assert_eq!(left(row, columns - 1), shot.firings.len() - 1);
            assert_eq!(left(row, 1), shot.firings.len() - columns + 1);
        }
        assert_eq!(places(&case, shot).len(), shot.firings.len());
    }

    /// Rows are fired through from both ends. The middle hole may depend on either end, so the mirror image of a plan has the same worst
    /// dud.
    #[test]
    fn the_mirror_image_of_a_plan_has_the_same_worst_dud() {
        let worst = |launches: [f64; 5]| {
            let hole =
                |(n, launch): (usize, f64)| format!("{{ x_m = {}, y_m = 0, launch_m_s = {launch} }}", 2 * n);
            let holes: Vec<String> = launches.into_iter().enumerate().map(hole).collect();
            let text = format!(
                r#"
shelter = {{ layout = "grid", rows = 2, columns = 5, spacing_m = 2 }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 100 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", holes = [{}] }}]
limits = {{ flight_height_m = 5, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = 0, hole_interval_ms = 20, hole_order = "ends", fired_through = true }}]
"#,
                holes.join(", ")
            );
            let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
            let control = StudyControl::default();
            let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
            let found = judge_one_dud(&context, &case.shots[0], None, false);
            let dud = found.expect("a result").expect("in time");
            assert_eq!(dud.places, 5);
            dud.planned.values
        };
        let plain = worst([3.0, 6.0, 5.0, 4.0, 7.0]);
        let mirrored = worst([7.0, 4.0, 5.0, 6.0, 3.0]);
        // The sums of the mirror image are rounded differently.
        for quantity in Quantity::ALL {
            let [value, image] = [&plain, &mirrored].map(|values| values.get(quantity).value);
            assert!((value - image).abs() <= 1e-6 * value, "{quantity:?}: {value} {image}");
        }
    }

    /// The quick check leaves three places open. The full check passes only the first of them.
    #[test]
    fn a_place_left_open_is_no_pass_beside_a_worst_that_passes() {
        let case = case("name = \"42 ms\"");
        let summary = |verdict| ShotSummary { verdict, ..ShotSummary::FAILED_RUN };
        let dud = |hole| Dud { hole, wiring: Wiring::default() };
        let quick = |hole, verdict| {
            let planned = summary(verdict);
            Place { dud: dud(hole), holes: vec![hole], planned, is_checked: false }
        };
        let [open, pass] = [Verdict::Undecided, Verdict::Pass];
        let all = [quick(0, open), quick(1, open), quick(2, open), quick(3, pass)];
        let check = |duds: &[Dud]| {
            let verdict = |dud: &Dud| if dud.hole == 0 { pass } else { open };
            Ok(Some(duds.iter().map(verdict).map(summary).collect()))
        };
        let mut places = all.clone();
        assert_eq!(check_worst_places(&case, &mut places, false, check), Ok(Some(())));
        let told = places.map(|place| (place.dud.hole, place.planned.verdict, place.is_checked));
        assert_eq!(told[..2], [(1, open, true), (2, open, true)]);
        assert!(told[2..].contains(&(0, pass, true)) && told[2..].contains(&(3, pass, false)), "{told:?}");
        let mut places = all.clone();
        assert_eq!(check_worst_places(&case, &mut places, true, check), Ok(Some(())));
        assert_eq!(places.iter().filter(|place| place.is_checked).count(), 1, "it fails anyway");
        let fails = |duds: &[Dud]| Ok(Some(duds.iter().map(|_| summary(Verdict::Fail)).collect()));
        let mut places = all.clone();
        assert_eq!(check_worst_places(&case, &mut places, false, fails), Ok(Some(())));
        assert_eq!(places.iter().filter(|place| place.is_checked).count(), 1, "one that fails is enough");
        let mut places = all.clone();
        assert_eq!(check_worst_places(&case, &mut places, false, |_| Ok(None)), Ok(None), "the time was up");
    }

    #[test]
    fn the_nearest_limit_is_that_of_the_greatest_share() {
        let mut case = case("name = \"42 ms\"");
        case.limits = Limits { height: 2.0, force: 1000.0, drift: None, ..case.limits };
        let nearest = |case: &Case, height, force, drift| {
            let values = PerQuantity { height, force, drift };
            let values = values.map(|&value| ValueWithError { value, error: 0.0 });
            let planned = ShotSummary { values, ..ShotSummary::FAILED_RUN };
            let dud =
                OneDud { row: 0, number: 0, planned, not_passing: 0, failing: 0, places: 1, sampled: None };
            dud.nearest_limit(case)
        };
        // 1.9 of 2 and 2.1 of 2 beside 960 of 1000. A quantity without a limit is near none.
        assert_eq!(nearest(&case, 1.9, 960.0, 0.0), Quantity::Force);
        assert_eq!(nearest(&case, 2.1, 960.0, 9.0), Quantity::Height);
        assert_eq!(nearest(&case, 0.0, 0.0, 9.0), Quantity::Height);
        case.limits.drift = Some(4.0);
        assert_eq!(nearest(&case, 2.1, 960.0, 9.0), Quantity::Drift);
    }

    /// Two tires are launched together and alike. If they are tied, a tire that flies alone pulls at its cable. Both places fail at this
    /// limit of force and are not sampled. If they are loose, a lone tire flies the same. Then samples judge both places at the risk that
    /// the plan accepts for a dud.
    #[test]
    fn places_that_fail_are_counted_and_others_are_sampled_at_the_risk_of_a_dud() {
        let judged = |links: &str| {
            let text = format!(
                r#"
shelter = {{ layout = "grid", rows = 1, columns = 2, spacing_m = 1.5, links = [{links}] }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 100 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", under_row = 1, launch_m_s = 3 }}]
limits = {{ flight_height_m = 5, cable_safety_factor = 1, withstands_one_dud = true, dud_risk_percent = 20 }}
delay = [{{ name = "1", interval_ms = 0 }}]
"#
            );
            let mut case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
            case.limits.force = 1.0;
            let control = StudyControl::default();
            let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
            let sampling = Sampling { least: 300, most: 500, ..Sampling::OF_VERDICT };
            let found = judge_one_dud(&context, &case.shots[0], Some(&sampling), false);
            found.expect("a result").expect("in time")
        };
        let tied = judged("\"row\"");
        assert_eq!((tied.places, tied.failing, tied.not_passing, tied.sampled), (2, 2, 2, None));
        assert_eq!((tied.verdict(), tied.planned.verdict), (Verdict::Fail, Verdict::Fail));
        let loose = judged("");
        assert_eq!((loose.places, loose.failing, loose.not_passing), (2, 0, 0));
        let sampled = loose.sampled.expect("samples").risk;
        assert_eq!((sampled.bounds.accepted, loose.verdict()), (0.2, Verdict::Pass));
        assert!(sampled.bounds.samples < 300, "no more than the verdict takes: {}", sampled.bounds.samples);
    }

    /// Sampled are the three worst places of a first look, ranked by failures and then by their use of the limits. So is any other place
    /// for which the look does not show that it is surely good enough.
    #[test]
    fn the_worst_places_and_those_that_are_not_sure_are_sampled() {
        let mut case = standing_case();
        case.limits.accepted_risk = 0.2;
        let look = |count, failing| sampled(&case, count, failing).sampled.known().expect("samples").clone();
        let higher = |height: f64| {
            let mut look = look(50, 0);
            look.samples.iter_mut().for_each(|sample| sample.run.height = height);
            look
        };
        let due =
            |looks: Vec<SampledShot>| places_to_sample(looks.into_iter().enumerate().collect(), &case.limits);
        let sure = || look(50, 0);
        assert_eq!(due(vec![higher(1.1), sure(), higher(1.3), higher(1.2), look(50, 1)]), [4, 2, 3]);
        // Ten samples without a failure do not prove that fewer than a fifth fail.
        assert_eq!(due(vec![higher(1.4), higher(1.3), higher(1.2), sure(), look(10, 0)]), [0, 1, 2, 4]);
    }

    #[test]
    fn a_place_that_does_not_pass_or_samples_that_do_not_are_no_pass() {
        let passes = ShotSummary { verdict: Verdict::Pass, ..ShotSummary::FAILED_RUN };
        let dud = |planned, not_passing, sampled: Option<Verdict>| {
            let risk = |verdict| {
                let bounds = FailureBounds::new(0.2, ErrorShare::Whole);
                RiskSummary { bounds, verdict, finer_runs_disagree: false, utilization: 0.5 }
            };
            let sampled = sampled.map(|verdict| SampledDud { row: 0, number: 0, risk: risk(verdict) });
            OneDud { row: 0, number: 0, planned, not_passing, failing: 0, places: 4, sampled }.verdict()
        };
        let [pass, open, fail] = [Verdict::Pass, Verdict::Undecided, Verdict::Fail];
        assert_eq!(
            [dud(passes, 0, None), dud(passes, 0, Some(pass)), dud(passes, 1, Some(pass))],
            [pass, pass, open]
        );
        assert_eq!([dud(passes, 0, Some(open)), dud(passes, 1, Some(fail))], [open, fail]);
        assert_eq!(dud(ShotSummary { verdict: fail, ..passes }, 0, None), fail);
    }

    /// Each of 30 places takes 50 samples. Three places take as many as a pass usually takes. At twice the usual risk that is half as many.
    #[test]
    fn runs_of_duds_are_expected_where_the_plan_asks_for_them() {
        let mut case = standing_case();
        let runs = |case: &Case| expected_dud_samples(case, &case.shots[0]);
        (case.plan.limits.withstands_one_dud, case.plan.limits.dud_risk_percent) = (false, 2.0);
        assert_eq!((case.shots[0].firings.len(), runs(&case)), (30, 0));
        case.plan.limits.withstands_one_dud = true;
        assert_eq!(runs(&case), 50 * 30 + 3 * USUAL_OF_PASS / 2);
    }

    /// Two tires without a tie: each flies the same without the other.
    #[test]
    fn samples_of_a_place_that_its_planned_shot_exceeds_by_far_are_no_evidence() {
        let case = super::super::brief_judgement::tests::case("", true);
        let control = StudyControl::default();
        let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
        let passing =
            check_summary(&context, &case.shots[0].with_dud(0, Wiring::default())).expect("a result");
        let exceeding = ShotSummary { verdict: Verdict::Pass, ..ShotSummary::FAILED_RUN };
        for (planned, verdict) in [(passing, Verdict::Pass), (exceeding, Verdict::Undecided)] {
            let dud = Dud { hole: 0, wiring: Wiring::default() };
            let place = Place { dud, holes: vec![0], planned, is_checked: true };
            let sampling = Sampling { most: 600, ..Sampling::OF_VERDICT };
            let sampled = sample_worst(&context, &case.shots[0], &[place], &sampling);
            let risk = sampled.expect("a result").expect("in time").risk;
            assert_eq!((planned.verdict, risk.verdict), (Verdict::Pass, verdict));
        }
    }
}
