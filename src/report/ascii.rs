//! The one map from other characters to ASCII, for fonts and pipes that know no more.

/// Text in ASCII.
pub fn to_ascii(text: &str) -> String {
    let mut ascii = String::with_capacity(text.len());
    for symbol in text.chars() {
        match substitute(symbol) {
            Some(letters) => ascii += letters,
            None => ascii.push(symbol),
        }
    }
    ascii
}

/// Substitute of a character, one or two letters of ASCII; `None` where the character is ASCII itself.
pub fn substitute(symbol: char) -> Option<&'static str> {
    if symbol.is_ascii() {
        return None;
    }
    Some(match symbol {
        '▁' => "_",
        '▂' => ".",
        '▃' => ":",
        '▄' => "-",
        '▅' => "=",
        '▆' => "+",
        '▇' => "*",
        '█' => "#",
        '│' => "|",
        '─' => "-",
        '✓' => "+",
        '✗' => "x",
        '±' => "+-",
        '·' => "|",
        '²' => "2",
        '…' => ".",
        '●' => "O",
        '━' => "=",
        '→' => ">",
        '←' => "<",
        '↑' | '↗' | '↖' | '▲' => "^",
        '↓' | '↙' | '↘' | '▼' => "v",
        '×' => "x",
        '•' => ".",
        'μ' => "u",
        '─'..='╿' => "+",
        // One dot of eight, as in a dotted limit; more are a curve.
        '\u{2801}' | '\u{2802}' | '\u{2804}' | '\u{2808}' | '\u{2810}' | '\u{2820}' | '\u{2840}'
        | '\u{2880}' => ".",
        '\u{2800}'..='\u{28ff}' => "*",
        // Joined to the letter before.
        '\u{300}'..='\u{36f}' | '\u{200d}' | '\u{fe00}'..='\u{fe0f}' => "",
        _ => "?",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_has_an_ascii_form() {
        assert_eq!(to_ascii("⠁⡀⣀⠉"), "..**", "a limit differs from a curve");
        assert_eq!(to_ascii("1.7655 ± 0.0002 · ▁▇"), "1.7655 +- 0.0002 | _*");
        assert_eq!(to_ascii("e\u{301}té 爆"), "et? ?");
    }
}
