//! Tries values of several assumptions at once. Decides which samples run and when the rest is spared.

use super::Ladder;
use super::change::change;
use crate::scene::Shot;
use crate::sorting::sort_by;
use crate::study::as_planned::quick_check::quick_or_whole_check;
use crate::study::samples::random_shot::draw_shots;
use crate::study::samples::run_sample::{ShotToSample, run_sample_once};
use crate::study::samples::sample::SampleRun;
use crate::study::samples::sample_count::Sampling;
use crate::study::work::batch::{run_announced_batch, run_batch};
use crate::study::{Case, Context, NoResult, ShotSummary, catch_panic};
use crate::verdict::{Quantity, Verdict};

/// The common data of all values tried.
pub(super) struct Trials<'t> {
    context: &'t Context<'t>,
    shot: &'t Shot,
    sampling: Sampling,
    /// Greatest number of failing samples with which a value passes.
    pub accepted: usize,
    /// The samples with the plan's values.
    pub as_stated: Vec<SampleRun>,
    /// How much of each limit these samples use.
    stated_use: Vec<Use>,
    /// Numbers of the samples, those nearest to a limit first.
    hardest_first: Vec<usize>,
}

/// Samples of a value in each round.
const ROUND: usize = 25;
/// Samples that a value must have before the rest may be spared.
const LEAST_BEFORE_SPARED: usize = 50;
/// A spared sample may move so many times as far as the sample that moved farthest.
const SPARED_MOVE: f64 = 3.0;

/// Use of each limit by a run, and how near a hole comes to firing under no tire; infinite if the run stays undecided.
type Use = [f64; Quantity::ALL.len() + 1];

fn used(run: &SampleRun, case: &Case) -> Use {
    if run.verdict == Verdict::Undecided {
        return [f64::INFINITY; _];
    }
    let [height, force, drift] = Quantity::ALL
        .map(|quantity| case.limits.get(quantity).map_or(0.0, |limit| run.get(quantity) / limit));
    [height, force, drift, run.uncovering]
}

fn greatest(used: &Use) -> f64 {
    used.iter().copied().fold(0.0, f64::max)
}

impl<'t> Trials<'t> {
    /// Runs the samples with the plan's values.
    pub fn new(context: &'t Context<'t>, shot: &'t Shot, sampling: Sampling) -> Result<Self, NoResult> {
        let &Context { case, compute, control, .. } = context;
        let target = ShotToSample::new(case, shot, compute, sampling);
        let numbers: Vec<usize> = (0..sampling.most).collect();
        let runs = run_announced_batch(&numbers, control, |&number| {
            Ok(run_sample_once(&target, number, control)?.run)
        })?;
        let as_stated = runs.into_iter().collect::<Option<Vec<SampleRun>>>().ok_or(NoResult::OutOfTime)?;
        let stated_use: Vec<Use> = as_stated.iter().map(|run| used(run, case)).collect();
        let mut hardest_first = numbers;
        sort_by(&mut hardest_first, |&a, &b| greatest(&stated_use[b]).total_cmp(&greatest(&stated_use[a])));
        let accepted = (case.limits.accepted_risk * sampling.most as f64 + 1e-9).floor() as usize;
        Ok(Self { context, shot, sampling, accepted, as_stated, stated_use, hardest_first })
    }

    /// The verdict on a planned shot, by a whole check if a quick one leaves it open.
    pub fn check(&self, case: &Case, shot: &Shot) -> Result<Verdict, NoResult> {
        let context = self.context.with_case(case);
        match catch_panic(|| quick_or_whole_check(&context, shot)) {
            Err(NoResult::Panicked(_)) => Ok(ShotSummary::FAILED_RUN.verdict),
            checked => Ok(checked?.verdict),
        }
    }

    /// Tries the next value of each of these ladders. Returns whether the time was up. In that case no ladder has moved.
    pub fn try_next(&self, ladders: &mut [&mut Ladder]) -> Result<bool, NoResult> {
        let (control, most) = (self.context.control, self.sampling.most);
        let begun = run_batch(ladders, control, |ladder| self.begin(ladder))?;
        let Some(mut values) = begun.into_iter().collect::<Option<Vec<Value>>>() else { return Ok(true) };
        for start in (0..most).step_by(ROUND) {
            let end = most.min(start + ROUND);
            let jobs: Vec<(usize, Drawn)> = values
                .iter()
                .enumerate()
                .filter(|(_, value)| value.is_open)
                .flat_map(|(n, value)| value.order[start..end].iter().map(move |&drawn| (n, drawn)))
                .collect();
            let runs = run_announced_batch(&jobs, control, |&(n, drawn)| self.sample(&values[n], drawn))?;
            for (&(n, drawn), run) in jobs.iter().zip(runs) {
                let Some(run) = run else { return Ok(true) };
                values[n].note(&run, &used(&run, self.context.case), &self.stated_use[drawn.number]);
            }
            for value in values.iter_mut().filter(|value| value.is_open) {
                value.passes = value.failing <= self.accepted;
                value.is_open = value.passes && !self.spares_the_rest(value, end);
                control.advance_by(if value.is_open { 0 } else { most - end });
            }
        }
        for (ladder, value) in ladders.iter_mut().zip(values) {
            ladder.note(value.passes);
            ladder.order = value.order;
        }
        Ok(false)
    }

