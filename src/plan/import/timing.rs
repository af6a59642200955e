//! Groups of holes that fire together, from firing times, from delays after other holes, or from rows.

use std::collections::{HashMap, HashSet};

use super::holes::{Holes, ListedHole};
use crate::plan::Time;
use crate::plan::diagnostic::Mistake;
use crate::plan::keys::delay;
use crate::sorting::sort_by_key;

/// Holes that fire together.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    pub name: String,
    /// Indices of the holes.
    pub holes: Vec<usize>,
    /// Firing time after the first hole of the blast; `None` where the list has no times.
    pub fire: Option<Time>,
}

/// The groups of a list, in the order of their firing times, or without times in the order of the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Timed {
    pub groups: Vec<Group>,
    /// Firing time of the first hole, as the list counts it; 0 if the list has no times.
    pub first: Time,
    /// Whether the list has rows that differ from the groups.
    pub without_rows: bool,
}

/// Median time [ms] between successive firings below which the times of a list are in seconds.
const SHORTEST_MS: f64 = 1.0;

/// Refuses times in seconds: no blast fires its holes a fraction of a millisecond apart.
fn in_milliseconds(holes: &[ListedHole], times: &[Time]) -> Result<(), Vec<Mistake>> {
    let mut sorted = times.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let mut gaps: Vec<Time> = sorted.windows(2).map(|pair| pair[1] - pair[0]).collect();
    gaps.sort_unstable();
    let Some(middle) = gaps.get(gaps.len() / 2).filter(|gap| gap.ms() < SHORTEST_MS) else { return Ok(()) };
    let Some((hole, _)) = holes.iter().zip(times).max_by_key(|(_, time)| **time) else { return Ok(()) };
    let message = format!("holes fire {middle} ms one after another, hole {} last", hole.id);
    Err(vec![wrong(hole, message, "are the times in seconds? convert them to milliseconds")])
}

/// Groups the holes of a list.
pub fn timed(table: &Holes) -> Result<Timed, Vec<Mistake>> {
    let listed: Option<Vec<Time>> =
        times(&table.holes)?.map(|times| times.into_iter().map(Time::from_ms).collect());
    let first = listed.iter().flatten().min().copied().unwrap_or_default();
    let times = listed.map(|times| times.into_iter().map(|time| time - first).collect::<Vec<_>>());
    within_range(&table.holes, times.as_deref().unwrap_or_default())?;
    in_milliseconds(&table.holes, times.as_deref().unwrap_or_default())?;
    let without_row = table.holes.iter().filter(|hole| hole.row.is_none());
    if times.is_none() && table.holes.iter().any(|hole| hole.row.is_some()) {
        let mistake = |hole: &ListedHole| {
            wrong(hole, format!("hole {} has no row", hole.id), "give every hole a row, or none")
        };
        let mistakes: Vec<Mistake> = without_row.map(mistake).collect();
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
    }
    let (mut groups, mut known): (Vec<Group>, HashMap<String, usize>) = (Vec::new(), HashMap::new());
    for (n, hole) in table.holes.iter().enumerate() {
        let fire = times.as_ref().map(|times| times[n]);
        let name = match (fire, &hole.row) {
            (Some(time), _) => format!("{time} ms"),
            (None, Some(row)) => row.clone(),
            (None, None) => "1".to_owned(),
        };
        let group = *known.entry(name.clone()).or_insert_with(|| {
            groups.push(Group { name, holes: Vec::new(), fire });
            groups.len() - 1
        });
        groups[group].holes.push(n);
    }
    sort_by_key(&mut groups, |group| group.fire);
    if !table.rows_are_places {
        rows_agree(&table.holes, &groups)?;
    }
    let rows: Option<Vec<String>> = groups.iter().map(|group| one_row(&table.holes, group)).collect();
    let rows = rows.filter(|rows| rows.iter().collect::<HashSet<_>>().len() == rows.len());
    let without_rows = rows.is_none() && table.holes.iter().any(|hole| hole.row.is_some());
    groups.iter_mut().zip(rows.unwrap_or_default()).for_each(|(group, row)| group.name = row);
    Ok(Timed { groups, first, without_rows })
}

