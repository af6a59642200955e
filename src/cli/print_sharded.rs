//! Prints orders, risks and schedules, for the studies that can be shared, and for `merge`.

use std::io;

use super::arguments::{FormatArg, LookArguments};
use super::print::print;
use super::status::Status;
use crate::report::json::{OrdersDocument, RiskDocument, SearchDocument};
use crate::report::{orders, risk, search};
use crate::study::judge_options::OptionResults;
use crate::study::orders::Orders;
use crate::study::samples::sample_count::Sampling;
use crate::study::search::Search;
use crate::study::{Case, Computed};

/// Prints the orders tried.
pub fn print_orders(
    case: &Case,
    orders: &Computed<Orders>,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let document = || OrdersDocument::new(case, orders);
    print(&[orders::report(case, orders)], document, format, look)
}

/// Prints the risks of all options.
pub fn print_risks(
    case: &Case,
    results: &Computed<OptionResults>,
    sampling: &Sampling,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let document = || RiskDocument::new(case, results, sampling);
    print(&[risk::report(case, results, sampling)], document, format, look)
}

/// Prints the schedules found.
pub fn print_search(
    case: &Case,
    found: &Computed<Search>,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let document = || SearchDocument::new(case, found);
    print(&[search::report(case, found)], document, format, look)
}
