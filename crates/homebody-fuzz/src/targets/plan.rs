//! Plans of Sweet Home 3D: imported homes pass the check, and the search for ways works in them.

use super::home::{BODY_M, SCENARIO};
use super::messages;
use crate::choices::Choices;
use crate::mutate::markup;
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_core::geometry::{self, Point};
use homebody_core::plan::Plan;
use homebody_core::scenario::load::Scenario;
use homebody_import::{Imported, sweet_home};
use homebody_walk::Mesh;
use std::collections::BTreeMap;
use std::path::Path;

pub const TARGET: Target = Target { name: "plan", cases: 2_000, seeds, mutate, run };

/// The plan, and its archive.
const XML: &str = "Home.xml";
const ARCHIVE: &str = "plan.sh3d";

/// Largest number of remarks (our choice).
const MOST_REMARKS: usize = 50;

fn seeds() -> Vec<CaseFiles> {
    let xmls = seeds::named(TARGET.name).into_iter().flat_map(CaseFiles::into_values);
    let files = |xml: Vec<u8>| CaseFiles::from([(ARCHIVE.to_owned(), markup::archive(&xml)), (XML.to_owned(), xml)]);
    xmls.map(files).collect()
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    let mut xml = target::text(files, XML).to_owned();
    if choices.is(0.9) {
        markup::markup(&mut xml, choices);
    }
    let mut archive = markup::archive(xml.as_bytes());
    if choices.is(0.2) {
        archive = markup::odd_archive(xml.as_bytes(), choices);
    }
    if choices.is(0.15) {
        let other = choices.one(seeds).get(ARCHIVE).map(Vec::as_slice).unwrap_or_default();
        crate::mutate::bytes::bytes(&mut archive, other, choices);
    }
    files.insert(XML.to_owned(), xml.into_bytes());
    files.insert(ARCHIVE.to_owned(), archive);
}

fn run(files: &CaseFiles, _: &Path) -> Result<ReadVerdict, String> {
    let mut verdict = ReadVerdict::Refused;
    for name in [XML, ARCHIVE] {
        match sweet_home(files.get(name).map(Vec::as_slice).unwrap_or_default(), "a", None) {
            Ok(Imported { home_json, remarks }) => {
                if remarks.len() > MOST_REMARKS {
                    return Err(format!("{} remarks are too many to read", remarks.len()));
                }
                find_ways(&home_json)?;
                verdict = ReadVerdict::Accepted;
            }
            Err(error) => {
                messages::refusal(&error)?;
                if !error.to_string().contains("\n  hint: ") {
                    return Err(format!("the error has no hint: {error}"));
                }
            }
        }
    }
    Ok(verdict)
}

fn find_ways(home_json: &str) -> Result<(), String> {
    let files = [("scenario.json", SCENARIO), ("home.json", home_json)];
    let files: BTreeMap<String, String> = files.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
    let scenario = Scenario::load(&files, "scenario.json")
        .map_err(|problems| format!("what was imported is refused: {}", problems.render()))?;
    let home = scenario.home;
    let plan = Plan::new(&*home);
    let mesh = Mesh::new(&plan, BODY_M);
    let rooms = plan.rooms.iter().map(|room| geometry::inner_point(&room.outline));
    let places: Vec<Point> = rooms.chain(home.furniture.iter().filter_map(|piece| piece.at.map(Point::from))).collect();
    for ends in places.windows(2) {
        mesh.path(ends[0], ends[1]);
    }
    for door in &home.doors {
        mesh.inside_of((geometry::point(door.from) + geometry::point(door.to)) / 2.0);
    }
    Ok(())
}
