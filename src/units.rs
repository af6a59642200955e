//! Texts of quantities: the digits follow the error, and units appear only at the edge of the program.
//!
//! SI numbers come in, text goes out. Every rounding that a reader sees happens here.

/// Greatest rounding noise of binary fractions, in the last digit that is shown. No digit is rounded up for it.
const ROUNDING_NOISE: f64 = 1e-9;

/// Unit in which views show a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Length [m].
    Metre,
    /// Force [N], shown in kN.
    Kilonewton,
    /// Time [s].
    Second,
    /// Time [s], shown in ms.
    Millisecond,
    /// Mass [kg], shown in t.
    Tonne,
    /// Share of 1, shown in %.
    Percent,
    /// Count or pure number, shown as it is.
    One,
}

impl Unit {
    /// Symbol of the unit.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::Metre => "m",
            Unit::Kilonewton => "kN",
            Unit::Second => "s",
            Unit::Millisecond => "ms",
            Unit::Tonne => "t",
            Unit::Percent => "%",
            Unit::One => "",
        }
    }

    /// Size of the unit in SI units.
    pub fn size(self) -> f64 {
        match self {
            Unit::Metre | Unit::Second | Unit::One => 1.0,
            Unit::Kilonewton | Unit::Tonne => 1e3,
            Unit::Millisecond => 1e-3,
            Unit::Percent => 1e-2,
        }
    }

    /// Greatest number of decimals worth reading: a tenth of a millimetre, a newton, a hundred kilograms of a shelter.
    fn most_decimals(self) -> usize {
        match self {
            Unit::Metre => 4,
            Unit::Kilonewton | Unit::Second => 3,
            Unit::Tonne => 1,
            Unit::Millisecond | Unit::Percent | Unit::One => 0,
        }
    }
}

/// A value and its error, both in SI units, with one digit of error: `1.7655 ± 0.0002`. The error is rounded up, and includes the
/// rounding of the value: the text reaches as far as the numbers. An infinite error is an unknown error: `353.157 ± unknown`.
pub fn value_and_error(value: f64, error: f64, unit: Unit) -> String {
    if value.is_finite() && error == f64::INFINITY {
        return format!("{} ± unknown", self::value(value, unit));
    }
    let (value, error) = (value / unit.size(), error / unit.size());
    if !(value.is_finite() && error.is_finite()) {
        return format!("{value} ± {error}");
    }
    let most = unit.most_decimals() as f64;
    // Decimals of the error's first digit; negative for tens, hundreds and more.
    let digit = if error > 0.0 { (-error.log10().floor()).min(most) } else { most };
    let last = 10_f64.powf(-digit);
    let decimals = digit.max(0.0) as usize;
    let value_shown = format!("{value:.decimals$}");
    let taken = value_shown.parse().map_or(0.0, |shown: f64| (value - shown).abs());
    let least = if error > 0.0 { 1.0 } else { 0.0 };
    // Of two zeros, `max` may return the negative zero.
    let error_shown = ((error + taken) / last - ROUNDING_NOISE).ceil().max(least).abs() * last;
    format!("{value_shown} ± {error_shown:.decimals$}")
}

/// A value and its standard deviation, with two digits of the standard deviation: `1.163 ± 0.014`.
pub fn value_and_sd(value: f64, sd: f64) -> String {
    let decimals = if sd > 0.0 { (1.0 - sd.log10().floor()).clamp(0.0, 9.0) as usize } else { 6 };
    format!("{value:.decimals$} ± {sd:.decimals$}")
}

/// A value with the digits that its error leaves: `132`. The error is left out, unless it is unknown.
pub fn value_by_error(value: f64, error: f64, unit: Unit) -> String {
    let both = value_and_error(value, error, unit);
    if error == f64::INFINITY {
        return both;
    }
    both.split(' ').next().unwrap_or_default().to_owned()
}

/// A value without an error: `1.500`.
pub fn value(value: f64, unit: Unit) -> String {
    format!("{:.3}", value / unit.size())
}

/// A value with `digits` significant digits, but never finer than a millionth: `1.67`, `53.0`.
pub fn significant(value: f64, unit: Unit, digits: i32) -> String {
    let value = value / unit.size();
    let first = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    rounded(value, (digits - 1 - first).clamp(0, 6) as usize)
}

/// A value whose error stands elsewhere, with one digit more than any error has: `0.75732`.
pub fn computed(value: f64, unit: Unit) -> String {
    rounded(value / unit.size(), unit.most_decimals() + 1)
}

