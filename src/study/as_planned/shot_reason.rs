//! Why one run fails or leaves a verdict open: limits, broken cables, an early end.

use crate::outcome::{EndReason, Outcome};
use crate::scene::Shot;
use crate::study::Case;
use crate::study::eight_ms::WithinEightMs;
use crate::verdict::{Estimate, Limits, PerQuantity, Quantity, Verdict};

/// Greatest energy residual of a run that may pass, over the energy put in. A greater residual shows that the step is too long for
/// the motion, whatever neighboring steps show.
const MOST_RESIDUAL: f64 = 0.01;

/// Why a shot does not pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShotReason {
    /// A value exceeds its limit, or is too near to the limit to decide.
    Limit {
        /// The quantity.
        quantity: Quantity,
        /// Fail or undecided.
        verdict: Verdict,
        /// The computed value with its error.
        estimate: Estimate,
        /// The limit [SI unit of the quantity].
        limit: f64,
    },
    /// A value keeps its limit with its error, but not with as many errors as a pass must stand with.
    NotSure {
        /// The quantity.
        quantity: Quantity,
        /// The computed value with its error.
        estimate: Estimate,
        /// The limit [SI unit of the quantity].
        limit: f64,
    },
    /// This number of cables breaks.
    Broken(usize),
    /// More holes fire within 8 ms than the plan allows.
    HolesTogether {
        /// Most holes within any 8 ms.
        holes: usize,
        /// The limit.
        limit: usize,
    },
    /// More explosive fires within 8 ms than the plan allows.
    ChargeTogether {
        /// Heaviest charge within any 8 ms [kg].
        charge: f64,
        /// The limit [kg].
        limit: f64,
    },
    /// This number of holes lies under no tire. The model gives the launch to the nearest tire, and knows nothing of what the hole
    /// throws.
    UnderNoTire(usize),
    /// This number of holes fires where no tire lies any more: earlier holes moved their tires aside, or threw them up.
    TiresMovedAway(usize),
    /// The energy residual over the energy put in. It is greater than [`MOST_RESIDUAL`].
    EnergyResidual(f64),
    /// The run ends too early for a verdict.
    EndsEarly {
        /// End of the run [s].
        end: f64,
        /// What the run leaves open.
        open: EarlyEnd,
    },
}

impl ShotReason {
    /// The verdict that this reason leads to: fail or undecided.
    pub fn verdict(&self) -> Verdict {
        match self {
            ShotReason::Limit { verdict, .. } => *verdict,
            ShotReason::Broken(_) | ShotReason::HolesTogether { .. } | ShotReason::ChargeTogether { .. } => {
                Verdict::Fail
            }
            ShotReason::NotSure { .. }
            | ShotReason::UnderNoTire(_)
            | ShotReason::TiresMovedAway(_)
            | ShotReason::EnergyResidual(_)
            | ShotReason::EndsEarly { .. } => Verdict::Undecided,
        }
    }
}

/// What a run that ends too early leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EarlyEnd {
    /// The run ends before the last hole fires at this time [s].
    HolesUnfired(f64),
    /// Tires are in the air: they rise, or will pull at cables as they fall.
    TiresInAir,
    /// The force is greatest at the very end.
    ForceGrowing,
    /// Tires still move, and may pull harder later.
    TiresMoving,
}

impl EarlyEnd {
    /// Whether a quantity may still grow after the end. Its error is then unknown.
    fn may_grow(self, quantity: Quantity) -> bool {
        match self {
            EarlyEnd::HolesUnfired(_) | EarlyEnd::TiresInAir => true,
            // On the ground nothing pulls a tire up.
            EarlyEnd::ForceGrowing | EarlyEnd::TiresMoving => quantity != Quantity::Height,
        }
    }
}

