//! What a command says beside its results.

/// Prints a line to standard error. Where nobody reads there any more, nothing is said; `eprintln` would panic.
macro_rules! tell {
    ($($words:tt)*) => {{
        // There is nobody to tell.
        let _ = std::io::Write::write_fmt(&mut std::io::stderr(), format_args!("{}\n", format_args!($($words)*)));
    }};
}
