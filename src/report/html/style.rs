//! How the page looks on a screen, on a phone and on paper.

use crate::report::language::phrase;
use crate::report::palette::Role;

const STYLE: &str = "
* { box-sizing: border-box }
body { font: 10pt/1.4 system-ui, sans-serif; color: #111; max-width: 250mm; margin: 0 auto; padding: 5mm }
h1 { font-size: 18pt; line-height: 1.2; margin: 0 0 1mm }
h2 { font-size: 12pt; margin: 6mm 0 2mm; border-bottom: 1px solid #999; break-after: avoid }
p { margin: 2mm 0; orphans: 3; widows: 3 } ul { margin: 2mm 0; padding-left: 6mm }
table { border-collapse: collapse; width: 100% } thead { display: table-header-group }
th, td { text-align: left; vertical-align: top; padding: 1mm 2mm; border-bottom: 1px solid #ddd }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap }
table.facts th { width: 30%; font-weight: 600 } tr.fired td { background: #eef3f9; font-weight: 600 }
th::first-letter { text-transform: uppercase } .pass, .thin, .undecided, .fail { font-weight: bold; white-space: nowrap }
.quiet { color: #555 } code, pre { overflow-wrap: anywhere } pre { font-size: 8pt; white-space: pre-wrap }
.scroll { overflow-x: auto } .options { font-size: 8.5pt } .options th { vertical-align: bottom } .options td:nth-child(2) { min-width: 22mm }
.charts { display: flex; gap: 4mm } .charts > div { flex: 1; min-width: 0 }
.charts svg, .view svg { display: block; width: 100%; height: auto; margin: 0 auto }
div.fired { border: 2px solid #111; padding: 3mm 4mm; margin: 4mm 0 }
.what { font-size: 13pt; font-weight: 600; margin: 0 } .large { font-size: 30pt; line-height: 1.2; margin: 1mm 0 }
.blanks { display: flex; flex-wrap: wrap; gap: 0 6mm }
.blank { border-bottom: 1px solid #111; min-height: 9mm; padding-top: 1mm; font-size: 8.5pt; color: #333; flex: 1 1 40% }
.blank.wide { flex-basis: 100% } .blank.tall { min-height: 24mm }
.signatures { display: flex; gap: 6mm; margin-top: 3mm; align-items: end; break-inside: avoid } .signatures > div { flex: 1 }
.signature { border-top: 1px solid #111; margin-top: 12mm; padding-top: 1mm; font-size: 8.5pt; color: #333 }
ul.boxes { list-style: none; padding: 0; columns: 2; column-gap: 5mm; font-size: 8.5pt }
dl { margin: 0; columns: 2; column-gap: 8mm; font-size: 8.5pt } dt { font-weight: 600 } dd { margin: 0 0 1.5mm }
dl.pairs div { margin-bottom: 1mm; break-inside: avoid } .pairs dt, .pairs dd { display: inline } .pairs dd { margin-left: 1ex }
details { margin-top: 6mm } summary { font-size: 12pt; font-weight: bold }
tr, li, dt, dd, .charts, .view, .blank, .signatures, div.fired, section.whole { break-inside: avoid } dt { break-after: avoid }
@media print {
  body { max-width: none; padding: 0; font-size: 8pt } details, tr.aside { display: none } .sheet { break-after: page } .scroll { overflow: visible } .options { font-size: 7pt } .options td, .options th { padding: 0.6mm 0.8mm } .options td.n, .options th.n { white-space: normal } table.facts td, table.facts th { padding: 0.6mm 2mm } dl, ul, .blank { font-size: 7pt; line-height: 1.2 } dl { columns: 3; column-gap: 5mm } .shelter dl, ul { columns: 2; column-gap: 5mm } dd { margin-bottom: 0.5mm } dl.glossary { columns: 4; column-gap: 4mm } .blank { min-height: 6.4mm } .blank.tall { min-height: 14mm }
  .signatures p { font-size: 8pt } .signature { margin-top: 10mm } h2 { font-size: 11pt; margin: 2.2mm 0 0.8mm } p, ul { margin: 0.8mm 0 } h1 { font-size: 14pt } .large { font-size: 24pt } .charts svg { width: auto; max-width: 100%; max-height: 30mm }
  .view svg { width: auto; max-width: 100%; max-height: 70mm } :lang(ru) .view svg { max-height: 55mm } .view.low svg { max-height: 46mm } :lang(ru) .view.low svg { max-height: 36mm } .options td:nth-child(2) { min-width: 15mm }
}
@media screen and (max-width: 600px) {
  body { padding: 4mm 3mm } .charts, .blanks, .signatures { display: block } dl { columns: 1 } .view { overflow-x: auto } .view svg { min-width: 620px }
  .options { white-space: nowrap } .options td[colspan] { white-space: normal }
}
";

/// The style sheet. `foot` and the page number stand at the foot of every printed page.
pub fn style_sheet(foot: &str) -> String {
    let small = "font: 8pt system-ui, sans-serif; color: #555";
    // Without a size the page takes the paper of the printer: A4 or Letter.
    let page = format!(
        "@page {{ margin: 14mm 15mm 16mm;\n  @bottom-left {{ content: \"{}\"; {small}; width: 80% }}\n  \
         @bottom-right {{ content: \"{} \" counter(page) \" {} \" counter(pages); {small} }} }}\n",
        quoted(foot),
        quoted(phrase("Page")),
        quoted(phrase("of"))
    );
    format!("{STYLE}{page}{}", verdict_colors())
}

/// A text inside a CSS string. All but ASCII letters and digits are escaped, so that no text ends the string or the sheet.
fn quoted(text: &str) -> String {
    let escape = |letter: char| match letter {
        'a'..='z' | 'A'..='Z' | '0'..='9' => letter.to_string(),
        _ => format!("\\{:x} ", u32::from(letter)),
    };
    text.chars().map(escape).collect()
}

/// CSS rules with the colours of verdicts, by class name.
fn verdict_colors() -> String {
    let rule = |role: Role| {
        let [red, green, blue] = role.on_light();
        format!(".{} {{ color: rgb({red}, {green}, {blue}) }}\n", role.class())
    };
    Role::ALL.map(rule).concat()
}
