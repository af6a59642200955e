//! Numbers of a list of holes, with decimal points or decimal commas. The whole list decides which, and nothing is guessed.

/// Notation of the numbers of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decimals {
    /// With decimal points, or without decimals.
    Point,
    /// With decimal commas.
    Comma,
    /// Some with points, some with commas.
    Mixed,
    /// With commas that may separate decimals or thousands.
    AmbiguousComma,
    /// With points that may separate decimals or thousands.
    AmbiguousPoint,
}

/// Notation of the `values` of a list. `european`: points may separate thousands.
pub fn decimals<'v>(values: impl Iterator<Item = &'v str>, european: bool) -> Decimals {
    let (mut points, mut sure_point, mut commas, mut sure_comma) = (false, !european, false, false);
    for value in values {
        let value = without_spaces(value);
        if value.contains('.') && value.parse::<f64>().is_ok() {
            points = true;
            sure_point |= !may_be_thousands(&value, '.');
        }
        if value.contains(',') && value.replace(',', "").parse::<f64>().is_ok() {
            commas = true;
            sure_comma |= !may_be_thousands(&value, ',');
        }
    }
    match (points, commas) {
        (true, false) if !sure_point => Decimals::AmbiguousPoint,
        (_, false) => Decimals::Point,
        (true, true) => Decimals::Mixed,
        (false, true) if sure_comma => Decimals::Comma,
        (false, true) => Decimals::AmbiguousComma,
    }
}

/// Remedy for a value whose `sign` may separate decimals or thousands. It shows four decimals, because four digits are no thousands.
pub fn both_ways(value: &str, sign: char) -> String {
    let name = if sign == ',' { "comma" } else { "point" };
    let as_thousands = format!("write {} if the {name} separates thousands", value.replace(sign, ""));
    match value.split_once(sign) {
        Some((whole, decimals)) if !decimals.contains(sign) => {
            format!("{as_thousands}, {whole}.{decimals}0 if it separates decimals; write all numbers alike")
        }
        _ => as_thousands,
    }
}

/// Whether a value is a number with a decimal comma, and not with thousands.
pub fn surely_decimal_comma(text: &str) -> bool {
    let text = without_spaces(text);
    value(&text, true).is_some() && text.contains(',') && !may_be_thousands(&text, ',')
}

/// The number that a text stands for, with a decimal point, or with one decimal comma if `comma`. A number with an exponent gives `None`:
/// spreadsheets that write `4.78E+05` have dropped digits.
pub fn value(text: &str, comma: bool) -> Option<f64> {
    if text.contains(['e', 'E']) {
        return None;
    }
    let mut text = without_spaces(text);
    if comma && text.matches(',').count() == 1 && !text.contains('.') {
        text = text.replace(',', ".");
    }
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Whether exactly three digits follow every `sign`, after one to three digits that do not begin with 0: `1,234`.
fn may_be_thousands(text: &str, sign: char) -> bool {
    let mut groups = text.trim_start_matches(['+', '-']).split(sign);
    let digits = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
    let first = groups
        .next()
        .is_some_and(|first| digits(first) && (1..=3).contains(&first.len()) && !first.starts_with('0'));
    first && groups.all(|group| digits(group) && group.len() == 3)
}

/// The text without the spaces that separate thousands: `512 345,10`.
fn without_spaces(text: &str) -> String {
    let space = |c: char| matches!(c, ' ' | '\u{a0}' | '\u{202f}');
    let whole = text.split(['.', ',']).next().unwrap_or_default();
    let mut groups = whole.trim_start_matches(['+', '-']).split(space);
    let digits = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
    let first = groups.next().is_some_and(|first| digits(first) && (1..=3).contains(&first.len()));
    let grouped = first && groups.all(|group| digits(group) && group.len() == 3);
    if grouped { text.replace(space, "") } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_commas_are_told_from_thousands() {
        let decimals_of = |values: &[&str]| decimals(values.iter().copied(), false);
        let european = |values: &[&str]| decimals(values.iter().copied(), true);
        assert_eq!(decimals_of(&["1.5", "2", "B1"]), Decimals::Point);
        assert_eq!(decimals_of(&["512 345,10", "1,234"]), Decimals::Comma);
        assert_eq!(decimals_of(&["0,250"]), Decimals::Comma);
        assert_eq!(decimals_of(&["1,234", "12"]), Decimals::AmbiguousComma);
        assert_eq!(decimals_of(&["1,234,567"]), Decimals::AmbiguousComma);
        assert_eq!(decimals_of(&["1,5", "1.5"]), Decimals::Mixed);
        assert_eq!(decimals_of(&["1.560", "12"]), Decimals::Point);
        assert_eq!(european(&["1.560", "12"]), Decimals::AmbiguousPoint);
        assert_eq!(european(&["1.560", "0.000"]), Decimals::Point);
        assert_eq!(european(&["1.560", "5403.210"]), Decimals::Point);
        assert!(
            surely_decimal_comma("12,5")
                && !surely_decimal_comma("0,255,0")
                && !surely_decimal_comma("1,234")
        );
    }

    #[test]
    fn what_is_told_to_write_is_sure() {
        assert_eq!(
            both_ways("1,500", ','),
            "write 1500 if the comma separates thousands, 1.5000 if it separates decimals; write all numbers alike"
        );
        for european in [false, true] {
            assert_eq!(decimals(["1.5000", "1500"].into_iter(), european), Decimals::Point);
        }
        assert_eq!(both_ways("1.234.567", '.'), "write 1234567 if the point separates thousands");
    }

    #[test]
    fn values_are_numbers_or_none() {
        assert_eq!(value("512 345,10", true), Some(512_345.10));
        assert_eq!(value("-1\u{a0}234,5", true), Some(-1234.5));
        assert_eq!(value("1,5", false), None);
        assert_eq!(value("1,234.5", true), None);
        assert_eq!(value("1,234,567", true), None);
        assert_eq!(value("51 23", true), None);
        assert_eq!(value("inf", true), None);
        assert_eq!(value("4.78E+05", false), None);
    }
}
