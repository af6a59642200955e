//! Charge, stemming and tires of the shots that a plan was fitted to, as `fitted_from` holds them: launches that were fitted to one charge
//! and mass do not hold for another. Where the program itself scales launches to other tires, it writes their mass here, too.

use itertools::Itertools;

use super::{Launch, Plan};

/// Largest share by which two charges, stemmings or masses of tires may differ and still count as alike.
const ALIKE: f64 = 0.05;

/// Whether two charges, stemmings or masses of tires count as alike: they differ by at most 5 %.
pub fn are_alike(then: f64, now: f64) -> bool {
    (then / now - 1.0).abs() <= ALIKE
}

/// Properties of the blast that decide its launches: name, unit, and the values of the holes in their order. NaN: the hole states no value.
/// Empty: no hole states one.
fn of_plan(plan: &Plan) -> [(&'static str, &'static str, Vec<f64>); 4] {
    let of_holes = |value: fn(&Launch) -> Option<f64>| -> Vec<f64> {
        let values = plan.launches().map(|launch| value(launch).unwrap_or(f64::NAN)).collect::<Vec<_>>();
        if values.iter().all(|value| value.is_nan()) { Vec::new() } else { values }
    };
    [
        ("charge", "kg", of_holes(|launch| launch.charge_kg)),
        ("stemming", "m", of_holes(|launch| launch.stemming_m)),
        ("hole diameter", "mm", of_holes(|launch| launch.hole_diameter_mm)),
        ("tires", "kg", plan.tire_masses()),
    ]
}

/// Values in words: `25`, or `2 x 20, 25` where holes differ. `?` is a hole that states no value.
fn in_words(values: &[f64]) -> String {
    let words = values.iter().map(|value| if value.is_nan() { "?".to_owned() } else { value.to_string() });
    let runs: Vec<(usize, String)> = words.dedup_with_count().collect();
    match &runs[..] {
        [(_, value)] => value.clone(),
        _ => runs
            .iter()
            .map(|(count, value)| if *count == 1 { value.clone() } else { format!("{count} x {value}") })
            .join(", "),
    }
}

/// The values in words that [`in_words`] wrote; `None` for other words.
fn of_words(words: &str) -> Option<Vec<f64>> {
    let run = |words: &str| -> Option<Vec<f64>> {
        let (count, value) = words.split_once('x').unwrap_or(("1", words));
        let value = if value.trim() == "?" { f64::NAN } else { value.trim().parse().ok()? };
        Some(vec![value; count.trim().parse::<usize>().ok()?.min(MOST_HOLES)])
    };
    words.split(',').map(run).collect::<Option<Vec<_>>>().map(|runs| runs.concat())
}

/// Largest number of values in one run of such words: no plan has more holes.
const MOST_HOLES: usize = 100_000;

/// Whether some holes have another value than before. Where all holes had one value and have one value, their number does not matter.
fn are_other(then: &[f64], now: &[f64]) -> bool {
    let is_far = |(then, now): (&f64, &f64)| !(are_alike(*then, *now) || then.is_nan() && now.is_nan());
    match (then.iter().dedup().count(), now.iter().dedup().count()) {
        (1, 1) => is_far((&then[0], &now[0])),
        _ => then.len() != now.len() || then.iter().zip(now).any(is_far),
    }
}

/// Entry of `fitted_from` for the tires: `tires 280 kg`.
pub fn of_tires(mass_kg: f64) -> String {
    format!("tires {mass_kg} kg")
}

/// Entries of `fitted_from` for the blast of a plan that is fitted now: `charge 25 kg`, `stemming 3, 2 x 2.5 m`.
pub fn kept(plan: &Plan) -> impl Iterator<Item = String> {
    let known = of_plan(plan).into_iter().filter(|(_, _, values)| !values.is_empty());
    known.map(|(name, unit, values)| format!("{name} {} {unit}", in_words(&values)))
}

/// Entries of `fitted_from` for the charge and stemming that a file of observations states: `seen charge 25 kg`. The plan itself may not
/// state them yet.
pub fn seen(charge_kg: Option<f64>, stemming_m: Option<f64>) -> impl Iterator<Item = String> {
    let told = [("charge", charge_kg, "kg"), ("stemming", stemming_m, "m")];
    told.into_iter().filter_map(|(name, value, unit)| Some(format!("{SEEN}{name} {} {unit}", value?)))
}

/// Beginning of an entry for a charge or a stemming that a file states.
const SEEN: &str = "seen ";

