//! One page for the blast file: the option to be fired, the plan, the results, the limits of the model, and room to sign. The page
//! loads nothing from elsewhere. It prints on A4 and Letter, and reads on a phone.

mod chosen_option;
mod facts;
mod map_frame;
mod record;
mod style;
mod svg;
mod table;
mod top_view;
mod words;

pub use self::svg::{stack_charts, svg};
use self::table::word;
pub use self::top_view::svg as top_view;

use chrono::{DateTime, Local};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::charts::Course;
use super::observed::{self, ObservedRow, observed_table};
use super::parts::{Block, Cell, Report};
use super::shared_columns::VERDICT;
use super::words::drawn_shot::deciding_samples;
use super::words::objections;
use super::words::option_sentences;
use super::words::to_be_confirmed::ToConfirm;
use super::words::{plan_warnings, to_be_confirmed, warnings};
use super::{charts, check, sweep};
use crate::file;
use crate::plan::observations::Observations;
use crate::report::answer::withhold;
use crate::report::language;
use crate::report::language::{phrase, say};
use crate::study::assumptions::Assumptions;
use crate::study::judge::OptionResults;
use crate::study::judge::recommend::MustPass;
use crate::study::observed::Withdrawn;
use crate::study::samples::sample_count::Sampling;
use crate::study::standing::verdict_word::ThinPass;
use crate::study::standing::{Doubt, Standing};
use crate::study::sweep::Sweep;
use crate::study::{Case, Computed, FileState};
use crate::verdict::{Verdict, VerdictWord};

/// Data of a page.
pub struct Page<'a> {
    /// The plan.
    pub case: &'a Case,
    /// Results of the options of the plan (`n_options`).
    pub results: &'a OptionResults,
    /// Index of the option to be fired; `None` where none is chosen.
    pub to_be_fired: Option<usize>,
    /// Sampling behind the verdicts; `None` where only the planned shots were judged.
    pub sampling: Option<&'a Sampling>,
    /// What the pass of each option stands on (`n_options`); `None` where it is not known.
    pub stands_on: &'a [Option<&'a Assumptions>],
    /// A sweep of the interval between rows, whose charts the page shows.
    pub sweep: Option<&'a Computed<Sweep>>,
    /// Observations of earlier shots beside their predictions; empty where there are none.
    pub observed: &'a [ObservedRow<'a>],
    /// Files that hold these observations.
    pub files: &'a [Observations],
    /// Observations that were taken back.
    pub withdrawn: &'a [Withdrawn],
    /// Whether the passes of the plan stand, and what speaks against firing by it.
    pub standing: &'a Standing,
    /// Whether the time was up before everything was computed.
    pub partial: bool,
    /// Day of the page, printed as it is.
    pub date: &'a str,
}

impl Page<'_> {
    /// Lines to confirm before the shot of the page.
    fn to_be_confirmed(&self) -> Vec<ToConfirm> {
        let fired = self.to_be_fired.and_then(|option| Some((option, self.results[option].as_ref().ok()?)));
        to_be_confirmed::to_be_confirmed(self.case, fired, self.files, self.standing.compared())
    }

    /// Whether no file holds the text of the plan that was judged.
    fn is_unsaved(&self) -> bool {
        self.standing.file() != FileState::AsJudged
    }

    /// The verdict on an option as people read it.
    fn word(&self, option: usize) -> VerdictWord {
        self.standing.word(self.results[option].as_ref().ok(), self.stands_on(option))
    }

    /// What the pass of an option stands on; `None` where it is not known.
    fn stands_on(&self, option: usize) -> Option<&Assumptions> {
        self.stands_on.get(option).copied().flatten()
    }

    /// What ends the pass of an option; `None` where the pass is not thin.
    fn thin(&self, option: usize) -> Option<ThinPass> {
        ThinPass::of(self.results[option].as_ref().ok()?, self.stands_on(option))
    }

    /// What speaks first against firing any option by this page; `None` where nothing does.
    fn against_any(&self) -> Option<Doubt> {
        let is_fixed = self.results.iter().flatten().any(|judged| judged.checked.compute.step.is_some());
        let is_planned_alone = self.sampling.is_none().then_some(Doubt::PlannedAlone);
        self.standing.against_plan().or(is_planned_alone).or(is_fixed.then_some(Doubt::FixedStep))
    }

    /// What speaks first against firing an option; `None` where the option may be fired.
    fn against_firing(&self, option: usize) -> Option<Doubt> {
        self.standing.against_firing(self.results[option].as_ref().ok(), self.stands_on(option))
    }
}

