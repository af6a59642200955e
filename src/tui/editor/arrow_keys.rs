//! The next value of a field for an arrow key.

use crate::plan::COMMON_DELAYS_MS;

/// The name before or after `name` in a list; the first name if `name` is not in the list.
pub fn neighbouring_name(names: &[&str], name: &str, up: bool) -> Option<String> {
    let index = names.iter().position(|known| *known == name);
    let next = index.map_or(0, |index| index.saturating_add_signed(if up { 1 } else { -1 }));
    names.get(next).map(|name| (*name).to_owned())
}

/// A stepped number is rounded to a multiple of 1 / `DIGITS`. For a time [ms] this is finer than a nanosecond.
const DIGITS: f64 = 1e9;

/// A number moved by `step`, at least 0. 1.1 moved by −1 is 0.1, not 0.10000000000000009.
pub fn add_to_number(number: &str, step: f64) -> Option<String> {
    let moved = (number.parse::<f64>().ok()? + step).max(0.0);
    Some(((moved * DIGITS).round() / DIGITS).to_string())
}

/// The common delay time [ms] next to `time` [ms]; `None` if there is none further.
pub fn common_delay(time: f64, up: bool) -> Option<f64> {
    match up {
        true => COMMON_DELAYS_MS.into_iter().find(|&common| common > time),
        false => COMMON_DELAYS_MS.into_iter().rfind(|&common| common < time),
    }
}

/// The number moved by one unit of its second digit: 20 to 21, 6 to 6.1, 280 to 290.
pub fn step_second_digit(number: f64, up: bool) -> f64 {
    if number == 0.0 {
        return if up { 1.0 } else { 0.0 };
    }
    let unit = 10_f64.powf(number.abs().log10().floor() - 1.0);
    let steps = (number / unit).round() + if up { 1.0 } else { -1.0 };
    // A unit below 1 is not exact in binary. Its reciprocal is.
    if unit < 1.0 { steps / (1.0 / unit).round() } else { steps * unit }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_delays_follow_one_another() {
        assert_eq!([0.0, 9.0, 20.0].map(|time| common_delay(time, true)), [9.0, 17.0, 25.0].map(Some));
        assert_eq!([9.0, 20.0, 0.0].map(|time| common_delay(time, false)), [Some(0.0), Some(17.0), None]);
    }

    #[test]
    fn a_moved_number_has_no_digits_of_rounding() {
        let moved = |number: &str| add_to_number(number, -1.0);
        assert_eq!(
            ["1.1", "8.2", "0.5", "x"].map(moved),
            [Some("0.1"), Some("7.2"), Some("0"), None].map(|n| n.map(str::to_owned))
        );
    }

    #[test]
    fn steps_follow_the_leading_digit() {
        assert_eq!([20.0, 6.0, 280.0, 1.8].map(|n| step_second_digit(n, true)), [21.0, 6.1, 290.0, 1.9]);
        assert_eq!([20.0, 0.0].map(|n| step_second_digit(n, false)), [19.0, 0.0]);
    }
}
