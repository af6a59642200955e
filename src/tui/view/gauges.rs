//! Gauges of one line: the risk of an option, the use of a limit, and a quantity over time with its limit.
//!
//! ```text
//! ━━━━┊         risk on a scale from 0.01 to 100 %, logarithmic; ┊ is the accepted risk, ┿ where the bar lies across it
//! ▆▆▆▆▆•▆▆┃82%  one in a hundred is above the bar, • is the planned shot, ┃ the limit, with the share where that is asked for
//! ▃▅▅✗✗▃▁       over time; ✗ on a full cell is past the limit
//! ⠤⠒⠉⠉⠒⠤⣀       the same of the planned shot: what is filled is the shot that decides, at every size
//! ```

use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};

use crate::report::spark::{self, resample};
use crate::tui::theme::{Theme, mark};
use crate::units;
use crate::verdict::Verdict;

/// Least risk on the scale. The greatest is 1.
pub const LEAST_RISK: f64 = 1e-4;

/// Sign of the deciding shots' use of a limit. `PLANNED`: sign of the cell that the planned shot reaches.
pub const DECIDING: &str = "▆";
pub const PLANNED: &str = "•";
/// Sign of the shot in review.
pub const REVIEWED: &str = "◆";
/// A planned shot over time: a line in a cell, from the lower edge to the upper edge.
pub const LINE: [&str; 4] = ["⣀", "⠤", "⠒", "⠉"];

/// Fill levels of a cell, from empty to full.
pub const EIGHTHS: [&str; 9] = [" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"];

/// Cells of a limit gauge beyond the limit. `LEAST_BAR`: least cells up to the limit; fewer would hide differences that matter.
const BEYOND: usize = 2;
const LEAST_BAR: usize = 5;

/// Most letters of a share of a limit.
const MOST_LETTERS: usize = 4;

/// The scale above risk gauges of this width: the accepted risk at its mark, and the ends as words if they fit.
pub fn risk_scale(accepted: f64, width: usize) -> String {
    let (low, high) = ("none", "all");
    let label = format!("{}%", units::short(1e2 * accepted));
    let start = risk_cell(accepted, width).saturating_sub((label.len() - 1) / 2);
    let start = start.min(width.saturating_sub(label.len()));
    let low = if low.len() < start { low } else { "" };
    let scale = format!("{low:start$}{label}");
    let room = width.saturating_sub(scale.len());
    if high.len() < room { format!("{scale}{high:>room$}") } else { scale }
}

/// The cell of a risk on a scale of `width` cells.
fn risk_cell(risk: f64, width: usize) -> usize {
    let part = 1.0 - risk.max(LEAST_RISK).log10() / LEAST_RISK.log10();
    ((part * width as f64) as usize).min(width.saturating_sub(1))
}

/// A failure probability between two bounds, on a logarithmic scale of `width` cells with a mark at the accepted risk.
pub fn risk(
    interval: Option<[f64; 2]>,
    accepted: f64,
    width: usize,
    [bar, scale]: [Style; 2],
) -> Line<'static> {
    let mark = risk_cell(accepted, width);
    // A risk that is surely on one side of the accepted risk does not reach its mark, however near it is.
    let ends = interval.map(|[low, high]| {
        let [from, to] = [low, high].map(|risk| risk_cell(risk, width));
        match () {
            () if high < accepted => [from, to].map(|end| end.min(mark.saturating_sub(1))),
            () if low > accepted => [from, to].map(|end| end.max(mark + 1).min(width.saturating_sub(1))),
            () => [from, to],
        }
    });
    let span = |n: usize| match ends {
        Some([from, to]) if (from..=to).contains(&n) => Span::styled(if n == mark { "┿" } else { "━" }, bar),
        _ if n == mark => Span::styled("┊", scale),
        _ => Span::raw(" "),
    };
    Line::from_iter((0..width).map(span))
}

/// Signs of the error of computing and of the spread by the inputs.
pub const ERRORS: [&str; 2] = ["●", "○"];

/// The scale above error gauges of this width: powers of ten at the same places as for risks.
pub fn error_scale(width: usize) -> String {
    let labels = [(LEAST_RISK, "0.01 %"), (1e-3, "0.1 %"), (1e-2, "1 %"), (0.1, "10 %"), (1.0, "100 %")];
    labels.into_iter().fold(String::new(), |scale, (error, label)| {
        let start = risk_cell(error, width).min(width.saturating_sub(label.len()));
        if start < scale.len() { scale } else { format!("{scale:start$}{label}") }
    })
}

/// Two errors on a logarithmic scale of `width` cells, from 0.01 to 100 %, with a line between them.
pub fn errors([computing, inputs]: [f64; 2], width: usize, [signs, line]: [Style; 2]) -> Vec<Span<'static>> {
    let [computing, inputs] = [computing, inputs].map(|error| risk_cell(error.min(1.0), width));
    let span = |n: usize| match n {
        _ if n == computing => Span::styled(ERRORS[0], signs),
        _ if n == inputs => Span::styled(ERRORS[1], signs),
        _ if (computing.min(inputs)..computing.max(inputs)).contains(&n) => Span::styled("─", line),
        _ => Span::raw(" "),
    };
    (0..width).map(span).collect()
}

