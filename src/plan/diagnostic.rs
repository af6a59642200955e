//! Mistakes in a plan, each with line, column and remedy. They look like the messages of a compiler.

use std::fmt;
use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::visible;

use crate::sorting::sort_by_key;

/// Largest number of mistakes shown at once: a file that is no plan has thousands.
const SHOWN: usize = 20;

/// Largest number of mistakes kept of one text: the rest would only take memory.
pub const MOST_KEPT: usize = 1000;

/// One mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Bytes of the source with the mistake.
    pub span: Range<usize>,
    /// Says what is wrong.
    pub message: String,
    /// Says what would be right; empty if the message says that already.
    pub remedy: String,
}

impl Mistake {
    /// A mistake at these bytes of the source, with its message and remedy.
    pub fn new(span: Range<usize>, message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { span, message: message.into(), remedy: remedy.into() }
    }
}

/// All mistakes of one plan, in the order of its lines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics {
    path: String,
    source: String,
    mistakes: Vec<Mistake>,
}

impl Diagnostics {
    /// Mistakes in `source`, the text of the file `path`.
    pub(super) fn new(path: &str, source: &str, mut mistakes: Vec<Mistake>) -> Self {
        sort_by_key(&mut mistakes, |mistake| (mistake.span.start, mistake.span.end));
        Self { path: path.to_owned(), source: source.to_owned(), mistakes }
    }

    /// One mistake of a file that cannot be read.
    pub(super) fn unreadable(path: &str, message: String, remedy: &str) -> Self {
        Self::new(path, "", vec![Mistake { span: 0..0, message, remedy: remedy.to_owned() }])
    }

    /// Number of mistakes kept; never 0.
    pub fn len(&self) -> usize {
        self.mistakes.len()
    }

    /// Whether there is no mistake.
    pub fn is_empty(&self) -> bool {
        self.mistakes.is_empty()
    }

    /// Message and remedy of the first mistake, in one line.
    pub fn first(&self) -> String {
        let first = self.mistakes.first();
        first.map_or_else(String::new, |mistake| format!("{}; {}", mistake.message, mistake.remedy))
    }

    /// Line and column (from 1), message and remedy of each mistake.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, &str, &str)> {
        self.mistakes.iter().map(|mistake| {
            let before = self.source.get(..mistake.span.start).unwrap_or("");
            let line = before.matches('\n').count() + 1;
            let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
            (line, column, mistake.message.as_str(), mistake.remedy.as_str())
        })
    }

    /// All mistakes with file, line, column, the line itself and the remedy.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let renderer = renderer.decor_style(DecorStyle::Ascii);
        let mut text = String::new();
        for mistake in self.mistakes.iter().take(SHOWN) {
            let snippet = (!self.source.is_empty()).then(|| {
                // Only this line, because the renderer would take memory for every line of the source.
                let Range { start, end } = self.visible(&mistake.span);
                let before = &self.source[..start];
                let line = before.rfind('\n').map_or(0, |newline| newline + 1);
                let number = before.matches('\n').count() + 1;
                let line_end =
                    self.source[end..].find('\n').map_or(self.source.len(), |newline| end + newline);
                let annotation = AnnotationKind::Primary.span(start - line..end - line);
                Snippet::source(&self.source[line..line_end])
                    .line_start(number)
                    .path(self.path.as_str())
                    .annotation(annotation)
            });
            let title = match snippet {
                Some(_) => visible(&mistake.message).into_owned(),
                None => format!("{}: {}", self.path, visible(&mistake.message)),
            };
            let mut group = Level::ERROR.primary_title(title).elements(snippet);
            if !mistake.remedy.is_empty() {
                group = group.element(Level::HELP.message(visible(&mistake.remedy)));
            }
            text += &renderer.render(&[group]);
            text += "\n\n";
        }
        if let Some(more @ 1..) = self.mistakes.len().checked_sub(SHOWN) {
            let at_least = if self.mistakes.len() < MOST_KEPT { "" } else { "at least " };
            text += &format!("and {at_least}{more} more mistakes in {}\n", self.path);
        }
        text
    }

    /// The part of a span on its first line.
    fn visible(&self, span: &Range<usize>) -> Range<usize> {
        let begin_of_char =
            |at: usize| (0..=at).rev().find(|&at| self.source.is_char_boundary(at)).unwrap_or(0);
        let start = begin_of_char(span.start.min(self.source.len()));
        let rest = &self.source[start..];
        let line_end = start + rest.find('\n').unwrap_or(rest.len());
        start..begin_of_char(span.end.clamp(start, line_end))
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Diagnostics {}
