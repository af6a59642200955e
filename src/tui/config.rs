//! The user's configuration (colors, characters, keys), and the list of recently opened plans.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

use etcetera::{BaseStrategy, choose_base_strategy};
use serde::Deserialize;

use super::keymap::{BINDINGS, Keymap};
use super::theme::Theme;
use crate::file::canonical;
use crate::kept::state_folder;

/// The configuration.
#[derive(Clone, Debug)]
pub struct Config {
    /// Colors at the start.
    pub theme: Theme,
    /// Whether only plain ASCII characters are drawn.
    pub ascii: bool,
    /// Whether the program takes mouse clicks. If not, the terminal selects text.
    pub mouse: bool,
    /// Which key triggers which action.
    pub keymap: Keymap,
}

impl Default for Config {
    fn default() -> Self {
        Self { theme: Theme::default(), ascii: false, mouse: true, keymap: Keymap::default() }
    }
}

/// The configuration as written in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(default)]
    theme: Theme,
    #[serde(default)]
    ascii: bool,
    #[serde(default = "with_mouse")]
    mouse: bool,
    #[serde(default)]
    keys: BTreeMap<String, Vec<String>>,
}

fn with_mouse() -> bool {
    Config::default().mouse
}

impl Config {
    /// The user's configuration; or the default and the mistake in the user's. A mistake must not keep anybody from looking at a plan.
    pub fn load_or_default() -> (Self, Option<String>) {
        match Self::load() {
            Ok(config) => (config, None),
            Err(mistake) => {
                // Leave out the excerpt that `toml` shows.
                let lines = mistake.lines().filter(|line| !line.contains('|'));
                let words = lines.collect::<Vec<_>>().join(": ");
                (Self::default(), Some(format!("the configuration is not used: {words}")))
            }
        }
    }

    /// Reads the user's configuration. Returns the default if the user has none.
    pub fn load() -> Result<Self, String> {
        let Some(path) = path() else { return Ok(Self::default()) };
        if path.exists() && !path.is_file() {
            return Err(format!("{}: not a file", path.display()));
        }
        match fs::read_to_string(&path) {
            Ok(text) => Self::parse(&text).map_err(|mistake| format!("{}: {mistake}", path.display())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Self::default()),
            Err(error) => Err(format!("{}: {error}", path.display())),
        }
    }

    /// Reads a configuration from its text, or returns the mistake in it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let written: Written =
            toml::from_str(text).map_err(|error| error.to_string().trim_end().to_owned())?;
        let keymap = Keymap::with(written.keys).map_err(|mistake| format!("[keys]: {mistake}"))?;
        let Written { theme, ascii, mouse, .. } = written;
        Ok(Self { theme, ascii, mouse, keymap })
    }
}

/// The path of the user's configuration.
pub fn path() -> Option<PathBuf> {
    Some(choose_base_strategy().ok()?.config_dir().join("shelter/config.toml"))
}

/// The text of the default configuration; every line is commented out.
pub fn default_text() -> String {
    let read_from = path().map_or_else(String::new, |path| format!("# Read from {}.\n", path.display()));
    let mut text = format!(
        "# The terminal's colours, characters and keys. Take the '#' away from what you change.\n{read_from}\n\
         # theme = \"dark\"   # dark | light | sunlight\n# ascii = false    # plain characters only, for poor fonts\n\
         # mouse = true     # false: no clicks, and the terminal selects text\n\n\
         # Keys: one character, or a name such as \"enter\", \"pageup\", \"f5\", \"ctrl-a\", \"alt-a\".\n# [keys]\n"
    );
    let width = BINDINGS.iter().map(|binding| binding.name.len()).max().unwrap_or(0);
    for binding in BINDINGS {
        let keys: Vec<String> = binding.keys.iter().map(|key| format!("{key:?}")).collect();
        text += &format!(
            "# {:width$} = {:20} # {}\n",
            binding.name,
            format!("[{}]", keys.join(", ")),
            binding.text
        );
    }
    text
}

/// Most plans that the list of recent plans holds.
const MOST_RECENT: usize = 10;

fn recent_path() -> Option<PathBuf> {
    Some(state_folder()?.join("recent"))
}

/// Recently opened plans whose files still exist, newest first.
pub fn recent() -> Vec<PathBuf> {
    let text = recent_path().and_then(|path| fs::read_to_string(path).ok()).unwrap_or_default();
    text.lines().map(PathBuf::from).filter(|path| path.is_file()).collect()
}

/// Adds a plan to the list of recent plans. Ignores errors: the list is a convenience.
pub fn remember(plan: &Path) {
    let (Some(path), Ok(plan)) = (recent_path(), canonical(plan)) else { return };
    let mut plans = recent();
    plans.retain(|other| *other != plan);
    plans.insert(0, plan);
    plans.truncate(MOST_RECENT);
    let lines: Vec<&str> = plans.iter().filter_map(|plan| plan.to_str()).collect();
    let folder = path.parent().map(fs::create_dir_all);
    if matches!(folder, Some(Ok(()))) {
        let _ = crate::file::save(&path, &(lines.join("\n") + "\n"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_text_states_the_defaults() {
        assert!(default_text().lines().all(|line| line.is_empty() || line.starts_with('#')));
        let all: String = default_text()
            .lines()
            .filter_map(|line| line.strip_prefix("# "))
            .filter(|line| line.contains(" = ") || *line == "[keys]")
            .map(|line| format!("{line}\n"))
            .collect();
        let config = Config::parse(&all).unwrap_or_else(|mistake| panic!("{mistake}\n{all}"));
        assert!(config.mouse && !Config::parse("mouse = false").expect("a configuration").mouse);
        for binding in BINDINGS {
            let default = Keymap::default().all_keys(binding.action);
            assert_eq!(config.keymap.all_keys(binding.action), default);
        }
    }

    #[test]
    fn mistakes_are_named_with_line_and_column() {
        for (text, expected) in [
            ("theme = \"pink\"", "line 1, column 9"),
            ("ascii = 1", "line 1, column 9"),
            ("colour = 1", "unknown field"),
            ("[keys]\nsvae = [\"s\"]", "did you mean 'save'"),
            ("[keys]\nsave = \"s\"", "line 2, column 8"),
        ] {
            let told = Config::parse(text).expect_err("a mistake");
            assert!(told.contains(expected), "{told}");
        }
    }
}
