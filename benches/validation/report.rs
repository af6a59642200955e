//! The table: quantity, theirs, ours by both methods, difference, source.

use shelter::simulation::RunError;

/// A value of each method; `None` where the method is left out.
pub type Ours = [Option<Result<f64, RunError>>; 2];

pub fn head() {
    println!("| quantity | theirs | `verlet` | `newmark` | differences | source |");
    println!("|---|---|---|---|---|---|");
}

/// Prints what the rows below are about.
pub fn section(name: &str) {
    println!("| **{name}** | | | | | |");
}

/// Prints a row; `places` are digits after the point.
pub fn row(quantity: &str, theirs: f64, ours: Ours, places: usize, source: &str) {
    let shown = |ours: &Option<Result<f64, RunError>>| match ours {
        None => ["–".to_owned(), "–".to_owned()],
        Some(Err(error)) => [error.to_string(), "–".to_owned()],
        Some(Ok(value)) if theirs.is_infinite() => [format!("{value:.places$}"), "–".to_owned()],
        Some(Ok(value)) => [format!("{value:.places$}"), percent(value / theirs - 1.0)],
    };
    let [[verlet, verlet_off], [newmark, newmark_off]] = [shown(&ours[0]), shown(&ours[1])];
    let theirs = if theirs.is_infinite() { "∞".to_owned() } else { format!("{theirs:.places$}") };
    println!("| {quantity} | {theirs} | {verlet} | {newmark} | {verlet_off}, {newmark_off} | {source} |");
}

/// A difference in per cent, to two digits.
fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    match percent.abs() {
        off if off < 1e-4 => "0 %".to_owned(),
        off => {
            let places = (1.0 - off.log10().floor()).max(0.0) as usize;
            format!("{percent:+.places$} %")
        }
    }
}
