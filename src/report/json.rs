//! The face for programs: each report as one JSON document, numbers SI and with all their digits.

use std::io;

use serde::{Serialize, Serializer};
use serde_json::Value;

use super::parts::{Block, Cell, Fact, Report, Table};
use crate::scene::TireId;

/// The document of a report, or a list of the documents of several reports, with a line end.
pub fn json(reports: &[Report]) -> io::Result<String> {
    match reports {
        [report] => text(&document(report)),
        reports => text(&reports.iter().map(document).collect::<Vec<_>>()),
    }
}

/// A document with a line end.
pub fn text(document: &impl Serialize) -> io::Result<String> {
    Ok(serde_json::to_string_pretty(document)? + "\n")
}

/// A part of a document.
enum Node<'a> {
    Value(Value),
    List(Vec<Node<'a>>),
    /// An object; null where all its values are null.
    Object(Fields<'a>),
    /// Rows of tables. Each row becomes an object as it is written: there may be millions.
    Rows(Vec<&'a Table>),
}

type Fields<'a> = Vec<(&'a str, Node<'a>)>;

impl Serialize for Node<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            node if node.is_null() => to.serialize_none(),
            Node::Value(value) => value.serialize(to),
            Node::List(nodes) => to.collect_seq(nodes),
            Node::Object(fields) => to.collect_map(fields.iter().map(|(name, node)| (name, node))),
            Node::Rows(tables) => to.collect_seq(tables.iter().flat_map(|table| objects(table))),
        }
    }
}

impl Node<'_> {
    fn is_null(&self) -> bool {
        match self {
            Node::Value(value) => value.is_null(),
            Node::Object(fields) => fields.iter().all(|(_, node)| node.is_null()),
            Node::List(_) | Node::Rows(_) => false,
        }
    }
}

/// The document of a report: all facts and tables from top to bottom, and the warnings.
fn document(report: &Report) -> Node<'_> {
    let mut fields = vec![("schema", Node::Value(report.schema.into()))];
    for block in &report.blocks {
        match block {
            Block::Facts(facts) => put_facts(&mut fields, facts),
            Block::Table(table) if !table.key.is_empty() => {
                match fields.iter_mut().find(|(name, _)| *name == table.key) {
                    Some((_, Node::Rows(tables))) => tables.push(table),
                    _ => fields.push((table.key, Node::Rows(vec![table]))),
                }
            }
            Block::Text(_) | Block::Table(_) | Block::Chart(_) | Block::Picture(_) => {}
        }
    }
    let warnings = report.warnings.iter().map(|warning| Node::Value(warning.as_str().into()));
    fields.push(("warnings", Node::List(warnings.collect())));
    Node::Object(fields)
}

fn objects(table: &Table) -> impl Iterator<Item = Node<'_>> {
    table.rows.iter().map(|row| {
        let mut fields = Vec::new();
        for (column, cell) in table.columns.iter().zip(&row.cells) {
            put_cell(&mut fields, column.paths, cell);
        }
        Node::Object(fields)
    })
}

fn put_facts<'a>(fields: &mut Fields<'a>, facts: &'a [Fact]) {
    facts.iter().for_each(|Fact { paths, value, .. }| put_cell(fields, paths, value));
}

/// Adds the values of a cell to an object.
fn put_cell<'a>(fields: &mut Fields<'a>, paths: &[&'a str], cell: &'a Cell) {
    let mut nodes = nodes(cell);
    match paths {
        [""] => {
            if let Some(Node::Object(inner)) = nodes.pop() {
                fields.extend(inner);
            }
        }
        [path] if nodes.len() > 1 => put(fields, path, Node::List(nodes)),
        paths => {
            let mut nodes = nodes.into_iter();
            for path in paths {
                put(fields, path, nodes.next().unwrap_or(Node::Value(Value::Null)));
            }
        }
    }
}

/// Adds a value to an object, at a path of names.
fn put<'a>(fields: &mut Fields<'a>, path: &'a str, node: Node<'a>) {
    let Some((name, rest)) = path.split_once('.') else {
        match path.strip_suffix('?') {
            Some(_) if node.is_null() => {}
            name => fields.push((name.unwrap_or(path), node)),
        }
        return;
    };
    if !fields.iter().any(|(known, _)| *known == name) {
        fields.push((name, Node::Object(Vec::new())));
    }
    match fields.iter_mut().find(|(known, _)| *known == name) {
        Some((_, Node::Object(inner))) => put(inner, rest, node),
        _ => unreachable!("{name} is no object"),
    }
}

/// The values of a cell, one per path; empty where the cell has no value.
fn nodes(cell: &Cell) -> Vec<Node<'_>> {
    let text = |text: &str| Node::Value(text.into());
    let node = match cell {
        Cell::Nothing | Cell::Sparkline { .. } => return Vec::new(),
        Cell::Text(name) => text(name),
        Cell::Verdict(verdict) => text(verdict.verdict().for_scripts()),
        Cell::Flag(flag) => Node::Value((*flag).into()),
        Cell::Count(count) => Node::Value((*count).into()),
        Cell::List(cells) => Node::List(cells.iter().flat_map(nodes).collect()),
        Cell::Sentences(sentences) => Node::List(sentences.iter().map(|sentence| text(sentence)).collect()),
        Cell::Tire(tire) => address(tire),
        Cell::Cable(ends) => Node::List(ends.iter().map(address).collect()),
        Cell::Object(facts) => {
            let mut fields = Vec::new();
            put_facts(&mut fields, facts);
            Node::Object(fields)
        }
        numbers => return numbers.numbers().into_iter().map(|number| Node::Value(number.into())).collect(),
    };
    vec![node]
}

/// The address of a tire. Its numbers are whole, except at the centres of a quincunx.
fn address<'a>(tire: &TireId) -> Node<'a> {
    let number = |n: f64| Node::Value(if n.fract() == 0.0 { (n as i64).into() } else { n.into() });
    Node::List(tire.numbers().into_iter().map(number).collect())
}
