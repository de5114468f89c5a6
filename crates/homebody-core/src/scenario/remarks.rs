//! Remarks on valid scenarios with an unlikely meaning: faults after the end of the run, sensors that always send at
//! once on one channel.

use super::check::link::LinkMessage;
use super::load::Scenario;
use crate::link::form::{FaultFile, LinkFile};
use crate::problem::Problem;
use crate::scenario::source::JsonSource;
use crate::sensors::form::ReportedInstant;
use crate::sensors::kinds::SensorFile;
use crate::time::{RunTime, Span};
use std::collections::BTreeMap;

/// The remarks on a scenario with a run of this length. They do not prevent the run.
pub fn scenario_remarks(scenario: &Scenario, length: Span) -> Vec<Problem> {
    let Some((name, link)) = scenario.file.link.as_ref().zip(scenario.link.as_ref()) else { return Vec::new() };
    let text = scenario.sources.get(name).map(String::as_str).unwrap_or_default();
    let Ok(source) = JsonSource::parse(name, text) else { return Vec::new() };
    let mut remarks = too_late(&source, link, scenario, length);
    remarks.extend(at_once(&source, link, &scenario.home.sensors));
    remarks
}

/// Faults that begin when the run is over.
fn too_late(source: &JsonSource, link: &LinkFile, scenario: &Scenario, length: Span) -> Vec<Problem> {
    let calendar = &scenario.calendar;
    let begins = |fault: &FaultFile| fault.span_from(calendar.start_of_day()).begin;
    let end = RunTime::START + length;
    let faults = link.faults.iter().enumerate().filter(|(_, fault)| begins(fault) >= end);
    let remark = |(index, fault): (usize, &FaultFile)| {
        let (kind, sensor) = (fault.kind().to_owned(), fault.sensor().map(str::to_owned));
        let on_wall = |at: RunTime| calendar.local(at).strftime("%Y-%m-%d at %H:%M").to_string();
        let (begin, end) = (on_wall(begins(fault)), on_wall(end));
        let message = LinkMessage::FaultAfterEnd { kind, sensor, begin, end };
        source.problem(&format!("/faults/{index}"), message, None)
    };
    faults.map(remark).collect()
}

/// Sensors of one thing that always send at the same instant, on a channel without waiting.
fn at_once(source: &JsonSource, link: &LinkFile, sensors: &[SensorFile]) -> Vec<Problem> {
    if link.channel().is_none() {
        return Vec::new();
    }
    let mut speakers: BTreeMap<ReportedInstant, Vec<&str>> = BTreeMap::new();
    for sensor in sensors {
        if let Some(instant) = sensor.moment() {
            speakers.entry(instant).or_default().push(sensor.name());
        }
    }
    let together = speakers.into_iter().filter(|(_, names)| names.len() > 1);
    let remark = |(instant, names): (ReportedInstant, Vec<&str>)| {
        let (ReportedInstant::Pressed(thing, _) | ReportedInstant::Used(thing)) = instant;
        let (sensors, thing) = (names.into_iter().map(str::to_owned).collect(), thing.to_owned());
        let at = if link.radio.is_some() { "/radio" } else { "/preset" };
        source.problem(at, LinkMessage::Simultaneous { sensors, thing }, None)
    };
    together.map(remark).collect()
}