/// Whether a text is a page that this program wrote.
pub fn is_page(text: &str) -> bool {
    text.contains(r#"<meta name="generator" content="shelter">"#)
}

/// Whether a page wrongly permits to fire an option of the plan in a file of this name. `head` is the head of the page, `checksum`
/// the checksum of the plan's text. The permission is wrong where the page belongs to another text, or the option is `refused`.
pub fn permits_wrongly(head: &str, plan: &str, checksum: &str, refused: &[String]) -> bool {
    let says = |name, content: &str| head.contains(&meta(name, content).into_string());
    let is_permit = says(META_PLAN, plan) && head.contains(META_FIRED);
    is_permit && (!says(META_TEXT, checksum) || refused.iter().any(|option| says(META_FIRED, option)))
}

/// Names of the entries for programs in the head of a page: the name of the plan's file, the checksum of its text, and the option
/// that the page permits to fire.
const META_PLAN: &str = "shelter-plan";
const META_TEXT: &str = "shelter-plan-sha256";
const META_FIRED: &str = "shelter-to-be-fired";

fn meta(name: &str, content: &str) -> Markup {
    html! { meta name=(name) content=(content); }
}

/// The name of a file without its folders.
fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// The page as an HTML text.
pub fn page(page: &Page<'_>) -> String {
    let Page { case, results, to_be_fired, sampling, .. } = *page;
    let hash = file::checksum(&case.source.text);
    let mut report = check::report_of_plan(
        case,
        results,
        None,
        MustPass::Every,
        (page.standing, page.files),
        page.partial,
    );
    say_words(&mut report, page);
    // These warnings stand at the head.
    let against = objections::against_plan(case, page.standing);
    report.warnings.retain(|warning| !against.contains(warning));
    let fired_judged = to_be_fired.and_then(|option| Some((option, results[option].as_ref().ok()?)));
    let checked = fired_judged.map(|(_, judged)| &judged.checked);
    let of_fired = fired_judged.map(|(option, judged)| warnings::of_option(case, option, judged));
    let others = to_be_confirmed::other_shots_unknown(case, page.files).filter(|_| to_be_fired.is_none());
    let is_new = page.files.iter().any(|file| !file.was_fitted(&case.plan.fitted_from));
    let not_fitted = is_new.then(|| {
        phrase("the plan is not fitted to all that was seen: `shelter fit` may change the verdict").to_owned()
    });
    let withdrawn = page.withdrawn.iter().map(|Withdrawn { what, day, .. }| {
        say!("{what}: it was seen, and taken back on {day}; why, say here: ________________", what, day)
    });
    let of_seen = others.chain(withdrawn).chain(not_fitted).collect();
    // A page for an option lists these values among its lines to confirm.
    let assumed =
        to_be_confirmed::marked_as_assumed(case).filter(|_| to_be_fired.is_none()).into_iter().collect();
    let of_file = objections::of_file(&case.source.name(), page.standing.file()).into_iter().collect();
    let exact =
        plan_warnings::nearly_exact_inputs(case).filter(|_| to_be_fired.is_none()).into_iter().collect();
    let mut of_plan = [assumed, plan_warnings::of_plan(case), exact].concat();
    let mut of_fired = of_fired.unwrap_or_default();
    if to_be_fired.is_some() {
        let boxes: Vec<String> = page.to_be_confirmed().into_iter().map(|line| line.text).collect();
        [&mut of_plan, &mut of_fired]
            .into_iter()
            .for_each(|all| all.retain(|warning| !boxes.contains(warning)));
    }
    let at_head = [of_file, of_plan, of_fired, of_seen].concat();
    let others = if to_be_fired.is_some() {
        warnings::of_options(case, results, to_be_fired)
    } else {
        report.warnings.iter().filter(|warning| !at_head.contains(warning)).cloned().collect()
    };
    let text = html! {
        (DOCTYPE)
        html lang=(language::spoken().code()) {
            head {
                meta charset="utf-8";
                meta name="generator" content="shelter";
                (meta(META_PLAN, file_name(&case.source.name())))
                (meta(META_TEXT, &hash))
                @if let Some(option) = to_be_fired.filter(|option| page.against_firing(*option).is_none()) {
                    (meta(META_FIRED, &case.plan.delays[option].name))
                }
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (case.title()) }
                style { (PreEscaped(style::style_sheet(&foot(page, &hash)))) }
            }
            body {
                h1 { (case.title()) }
                p.quiet {
                    (say!("Plan {path} · {date} · shelter {version} · SHA-256 of the plan {hash}…", case.source.name(), page.date, env!("CARGO_PKG_VERSION"), &hash[..SHORT_HASH]))
                }
                @if page.is_unsaved() {
                    p { strong { (phrase("Not saved: ")) } (phrase("no file holds the plan that was computed. Its text stands at the end of this page.")) }
                }
                @if page.partial { p { strong { (phrase("Ended early, before all was computed.")) } } }
                div.sheet {
                    (chosen_option::head(page, &at_head))
                    @if to_be_fired.is_none() { (conclusion_of(page, &report)) }
                    section {
                        h2 { (phrase("The shelter from above")) }
                        // The view is low where lines to confirm stand below it. So the signatures stay on the same sheet.
                        div.view.low[to_be_fired.is_some() && !page.to_be_confirmed().is_empty()] { (PreEscaped(top_view(case, to_be_fired, checked))) }
                    }
                    (record::to_be_confirmed(page))
                    (record::signatures(page))
                }
                @if let Some((option, judged)) = fired_judged {
                    (over_time(page, option))
                    (chosen_option::peaks(case, judged))
                }
                section.shelter {
                    h2 { (phrase("Shelter")) }
                    (facts::shelter(case, to_be_fired))
                }
                section {
                    h2 { (phrase("Delay options")) }
                    // Without the verdict on all options: readers would take it for the verdict on the option to be fired.
                    @if let (Some(_), Some(conclusion)) = (to_be_fired, &report.conclusion) { p { (say!("All options: {conclusion}", conclusion.text)) } }
                    @if let Some(Sampling { most, seed, .. }) = sampling {
                        p.quiet { (say!("At most {most} sampled shots of each option, drawn from seed {seed}", most, seed)) }
                    } @else {
                        p { (phrase("The plan's own numbers only, nothing varied: other shots that may come of this plan can fail.")) }
                    }
                    @for block in &report.blocks {
                        @if let Block::Table(options) = block { div.scroll.options { (table::table(options, to_be_fired)) } }
                    }
                    @for warning in others { p { strong { (phrase("Warning: ")) } (warning) } }
                }
                @if let Some(sweep) = page.sweep { (intervals(page, sweep)) }
                @if to_be_fired.is_none() { @for option in 0..results.len() { (over_time(page, option)) } }
                @if !page.observed.is_empty() { (seen(page)) }
                (record::blanks())
                @if sampling.is_some() {
                    section {
                        h2 { (phrase("What is not known")) }
                        (facts::uncertainty(&case.plan.uncertainty))
                    }
                }
                section {
                    h2 { (phrase("What the model assumes")) }
                    ul { @for assumption in words::ASSUMPTIONS { li { (phrase(assumption)) } } }
                }
                section {
                    h2 { (phrase("The words of this page")) }
                    (words::glossary())
                }
                section {
                    h2 { (phrase("Reproduce")) }
                    @if page.is_unsaved() { p { (phrase("After the plan below is saved as a file:")) } }
                    p { code { (facts::command(case, results, sampling)) } }
                    @if page.partial { p { (phrase("Ended early, before all was computed: the same command computes more.")) } }
                    p.quiet { (phrase("SHA-256 of the plan: ")) code { (hash) } }
                }
                (on_screen(page))
            }
        }
    };
    text.into_string()
}

