//! Sparklines: a series as one line of bars. Each stretch of the series keeps its tallest bar. A value above a limit is a full
//! block.

/// Bars from the least to the greatest value. No bar is a full block: rows of sparklines would run into each other.
const BARS: [char; 7] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇'];

/// Bar of a value above the limit.
const BEYOND: char = '█';

/// The bar of a value. The tallest bar stands for `top`.
pub fn bar(value: f64, top: f64) -> char {
    match value > top {
        true => BEYOND,
        false => BARS[((value / top * BARS.len() as f64) as usize).min(BARS.len() - 1)],
    }
}

/// `width` bars for `series`. The tallest bar stands for `top`, or for the greatest value where `top` is 0.
pub fn sparkline(series: &[f64], width: usize, top: f64) -> String {
    let top = if top > 0.0 { top } else { series.iter().copied().fold(0.0, f64::max) };
    resample(series, width).into_iter().map(|value| bar(value, top)).collect()
}

/// The greatest value of each of `width` stretches of `series`.
pub fn resample(series: &[f64], width: usize) -> Vec<f64> {
    if series.is_empty() {
        return vec![0.0; width];
    }
    let edge = |n: usize| n * series.len() / width;
    let stretch = |n: usize| edge(n)..edge(n + 1).max(edge(n) + 1).min(series.len());
    (0..width).map(|n| series[stretch(n)].iter().copied().fold(0.0, f64::max)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_sparkline_keeps_the_peak() {
        let mut series = vec![0.0; 1000];
        series[613] = 1.0;
        assert_eq!(sparkline(&series, 10, 0.0), "▁▁▁▁▁▁▇▁▁▁");
        assert_eq!(sparkline(&series, 10, 2.0), "▁▁▁▁▁▁▄▁▁▁");
        assert_eq!(sparkline(&series, 10, 0.9), "▁▁▁▁▁▁█▁▁▁", "past the limit");
    }

    #[test]
    fn short_empty_and_zero_series_have_bars_too() {
        assert_eq!(sparkline(&[0.0, 1.0], 4, 0.0), "▁▁▇▇");
        assert_eq!(sparkline(&[], 3, 0.0), "▁▁▁");
        assert_eq!(sparkline(&[0.0], 0, 0.0), "");
    }
}
