//! Prints orders, risks and schedules, for the studies that can be shared, and for `merge`.

use std::io;

use super::arguments::{FormatArg, LookArguments};
use super::print::print;
use super::status::Status;
use crate::report::json::{OrdersDocument, RiskDocument, SearchDocument};
use crate::report::{orders, risk, search};
use crate::study::Case;
use crate::study::judge_options::OptionResults;
use crate::study::orders::Orders;
use crate::study::samples::sample_count::Sampling;
use crate::study::search::Search;

/// Prints the orders tried; `partial` where the time was up before all were.
pub fn print_orders(
    case: &Case,
    orders: &Orders,
    partial: bool,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let document = || OrdersDocument::new(case, orders, partial);
    print(&[orders::report(case, orders, partial)], document, format, look)
}

/// Prints the risks of all options; `partial` where the time was up before all samples were drawn.
pub fn print_risks(
    case: &Case,
    results: &OptionResults,
    sampling: &Sampling,
    partial: bool,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let document = || RiskDocument::new(case, results, sampling, partial);
    print(&[risk::report(case, results, sampling, partial)], document, format, look)
}

/// Prints the schedules found; `partial` where the time was up before all were judged.
pub fn print_search(
    case: &Case,
    found: &Search,
    partial: bool,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let document = || SearchDocument::new(case, found, partial);
    print(&[search::report(case, found, partial)], document, format, look)
}