/// The command that shows a sample of an option, without the number of the sample.
fn asked(page: &Page<'_>, option: usize) -> String {
    let seed = page.sampling.map_or(Sampling::OF_VERDICT.seed, |sampling| sampling.seed);
    let plan = facts::quoted(&page.case.source.name());
    let option = facts::quoted_word(&page.case.plan.delays[option].name);
    format!("shelter trace {plan} --option={option} --seed {seed} --sample")
}

/// Writes the verdict of each option into the table of options, and the number of thin passes behind the count of passes. Nobody
/// may take another option for better than it is. A pass that may not be fired has no colour of a pass.
fn say_words(report: &mut Report, page: &Page<'_>) {
    let words: Vec<VerdictWord> = (0..page.results.len()).map(|option| page.word(option)).collect();
    for (option, &word) in words.iter().enumerate() {
        let is_fired = page.to_be_fired == Some(option);
        let is_tried = is_fired || page.sampling.is_none() || page.stands_on(option).is_some();
        say_word(
            report,
            option,
            match word {
                VerdictWord::Pass if !is_tried => Cell::Text(phrase("PASS, margin not tried").to_owned()),
                word if chosen_option::is_forbidden_pass(page, option) => {
                    Cell::Text(phrase(word.for_people()).to_owned())
                }
                word => word.into(),
            },
        );
    }
    let thin = words.iter().filter(|word| **word == VerdictWord::Thin).count();
    if let Some(conclusion) = report.conclusion.as_mut().filter(|_| thin > 0) {
        conclusion.text += &say!(", {thin} of them thinly", thin);
    }
}

