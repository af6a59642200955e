//! Single values: numbers in TOML, their range, and similar names.

use std::ops::RangeInclusive;

use toml::de::DeValue;

/// The name in `known` that is most similar to `name`, if one is similar.
pub fn nearest<'k>(name: &str, known: impl Iterator<Item = &'k str>) -> Option<&'k str> {
    let alike = known.map(|word| (strsim::jaro_winkler(name, word), word));
    alike.filter(|(score, _)| *score > 0.8).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, word)| word)
}

/// Why a number is not in a range; `None` if it is.
pub fn range_mistake(range: &RangeInclusive<f64>, number: f64) -> Option<String> {
    let (low, high) = (range.start(), range.end());
    if number.is_nan() {
        Some("is not a number".to_owned())
    } else if number.is_infinite() {
        Some("is infinite".to_owned())
    } else if number < 0.0 && *low >= 0.0 {
        Some("is negative".to_owned())
    } else if number == 0.0 && *low > 0.0 {
        Some("is zero".to_owned())
    } else if number < *low {
        Some(format!("is below {low}"))
    } else if number > *high {
        Some(format!("is above {high}"))
    } else {
        None
    }
}

/// A number, with or without decimals.
pub fn as_number(value: &DeValue<'_>) -> Option<f64> {
    if let Some(integer) = value.as_integer() {
        return i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|n| n as f64);
    }
    value.as_float()?.as_str().parse().ok()
}

/// A whole number of 0 or more.
pub fn as_whole(value: &DeValue<'_>) -> Option<usize> {
    let integer = value.as_integer()?;
    // A number that does not fit exceeds every limit; the message names the limit.
    let number = i128::from_str_radix(integer.as_str(), integer.radix()).unwrap_or(i128::MAX);
    (number >= 0).then(|| usize::try_from(number).unwrap_or(usize::MAX))
}

/// The article before a noun.
pub fn article(noun: &str) -> &'static str {
    if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}
