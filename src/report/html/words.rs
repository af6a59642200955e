//! Fixed texts of the page: the assumptions of the model, and the meaning of the words.

use crate::report::language::phrase;
use maud::{Markup, html};

/// Sentences under the results of every plan.
pub const ASSUMPTIONS: &[&str] = &[
    "Tires are point masses that do not turn; the ground is a hard plane. It is level, and a landing does not rebound, where the plan says nothing else.",
    "Cables are elastic and without mass, and without damping where the plan says nothing else; they only pull, and their fastenings hold.",
    "Each hole gives its tire the launch velocity written in the plan, varied in the sampled shots as [uncertainty] says; it does not follow from charge, stemming or gas: charges only count within 8 ms.",
    "Friction on the ground is Coulomb's, with one coefficient.",
    "The error stated with a value of the planned shot is that of the computation; what the plan's own numbers leave open is in the bands and the risk.",
    "The limits are the plan's; no limit is safe by default. A competent person decides.",
];

/// Words of the page, each with its meaning in one sentence.
const WORDS: &[(&str, &str)] = &[
    (
        "Verdict",
        "PASS, FAIL or OPEN: whether the planned shot, and surely enough of the shots where these were sampled, keep every limit of the plan; OPEN means that neither can be said. THIN is a PASS that little more than planned ends, HOLD one that does not stand.",
    ),
    ("As planned", "The shot exactly as the plan says, nothing varied."),
    (
        "Sampled shots",
        "The shots that may come of the plan, because its numbers are only known as far as [uncertainty] says; samples are drawn from them.",
    ),
    (
        "Risk",
        "The share of the shots that exceed a limit, given as two bounds between which it lies with 95 % confidence.",
    ),
    ("Accepted risk", "The greatest share of the shots that the plan allows to exceed a limit."),
    (
        "Planned shot alone",
        "How much faster than planned all tires may leave the ground before the planned shot no longer passes.",
    ),
    (
        "Height",
        "How far the centre of a tire rises above where it lay. An edge of a tire that turns in the air may stand half its diameter above that.",
    ),
    ("Factor", "The breaking force of rope and termination over the greatest cable force."),
    (
        "Slack",
        "How much longer a cable is than the distance that it spans at rest, in percent of this distance.",
    ),
    ("Slide", "How far a tire lies from its first place when the shot is over, measured along the ground."),
    (
        "Energy residual",
        "The error of the energy balance over the energy that the holes put in: a run that can be trusted has well below 1 %.",
    ),
    ("In 8 ms", "The most holes, and the heaviest charge, that fire within any 8 ms of the planned shot."),
];

/// The words of the page, with their meanings.
pub fn glossary() -> Markup {
    html! { dl.glossary { @for (word, meaning) in WORDS { dt { (phrase(word)) } dd { (phrase(meaning)) } } } }
}
