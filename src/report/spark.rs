//! Sparklines: a series as one line of bars; of each stretch the tallest bar is kept.

/// Bars from the least to the greatest. No full block: rows of sparklines would run into one another.
pub const BARS: [char; 7] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇'];

/// `width` bars for `series`, scaled so that `top` fills a bar, or the greatest value where that is more.
pub fn sparkline(series: &[f64], width: usize, top: f64) -> String {
    let full = series.iter().copied().fold(top, f64::max);
    let bar = |value: f64| {
        let level = if full > 0.0 { value / full * BARS.len() as f64 } else { 0.0 };
        BARS[(level as usize).min(BARS.len() - 1)]
    };
    resample(series, width).into_iter().map(bar).collect()
}

/// The greatest of each of `width` stretches of `series`.
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
    }

    #[test]
    fn short_empty_and_zero_series_have_bars_too() {
        assert_eq!(sparkline(&[0.0, 1.0], 4, 0.0), "▁▁▇▇");
        assert_eq!(sparkline(&[], 3, 0.0), "▁▁▁");
        assert_eq!(sparkline(&[0.0], 0, 0.0), "");
    }
}