/// What the run of a shot leaves open if it ends too early for a verdict; `None` if it ends at rest.
fn early_end(shot: &Shot, outcome: &Outcome) -> Option<EarlyEnd> {
    if outcome.end.reason == EndReason::AtRest {
        return None;
    }
    let last = shot.firings.last().map_or(0.0, |firing| firing.time);
    if last >= outcome.end.time {
        return Some(EarlyEnd::HolesUnfired(last));
    }
    // A tire whose push has just begun will rise, though it may be too low to count as in the air.
    let is_pushed = shot.firings.iter().any(|firing| firing.time + firing.push_time >= outcome.end.time);
    if outcome.tires_in_air || is_pushed {
        return Some(EarlyEnd::TiresInAir);
    }
    // The greatest force is at one of the last three steps.
    if outcome.force.value > 0.0 && outcome.force.time > outcome.end.time - 2.5 * outcome.step {
        return Some(EarlyEnd::ForceGrowing);
    }
    Some(EarlyEnd::TiresMoving)
}

/// Why a planned shot does not pass, by one of its runs and by what fires together in it. See [`find_reasons`].
pub fn find_reasons_as_planned(
    case: &Case,
    shot: &Shot,
    outcome: &Outcome,
    estimates: &PerQuantity<Estimate>,
    errors_of_pass: f64,
) -> Vec<ShotReason> {
    let of_run = find_reasons(case, shot, outcome, estimates, errors_of_pass);
    of_run.into_iter().chain(too_much_together(case, WithinEightMs::of(case, shot))).collect()
}

/// Whether a shot fires more within 8 ms than the plan allows.
pub fn exceeds_together(case: &Case, shot: &Shot) -> bool {
    too_much_together(case, WithinEightMs::of(case, shot)).next().is_some()
}

/// The limits that what fires together exceeds.
fn too_much_together(
    case: &Case,
    WithinEightMs { holes, charge }: WithinEightMs,
) -> impl Iterator<Item = ShotReason> {
    let limits = &case.limits;
    let most = limits.holes_in_8_ms.filter(|&limit| holes > limit);
    let heaviest = charge.zip(limits.charge_in_8_ms).filter(|(charge, limit)| charge > limit);
    let holes = most.map(|limit| ShotReason::HolesTogether { holes, limit });
    holes.into_iter().chain(heaviest.map(|(charge, limit)| ShotReason::ChargeTogether { charge, limit }))
}

/// Height, force and drift of a run of a shot. If a value may still grow after the end of the run, its error is unknown and so
/// infinite.
pub fn with_unknown_errors(
    shot: &Shot,
    outcome: &Outcome,
    estimates: &PerQuantity<Estimate>,
) -> PerQuantity<Estimate> {
    let open = early_end(shot, outcome);
    PerQuantity::from_fn(|quantity| {
        let estimate = *estimates.get(quantity);
        let may_grow = open.is_some_and(|open| open.may_grow(quantity));
        if may_grow { Estimate { error: f64::INFINITY, ..estimate } } else { estimate }
    })
}

/// Why a run of a shot does not pass; empty for a pass. `estimates` are its height, force and drift with the errors of their steps.
/// A pass must stand with `errors_of_pass` times each error.
pub fn find_reasons(
    case: &Case,
    shot: &Shot,
    outcome: &Outcome,
    estimates: &PerQuantity<Estimate>,
    errors_of_pass: f64,
) -> Vec<ShotReason> {
    let told = with_unknown_errors(shot, outcome, estimates);
    let limits = with_limits(estimates, &case.limits).filter_map(|(quantity, estimate, limit)| {
        let (verdict, told) = (estimate.compare_with(limit), *told.get(quantity));
        match verdict {
            Verdict::Fail => Some(ShotReason::Limit { quantity, verdict, estimate: told, limit }),
            // If a value may still grow, the early end is the reason.
            _ if told.error.is_infinite() => None,
            Verdict::Undecided => Some(ShotReason::Limit { quantity, verdict, estimate, limit }),
            Verdict::Pass if estimate.times_error(errors_of_pass).compare_with(limit) != Verdict::Pass => {
                Some(ShotReason::NotSure { quantity, estimate, limit })
            }
            Verdict::Pass => None,
        }
    });
    let broken = Some(outcome.broken.len()).filter(|&count| count > 0).map(ShotReason::Broken);
    let too_large = Some(outcome.ledger.residual()).filter(|&residual| !energy_balance_closes(residual));
    let residual = too_large.map(ShotReason::EnergyResidual);
    let end = case.plan.simulation.duration_s.unwrap_or(outcome.end.time);
    let early = early_end(shot, outcome).map(|open| ShotReason::EndsEarly { end, open });
    limits.chain(broken).chain(residual).chain(early).collect()
}