/// Gauge of a limit: the share that the planned shot uses, and the share that only the accepted share of the sampled shots exceeds, as far
/// as known. The color becomes warmer than `calm` toward the limit.
pub fn use_of_limit(
    theme: Theme,
    planned: Option<f64>,
    deciding: Option<f64>,
    width: usize,
    calm: Style,
    has_share: bool,
) -> Line<'static> {
    let (beyond, greatest) = (theme.limit(), planned.into_iter().chain(deciding).fold(0.0, f64::max));
    // A narrow gauge keeps its cells for the bar, or shows digits instead of the bar.
    let has_share = has_share && width > LEAST_BAR + 1 + MOST_LETTERS;
    let inside = width.saturating_sub(if has_share { MOST_LETTERS } else { BEYOND } + 1);
    let share = deciding.map(|share| share.max(greatest)).or((greatest > 1.0).then_some(greatest));
    let letters = share.map(in_letters).unwrap_or_default();
    let start = match () {
        () if has_share => inside + 1,
        () if inside < LEAST_BAR => inside.saturating_sub(letters.len()),
        () => width,
    };
    // A share within the limit does not reach its mark, and a share over the limit crosses it, however near it is.
    let cells = |share: f64| {
        let cells = (share * inside as f64).round() as usize;
        if share > 1.0 { cells.max(inside + 1) } else { cells.min(inside.saturating_sub(1)) }
    };
    let [planned, deciding] = [planned, deciding].map(|share| share.map_or(0, cells));
    let span = |n: usize| {
        // The cell of the limit mark belongs to no share.
        let at = if n < inside { n } else { n - 1 };
        let style = if n < inside { theme.heat(calm, (n + 1) as f64 / inside as f64) } else { beyond };
        let has_letters =
            !letters.is_empty() && (has_share && n > inside || inside < LEAST_BAR && n < inside);
        match () {
            // If no cell lies beyond the limit, the limit mark itself shows the excess.
            () if n == inside && has_share && greatest > 1.0 => Span::styled("▶", beyond),
            () if n == inside => Span::styled("┃", theme.limit_line()),
            () if has_letters => {
                let letter = n.checked_sub(start).and_then(|at| letters.get(at..=at)).unwrap_or(" ");
                Span::styled(letter.to_owned(), if greatest > 1.0 { beyond } else { theme.base() })
            }
            () if has_share && n > inside => Span::raw(" "),
            () if n + 1 == width && planned.max(deciding) > at + 1 => Span::styled("▶", beyond),
            () if at + 1 == planned => Span::styled(PLANNED, theme.title()),
            () if at < deciding => Span::styled(DECIDING, style),
            () => Span::raw(" "),
        }
    };
    Line::from_iter((0..width).map(span))
}

/// A share of a limit in few letters, rounded up: `82%`, `140%`, `12x`.
fn in_letters(share: f64) -> String {
    let percent = format!("{:.0}%", units::whole_percent(share));
    if percent.len() <= MOST_LETTERS { percent } else { format!("{share:.0}x") }
}

