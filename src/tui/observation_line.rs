//! A typed observation, turned into the words of a table row: a tire or a cable, the quantity (unless it is the height), the value,
//! and the uncertainty of the value.

use crate::plan::observations::LEAST_FORCE;

/// Tire for the example line, if no tire is known to rise.
pub const EXAMPLE_TIRE: &str = "2:4";
/// From these values of a height and of its uncertainty [m] on, a number without a unit is more likely in centimeters.
const HARDLY_METRES: [f64; 2] = [10.0, 1.0];

/// The words of a line. For a tire, decimal commas become points and centimeters become meters; all other words stay as typed.
/// Refuses an ambiguous line; the message shows the correct form with `tire`.
pub fn observation_words(line: &str, tire: &str) -> Result<Vec<String>, String> {
    let signs = ["+/-", "+-", "±"];
    let plain =
        signs.into_iter().fold(line.replace(['–', '−'], "-"), |line, sign| line.replace(sign, " "));
    let mut words: Vec<String> = plain.split_whitespace().map(str::to_owned).collect();
    let lengths: Vec<Option<(String, &str)>> = words.iter().map(|word| length(word)).collect();
    let all_three = format!("type the tire, its height, and give or take, as `{tire} 1.95 0.05`");
    match (&words[..], &lengths[..]) {
        ([_], [Some(_)]) | ([_, _], [Some(_), Some(_)]) => return Err(all_three),
        ([_, value], [None, Some(_)]) => return Err(format!("how sure is {value}? {all_three}")),
        _ => {}
    }
    let is_of_tire = words.first().is_some_and(|place| !place.contains('-'));
    if let [cable, value, sd] = &words[..]
        && !is_of_tire
    {
        return forces(cable, value, sd).unwrap_or(Ok(words));
    }
    let is_length = words.len() == 3 || words.get(1).is_some_and(|quantity| quantity.ends_with("_m"));
    let [.., Some(value), Some(sd)] = &lengths[..] else { return Ok(words) };
    if !is_of_tire || !is_length {
        return Ok(words);
    }
    let hardly = |(number, _): &(String, &str), from: f64| metres(number).abs() >= from;
    let [is_tall, is_unsure] = [hardly(value, HARDLY_METRES[0]), hardly(sd, HARDLY_METRES[1])];
    let is_clear = match [value.1, sd.1] {
        ["", ""] => !is_tall && !is_unsure,
        ["", _] => !is_tall,
        [_, ""] => false,
        _ => true,
    };
    if !is_clear {
        let with_unit = |(number, unit): &(String, &'static str), is_hardly: bool| {
            let likely = if is_hardly { "cm" } else { "m" };
            format!("{number}{}", if unit.is_empty() { likely } else { unit })
        };
        let typed = format!("{} {} {}", words[0], with_unit(value, is_tall), with_unit(sd, is_unsure));
        return Err(format!("metres or centimetres? Type both units, as `{typed}`"));
    }
    let count = words.len();
    let [value, sd] = [value, sd].map(in_metres);
    words.splice(count - 2.., [value, sd]);
    Ok(words)
}

/// The words of a cable force and its uncertainty in newtons. Refuses a number that may be in kilonewtons. `None` if a word is no number,
/// or the numbers have no units but are clear enough for the table.
fn forces(cable: &str, value: &str, sd: &str) -> Option<Result<Vec<String>, String>> {
    let force = |word: &str| {
        let small = word.to_lowercase();
        let number = |unit: &str| small.strip_suffix(unit)?.replace(',', ".").parse::<f64>().ok();
        let units = [("kn", 1e3), ("n", 1.0), ("", 1.0)];
        let found = units.into_iter().find_map(|(unit, size)| Some((number(unit)?, unit, size)));
        found.filter(|(number, ..)| number.is_finite())
    };
    let is_whole_or_decimal = |word: &str| {
        let digits = word.trim_end_matches(|sign: char| sign.is_ascii_alphabetic());
        digits.rsplit_once([',', '.']).is_none_or(|(_, decimals)| decimals.len() != 3)
    };
    let (given, take) = (force(value)?, force(sd)?);
    let has_units = [given.1, take.1].map(|unit| !unit.is_empty());
    match has_units {
        // Three digits behind a comma or point may be thousands.
        [true, true] if is_whole_or_decimal(value) && is_whole_or_decimal(sd) => {
            let newtons = [given, take].map(|(number, _, size)| (number * size).to_string());
            Some(Ok([cable.to_owned()].into_iter().chain(newtons).collect()))
        }
        // The table decides whether a comma or point separates decimals or thousands.
        [false, false] if given.0.abs() >= LEAST_FORCE || value.contains([',', '.']) => None,
        _ => {
            let kilonewtons = |(number, unit, size): (f64, &str, f64)| match unit {
                "" if number.abs() < LEAST_FORCE => number,
                _ => number * size / 1e3,
            };
            let [value, sd] = [given, take].map(kilonewtons);
            Some(Err(format!("newtons or kilonewtons? Type both units, as `{cable} {value}kN {sd}kN`")))
        }
    }
}

