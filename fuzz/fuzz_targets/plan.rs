//! Any text is a plan, or a list of mistakes that can be shown; its values can be listed and replaced.
#![no_main]

use libfuzzer_sys::fuzz_target;
use shelter::plan::Plan;
use shelter::plan::edit::fields;

fuzz_target!(|text: &str| {
    match Plan::parse("plan.toml", text) {
        Ok(_) => {
            let fields = fields::fields(text);
            if let Some(field) = fields.get(text.len() % fields.len().max(1)) {
                let changed = fields::set(text, &field.path, &field.value);
                assert!(changed.is_ok(), "{field:?}: {changed:?}");
            }
        }
        Err(mistakes) => {
            assert!(mistakes.iter().next().is_some(), "a refusal says why");
            // Drawing them takes ten times as long as finding them.
            if text.len().is_multiple_of(16) {
                assert!(!mistakes.render(false).is_empty());
            }
        }
    }
});
