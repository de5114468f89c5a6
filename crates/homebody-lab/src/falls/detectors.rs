//! Fall detectors, each prepared once for all cases of a home.

use super::room::Condition;
use homebody_analysis::falls::fused::{FallEvidence, Fusion, fused};
use homebody_analysis::falls::long_lie::{LongLieRule, long_lies};
use homebody_analysis::falls::passive::{Ear, PassiveMessage};
use homebody_analysis::falls::rules::FallRules;
use homebody_analysis::falls::scenes::{CameraPicture, CameraSighting, Scenes};
use homebody_analysis::falls::watch::Fall;
use homebody_core::camera::lens::Lens;
use homebody_core::camera::silhouette::Silhouette;
use homebody_core::event::Events;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::SensorId;
use homebody_core::time::RunTime;
use homebody_log::silhouettes::cameras;
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    Silhouettes,
    Passive,
    Fused,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct DetectorSetup {
    pub method: Method,
    pub cameras: usize,
    #[serde(skip)]
    of: &'static [usize],
    pub name: &'static str,
    pub condition: Condition,
}

pub(super) const fn way(
    method: Method,
    of: &'static [usize],
    name: &'static str,
    condition: Condition,
) -> DetectorSetup {
    DetectorSetup { method, cameras: of.len(), of, name, condition }
}

/// The detectors that are compared.
pub const DETECTORS: [DetectorSetup; 13] = {
    use Condition::{Furniture, MoreNoise, NoNoise, Usual};
    use Method::{Fused, Passive, Silhouettes};
    [
        way(Silhouettes, &[0, 1], "two cameras", Usual),
        way(Silhouettes, &[0], "first camera", Usual),
        way(Silhouettes, &[1], "second camera", Usual),
        way(Passive, &[], "motion sensors", Usual),
        way(Fused, &[0, 1], "two cameras and motion", Usual),
        way(Fused, &[0], "first camera and motion", Usual),
        way(Silhouettes, &[0, 1], "two cameras", NoNoise),
        way(Silhouettes, &[0, 1], "two cameras", MoreNoise),
        way(Silhouettes, &[0], "first camera", MoreNoise),
        way(Silhouettes, &[0, 1], "two cameras", Furniture),
        way(Silhouettes, &[0], "first camera", Furniture),
        way(Fused, &[0, 1], "two cameras and motion", Furniture),
        way(Fused, &[0], "first camera and motion", Furniture),
    ]
};

/// A threshold for alarms. The first of each method is the usual one; the others form its curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Setting {
    /// For silhouettes alone: the least confidence.
    pub confidence: f64,
    /// For passive sensors, alone or with cameras.
    pub fusion: Fusion,
}

/// Least confidence of an alarm.
const USUAL_CONFIDENCE: f64 = 0.4;

pub(super) fn settings(method: Method) -> Vec<Setting> {
    let usual = Setting { confidence: USUAL_CONFIDENCE, fusion: Fusion::default() };
    let quiet = |minutes: f64| {
        let long_lie = LongLieRule { quiet_s: 60.0 * minutes, ..usual.fusion.long_lie };
        Setting { fusion: Fusion { long_lie, ..usual.fusion }, ..usual }
    };
    let others: Vec<Setting> = match method {
        Method::Silhouettes => {
            [0.1, 0.25, 0.5, 0.6, 0.7, 0.8, 0.9].map(|confidence| Setting { confidence, ..usual }).into()
        }
        Method::Passive => [3.0, 5.0, 10.0, 15.0, 30.0, 45.0].map(quiet).into(),
        Method::Fused => {
            [0.3, 0.5, 0.65, 0.85, 0.95].map(|sure| Setting { fusion: Fusion { sure, ..usual.fusion }, ..usual }).into()
        }
    };
    std::iter::once(usual).chain(others).collect()
}

pub(super) struct FallDetector<'r> {
    pub way: DetectorSetup,
    settings: Vec<Setting>,
    cameras: Vec<(SensorId, Lens)>,
    scenes: Scenes<'r>,
    ears: Vec<Ear>,
}

impl<'r> FallDetector<'r> {
    pub fn new(way: DetectorSetup, home: &ResolvedHome, rules: &'r FallRules) -> FallDetector<'r> {
        let all = cameras(home).enumerate().filter(|(number, _)| way.of.contains(number));
        let cameras: Vec<(SensorId, Lens)> = all.map(|(_, (sensor, camera))| (sensor, camera.lens())).collect();
        let lenses: Vec<Lens> = cameras.iter().map(|(_, lens)| *lens).collect();
        let scenes = Scenes::new(home.plan(), &lenses, rules);
        FallDetector { way, settings: settings(way.method), cameras, scenes, ears: Ear::all_of_home(home) }
    }

    pub fn alarms(&self, events: &Events, until: RunTime) -> Vec<Vec<RunTime>> {
        let (falls, sightings) = match self.way.method {
            Method::Passive => Default::default(),
            _ => self.seen(events),
        };
        let heard: Vec<PassiveMessage> = events
            .firings
            .iter()
            .filter_map(|firing| {
                Some(PassiveMessage { at: firing.at, heard: self.ears[firing.sensor.index()].hears(firing.value)? })
            })
            .collect();
        let evidence = FallEvidence { falls: &falls, sightings: &sightings, heard: &heard, until };
        let by = |Setting { confidence, fusion }: &Setting| match self.way.method {
            Method::Silhouettes => {
                falls.iter().filter(|fall| fall.confidence >= *confidence).map(|fall| fall.alarm_at).collect()
            }
            Method::Passive => long_lies(&fusion.long_lie, &heard, until).into_iter().map(|lie| lie.alarm_at).collect(),
            Method::Fused => fused(fusion, &evidence),
        };
        self.settings.iter().map(by).collect()
    }

    fn seen(&self, events: &Events) -> (Vec<Fall>, Vec<CameraSighting>) {
        let mut scenes = self.scenes.clone();
        let (mut found, mut sightings) = (Vec::new(), Vec::<CameraSighting>::new());
        for frame in &events.frames {
            let Some(camera) = self.cameras.iter().position(|(known, _)| *known == frame.sensor) else { continue };
            let Lens { columns, rows, .. } = self.cameras[camera].1;
            let Some(silhouette) = Silhouette::unpacked(&frame.picture.packed, columns, rows) else { continue };
            found.extend(scenes.next(CameraPicture { at: frame.at, camera, silhouette }));
            sightings.extend(scenes.last_sighting());
        }
        found.extend(scenes.look());
        sightings.extend(scenes.last_sighting());
        // Without a new picture, the last sighting repeats.
        sightings.dedup();
        (found, sightings)
    }
}