/// A number with `decimals` decimals: `0.122`.
pub fn rounded(number: f64, decimals: usize) -> String {
    format!("{number:.decimals$}")
}

/// A share of 1 as percent with `decimals` decimals: `52 %`.
pub fn percent(share: f64, decimals: usize) -> String {
    format!("{} %", rounded(100.0 * share, decimals))
}

/// An upper bound of a share of 1 as percent, rounded up: `1.01 %` for 1.004 %.
pub fn at_most(share: f64) -> String {
    format!("{} %", rounded(up(1e4 * share) * 1e-2, 2))
}

/// A share of a limit in whole percent, rounded up: 101 for 1.001.
pub fn whole_percent(share: f64) -> f64 {
    up(1e2 * share)
}

/// The least whole number that is not below `number`.
fn up(number: f64) -> f64 {
    (number - ROUNDING_NOISE).ceil().max(0.0).abs()
}

/// The greatest whole number that is not above `number`.
fn down(number: f64) -> f64 {
    (number + ROUNDING_NOISE).floor()
}

/// Number of shots of which one may fail, for a probability, rounded down: `100` for 1 %.
pub fn one_in(probability: f64) -> String {
    down(1.0 / probability).to_string()
}

/// Bounds of a probability in percent, rounded outward, without the percent sign: `88.65` and `100.00`.
pub fn probabilities([low, high]: [f64; 2]) -> [String; 2] {
    [down(1e4 * low), up(1e4 * high)].map(|bound| rounded(bound * 1e-2, 2))
}

/// Energy residual over the energy put in, with one digit: `1e-5`.
pub fn residual(share: f64) -> String {
    format!("{share:.0e}")
}

/// A power of ten, written out: `0.001`.
pub fn power_of_ten(exponent: f64) -> String {
    format!("{}", 10_f64.powf(exponent) as f32)
}

/// A value as somebody wrote it, with its own digits, but at most six: `1.8346`.
pub fn exact(value: f64, unit: Unit) -> String {
    let value = value / unit.size();
    let scale = 10_f64.powf((5.0 - value.abs().max(1e-9).log10().floor()).clamp(0.0, 12.0));
    format!("{}", (value * scale).round() / scale)
}

/// Seconds with three decimals: `0.602 s`.
pub fn seconds(time: f64) -> String {
    format!("{time:.3} s")
}

/// Seconds as milliseconds without needless decimals: `20 ms`, `0.2 ms`.
pub fn milliseconds(time: f64) -> String {
    format!("{} ms", short(time * 1e3))
}

/// Rough time to wait: `40 s`, `3 min`, `2.5 h`.
pub fn rough_duration(time: f64) -> String {
    match time {
        ..60.0 => format!("{time:.0} s"),
        ..7200.0 => format!("{:.0} min", (time / 60.0).ceil()),
        _ => format!("{:.1} h", time / 3600.0),
    }
}

/// Time to wait that is known to a factor of two, each end with one digit: `5-20 s`, `50 s-4 min`. The second text is the upper end
/// alone.
pub fn rough_range(time: f64) -> [String; 2] {
    let rounded = |time: f64| {
        let (size, unit) = if time < 60.0 {
            (1.0, "s")
        } else if time < 7200.0 {
            (60.0, "min")
        } else {
            (3600.0, "h")
        };
        let count = (time / size).max(1.0);
        let digit = 10_f64.powf(count.log10().floor());
        ((count / digit).round() * digit, unit)
    };
    let [(low, small), (high, large)] = [0.5 * time, 2.0 * time].map(rounded);
    let low = if small == large { low.to_string() } else { format!("{low} {small}") };
    [format!("{low}-{high} {large}"), format!("{high} {large}")]
}

/// A number with three digits at least and no needless decimals: `20`, `0.125`.
pub fn short(number: f64) -> String {
    let digits = if number == 0.0 { 0.0 } else { 3.0 - number.abs().log10().floor() - 1.0 };
    let scale = 10_f64.powf(digits.clamp(0.0, 12.0));
    format!("{}", (number * scale).round() / scale)
}

/// Seconds as milliseconds with all computed digits: `30.625 ms`.
pub fn exact_milliseconds(time: f64) -> String {
    format!("{} ms", exact_number_of_milliseconds(time))
}

/// The same without the unit: `30.625`.
pub fn exact_number_of_milliseconds(time: f64) -> f64 {
    (time * 1e9).round() / 1e6
}

