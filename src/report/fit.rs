//! `fit` as a report: the estimates of each answer, and every observation beside its planned, predicted and fitted value.

use super::brief::Brief;
use super::observed::{
    ObservedRow, bands, fitted_rows, heads_table, observed_rows, observed_table, perhaps_one_shot, place,
    remarks, seen_and_predicted,
};
use super::parts::{Audience, Block, Cell, Column, Conclusion, Fact, Field, Report, Table, fact};
use super::report_head;
use super::words::advice::{loose_tire, what_to_film};
use super::words::counted;
use super::words::objections::{of_other_shot, sentences};
use crate::choice::Unknown;
use crate::plan::observations::Observations;
use crate::sorting::sort;
use crate::study::fit::between_shots::{BetweenShots, BetweenShotsSource};
use crate::study::fit::observation_bands::NextObservation;
use crate::study::fit::parameter::Parameter;
use crate::study::fit::what_next::WhatNext;
use crate::study::fit::{
    Answer, ComparedWithObservations, Fit, FitResult, FittedParameter, NotDetermined, Observable, Residual,
};
use crate::study::observed::contradiction::count_within;
use crate::study::observed::other_shot::other_shots;
use crate::study::observed::{Comparison, Objection, is_typed};
use crate::study::standing::writable::NotWritable;
use crate::study::{Case, Computed};
use crate::units;
use crate::verdict::VerdictWord;

/// Correlation above which the report says that two estimates hang together.
const TIED: f64 = 0.7;

/// An estimate of one answer.
struct EstimateRow<'a> {
    case: &'a Case,
    /// Number of the answer, from 1.
    answer: usize,
    estimate: &'a FittedParameter,
}

fn estimate_fields<'a>(several: bool) -> [Field<EstimateRow<'a>>; 11] {
    let number = Column::numbers(&["answer"], "answer", units::Unit::One).json(&[]);
    [
        Field::new(if several { number } else { number.shown(Audience::Scripts) }, |row| row.answer.into()),
        Field::new(Column::words(&["name"], "unknown"), |row| {
            row.estimate.parameter.name(&row.case.plan).into()
        }),
        Field::new(Column::words(&[], "estimate ± sd"), |row| estimate(row.estimate).into()),
        Field::new(Column::words(&[], "in the plan"), |row| {
            row.estimate.was.map_or_else(|| "stiff".to_owned(), units::short).into()
        }),
        Field::new(Column::words(&["unit"], "unit"), |row| row.estimate.parameter.unit().into()),
        Field::new(Column::words(&[], "what it means"), |row| {
            let FittedParameter { parameter, value, sd, .. } = *row.estimate;
            launch_velocities(row.case, parameter, value, sd).into()
        }),
        Field::scripts(&["value"], |row| row.estimate.value.into()),
        Field::scripts(&["sd"], |row| row.estimate.sd.into()),
        Field::scripts(&["was"], |row| row.estimate.was.into()),
        Field::json(&["launch_m_s?"], |row| {
            let speeds = launch_speeds(row.case, row.estimate.parameter);
            let factor = row.estimate.value;
            (!speeds.is_empty()).then(|| Cell::list(speeds.iter().map(|speed| speed * factor))).into()
        }),
        Field::json(&["at_end"], |row| row.estimate.is_at_end.into()),
    ]
}

/// Facts of an answer, for scripts.
fn answer_facts(case: &Case, answer: &Answer) -> Vec<Fact> {
    let unknown =
        |estimate| Cell::object(&estimate_fields(false), &EstimateRow { case, answer: 1, estimate });
    vec![
        fact(&["chi_square"], answer.chi_square),
        fact(&["unknowns"], Cell::list(answer.estimates.iter().map(unknown))),
        fact(
            &["correlation"],
            Cell::list(answer.correlation.iter().map(|row| Cell::list(row.iter().copied()))),
        ),
    ]
}