/// Notes a mistake if a row fires together with another row, and also at another time: a time or a row is wrong then.
fn rows_agree(holes: &[ListedHole], groups: &[Group]) -> Result<(), Vec<Mistake>> {
    let row = |hole: usize| holes[hole].row.as_deref();
    let mut groups_of: HashMap<&str, HashSet<usize>> = HashMap::new();
    for (n, group) in groups.iter().enumerate() {
        group.holes.iter().filter_map(|&hole| row(hole)).for_each(|row| {
            groups_of.entry(row).or_default().insert(n);
        });
    }
    for group in groups {
        let fires_again = |row: &str| groups_of.get(row).is_some_and(|groups| groups.len() > 1);
        let odd = group.holes.iter().find(|&&hole| row(hole).is_some_and(fires_again));
        let Some((&odd, here)) = odd.and_then(|odd| Some((odd, row(*odd)?))) else { continue };
        let Some(other) = group.holes.iter().filter_map(|&hole| row(hole)).find(|&row| row != here) else {
            continue;
        };
        let message = format!(
            "hole {} fires with row {other}, other holes of its row {here} at another time",
            holes[odd].id
        );
        let remedy = "correct its time or its row; where rows only say where holes lie, remove their column";
        return Err(vec![wrong(&holes[odd], message, remedy)]);
    }
    Ok(())
}

/// The row of a group, if all its holes are of one row.
fn one_row(holes: &[ListedHole], group: &Group) -> Option<String> {
    let row = holes[group.holes[0]].row.clone()?;
    group.holes.iter().all(|&hole| holes[hole].row.as_ref() == Some(&row)).then_some(row)
}

/// Firing time of every hole as the list counts it [ms] (n_holes); `None` if the list has no times.
fn times(holes: &[ListedHole]) -> Result<Option<Vec<f64>>, Vec<Mistake>> {
    let absolute = holes.iter().any(|hole| hole.fire_ms.is_some());
    if !absolute && holes.iter().all(|hole| hole.delay_ms.is_none()) {
        return Ok(None);
    }
    let times = if absolute { firing_times(holes)? } else { chained_times(holes)? };
    if absolute && delays_are_whole(holes) {
        require_agreement(holes, &times)?;
    } else if absolute {
        some_agree(holes, &times)?;
    }
    Ok(Some(times))
}

/// Refuses times after the first hole that a plan cannot hold.
fn within_range(holes: &[ListedHole], times: &[Time]) -> Result<(), Vec<Mistake>> {
    let Some(late) = times.iter().position(|time| !delay::AT_MS.kind.range().contains(&time.ms())) else {
        return Ok(());
    };
    let message = format!("hole {} fires {} ms after the first", holes[late].id, times[late]);
    Err(vec![wrong(&holes[late], message, "are the delays in milliseconds?")])
}

/// Whether every hole has a delay after another hole.
pub fn delays_are_whole(holes: &[ListedHole]) -> bool {
    holes.iter().all(|hole| hole.delay_ms.is_some() && hole.from.is_some())
}

/// Notes a mistake if the firing times and the delays after other holes disagree, in a list that has both.
fn require_agreement(holes: &[ListedHole], times: &[f64]) -> Result<(), Vec<Mistake>> {
    let chained = chained_times(holes)?;
    let first = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let (start, chained_start) = (first(times), first(&chained));
    let differs = |n: &usize| ((times[*n] - start) - (chained[*n] - chained_start)).abs() > 0.5;
    let Some(n) = (0..holes.len()).find(differs) else { return Ok(()) };
    let message = format!(
        "hole {} fires at {} ms by its firing time and at {} ms by the delays",
        holes[n].id,
        times[n] - start,
        chained[n] - chained_start
    );
    Err(vec![wrong(&holes[n], message, "remove the column that is wrong")])
}

/// Notes a mistake if the delay of a hole after another is not the difference of their firing times. Not every hole has such a delay here.
fn some_agree(holes: &[ListedHole], times: &[f64]) -> Result<(), Vec<Mistake>> {
    let mut by_id: HashMap<&str, Option<usize>> = HashMap::new();
    for (n, hole) in holes.iter().enumerate() {
        // If two holes have one name, nobody knows which one is meant.
        by_id.entry(&hole.id).and_modify(|known| *known = None).or_insert(Some(n));
    }
    for (hole, time) in holes.iter().zip(times) {
        let (Some(delay), Some(from)) = (hole.delay_ms, hole.from.as_deref().filter(|from| *from != hole.id))
        else {
            continue;
        };
        let between = by_id.get(from).copied().flatten().map(|before| time - times[before]);
        if let Some(between) = between.filter(|between| (between - delay).abs() > 0.5) {
            let message = format!(
                "hole {} fires {between} ms after hole {from} by their firing times and {delay} ms by its delay",
                hole.id
            );
            return Err(vec![wrong(hole, message, "remove the column that is wrong")]);
        }
    }
    Ok(())
}

