//! The silhouettes of a stored run, a part at a time, and the persons in them.
//!
//! Only the requested part of the file is read. A search for falls reads all of it.

use crate::draw;
use crate::request_error::{RequestError, unprocessable};
use crate::wire::{MomentView, PersonView, PictureView, PlaybackView, SilhouettesView};
use homebody_analysis::falls::rules::FallRules;
use homebody_analysis::falls::scenes::{CameraPicture, Scenes, SeenPerson};
use homebody_analysis::falls::voxels::EDGE_M;
use homebody_core::body::figure::Point3;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{Interval, RunTime, Span};
use homebody_log::LogError;
use homebody_log::silhouettes::{KeptSilhouettes, Silhouettes};
use homebody_query::RunSilhouettes;
use homebody_query::search::KnownStay;
use homebody_simulation::Cancel;
use std::borrow::Cow;
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::{LazyLock, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// Largest number of instants in an answer (our choice): a minute of five pictures a second.
const MOST_MOMENTS: usize = 300;

static RULES: LazyLock<FallRules> = LazyLock::new(FallRules::default);

pub struct StoredSilhouettes {
    path: PathBuf,
    scenario: Scenario,
    /// By name, in the order of the view's sensors.
    sensors: Vec<String>,
    open: Mutex<Option<OpenSilhouettes>>,
    /// The falls that the cameras see, once they were searched.
    falls: OnceLock<Vec<KnownStay<'static, RunTime>>>,
}

struct OpenSilhouettes {
    silhouettes: Silhouettes,
    scenes: Scenes<'static>,
    /// The numbers of its cameras among the view's sensors.
    numbers: Vec<u32>,
}

enum ReadEnd {
    Full,
    Log(LogError),
}

impl From<LogError> for ReadEnd {
    fn from(error: LogError) -> ReadEnd {
        ReadEnd::Log(error)
    }
}

impl StoredSilhouettes {
    pub fn new(path: PathBuf, scenario: Scenario, view: &PlaybackView) -> StoredSilhouettes {
        let sensors = view.home.sensors.iter().map(|sensor| sensor.name.clone()).collect();
        StoredSilhouettes { path, scenario, sensors, open: Mutex::new(None), falls: OnceLock::new() }
    }

    /// The silhouettes of a span, as many as there is time for: all, or one for each `every`.
    pub fn part(
        &self,
        span: Interval<RunTime>,
        every: Span,
        longest: Duration,
    ) -> Result<SilhouettesView, RequestError> {
        let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
        let open: &OpenSilhouettes = match &mut *open {
            Some(open) => open,
            closed => closed.insert(self.opened()?),
        };
        let corner = self.scenario.home.plan().bounds().0;
        let until_us = span.end.max(span.begin).micros();
        let mut view = SilhouettesView { until_us, corner: draw::at(corner), edge_m: EDGE_M, moments: Vec::new() };
        let (begun, mut now): (_, Vec<CameraPicture>) = (Instant::now(), Vec::new());
        let tell = |now: &mut Vec<CameraPicture>, view: &mut SilhouettesView| {
            let Some(first) = now.first() else { return };
            let persons: Vec<PersonView> =
                open.scenes.persons(now).iter().map(|person| person_view(person, corner.extend(0.0))).collect();
            let picture = |seen: &CameraPicture| PictureView {
                sensor: open.numbers[seen.camera],
                packed: seen.silhouette.packed(),
            };
            view.moments.push(MomentView {
                at_us: first.at.micros(),
                pictures: now.iter().map(picture).collect(),
                persons,
            });
            now.clear();
        };
        let is_enough = |view: &SilhouettesView| view.moments.len() >= MOST_MOMENTS || begun.elapsed() >= longest;
        let mut next = span.begin;
        while let Some(at) = open.silhouettes.next_from(next).map_err(unprocessable)?.filter(|at| *at < span.end) {
            let end = if every > Span::ZERO { at + Span::MICROSECOND } else { span.end };
            let read = open.silhouettes.for_each_within(
                Interval::new(at, end),
                |KeptSilhouettes { at, camera, silhouette, .. }| {
                    if now.first().is_some_and(|seen| seen.at != at) {
                        tell(&mut now, &mut view);
                        if is_enough(&view) {
                            view.until_us = at.micros();
                            return Err(ReadEnd::Full);
                        }
                    }
                    now.push(CameraPicture { at, camera, silhouette });
                    Ok(())
                },
            );
            match read {
                Ok(()) => tell(&mut now, &mut view),
                Err(ReadEnd::Full) => return Ok(view),
                Err(ReadEnd::Log(error)) => return Err(unprocessable(error)),
            }
            if every <= Span::ZERO {
                break;
            }
            next = at + every;
            if is_enough(&view) {
                view.until_us = next.min(span.end).micros();
                break;
            }
        }
        Ok(view)
    }

    fn opened(&self) -> Result<OpenSilhouettes, RequestError> {
        let kept = RunSilhouettes::open(&self.path, &self.scenario).map_err(unprocessable)?;
        let scenes = Scenes::new(self.scenario.home.plan(), &kept.lenses(), &RULES);
        let number =
            |name: &str| self.sensors.iter().position(|sensor| sensor == name).map_or(u32::MAX, |at| at as u32);
        let numbers = kept.silhouettes.cameras.iter().map(|camera| number(&camera.file.name)).collect();
        Ok(OpenSilhouettes { silhouettes: kept.silhouettes, scenes, numbers })
    }

    /// Searches all silhouettes once; other requests can read parts meanwhile.
    pub fn falls(&self, cancel: &Cancel) -> Result<&Vec<KnownStay<'static, RunTime>>, RequestError> {
        if let Some(known) = self.falls.get() {
            return Ok(known);
        }
        let kept = RunSilhouettes::open(&self.path, &self.scenario).map_err(unprocessable)?;
        let looked = kept.falls(&RULES, |_| !cancel.is_cancelled()).map_err(unprocessable)?;
        let stay = |fall: &homebody_analysis::falls::watch::Fall| KnownStay {
            time: Interval::new(fall.at, fall.alarm_at),
            who: None,
            name: Cow::Owned(fall.rule.clone()),
            words: Cow::Owned(kept.words(fall)),
        };
        let falls = looked.falls.iter().map(stay).collect();
        Ok(self.falls.get_or_init(|| falls))
    }
}

/// A person as the page draws them: without the cubes that others surround.
fn person_view(person: &SeenPerson, corner: Point3) -> PersonView {
    let steps = |cube: &Point3| {
        let from = (*cube - corner) / EDGE_M - Point3::splat(0.5);
        [from.x.round() as i32, from.y.round() as i32, from.z.round() as i32]
    };
    let all: HashSet<[i32; 3]> = person.cubes.iter().map(steps).collect();
    let is_surface = |[x, y, z]: &[i32; 3]| {
        [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
            .iter()
            .any(|[right, back, up]| !all.contains(&[x + right, y + back, z + up]))
    };
    let mut surface: Vec<&[i32; 3]> = all.iter().filter(|cube| is_surface(cube)).collect();
    surface.sort_unstable();
    let memberships = &person.memberships;
    PersonView {
        cubes: surface.into_iter().flatten().map(|&step| u16::try_from(step).unwrap_or(u16::MAX)).collect(),
        height_m: person.shape.height_m,
        centroid_up_m: person.shape.centroid_up_m,
        tilt_deg: person.shape.tilt_deg,
        at: person.shape.at_m,
        upright: memberships.upright,
        in_between: memberships.in_between,
        on_the_ground: memberships.on_the_ground,
    }
}