/// The report of a fit. `sampled`: the fit varies the plan's unknowns, too.
pub fn report_of_fit(case: &Case, files: &[Observations], fit: &Fit, sampled: bool) -> Report {
    let several = fit.answers.len() > 1;
    let rows = || {
        let numbered = fit.answers.iter().enumerate();
        numbered.flat_map(|(n, answer)| {
            answer.estimates.iter().map(move |estimate| EstimateRow { case, answer: n + 1, estimate })
        })
    };
    let (best, others) = (&fit.answers[0], &fit.answers[1..]);
    let seen = fitted_rows(case, fit);
    let held = count_within(&seen_and_predicted(&seen));
    let next_facts = |next: &NextObservation| {
        vec![
            fact(&["observe"], place(case, next.observable.option, &next.observable.watched)),
            fact(&["sd"], next.sd),
            fact(&["variance_share"], next.share),
        ]
    };
    let file = |file: &Observations| vec![fact(&["path"], &file.path), fact(&["sha256"], &file.checksum)];
    let mut report = report_head(case, "shelter.fit/1", false);
    report.blocks.extend([
        Block::Facts(vec![
            fact(&["files"], Cell::list(files.iter().map(file))),
            fact(&["explained"], best.explains()),
            fact(&["degrees_of_freedom"], best.freedom),
        ]),
        Block::Facts(answer_facts(case, best)),
        Block::Facts(vec![
            fact(&["launch_common_percent"], fit.launches.map(|launches| launches.common_percent)),
            fact(&["launch_between_shots_percent"], fit.between_shots.map(|between| between.percent)),
        ]),
        Block::Text(vec![basis(files, fit, sampled)]),
        Block::Table(Table::of(&estimate_fields(several), rows())),
        Block::Text(launches_known(fit).into_iter().chain(correlated_pairs(case, best)).collect()),
        Block::Table(observed_table(&seen)),
    ]);
    report.blocks.extend(heads_table(case, files).map(Block::Table));
    report.blocks.extend([
        Block::Facts(vec![
            fact(&["other_answers"], Cell::list(others.iter().map(|answer| answer_facts(case, answer)))),
            fact(&["bands.within"], held.map(|(within, _)| within)),
            fact(&["bands.of"], held.map(|(_, of)| of)),
            fact(&["next"], fit.next.as_ref().and_then(WhatNext::observation).map(next_facts)),
        ]),
        Block::Text(
            bands(case, &seen)
                .into_iter()
                .chain(fit.next.iter().flat_map(|next| what_to_film(case, next)))
                .collect(),
        ),
    ]);
    let perhaps_others = other_shots(case, files).into_iter().filter(|other| !other.differs());
    let perhaps_others = perhaps_others.map(|other| of_other_shot(&other));
    report.warnings.extend(
        warnings(case, files, fit)
            .into_iter()
            .chain(fitted_before(case))
            .chain(perhaps_one_shot(&files.iter().collect::<Vec<_>>()))
            .chain(remarks(files))
            .chain(perhaps_others),
    );
    report.conclusion = conclusion(case, files, fit);
    report
}

/// Warning that the plan was fitted before, to films that are not compared with these.
fn fitted_before(case: &Case) -> Option<String> {
    let text = "the plan was fitted to other films before, which are not compared with these: a shot that is read again counts as another \
                one, and looks surer than it is";
    (!case.plan.fitted_from.is_empty()).then(|| text.to_owned())
}

/// Sentence: number of observations and shots behind the estimates, and how well the estimates fit.
fn basis(files: &[Observations], fit: &Fit, sampled: bool) -> String {
    let mut shots: Vec<(usize, usize)> =
        fit.file.iter().zip(&fit.observed).map(|(&file, seen)| (file, seen.option)).collect();
    shots.dedup();
    sort(&mut shots);
    shots.dedup();
    let best = &fit.answers[0];
    let paths: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
    let alone = if sampled { "" } else { "; all other numbers of the plan are taken for exact" };
    format!(
        "from {} of {} in {}: misfit {}, about {} is usual{alone}",
        counted(fit.observed.len(), "observation"),
        counted(shots.len(), "shot"),
        paths.join(", "),
        units::rounded(best.chi_square, 1),
        best.freedom
    )
}

/// An estimate with its standard deviation: `1.163 ± 0.014`.
fn estimate(estimate: &FittedParameter) -> String {
    units::value_and_sd(estimate.value, estimate.sd)
}