/// Writes the verdict of an option into the table of options.
fn say_word(report: &mut Report, option: usize, word: Cell) {
    let tables = report.blocks.iter_mut().filter_map(|block| match block {
        Block::Table(table) => Some(table),
        _ => None,
    });
    for table in tables {
        let verdict = table.columns.iter().position(|column| *column == VERDICT);
        let cell = verdict.and_then(|n| table.rows.get_mut(option)?.cells.get_mut(n));
        cell.into_iter().for_each(|cell| *cell = word.clone());
    }
}

/// Digits of the plan's checksum at the head and at the foot of every page.
const SHORT_HASH: usize = 12;

/// Foot of every printed page. It names the plan, so that nobody takes the page for a page of another plan.
fn foot(page: &Page<'_>, hash: &str) -> String {
    let option = page.to_be_fired.map(|option| {
        let name = &page.case.plan.delays[option].name;
        match page.word(option) {
            // A sheet that lies alone is no permission, either.
            VerdictWord::Pass | VerdictWord::Thin => {
                format!(" · “{name}”: {}", chosen_option::firing_instruction(page, option))
            }
            word => format!(" · “{name}”: {}", phrase(word.for_people())),
        }
    });
    let unsaved = if page.is_unsaved() { phrase(" (not saved)") } else { "" };
    say!(
        "{}{} · plan {}{unsaved} · {}",
        page.case.title(),
        option.unwrap_or_default(),
        &hash[..SHORT_HASH],
        unsaved,
        page.date
    )
}

/// Conclusion on all options, without the colour of a pass where no option may be fired.
fn conclusion_of(page: &Page<'_>, report: &Report) -> Markup {
    match report.conclusion.as_ref().filter(|_| page.against_any().is_some()) {
        Some(told) if told.word.verdict() == Verdict::Pass => {
            html! { p { (phrase(told.word.for_people())) (told.unchecked) " · " (told.text) } }
        }
        _ => conclusion(report),
    }
}

/// Conclusion of a report, with its verdict.
fn conclusion(report: &Report) -> Markup {
    html! {
        @if let Some(conclusion) = &report.conclusion {
            p { @if let Some(answer) = &report.answer { (answer) " · " } (word(conclusion.word)) (conclusion.unchecked) " · " (conclusion.text) }
        }
    }
}

/// Parts that only the file of the page shows, not paper: the other options over time, and the plan. An unsaved plan is printed,
/// too.
fn on_screen(page: &Page<'_>) -> Markup {
    let Page { case, results, to_be_fired, .. } = *page;
    let is_unsaved = page.is_unsaved();
    let others = (0..results.len()).filter(|option| to_be_fired.is_some_and(|fired| fired != *option));
    let plan = html! { @if !case.source.text.is_empty() { (verbatim(&case.source.text)) } };
    html! {
        @if is_unsaved { section { h2 { (phrase("The plan, word for word (not saved)")) } (plan) } }
        @if to_be_fired.is_some() && results.len() > 1 {
            details { summary { (phrase("The other options over time")) } @for option in others { (over_time(page, option)) } }
        }
        @if !is_unsaved { details { summary { (phrase("The plan, word for word")) } (plan) } }
    }
}