/// Ratio of breaking force to force, rounded down: `2.11`; `none` if no cable pulls, `unknown` if the ratio is not a number.
pub fn factor(factor: f64) -> String {
    match factor {
        _ if factor.is_nan() => "unknown".to_owned(),
        f64::INFINITY => "none".to_owned(),
        _ => rounded(down(1e2 * factor) * 1e-2, 2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_error() {
        assert_eq!(value_and_error(1.76549, 0.00019, Unit::Metre), "1.7655 ± 0.0002");
        assert_eq!(value_and_error(1.76549, 0.03, Unit::Metre), "1.77 ± 0.04");
        assert_eq!(value_and_error(9926.5, 4.0, Unit::Kilonewton), "9.927 ± 0.005");
        assert_eq!(value_and_error(26750.4, 1200.0, Unit::Kilonewton), "27 ± 2");
        assert_eq!(value_and_error(81_400.0, 12_300.0, Unit::Kilonewton), "81 ± 20");
        assert_eq!(value_and_error(27_000.0, 26_028e3, Unit::Kilonewton), "27 ± 30000");
        assert_eq!(value_and_error(0.0, 0.0, Unit::Metre), "0.0000 ± 0.0000");
    }

    #[test]
    fn an_error_is_never_shown_smaller_than_it_is() {
        assert_eq!(value_and_error(1.0, 1e-9, Unit::Metre), "1.0000 ± 0.0001");
        assert_eq!(value_and_error(1.0, 0.000_11, Unit::Metre), "1.0000 ± 0.0002");
    }

    #[test]
    fn the_text_of_a_value_reaches_as_far_as_its_error() {
        assert_eq!(value_and_error(1.49949, 0.001, Unit::Metre), "1.499 ± 0.002");
        for n in 0..2000 {
            let (value, error) = (1.0 + 0.000_37 * f64::from(n), 0.000_013 * f64::from(1 + n * n % 977));
            let text = value_and_error(value, error, Unit::Metre);
            let numbers: Vec<f64> = text.split(" ± ").map(|part| part.parse().expect("a number")).collect();
            let [shown, reach] = numbers[..] else { panic!("{text}") };
            let spare = 1e-9;
            assert!(shown + reach >= value + error - spare, "{text} of {value} ± {error}");
            assert!(shown - reach <= value - error + spare, "{text} of {value} ± {error}");
        }
    }

    #[test]
    fn a_safety_factor_is_rounded_down() {
        assert_eq!([1.496, 1.499_99, 1.5, 1.3, 2.119].map(factor), ["1.49", "1.49", "1.50", "1.30", "2.11"]);
    }

    #[test]
    fn bounds_of_a_probability_are_rounded_outward() {
        assert_eq!(probabilities([0.009_999, 0.010_04]), ["0.99", "1.01"]);
        assert_eq!(probabilities([0.0, 0.01]), ["0.00", "1.00"]);
        assert_eq!(probabilities([0.01, 1.0]), ["1.00", "100.00"]);
        assert_eq!([0.010_04, 0.01, 0.29].map(at_most), ["1.01 %", "1.00 %", "29.00 %"]);
    }

    #[test]
    fn a_screen_has_three_digits() {
        let of = |value| significant(value, Unit::Kilonewton, 3);
        assert_eq!(
            [53_000.0, 1671.0, 123_456.0, 12.3, 0.0].map(of),
            ["53.0", "1.67", "123", "0.0123", "0.00"]
        );
    }

    #[test]
    fn limits_keep_their_digits() {
        assert_eq!(exact(1.8346, Unit::Metre), "1.8346");
        assert_eq!(exact(0.001_551_14, Unit::Metre), "0.00155114");
        assert_eq!(exact(61_019.333, Unit::Kilonewton), "61.0193");
        assert_eq!(exact(2.0, Unit::Metre), "2");
    }

    #[test]
    fn a_time_to_wait_has_the_unit_of_its_size() {
        assert_eq!([40.2, 61.0, 9000.0].map(rough_duration), ["40 s", "2 min", "2.5 h"]);
    }

    #[test]
    fn milliseconds_keep_three_digits() {
        assert_eq!(milliseconds(0.02), "20 ms");
        assert_eq!(milliseconds(0.0002), "0.2 ms");
        assert_eq!(milliseconds(0.0), "0 ms");
        assert_eq!(milliseconds(1.2), "1200 ms");
        assert_eq!(exact_milliseconds(0.030625), "30.625 ms");
        assert_eq!(exact_milliseconds(0.1), "100 ms");
        assert_eq!(exact_milliseconds(0.0353875), "35.3875 ms");
    }
}