/// Launch velocities of the plan times a factor, in words; empty where the parameter scales no launch.
pub fn launch_velocities(case: &Case, parameter: Parameter, factor: f64, sd: f64) -> String {
    let mut speeds = launch_speeds(case, parameter);
    speeds.truncate(4);
    let words: Vec<String> = speeds
        .iter()
        .map(|speed| format!("{} m/s", units::value_and_sd(speed * factor, speed * sd)))
        .collect();
    if words.is_empty() { String::new() } else { format!("launches of {}", words.join(", ")) }
}

/// Launch velocities of the plan that a parameter scales, each once [m/s]; empty where the parameter scales none.
pub fn launch_speeds(case: &Case, parameter: Parameter) -> Vec<f64> {
    if !matches!(parameter.unknown, Unknown::Launch | Unknown::LaunchByRow) {
        return Vec::new();
    }
    let firings = case.shots.first().map_or(&[][..], |shot| &shot.firings);
    let of_row = firings.iter().filter(|firing| parameter.row.is_none_or(|row| row == firing.row));
    let mut speeds: Vec<f64> = of_row.map(|firing| (firing.launch.norm() * 1e6).round() / 1e6).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// Sentence: how well the launches are known after the fit, and how far they differ from shot to shot.
fn launches_known(fit: &Fit) -> Option<String> {
    let between = fit.between_shots?;
    let source = match between.source {
        BetweenShotsSource::Stated => "as stated".to_owned(),
        BetweenShotsSource::Assumed => "assumed: the plan does not say".to_owned(),
        BetweenShotsSource::UpperBound => format!("95 % upper bound of {} shots", between.shots),
        BetweenShotsSource::WiderThan(_) => format!("as the {} shots differ", between.shots),
    };
    let percent = |percent: f64| units::rounded(percent, 1);
    let common =
        fit.launches.map(|launches| format!("launch_common_percent {}, ", percent(launches.common_percent)));
    let (common, between) = (common.unwrap_or_default(), percent(between.percent));
    Some(format!("after this fit: {common}launch_between_shots_percent {between} ({source})"))
}

/// Warning that shots differ by more than the plan says.
fn wider_than_stated(between: BetweenShots) -> Option<String> {
    let BetweenShotsSource::WiderThan(before) = between.source else { return None };
    let [now, before] = [between.percent, before].map(|percent| units::rounded(percent, 1));
    Some(format!(
        "the shots differ from one another by some {now} %, more than launch_between_shots_percent says, {before}: the fit takes {now}; \
         were they charged and stemmed alike?"
    ))
}

/// Sentences: the estimates that hang together.
fn correlated_pairs(case: &Case, answer: &Answer) -> Vec<String> {
    let count = answer.estimates.len();
    let pairs = itertools::iproduct!(0..count, 0..count).filter(|(a, b)| a < b);
    let tied = pairs.filter(|&(a, b)| answer.correlation[a][b].abs() > TIED);
    tied.map(|(a, b)| {
        let [first, second] = [a, b].map(|n| answer.estimates[n].parameter.name(&case.plan));
        let correlation = units::rounded(answer.correlation[a][b], 2);
        format!("{first} and {second} hang together: correlation {correlation}")
    })
    .collect()
}

/// Factor between plan and estimate from which a mistake is likelier than a surprise.
const FAR_MOVE: f64 = 1.5;

fn warnings(case: &Case, files: &[Observations], fit: &Fit) -> Vec<String> {
    let best = &fit.answers[0];
    let mut warnings = Vec::new();
    if !best.is_converged {
        warnings.push(not_writable(case, &NotWritable::NotSettled));
    }
    for estimate in &best.estimates {
        let name = estimate.parameter.name(&case.plan);
        if estimate.is_at_end {
            warnings.push(format!(
                "{name} lies at an end of its plausible range: another unknown is perhaps behind it"
            ));
        }
        if matches!(estimate.parameter.unknown, Unknown::EndStiffness | Unknown::Damping) {
            warnings.push(format!(
                "{name} has no place in [uncertainty]: once written, a check takes it for exact"
            ));
        }
        let times = estimate.was.filter(|was| *was > 0.0).map_or(1.0, |was| estimate.value / was);
        if !(1.0 / FAR_MOVE..=FAR_MOVE).contains(&times) {
            let times = units::short(times);
            warnings.push(format!(
                "{name} is {times} times what the plan says: are the units, the option and the tire right?"
            ));
        }
        if let Some(from) = estimate.from_stated.filter(|from| from.abs() > 2.0) {
            let deviations = units::rounded(from.abs(), 1);
            warnings.push(format!(
                "{name} lies {deviations} sd from what [uncertainty] states of it: is the range there too narrow?"
            ));
        }
    }
    warnings.extend(fit.between_shots.and_then(wider_than_stated));
    let rows = fitted_rows(case, fit);
    let is_computed_badly =
        |row: &&ObservedRow<'_>| row.residual.is_some_and(|residual| residual.error > row.observed.sd);
    let badly: Vec<String> = rows
        .iter()
        .filter(is_computed_badly)
        .map(|row| place(case, row.observed.option, &row.observed.watched))
        .collect();
    if !badly.is_empty() {
        warnings.push(format!(
            "the error of computing is larger than the sd of the observations, which say little then: {}: choose a finer --accuracy",
            badly.join("; ")
        ));
    }
    let suspicious: Vec<String> = rows
        .iter()
        .zip(&fit.file)
        .filter(|(row, _)| row.residual.is_some_and(Residual::is_suspicious))
        .map(|(row, &file)| {
            let place = place(case, row.observed.option, &row.observed.watched);
            // Typed observations stand below a line of headings that nobody sees.
            match files.get(file).is_some_and(|file| is_typed(&file.path)) {
                true => format!("{place}, your observation {}", row.observed.line.saturating_sub(1)),
                false => format!("{place} in line {}", row.observed.line),
            }
        })
        .collect();
    if !suspicious.is_empty() {
        warnings.push(format!("suspicious, more than 3 sd from the fit: {}", suspicious.join("; ")));
    }
    warnings
}

fn conclusion(case: &Case, files: &[Observations], fit: &Fit) -> Option<Conclusion> {
    let why = fit.not_writable(case, files)?;
    Some(Conclusion::labelled(VerdictWord::Open, "NO ESTIMATE", not_writable(case, &why)))
}

/// Why a plan may not take the estimates, with the remedy.
pub fn not_writable(case: &Case, why: &NotWritable) -> String {
    match why {
        NotWritable::OtherShot(other) => {
            let remedy = match other.cause.is_scaled() {
                true => "`shelter launch` scales it",
                false => "film a shot with these tires",
            };
            format!("{}; {remedy}", of_other_shot(other))
        }
        NotWritable::TooUnsure(estimate) => format!(
            "{} is known to {} only, and the plan has no key that says so: observe more, or leave it out",
            estimate.parameter.name(&case.plan),
            units::percent(estimate.sd / estimate.value, 0)
        ),
        NotWritable::DoesNotExplain => {
            "the model does not explain what was observed: the residuals are larger than chance makes them"
                .to_owned()
        }
        NotWritable::NotSettled => {
            "the estimates have not settled and may lie elsewhere: look for a wrong observation, or observe more"
                .to_owned()
        }
        NotWritable::AtEnd => {
            "an estimate lies at an end of its plausible range: it is no estimate".to_owned()
        }
        NotWritable::SeveralAnswers(count) => format!(
            "{count} separate answers fit nearly as well: observe something that tells them apart"
        ),
    }
}

/// The report: what to observe of the next shot, and how.
pub fn report_of_next(case: &Case, what: &WhatNext) -> Report {
    let next = what.observation();
    let loose = format!("before a covered shot: {}", loose_tire(case.plan.mass_of_all_tires()));
    let observe = next.map(|next| place(case, next.observable.option, &next.observable.watched));
    let mut report = report_head(case, "shelter.fit-next/1", true);
    report.blocks.extend([
        Block::Facts(vec![
            fact(&["next.observe"], observe),
            fact(&["next.sd"], next.map(|next| next.sd)),
            fact(&["next.variance_share"], next.map(|next| next.share)),
            fact(&["next.launch_common_percent"], next.and_then(|next| next.launch_percent)),
        ]),
        Block::Text(what_to_film(case, what)),
        Block::Text(vec![loose]),
    ]);
    report
}

/// The report of a fit without estimates: the reason, and the observations beside the plan's predictions.
pub fn report_of_refusal(case: &Case, found: &FitResult) -> Report {
    let mut blocks = vec![Block::Text(refusal(case, found).into_iter().collect())];
    if let FitResult::NotDetermined { observed, predictions, .. } = found {
        blocks.push(Block::Table(observed_table(&observed_rows(case, observed, predictions))));
    }
    Report { blocks, ..Report::default() }
}

/// Adds the observations of the shots that the plan was fitted to, beside what the plan predicts of them now.
pub fn add_fitted_before(report: &mut Report, rows: &[ObservedRow<'_>]) {
    let Some(ObservedRow { case, .. }) = rows.first() else { return };
    let head = "the plan was fitted to this, and says of it now:".to_owned();
    report.blocks.extend([
        Block::Text(vec![head]),
        Block::Table(observed_table(rows).key("")),
        Block::Text(bands(case, rows).into_iter().collect()),
    ]);
}

/// Why there are no estimates, with the remedy; `None` where there are estimates.
pub fn refusal(case: &Case, found: &FitResult) -> Option<String> {
    match found {
        FitResult::Fitted(_) => None,
        FitResult::NotDetermined { refused: NotDetermined { parameters, observe }, .. } => {
            let names: Vec<String> = parameters.iter().map(|parameter| parameter.name(&case.plan)).collect();
            let what = match names.len() {
                1 => format!("the observations do not determine {}", names[0]),
                _ => format!("the observations determine only a combination of {}", names.join(" and ")),
            };
            let remedy = observe.map_or_else(
                || "nothing that can be seen of this shot would: leave it out".to_owned(),
                |Observable { option, watched }| {
                    let out = if names.len() == 1 { "it" } else { "one" };
                    format!("observe {} too, or leave {out} out", place(case, option, &watched))
                },
            );
            Some(format!("{what}: {remedy}"))
        }
        FitResult::KnownExactly(unknown) => Some(format!(
            "[uncertainty] says that {unknown} is known exactly: widen it there, or leave {unknown} out"
        )),
        FitResult::NotInMethod(unknown) => {
            Some(format!("newmark has no {unknown}: choose --method verlet, or leave {unknown} out"))
        }
    }
}

/// The report of a fit beside what the plan says, and of the observations that the plan was fitted to.
pub fn report(case: &Case, Computed { value: compared, .. }: &Computed<ComparedWithObservations>) -> Report {
    let ComparedWithObservations { fitted, new, files, seen, is_sampled, .. } = compared;
    let mut report = match fitted {
        Some(FitResult::Fitted(fit)) => report_of_fit(case, new, fit, *is_sampled),
        Some(refused) => report_of_refusal(case, refused),
        None => Report::default(),
    };
    let rows = compared_rows(case, compared).into_iter().zip(&seen.file);
    let in_plan = rows.filter(|(_, file)| files[**file].was_fitted(&case.plan.fitted_from));
    add_fitted_before(&mut report, &in_plan.map(|(row, _)| row).collect::<Vec<_>>());
    // The conclusion says why observations belong to another shot, or are not compared.
    let mut objections = compared.objections(case);
    objections.retain(|objection| matches!(objection, Objection::Contradiction(_)));
    report.warnings.splice(0..0, sentences(case, &Comparison::compared(objections)));
    report
}

/// Rows of the observations beside what the plan predicts of them.
pub fn compared_rows<'a>(case: &'a Case, compared: &'a ComparedWithObservations) -> Vec<ObservedRow<'a>> {
    observed_rows(case, &compared.seen.list, &compared.predictions)
}

/// Whether the observations agree with the plan, in one line.
pub fn in_brief(case: &Case, compared: &Computed<ComparedWithObservations>) -> Brief {
    let agrees = compared.value.objections(case).is_empty();
    let text = if agrees { "agrees with this plan" } else { "contradicts this plan" };
    let texts = vec![format!("what was seen {text}"), text.to_owned()];
    Brief { is_warning: !agrees, texts, ..Brief::default() }
}