/// Whether the energy balance of a run closes well enough for a pass. `residual` is over the energy put in.
pub(in crate::study) fn energy_balance_closes(residual: f64) -> bool {
    residual <= MOST_RESIDUAL
}

/// The quantities with a limit, each with its estimate and its limit.
pub(in crate::study) fn with_limits(
    estimates: &PerQuantity<Estimate>,
    limits: &Limits,
) -> impl Iterator<Item = (Quantity, Estimate, f64)> {
    Quantity::ALL
        .into_iter()
        .filter_map(|quantity| Some((quantity, *estimates.get(quantity), limits.get(quantity)?)))
}

#[cfg(test)]
pub(in crate::study) mod tests {
    use super::*;
    use crate::outcome::{BrokenCable, History, Ledger, Peak, RunEnd};
    use crate::plan::Plan;

    pub(in crate::study) fn case() -> Case {
        let text = include_str!("../../../plans/paper-5-tire.toml");
        let mut case = Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        case.limits = Limits { height: 2.0, force: 1000.0, drift: None, ..case.limits };
        case
    }

    /// A run of 1 s in steps of 1/8 s, at rest at its end, in which nothing was pulled.
    pub(in crate::study) fn outcome() -> Outcome {
        Outcome {
            height: Peak::default(),
            force: Peak::default(),
            drift: Peak::default(),
            broken: Vec::new(),
            ledger: Ledger::default(),
            history: History::new(0.125),
            step: 0.125,
            steps: 8,
            end: RunEnd { time: 1.0, reason: EndReason::AtRest },
            tires_in_air: false,
        }
    }

    fn ended_early() -> Outcome {
        Outcome { end: RunEnd { time: 1.0, reason: EndReason::TimeLimit }, ..outcome() }
    }

    #[test]
    fn a_run_that_ends_early_leaves_open_what_may_still_come() {
        let case = case();
        let open = |outcome: &Outcome| early_end(&case.shots[0], outcome);
        let pulled =
            |value: f64, time: f64| Outcome { force: Peak { value, time, index: 0 }, ..ended_early() };
        assert_eq!(open(&Outcome { end: outcome().end, ..pulled(5.0, 1.0) }), None);
        let last = case.shots[0].firings.last().expect("a hole").time;
        let unfired = Outcome { end: RunEnd { time: last, reason: EndReason::TimeLimit }, ..outcome() };
        assert_eq!(open(&unfired), Some(EarlyEnd::HolesUnfired(last)));
        assert_eq!(open(&Outcome { tires_in_air: true, ..pulled(5.0, 1.0) }), Some(EarlyEnd::TiresInAir));
        // Two and a half steps before the end is at 0.6875 s.
        assert_eq!(open(&pulled(5.0, 0.7)), Some(EarlyEnd::ForceGrowing));
        let mut pushed = case.shots[0].clone();
        pushed.firings[0].push_time = 1.0;
        assert_eq!(early_end(&pushed, &pulled(0.0, 0.0)), Some(EarlyEnd::TiresInAir), "a push that goes on");
        for (force, at) in [(5.0, 0.6875), (5.0, 0.1), (0.0, 1.0)] {
            assert_eq!(open(&pulled(force, at)), Some(EarlyEnd::TiresMoving), "{force} {at}");
        }
        let grow = |open: EarlyEnd| Quantity::ALL.map(|quantity| open.may_grow(quantity));
        assert_eq!(grow(EarlyEnd::HolesUnfired(0.1)), [true; 3]);
        assert_eq!(grow(EarlyEnd::TiresInAir), [true; 3]);
        assert_eq!(grow(EarlyEnd::ForceGrowing), [false, true, true]);
        assert_eq!(grow(EarlyEnd::TiresMoving), [false, true, true]);
    }