fn wrong(hole: &ListedHole, message: String, remedy: &str) -> Mistake {
    Mistake::new(hole.span.clone(), message, remedy)
}

fn firing_times(holes: &[ListedHole]) -> Result<Vec<f64>, Vec<Mistake>> {
    let without = holes.iter().filter(|hole| hole.fire_ms.is_none());
    let mistake = |hole: &ListedHole| {
        wrong(hole, format!("hole {} has no firing time", hole.id), "give every hole one, or none")
    };
    let mistakes: Vec<Mistake> = without.map(mistake).collect();
    if mistakes.is_empty() {
        Ok(holes.iter().filter_map(|hole| hole.fire_ms).collect())
    } else {
        Err(mistakes)
    }
}

/// Firing time of every hole [ms]: the sum of the delays along its chain. A chain begins with a hole that follows itself or no hole.
fn chained_times(holes: &[ListedHole]) -> Result<Vec<f64>, Vec<Mistake>> {
    let (mut by_id, mut mistakes): (HashMap<&str, usize>, _) = (HashMap::new(), Vec::new());
    let follows_itself = |hole: &ListedHole| hole.from.as_ref() == Some(&hole.id);
    // If one hole names itself, a hole that names none is not tied in.
    let mut starters = usize::from(holes.iter().any(follows_itself));
    let is_tied = |hole: &ListedHole| hole.from.is_some() && !follows_itself(hole);
    let is_late = |hole: &&ListedHole| hole.delay_ms.is_some_and(|delay| delay > 0.0);
    if let Some(late) = holes.iter().find(is_late).filter(|_| holes.len() > 1 && !holes.iter().any(is_tied)) {
        let message =
            format!("no hole follows another, and hole {} has a delay: nothing is tied in", late.id);
        let remedy =
            "tie the holes in; or give firing times counted from the first hole, in a column fire_ms";
        return Err(vec![wrong(late, message, remedy)]);
    }
    for (n, hole) in holes.iter().enumerate() {
        let follows_itself = follows_itself(hole);
        if hole.from.is_some() && !follows_itself && hole.delay_ms.is_none() {
            let message = format!("hole {} follows another and has no delay", hole.id);
            mistakes.push(wrong(hole, message, "write its delay in ms"));
        }
        starters += usize::from(hole.from.is_none());
        if hole.from.is_none() && starters > 1 {
            let message = format!("hole {} follows no hole, like another before it", hole.id);
            mistakes.push(wrong(
                hole,
                message,
                "name the hole before it in `from`; a hole that starts names itself",
            ));
        }
        if by_id.insert(hole.id.as_str(), n).is_some() {
            let message = format!("hole {} is listed twice, so a delay after it has two meanings", hole.id);
            mistakes.push(wrong(hole, message, "give every hole a name of its own"));
        }
    }
    let mut times: Vec<Option<f64>> = vec![None; holes.len()];
    for n in 0..holes.len() {
        let (mut chain, mut at) = (Vec::new(), n);
        let mut time = loop {
            if let Some(time) = times[at] {
                break time;
            }
            chain.push(at);
            let hole = &holes[at];
            let Some(from) = hole.from.as_deref().filter(|&from| from != hole.id) else { break 0.0 };
            match by_id.get(from) {
                Some(&before) if chain.len() <= holes.len() => at = before,
                Some(_) => {
                    let message = format!("hole {} follows itself by way of others", holes[n].id);
                    mistakes.push(wrong(&holes[n], message, "let the chain of holes begin somewhere"));
                    chain.drain(..).for_each(|hole| times[hole] = Some(0.0));
                    break 0.0;
                }
                None => {
                    let message = format!("hole {} follows hole {from}, which is not listed", hole.id);
                    mistakes.push(wrong(hole, message, "list it, or correct the column `from`"));
                    break 0.0;
                }
            }
        };
        for &hole in chain.iter().rev() {
            time += holes[hole].delay_ms.unwrap_or(0.0);
            times[hole] = Some(time);
        }
    }
    if mistakes.is_empty() { Ok(times.into_iter().flatten().collect()) } else { Err(mistakes) }
}