    /// Begins the next value of a ladder: checks its planned shot and orders its samples.
    fn begin(&self, ladder: &Ladder) -> Result<Value, NoResult> {
        let (&Context { case, control, .. }, shot) = (self.context, self.shot);
        let (case, shot) = ladder
            .next()
            .map_or_else(|| (case.clone(), shot.clone()), |rung| ladder.found.assumed.vary(case, shot, rung));
        let passes = shot == *self.shot || self.check(&case, &shot)? == Verdict::Pass;
        if !passes {
            control.advance_by(self.sampling.most);
        }
        let steady = ladder.found.assumed.changes_steadily();
        let order = match ladder.rungs.last() {
            _ if !passes => Vec::new(),
            _ if steady && !ladder.order.is_empty() => ladder.order.clone(),
            // If even the farthest value leaves a draw unchanged, every value does.
            Some(farthest) if steady => {
                let (case, shot) = ladder.found.assumed.vary(self.context.case, self.shot, farthest);
                self.order(&case, &shot)
            }
            _ => self.order(&case, &shot),
        };
        Ok(Value { case, shot, order, passes, is_open: passes, failing: 0, farthest_moves: [0.0; _] })
    }

    /// The samples of a value by turns: one that came nearest to a limit with the plan's values, then one whose draw changes most.
    fn order(&self, case: &Case, shot: &Shot) -> Vec<Drawn> {
        let seed = self.sampling.seed;
        let change = |number: usize| {
            let [stated, varied] = [(self.context.case, self.shot), (case, shot)]
                .map(|(case, shot)| draw_shots(case, shot, seed, number));
            if stated.len() != varied.len() {
                return f64::INFINITY;
            }
            let pairs = stated.iter().zip(&varied);
            let changes = pairs.map(|(stated, varied)| change(case, stated, &self.as_stated[number], varied));
            changes.fold(0.0, f64::max)
        };
        let drawn = |&number: &usize| Drawn { number, change: change(number) };
        let hardest: Vec<Drawn> = self.hardest_first.iter().map(drawn).collect();
        let mut most_changed = hardest.clone();
        sort_by(&mut most_changed, |a, b| b.change.total_cmp(&a.change));
        let mut is_new = vec![true; hardest.len()];
        let by_turns = hardest.into_iter().zip(most_changed).flat_map(|(hard, changed)| [hard, changed]);
        by_turns.filter(|drawn| std::mem::take(&mut is_new[drawn.number])).collect()
    }

    /// Whether none of the samples after the first `run` would fail if it moved [`SPARED_MOVE`] times as far as any of the first. If the
    /// plan ends the runs, that is unknown: a run may end too early.
    fn spares_the_rest(&self, value: &Value, run: usize) -> bool {
        let stays = |drawn: &Drawn| {
            let mut uses = self.stated_use[drawn.number].iter().zip(&value.farthest_moves);
            drawn.change.is_finite() && uses.all(|(stated, moved)| stated + SPARED_MOVE * moved < 1.0)
        };
        let ends_itself = self.context.case.plan.simulation.duration_s.is_none();
        ends_itself && run >= LEAST_BEFORE_SPARED && value.order[run..].iter().all(stays)
    }

    /// Runs one sample. An unchanged draw need not run again.
    fn sample(&self, value: &Value, drawn: Drawn) -> Result<SampleRun, NoResult> {
        let (&Context { compute, control, .. }, number) = (self.context, drawn.number);
        if drawn.change == 0.0 {
            return Ok(self.as_stated[number]);
        }
        let target = ShotToSample::new(&value.case, &value.shot, compute, self.sampling);
        Ok(run_sample_once(&target, number, control)?.run)
    }
}

/// A sample of a value.
#[derive(Clone, Copy)]
pub(super) struct Drawn {
    number: usize,
    /// How far the draw differs from that with the plan's values, by [`change()`].
    change: f64,
}

/// A value of one assumption while its samples run.
struct Value {
    /// The plan with the value.
    case: Case,
    /// The shot with the value.
    shot: Shot,
    /// Its samples in the order in which they run.
    order: Vec<Drawn>,
    /// Whether the value passes by the samples so far.
    passes: bool,
    /// Whether more samples are to run.
    is_open: bool,
    /// Number of failing samples so far.
    failing: usize,
    /// Farthest move of any sample toward each limit, and toward firing a hole under no tire, as a share of the limit.
    farthest_moves: Use,
}

impl Value {
    /// Notes a run with the use `used`. `stated` is the use of the same sample with the plan's values.
    fn note(&mut self, run: &SampleRun, used: &Use, stated: &Use) {
        self.failing += usize::from(run.verdict != Verdict::Pass);
        for (farthest, (used, stated)) in self.farthest_moves.iter_mut().zip(used.iter().zip(stated)) {
            *farthest = farthest.max(used - stated);
        }
    }
}