    /// A height of 1.5, 1.9 or 2.5 m ± 0.25 m at a limit of 2 m; broken cables; an energy residual of 1 % or 2 %.
    #[test]
    fn each_reason_stands_where_it_keeps_a_run_from_passing() {
        let case = case();
        let height = |value| Estimate { value, error: 0.25, time: 0.5, index: 0 };
        let told = |outcome: &Outcome, value: f64, errors_of_pass: f64| {
            let none = Estimate::default();
            let estimates = PerQuantity { height: height(value), force: none, drift: none };
            find_reasons(&case, &case.shots[0], outcome, &estimates, errors_of_pass)
        };
        let (quantity, limit) = (Quantity::Height, 2.0);
        let over = |verdict, estimate| ShotReason::Limit { quantity, verdict, estimate, limit };
        assert_eq!(told(&outcome(), 1.5, 1.0), []);
        let not_sure = ShotReason::NotSure { quantity, estimate: height(1.5), limit };
        assert_eq!(told(&outcome(), 1.5, 3.0), [not_sure]);
        assert_eq!(told(&outcome(), 1.9, 1.0), [over(Verdict::Undecided, height(1.9))]);
        assert_eq!(told(&outcome(), 2.5, 1.0), [over(Verdict::Fail, height(2.5))]);
        // For a height that may still grow, the early end is the reason, unless the height exceeds the limit already.
        let in_air = Outcome { tires_in_air: true, ..ended_early() };
        let end = case.plan.simulation.duration_s.unwrap_or(1.0);
        let early = ShotReason::EndsEarly { end, open: EarlyEnd::TiresInAir };
        assert_eq!(told(&in_air, 1.5, 3.0), [early]);
        assert_eq!(told(&in_air, 1.9, 1.0), [early]);
        let unknown = Estimate { error: f64::INFINITY, ..height(2.5) };
        assert_eq!(told(&in_air, 2.5, 1.0), [over(Verdict::Fail, unknown), early]);
        let broken = vec![BrokenCable { time: 0.1, cable: 0 }, BrokenCable { time: 0.2, cable: 1 }];
        assert_eq!(told(&Outcome { broken, ..outcome() }, 1.5, 1.0), [ShotReason::Broken(2)]);
        let lost = |greatest_residual| Ledger { put_in: 128.0, dissipated: 128.0, greatest_residual };
        assert_eq!(told(&Outcome { ledger: lost(1.28), ..outcome() }, 1.5, 1.0), []);
        let residual = ShotReason::EnergyResidual(0.02);
        assert_eq!(told(&Outcome { ledger: lost(2.56), ..outcome() }, 1.5, 1.0), [residual]);
        assert_eq!(residual.verdict().max(not_sure.verdict()).max(early.verdict()), Verdict::Undecided);
        assert_eq!(ShotReason::Broken(2).verdict(), Verdict::Fail);
    }

    #[test]
    fn as_many_holes_together_as_allowed_are_not_too_many() {
        let mut case = case();
        let WithinEightMs { holes, .. } = WithinEightMs::of(&case, &case.shots[0]);
        for (limit, exceeds) in [(None, false), (Some(holes), false), (Some(holes - 1), true)] {
            case.limits.holes_in_8_ms = limit;
            assert_eq!(exceeds_together(&case, &case.shots[0]), exceeds, "{limit:?}");
        }
    }

    #[test]
    fn as_much_charge_together_as_allowed_is_not_too_much() {
        let mut case = case();
        case.plan.launches_mut().for_each(|launch| launch.charge_kg = Some(2.0));
        case.shots[0].firings.iter_mut().for_each(|firing| firing.charge = 2.0);
        let charge = WithinEightMs::of(&case, &case.shots[0]).charge.expect("a charge");
        for (limit, exceeds) in [(None, false), (Some(charge), false), (Some(charge - 0.1), true)] {
            case.limits.charge_in_8_ms = limit;
            assert_eq!(exceeds_together(&case, &case.shots[0]), exceeds, "{limit:?}");
        }
    }
}
