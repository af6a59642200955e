//! Tables of a report as HTML.

use maud::{Markup, html};

use crate::report::language::phrase;
use crate::report::palette::Role;
use crate::report::parts::{Align, Audience, Cell, Column, Table};
use crate::verdict::{Verdict, VerdictWord};

/// Bars of a sparkline.
const BARS: usize = 16;

/// The columns of a table that readers of the page see. The row of the option `to_be_fired` stands out.
pub fn table(table: &Table, to_be_fired: Option<usize>) -> Markup {
    let seen = table.columns_for(|shown| matches!(shown, Audience::People | Audience::Page));
    let number = |n: usize| (table.columns[n].align == Align::Right).then_some("n");
    html! {
        table {
            thead { tr { @for &n in &seen { th class=[number(n)] { (heading(&table.columns[n])) } } } }
            tbody {
                @for (option, row) in table.rows.iter().enumerate() {
                    tr.fired[to_be_fired == Some(option)] {
                        @let known = row.count_known(&seen);
                        @for &n in &seen[..known] { td class=[number(n)] { (cell(&row.cells[n])) } }
                        @if let Some(missing) = &row.missing { td colspan=(seen.len() - known) { (missing) } }
                    }
                    // Beside an option to be fired, the page shows only details that speak against an option.
                    @for detail in row.details.iter().filter(|detail| to_be_fired.is_none() || detail.verdict != Verdict::Pass) {
                        // Paper has no room for these details.
                        tr.aside[to_be_fired.is_some()] { td {} td.quiet colspan=(seen.len() - 1) { (detail.text) } }
                    }
                }
            }
        }
    }
}

fn heading(column: &Column) -> Markup {
    html! { (column.label()) @if !column.subheading.is_empty() { div { (phrase(column.subheading)) } } }
}

fn cell(cell: &Cell) -> Markup {
    match cell {
        Cell::Verdict(verdict) => word(*verdict),
        cell => html! { (cell.label(BARS)) },
    }
}

/// A verdict in its colour.
pub fn word(word: impl Into<VerdictWord>) -> Markup {
    let word = word.into();
    html! { span class=(Role::of(word).class()) { (phrase(word.for_people())) } }
}
