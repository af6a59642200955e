//! Any text is a configuration, or one mistake in words.
#![no_main]

use libfuzzer_sys::fuzz_target;
use shelter::tui::config::Config;

fuzz_target!(|text: &str| {
    if let Err(words) = Config::parse(text) {
        assert!(!words.is_empty());
    }
});
