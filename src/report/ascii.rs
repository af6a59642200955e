//! The one map from other characters to ASCII, for fonts and pipes that know only ASCII.

use deunicode::deunicode_char;

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

/// Substitute of a character in ASCII; `None` where the character is ASCII itself.
pub fn substitute(symbol: char) -> Option<&'static str> {
    if symbol.is_ascii() {
        return None;
    }
    Some(match symbol {
        '▁' => "_",
        '▂' => ",",
        '▃' => ":",
        '▄' => "=",
        '▅' => "+",
        '▆' => "*",
        '▇' => "&",
        '█' => "#",
        '▀' => "=",
        '│' | '┆' => "|",
        '─' => "-",
        '✓' => "Y",
        '✗' => "X",
        '△' => "T",
        '±' => "+-",
        '·' => ";",
        '²' => "2",
        '³' => "3",
        // An `o` behind digits would read as a zero.
        '°' => "deg",
        '○' | '☐' => "o",
        '—' | '–' | '−' => "-",
        '“' | '”' => "\"",
        '…' => "..",
        '●' => "O",
        '━' => "=",
        '═' | '║' => "#",
        '┃' => "|",
        '┊' => ":",
        '▒' => "~",
        '▓' => "#",
        '░' => ".",
        '┄' => "-",
        '◉' => "@",
        // A star would read as part of a bar.
        '◆' => "$",
        '▶' | '▸' => ">",
        '→' => ">",
        '←' => "<",
        '↑' | '↗' | '↖' | '▲' => "^",
        '↓' | '↙' | '↘' | '▼' => "v",
        '×' => "x",
        '•' => "o",
        '∙' => ".",
        '╱' => "/",
        '╲' => "\\",
        '╳' => "x",
        'μ' | 'µ' => "u",
        '─'..='╿' => "+",
        '\u{2800}'..='\u{28ff}' => dots(symbol as u32 & 0xff),
        // Marks that join the letter before.
        '\u{300}'..='\u{36f}' | '\u{200d}' | '\u{fe00}'..='\u{fe0f}' => "",
        _ => letters_of(symbol).unwrap_or("?"),
    })
}

/// ASCII of another letter or sign: two names of options must not become one, which is then recommended. `None` for a number that
/// is no plain digit: raised, circled or a fraction. Behind digits it would make another number: `10⁴` would become `104`.
fn letters_of(symbol: char) -> Option<&'static str> {
    let letters = deunicode_char(symbol)?.trim_end();
    let is_raised = matches!(symbol, '¹' | '⁰'..='₟' | '①'..='⓿' | '❶'..='➓');
    let is_digit = letters.len() == 1 && !is_raised;
    (is_digit || !letters.bytes().any(|letter| letter.is_ascii_digit())).then_some(letters)
}

/// Substitute of a braille character by the shape of its dots, so that a dotted limit, a line and a double line differ. Each dot is
/// a bit of `bits`.
fn dots(bits: u32) -> &'static str {
    // From top to bottom, the dots of the left column are bits 0, 1, 2 and 6. The dots of the right column are bits 3, 4, 5 and 7.
    const ROWS: [u32; 4] = [0b1001, 0b1_0010, 0b10_0100, 0b1100_0000];
    const LEFT: u32 = 0b100_0111;
    let height = |side: u32| -> Option<f64> {
        let rows: Vec<usize> = (0..4).filter(|&row| bits & side & ROWS[row] != 0).collect();
        (!rows.is_empty()).then(|| rows.iter().sum::<usize>() as f64 / rows.len() as f64)
    };
    match (bits.count_ones(), height(LEFT), height(!LEFT)) {
        (0, ..) => " ",
        (1, ..) => ".",
        (5.., ..) => "@",
        (_, Some(left), Some(right)) if left > right => "/",
        (_, Some(left), Some(right)) if left < right => "\\",
        (2, Some(_), Some(_)) => "-",
        (_, Some(_), Some(_)) => "=",
        _ => "|",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_has_an_ascii_form() {
        assert_eq!(to_ascii("⠁⡀⣀⠉"), "..--", "a limit differs from a curve");
        assert_eq!(to_ascii("⡇⢸⠤⠔⠢⣤⣶⠀"), "||-/\\=@ ", "and a cable over its limit from one below");
        assert_eq!(to_ascii("1.7655 ± 0.0002 · ▁▇"), "1.7655 +- 0.0002 ; _&");
        assert_eq!(to_ascii("e\u{301}té 爆"), "ete Bao");
        assert_eq!(to_ascii("схема А, схема Б"), "skhema A, skhema B", "names stay apart");
        assert_eq!(
            to_ascii("10⁴ 2½ ①, ٤ ≤ №"),
            "10? 2? ?, 4 <= No",
            "no sign makes another number of a name"
        );
        assert_eq!(to_ascii("○ slide — “42 ms” 2.6° kg/m³"), "o slide - \"42 ms\" 2.6deg kg/m3");
    }
}