/// The difference between the plan and the shots that it was fitted to, as a sentence; `None` if they agree.
pub fn differs(plan: &Plan) -> Option<String> {
    of_plan(plan).into_iter().find_map(|(name, unit, now)| {
        let values = |kept: &str| -> Option<Vec<f64>> {
            of_words(kept.strip_prefix(name)?.trim_end().strip_suffix(unit)?)
        };
        let is_other = |then: &Vec<f64>| are_other(then, &now);
        // A file states one number. It is compared with the hole that launches most, as it was when it was fitted.
        let most = if name == "stemming" { f64::min } else { f64::max };
        let worst = now.iter().copied().reduce(most);
        let is_seen_otherwise =
            |then: &Vec<f64>| worst.is_some_and(|now| then.iter().any(|then| !are_alike(*then, now)));
        let of_plan = || plan.fitted_from.iter().filter_map(|kept| values(kept)).find(is_other);
        let of_files = || {
            let told = plan.fitted_from.iter().filter_map(|kept| values(kept.strip_prefix(SEEN)?));
            told.into_iter().find(is_seen_otherwise)
        };
        let then = of_plan().or_else(of_files)?;
        let [then, now] = [then, now].map(|values| in_words(&values));
        let now = if now.is_empty() { "no".to_owned() } else { format!("{now} {unit}") };
        Some(format!("the launches were fitted to shots of {then} {unit} {name}; the plan has {now} {name}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(launch: &str, fitted_from: &str) -> Result<Plan, String> {
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml");
        let text = text.replace("launch_m_s = 6.0", &format!("launch_m_s = 6.0\n{launch}"));
        let text =
            text.replace("\n[uncertainty]", &format!("\n[uncertainty]\nfitted_from = [{fitted_from}]"));
        Plan::parse("", &text).map_err(|mistakes| mistakes.first())
    }

    /// A plan may keep its blast, within the share that counts as alike. With another charge or stemming, the plan is refused.
    #[test]
    fn launches_that_were_fitted_belong_to_their_charge() {
        let fitted = plan("charge_kg = 25\nstemming_m = 2.5", "").expect("a plan");
        let kept: Vec<String> = kept(&fitted).collect();
        assert_eq!(kept, ["charge 25 kg", "stemming 2.5 m", &of_tires(280.0)]);
        let kept = "\"ab12\", \"charge 25 kg\", \"stemming 2.5 m\", \"tires 280 kg\"";
        for alike in ["charge_kg = 25\nstemming_m = 2.5", "charge_kg = 26\nstemming_m = 2.5"] {
            assert!(plan(alike, kept).is_ok());
        }
        for (other, told) in [
            ("charge_kg = 60\nstemming_m = 2.5", "25 kg charge; the plan has 60 kg"),
            ("charge_kg = 25\nstemming_m = 1.5", "2.5 m stemming; the plan has 1.5 m"),
            ("charge_kg = 25", "the plan has no stemming"),
        ] {
            let refused = plan(other, kept).expect_err("another blast");
            assert!(refused.contains(told), "{refused}");
        }
        let lighter = plan("", "\"ab12\", \"tires 300 kg\"").expect_err("other tires");
        assert!(lighter.contains("300 kg tires; the plan has 280 kg"), "{lighter}");
        // A plan need not state a charge that only the files state, but it must not state another one.
        let told: Vec<String> = seen(Some(25.0), None).collect();
        assert_eq!(told, ["seen charge 25 kg"]);
        let kept = "\"ab12\", \"seen charge 25 kg\"";
        assert!(plan("", kept).is_ok() && plan("charge_kg = 25", kept).is_ok());
        let refused = plan("charge_kg = 60", kept).expect_err("another blast");
        assert!(refused.contains("25 kg charge; the plan has 60 kg"), "{refused}");
        // Where holes differ, the file's charge is compared with the heaviest charge.
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml");
        let of_rows = |first: f64, others: f64| {
            let text =
                text.replacen("launch_m_s = 6.0", &format!("launch_m_s = 6.00\ncharge_kg = {first}"), 1);
            let text =
                text.replace("launch_m_s = 6.0\n", &format!("launch_m_s = 6.0\ncharge_kg = {others}\n"));
            let text = text.replace("launch_m_s = 6.0 ", &format!("charge_kg = {others}\nlaunch_m_s = 6.0 "));
            let mut plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            plan.fitted_from = vec!["ab12".to_owned(), "seen charge 25 kg".to_owned()];
            differs(&plan).is_none()
        };
        assert_eq!([of_rows(20.0, 25.0), of_rows(25.0, 20.0), of_rows(25.0, 60.0)], [true, true, false]);
    }

    /// Two rows of 20 kg before one row of 25 kg are not one row of 20 kg before two rows of 25 kg. Rows that are all alike may become
    /// more.
    #[test]
    fn each_hole_keeps_its_own_charge() {
        assert_eq!(in_words(&[20.0, 20.0, 25.0]), "2 x 20, 25");
        assert_eq!(of_words("2 x 20, 25"), Some(vec![20.0, 20.0, 25.0]));
        assert_eq!([of_words("2 y 20"), of_words("")], [None, None]);
        assert!(are_other(&[20.0, 20.0, 25.0], &[20.0, 25.0, 25.0]));
        assert!(!are_other(&[20.0, 20.0, 25.0], &[20.0, 20.5, 25.0]));
        let [first, last] = [[20.0, f64::NAN, 25.0], [f64::NAN, 20.0, 25.0]];
        assert_eq!(in_words(&first), "20, ?, 25");
        assert!(
            of_words("20, ?, 25").is_some_and(|kept| !are_other(&kept, &first) && are_other(&kept, &last))
        );
        assert!(
            !are_other(&[25.0; 3], &[25.5; 4])
                && are_other(&[25.0; 3], &[])
                && are_other(&[25.0], &[20.0; 3])
        );
    }
}
