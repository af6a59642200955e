//! The screen of a terminal as SVG.

use std::fmt::Write as _;

use vt100::{Cell, Color, Screen};

/// Width and height of a cell [px].
const CELL: (f64, f64) = (8.4, 17.0);
/// What a terminal's screen lies on.
#[derive(Clone, Copy)]
pub enum Ground {
    Dark,
    Light,
}

impl Ground {
    /// Its name as a theme of the program, and in the names of pictures.
    pub fn name(self) -> &'static str {
        match self {
            Ground::Dark => "dark",
            Ground::Light => "light",
        }
    }

    /// Colours of background and letters where the program names none.
    fn colors(self) -> [&'static str; 2] {
        match self {
            Ground::Dark => ["#101418", "#d0d0d0"],
            Ground::Light => ["#fafaf6", "#1e1e1e"],
        }
    }
}

/// The first sixteen colours of a terminal.
const NAMED: [&str; 16] = [
    "#1c1c1c", "#cd3131", "#0dbc79", "#c8b04a", "#2472c8", "#bc3fbc", "#11a8cd", "#d0d0d0", "#666666",
    "#f14c4c", "#23d18b", "#f5f543", "#3b8eea", "#d670d6", "#29b8db", "#ffffff",
];

/// Draws a screen: runs of cells of one style are one text.
pub fn svg(screen: &Screen, ground: Ground) -> String {
    let colors @ [ground_paper, ground_ink] = ground.colors();
    let (rows, columns) = screen.size();
    let (width, height) = (CELL.0 * f64::from(columns), CELL.1 * f64::from(rows));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" font-size=\"14\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"{ground_paper}\"/>\n"
    );
    for row in 0..rows {
        let mut column = 0;
        while column < columns {
            let style = screen.cell(row, column).map(|cell| style(cell, colors));
            let mut text = String::new();
            let begun = column;
            while column < columns && screen.cell(row, column).map(|cell| self::style(cell, colors)) == style
            {
                let letter = screen.cell(row, column).map_or(" ", |cell| cell.contents());
                text.push_str(if letter.is_empty() { " " } else { letter });
                column += 1;
            }
            let (x, y) = (CELL.0 * f64::from(begun), CELL.1 * f64::from(row));
            let (ink, paper, bold) = style.unwrap_or((ground_ink.to_owned(), ground_paper.to_owned(), false));
            let length = CELL.0 * f64::from(column - begun);
            if paper != ground_paper {
                let _ = writeln!(
                    svg,
                    "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{length:.1}\" height=\"{}\" fill=\"{paper}\"/>",
                    CELL.1
                );
            }
            if !text.trim().is_empty() {
                let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
                let weight = if bold { " font-weight=\"bold\"" } else { "" };
                let base = y + 0.78 * CELL.1;
                let _ = writeln!(
                    svg,
                    "<text x=\"{x:.1}\" y=\"{base:.1}\" fill=\"{ink}\"{weight} textLength=\"{length:.1}\" xml:space=\"preserve\">{text}</text>"
                );
            }
        }
    }
    svg + "</svg>\n"
}

/// Colours of letter and background, and whether the letter is bold.
fn style(cell: &Cell, [paper, ink]: [&str; 2]) -> (String, String, bool) {
    let (ink, paper) = (color(cell.fgcolor(), ink), color(cell.bgcolor(), paper));
    if cell.inverse() { (paper, ink, cell.bold()) } else { (ink, paper, cell.bold()) }
}

fn color(color: Color, default: &str) -> String {
    match color {
        Color::Default => default.to_owned(),
        Color::Rgb(r, g, b) => format!("#{r:02x}{g:02x}{b:02x}"),
        Color::Idx(n) if n < 16 => NAMED[usize::from(n)].to_owned(),
        Color::Idx(n @ 16..=231) => {
            let level = |n: u8| if n == 0 { 0 } else { 55 + 40 * u16::from(n) };
            let n = n - 16;
            format!("#{:02x}{:02x}{:02x}", level(n / 36), level(n / 6 % 6), level(n % 6))
        }
        Color::Idx(n) => {
            let gray = 8 + 10 * u16::from(n - 232);
            format!("#{gray:02x}{gray:02x}{gray:02x}")
        }
    }
}