/// A quantity over time: filled, or a line for the planned shot. The color becomes warmer than `calm` toward the limit. Over the limit, a
/// full cell in the style of a fail with its sign, so that color is not the only sign.
pub fn over_time(
    theme: Theme,
    series: &[f64],
    limit: f64,
    width: usize,
    calm: Style,
    is_planned: bool,
) -> Line<'static> {
    let line = |share: f64| LINE[((share * LINE.len() as f64) as usize).min(LINE.len() - 1)].to_owned();
    let span = |value: f64| match (value / limit, is_planned) {
        (share, _) if share > 1.0 => {
            Span::styled(mark(Verdict::Fail), theme.limit().add_modifier(Modifier::REVERSED))
        }
        (share, true) => Span::styled(line(share), theme.heat(calm, share)),
        (share, false) => Span::styled(spark::bar(value, limit).to_string(), theme.heat(calm, share)),
    };
    Line::from_iter(resample(series, width).into_iter().map(span))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(line: &Line<'_>) -> String {
        line.spans.iter().map(|span| span.content.as_ref()).collect()
    }

    /// 0.01, 0.1, 1, 10 and 100 % lie a quarter of the scale apart. 1 % is accepted.
    #[test]
    fn risk_lies_on_its_side_of_the_accepted_one() {
        let of = |interval| text(&risk(interval, 0.01, 8, [Style::new(); 2]));
        assert_eq!(of(None), "    ┊   ");
        assert_eq!(of(Some([0.0, 0.005])), "━━━━┊   ");
        assert_eq!(of(Some([0.05, 0.2])), "    ┊━━ ");
        assert_eq!(of(Some([0.002, 0.03])), "  ━━┿   ");
        assert_eq!(of(Some([1.0, 1.0])), "    ┊  ━");
        assert_eq!(of(Some([0.001, 0.0099])), "  ━━┊   ", "near it");
        assert_eq!(of(Some([0.011, 0.02])), "    ┊━  ", "near it");
    }

    #[test]
    fn errors_stand_at_their_powers_of_ten() {
        let of = |found, width| Line::from(errors(found, width, [Style::new(); 2])).to_string();
        assert_eq!(error_scale(40), "0.01 %    0.1 %     1 %       10 % 100 %");
        assert_eq!(error_scale(8), "0.01 %");
        assert_eq!(of([1e-3, 0.1], 40), "          ●───────────────────○         ");
        assert_eq!(of([0.2, 2.0], 8), "      ●○");
        assert_eq!(of([0.0, 0.0], 4), "●   ", "computing stands before the inputs");
    }

    #[test]
    fn the_scale_of_risk_names_what_has_room() {
        assert_eq!(risk_scale(0.01, 16), "none    1%   all");
        assert_eq!(risk_scale(0.01, 11), "none 1% all");
        assert_eq!(risk_scale(0.01, 6), "   1%");
        assert_eq!(risk_scale(0.5, 11), "none    50%");
    }

    #[test]
    fn a_gauge_is_full_at_its_limit() {
        let with = |planned, deciding, has_share| {
            text(&use_of_limit(Theme::Dark, planned, deciding, 13, Style::new(), has_share))
        };
        let of = |planned, deciding| with(planned, deciding, false);
        assert_eq!(of(Some(0.6), Some(0.9)), "▆▆▆▆▆•▆▆▆ ┃  ");
        assert_eq!(of(Some(0.6), None), "     •    ┃  ");
        assert_eq!(of(None, Some(0.6)), "▆▆▆▆▆▆    ┃  ");
        assert_eq!(of(Some(0.9), Some(1.1)), "▆▆▆▆▆▆▆▆•▆┃▆ ");
        assert_eq!(of(Some(1.2), Some(3.0)), "▆▆▆▆▆▆▆▆▆▆┃▆▶");
        for over in [1.001, 1.03, 1.04] {
            assert_eq!(of(Some(over), None), "          ┃• ", "{over}");
            assert_eq!(of(Some(0.5), Some(over)), "▆▆▆▆•▆▆▆▆▆┃▆ ", "{over}");
        }
        for under in [0.96, 0.999, 1.0] {
            assert_eq!(of(None, Some(under)), "▆▆▆▆▆▆▆▆▆ ┃  ", "{under}");
        }
        for (planned, deciding, shown) in [
            (Some(0.6), Some(0.821), "▆▆▆▆•▆▆ ┃83% "),
            (Some(0.3), Some(0.6), "▆•▆▆▆   ┃60% "),
            (Some(0.3), None, " •      ┃    "),
            (Some(0.8), Some(0.93), "▆▆▆▆▆•▆ ┃93% "),
            (Some(0.6), Some(0.9999), "▆▆▆▆•▆▆ ┃100%"),
            (Some(0.9), Some(1.1), "▆▆▆▆▆▆•▆▶110%"),
            (Some(0.5), Some(12.4), "▆▆▆•▆▆▆▆▶12x "),
        ] {
            assert_eq!(with(planned, deciding, true), shown);
        }
    }

    /// In three cells, 98 % and 82 % would look the same. So digits replace the bar.
    #[test]
    fn a_narrow_gauge_has_digits_in_place_of_a_bar() {
        for (planned, deciding, shown) in [
            (Some(0.6), Some(0.82), " 82%┃  "),
            (Some(0.6), Some(0.98), " 98%┃  "),
            (Some(0.6), Some(1.03), "103%┃▆ "),
            (Some(0.6), None, " •  ┃  "),
        ] {
            assert_eq!(text(&use_of_limit(Theme::Dark, planned, deciding, 7, Style::new(), true)), shown);
        }
    }

    /// Half of the limit is calm, the limit itself has the color of a thin pass, and only a greater share has the color of a fail. In
    /// between the color changes from cell to cell.
    #[test]
    fn a_bar_grows_warmer_toward_its_limit() {
        let (theme, calm) = (Theme::Dark, Theme::Dark.verdict(Verdict::Pass));
        assert_eq!([0.0, 0.5].map(|share| theme.heat(calm, share)), [calm; 2]);
        assert_eq!(
            [1.0, 1.001].map(|share| theme.heat(calm, share).fg),
            [theme.caution().fg, theme.limit().fg]
        );
        let bar = use_of_limit(theme, None, Some(1.0), 13, calm, false);
        let colours: Vec<_> = bar.spans[4..9].iter().map(|span| span.style.fg).collect();
        assert!(colours.windows(2).all(|pair| pair[0] != pair[1]), "{colours:?}");
    }

    #[test]
    fn only_what_lies_past_the_limit_has_the_sign_of_a_fail() {
        let of = |is_planned| {
            let series = [0.0, 0.5, 0.99, 1.0, 1.01];
            text(&over_time(Theme::Dark, &series, 1.0, series.len(), Style::new(), is_planned))
        };
        assert_eq!([false, true].map(of), ["▁▄▇▇✗", "⣀⠒⠉⠉✗"]);
    }
}
