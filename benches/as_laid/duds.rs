//! One dud at each place of an option.

use shelter::scene::{Shot, Wiring};
use shelter::study::Context;
use shelter::study::judge::one_dud::judge_one_dud;
use shelter::{ComputeSettings, StudyControl};

use super::sampler::Planned;
use super::{SEED, share_by_program, unknowns};

/// Holes of a row, of which those beyond the middle are mirror images of those before it.
const IN_ROW: usize = 10;
/// Greatest difference of a height or force between the program and its counterpart, over the value.
const TOLERANCE: f64 = 5e-3;

/// Compares heights and forces of the shot as planned without each hole, and the failing shares of `samples` samples of it; true where
/// all agree.
pub fn compare(samples: usize) -> bool {
    let case = unknowns::exact();
    let compute = ComputeSettings::of(&case.plan);
    let limits = Planned::new(&case, 0, None).bounds;
    println!("\nlimits {:.3} m, {:.2} kN; {samples} samples each\n", limits.height, 1e-3 * limits.force);
    println!(
        "| dud: row, hole | height, m | independent | force, kN | independent | fails, % | independent | agree |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let (mut agree, mut failing) = (true, 0);
    for (dud, firing) in case.shots[0].firings.iter().enumerate() {
        if firing.number >= IN_ROW / 2 {
            continue;
        }
        let shot: Shot = case.shots[0].with_dud(dud, Wiring::default());
        let mut without = case.clone();
        without.shots = vec![shot.clone()];
        let checked = without.check_as_planned(0, &compute).expect("a result");
        let independent = Planned::new(&case, 0, Some(dud));
        let reached = independent.reach_as_planned();
        failing += 2 * usize::from(reached.fails(&independent.bounds));
        let near = |ours: f64, theirs: f64| (ours / theirs - 1.0).abs() < TOLERANCE;
        let program = share_by_program(&case, &shot, samples);
        let share = independent.share(SEED, samples);
        let agrees = near(checked.estimates.height.value, reached.height)
            && near(checked.estimates.force.value, reached.force)
            && program.agrees_with(share);
        println!(
            "| {}, {} | {:.4} | {:.4} | {:.2} | {:.2} | {program} | {share} | {} |",
            firing.row + 1,
            firing.number + 1,
            checked.estimates.height.value,
            reached.height,
            1e-3 * checked.estimates.force.value,
            1e-3 * reached.force,
            if agrees { "yes" } else { "NO" }
        );
        agree &= agrees;
    }
    let found =
        judge_one_dud(&Context::new(&case, compute, &StudyControl::default()), &case.shots[0], None, false);
    let found = found.expect("a result").expect("enough time");
    println!(
        "\nplaces at which the shot as planned does not pass: {} of {} by the program, {failing} by its counterpart; worst: row {}, hole {}, {:.2} kN",
        found.not_passing,
        found.places,
        found.row + 1,
        found.number + 1,
        1e-3 * found.planned.values.force.value
    );
    agree && found.not_passing == failing
}