/// A number with a decimal point, and its unit: `m`, `cm` or empty.
fn length(word: &str) -> Option<(String, &'static str)> {
    let number = |unit: &str| {
        let number = word.strip_suffix(unit)?.replace(',', ".");
        number.parse::<f64>().ok().map(|_| number)
    };
    ["cm", "m", ""].into_iter().find_map(|unit| Some((number(unit)?, unit)))
}

fn metres(number: &str) -> f64 {
    number.parse().unwrap_or(f64::NAN)
}

/// A length in meters. Only centimeters are converted, so other lengths keep their digits as typed.
fn in_metres((number, unit): &(String, &str)) -> String {
    if *unit == "cm" { (metres(number) / 1e2).to_string() } else { number.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_type_signs_and_units() {
        let words = |line| observation_words(line, "3:1").map(|words| words.join(" "));
        for (line, read) in [
            ("3:1 1.95 ±0.05", "3:1 1.95 0.05"),
            ("1:8 1.95m+-5cm", "1:8 1.95 0.05"),
            ("1:8 1.95 5cm", "1:8 1.95 0.05"),
            ("1:8 1,95 0,05", "1:8 1.95 0.05"),
            ("1:8 140cm 20cm", "1:8 1.4 0.2"),
            ("7 1.95 0.05", "7 1.95 0.05"),
            ("3:1 drift_m 2 +/- 0.1", "3:1 drift_m 2 0.1"),
            ("3:1 drift_m 200cm 10cm", "3:1 drift_m 2 0.1"),
            ("3:1 height_m 0.3 0.9 0.1", "3:1 height_m 0.3 0.9 0.1"),
            ("3:1 landing_s 0.95 0.02", "3:1 landing_s 0.95 0.02"),
            ("3:1–4:1 52000 2000", "3:1-4:1 52000 2000"),
            ("3:1-4:1 52kN 2kN", "3:1-4:1 52000 2000"),
            ("3:1-4:1 52kn 2KN", "3:1-4:1 52000 2000"),
            ("3:1-4:1 52,5kN ±2000N", "3:1-4:1 52500 2000"),
            ("3:1-4:1 cable_force_n 52000 2000", "3:1-4:1 cable_force_n 52000 2000"),
        ] {
            assert_eq!(words(line).as_deref(), Ok(read));
        }
        // A line that the table may refuse reaches the table as typed: separators of thousands, or decimals.
        for line in ["3:1-4:1 52,000 2,000", "3:1-4:1 60.000 2.000", "3:1 1400mm 20mm", "3:1 firing_s 0.0003"]
        {
            assert_eq!(words(line).as_deref(), Ok(line));
        }
    }

    /// A height in centimeters read as meters, or a height of another tire, leads to a fit of a launch that never happened. If 20 cm of
    /// uncertainty is read as 20 m, no contradiction is found.
    #[test]
    fn a_line_that_may_mean_two_things_is_refused() {
        for (line, told) in [
            ("1.95", "type the tire, its height, and give or take, as `3:1 1.95 0.05`"),
            ("1.95 0.05", "type the tire, its height, and give or take, as `3:1 1.95 0.05`"),
            ("3:1 1.6", "how sure is 1.6? type the tire, its height, and give or take, as `3:1 1.95 0.05`"),
            ("3:1 140 20", "metres or centimetres? Type both units, as `3:1 140cm 20cm`"),
            ("3:1 1.4 20", "metres or centimetres? Type both units, as `3:1 1.4m 20cm`"),
            ("3:1 2.2m 20", "metres or centimetres? Type both units, as `3:1 2.2m 20cm`"),
            ("3:1 140cm 0.2", "metres or centimetres? Type both units, as `3:1 140cm 0.2m`"),
            ("3:1-4:1 52 2", "newtons or kilonewtons? Type both units, as `3:1-4:1 52kN 2kN`"),
            ("3:1-4:1 52kN 2000", "newtons or kilonewtons? Type both units, as `3:1-4:1 52kN 2kN`"),
            ("3:1-4:1 52,000kN 2kN", "newtons or kilonewtons? Type both units, as `3:1-4:1 52kN 2kN`"),
            ("3:1 drift_m 200 10", "metres or centimetres? Type both units, as `3:1 200cm 10cm`"),
            ("3:1 flight_height_m 140cm 20", "metres or centimetres? Type both units, as `3:1 140cm 20cm`"),
        ] {
            assert_eq!(observation_words(line, "3:1"), Err(told.to_owned()));
        }
    }
}