/// Height and force of an option over time; nothing where the option has no result.
fn over_time(page: &Page<'_>, option: usize) -> Markup {
    let case = page.case;
    let Ok(judged) = &page.results[option] else { return Markup::default() };
    let planned = Course::planned(case, option, &judged.checked);
    let (shown, behind) = match &judged.deciding {
        Some(deciding) => (Course::of(deciding), Some(planned)),
        None => ([planned; 2], None),
    };
    html! {
        section.whole {
            h2 { (case.plan.delays[option].name) " " (chosen_option::verdict_word(page, option)) (chosen_option::only_planned(page)) @if page.to_be_fired == Some(option) { " · " (chosen_option::firing_instruction(page, option)) } }
            p.quiet { (option_sentences::computation(case.scene(), &judged.checked)) }
            @if let (Some(deciding), Some(sampled)) = (&judged.deciding, judged.sampled.known()) {
                p.quiet { (deciding_samples(sampled.share_above(), &deciding.samples, asked(page, option))) }
            }
            div.charts {
                @for chart in charts::history(case, shown, behind) {
                    div { (PreEscaped(svg(&chart).unwrap_or_default())) }
                }
            }
        }
    }
}

/// The sweep of other intervals between rows.
fn intervals(page: &Page<'_>, sweep: &Computed<Sweep>) -> Markup {
    let (mut report, of_plan) = (sweep::report(page.case, sweep), plan_warnings::of_plan(page.case));
    // Nothing is recommended where nothing may be fired.
    let against = page.against_any();
    if against.is_some() {
        withhold(&mut report, "");
    }
    html! {
        section.whole {
            h2 { (phrase("Other intervals between rows")) }
            @if against.is_none() { (conclusion(&report)) }
            // Warnings of the plan stand at the head.
            @for warning in report.warnings.iter().filter(|warning| !of_plan.contains(warning)) {
                p { strong { (phrase("Warning: ")) } (warning) }
            }
            div.charts {
                @for chart in report.charts() { div { (PreEscaped(svg(chart).unwrap_or_default())) } }
            }
            @for block in &report.blocks {
                @if let Block::Text(sentences) = block { @for sentence in sentences { p.quiet { (sentence) } } }
            }
        }
    }
}

/// Observations of earlier shots, beside the planned and predicted values.
fn seen(page: &Page<'_>) -> Markup {
    html! {
        section.whole {
            h2 { (phrase("Earlier shots: planned, predicted, observed")) }
            p.quiet { (phrase("Of the plan of this page. Predicted: where nine of ten such observations should lie.")) }
            div.scroll { (table::table(&observed_table(page.observed), None)) }
            @if let Some(heads) = observed::heads_table(page.case, page.files) {
                h3 { (phrase("How these shots were charged and covered")) }
                div.scroll { (table::table(&heads, None)) }
            }
            @if page.files.iter().any(|file| file.was_fitted(&page.case.plan.fitted_from)) {
                p { strong { (phrase("The plan was fitted to some of these: that they lie within says nothing.")) } }
            }
            @if let Some(sentence) = observed::bands(page.case, page.observed) { p { (sentence) } }
        }
    }
}

/// A text letter by letter. HTML drops a line end at the start of `pre`, and reads a carriage return as a line end.
fn verbatim(text: &str) -> Markup {
    let escaped = html! { (text) }.into_string().replace('\r', "&#13;");
    html! { pre { "\n" (PreEscaped(escaped)) } }
}

/// Day for the page: today, or the day of SOURCE_DATE_EPOCH, which reproduces a page.
pub fn today() -> String {
    let fixed = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let fixed = fixed.and_then(|seconds| DateTime::from_timestamp(seconds, 0));
    fixed.map_or_else(|| Local::now().date_naive(), |fixed| fixed.date_naive()).to_string()
}
