//! Installing sensors: sheets, comparison of layouts, suggested places.

use super::plan::{build, coverage_view, home, step_m};
use super::{DraftService, problems};
use crate::draw;
use crate::messages::DraftMessage;
use crate::request_error::{code_of, sentence};
use crate::wire::{
    Draft, LayoutView, Layouts, LayoutsView, PartView, PartsView, ProblemView, StepView, Suggest, SuggestionView,
};
use homebody_analysis::coverage;
use homebody_analysis::parts::{PartsList, SensorLayout, SensorPart, beside};
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::problem::{Diagnostic, readable};
use homebody_core::resident::Build;
use homebody_core::sensors::products::Product;
use homebody_picture::{installing, pdf};
use homebody_placement::people::{LoadedScenario, PeopleError};
use homebody_placement::proposal::{Proposal, Request, Step, goals, propose};
use homebody_placement::search;
use homebody_routine::household::Household;
use homebody_simulation::Cancel;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicU32, Ordering};

/// Largest number of sensors that are suggested at once, and of people that are simulated for it (our choice). The
/// command has no such limits.
const MOST_SENSORS: u16 = 64;
const MOST_PEOPLE: u32 = 100;
/// Smallest number of people that are simulated (our choice): one person shows only their own habits.
const FEWEST_PEOPLE: u32 = 4;
/// The same people each time.
const SEED: u64 = 1;
/// Share of the work that simulation takes, approximately (our choice). Trying layouts takes the rest.
const SHARE_OF_LIVES: f64 = 0.8;

impl DraftService {
    pub fn parts(&self, draft: Draft) -> PartsView {
        match home(&self.with(draft), &self.folders.entry) {
            Err(wrong) => PartsView { problems: problems(&wrong), ..PartsView::default() },
            Ok(home) => {
                let parts = PartsList::from_home(&home);
                let view = parts.parts.iter().map(part).collect();
                PartsView { problems: Vec::new(), devices: devices(&parts), parts: view, csv: parts.csv() }
            }
        }
    }

    /// The printed sheets as a PDF, or the problems of the home.
    pub fn sheet(&self, draft: Draft) -> Result<Vec<u8>, Diagnostic> {
        let wrong = |problems: Vec<ProblemView>| DraftMessage::HomeProblems { problems: in_words(&problems) };
        let (home, build) = self.read(draft).map_err(wrong)?;
        let seen = coverage::of_home(&home, build, step_m(home.plan()));
        Ok(pdf(&home.name, &installing(&home, &seen, &PartsList::from_home(&home)))?)
    }

    pub fn compare(&self, Layouts { one, other }: Layouts) -> LayoutsView {
        let both = [one, other].map(|layout| (layout.name, self.read(layout.draft)));
        let wrong: Vec<ProblemView> =
            both.iter().filter_map(|(_, read)| read.as_ref().err()).flatten().cloned().collect();
        let [(one, Ok(first)), (other, Ok(second))] = &both else {
            return LayoutsView { problems: wrong, ..LayoutsView::default() };
        };
        let layouts =
            [(one, first), (other, second)].map(|(name, (home, build))| SensorLayout { name, home, build: *build });
        let differences = beside(layouts).differences;
        let view = |(name, (home, build)): (&String, &(ResolvedHome, Build))| LayoutView {
            name: name.clone(),
            devices: devices(&PartsList::from_home(home)),
            home: draw::home(home, home.plan(), home.placed_sensors()),
            coverage: coverage_view(&coverage::of_home(home, *build, step_m(home.plan()))),
        };
        LayoutsView { problems: Vec::new(), layouts: vec![view((one, first)), view((other, second))], differences }
    }

    /// Suggests places for sensors in the home of a draft, until it is cancelled.
    pub fn suggest(&self, asked: Suggest, cancel: &Cancel) -> SuggestionView {
        let _making = self.suggesting.making.lock().unwrap_or_else(PoisonError::into_inner);
        self.suggesting.done.store(0, Ordering::Relaxed);
        match self.proposed(asked, cancel) {
            Ok(proposed) => suggestion(proposed),
            Err(SuggestionError::Problems(problems)) => SuggestionView { problems, ..SuggestionView::default() },
            Err(SuggestionError::Refused(why)) => {
                SuggestionView { refused: Some(sentence(&why)), code: code_of(&why), ..SuggestionView::default() }
            }
        }
    }

    /// From 0 to 1.
    pub fn suggestion_progress(&self) -> f64 {
        f64::from(self.suggesting.done.load(Ordering::Relaxed)) / 1000.0
    }

    fn proposed(&self, asked: Suggest, cancel: &Cancel) -> Result<Proposal, SuggestionError> {
        let Suggest { draft, sensors, to_see, people, device } = asked;
        let goals = goals(&to_see).map_err(|goals| DraftMessage::UnknownGoals { goals })?;
        if goals.is_empty() {
            return Err(DraftMessage::NoGoals.into());
        }
        let of_key = |key: &String| Product::all().find(|device| device.key() == *key);
        let device = match &device {
            Some(key) => {
                Some(of_key(key).ok_or_else(|| DraftMessage::UnknownDevice { device: readable(key.clone()) })?)
            }
            None => None,
        };
        let files = self.with(draft);
        let home = home(&files, &self.folders.entry).map_err(|wrong| SuggestionError::Problems(problems(&wrong)))?;
        let sensors = usize::from(sensors.clamp(1, MOST_SENSORS));
        let people = people.clamp(FEWEST_PEOPLE, MOST_PEOPLE);
        let (build, step_m) = (build(&files, &self.folders.entry), step_m(home.plan()));
        let request = Request { goals: &goals, sensors, people, seed: SEED, device, build, step_m };
        let load = || {
            let (scenario, household) = Household::load(&files, &self.folders.entry, &[])?;
            Ok(LoadedScenario { scenario, household })
        };
        let lives = if request.needs_people() { SHARE_OF_LIVES } else { 0.0 };
        let lived = AtomicU32::new(0);
        let goes_on = |step: Step| {
            let share = match step {
                Step::Simulated => lives * f64::from(lived.fetch_add(1, Ordering::Relaxed) + 1) / f64::from(people),
                Step::Searching(_, placed) => lives + (1.0 - lives) * placed as f64 / (sensors + 1) as f64,
            };
            self.suggesting.done.store((share * 1000.0) as u32, Ordering::Relaxed);
            !cancel.is_cancelled()
        };
        Ok(propose(&home, &request, load, &goes_on)?)
    }

    /// A home, and the body that sensors have to detect.
    fn read(&self, draft: Draft) -> Result<(ResolvedHome, Build), Vec<ProblemView>> {
        let files = self.with(draft);
        let home = home(&files, &self.folders.entry).map_err(|wrong| problems(&wrong))?;
        Ok((home, build(&files, &self.folders.entry)))
    }
}

enum SuggestionError {
    Problems(Vec<ProblemView>),
    Refused(Diagnostic),
}

impl From<DraftMessage> for SuggestionError {
    fn from(why: DraftMessage) -> SuggestionError {
        SuggestionError::Refused(why.into())
    }
}

impl From<PeopleError> for SuggestionError {
    fn from(error: PeopleError) -> SuggestionError {
        match error {
            PeopleError::Problems(wrong) => SuggestionError::Problems(problems(&wrong.0)),
            PeopleError::NoRoutine => DraftMessage::NoRoutine.into(),
            other => SuggestionError::Refused(other.into()),
        }
    }
}

fn in_words(problems: &[ProblemView]) -> Vec<String> {
    problems.iter().map(|problem| format!("{}: {}", problem.file, problem.what)).collect()
}

fn part(part: &SensorPart) -> PartView {
    PartView {
        number: part.number,
        name: part.name.clone(),
        kind: part.kind.to_owned(),
        device: part.device.clone(),
        network: part.network.to_owned(),
        place: part.whereabouts(),
        aim: part.aim(),
    }
}

fn devices(parts: &PartsList) -> Vec<(String, usize)> {
    parts.devices.iter().map(|count| (count.device.clone(), count.count)).collect()
}

fn suggestion(Proposal { sensors, found, own }: Proposal) -> SuggestionView {
    let step = |layout: &search::Layout| StepView {
        sensor: layout.sensors.last().cloned().unwrap_or_default(),
        score: layout.score,
        reached: layout.goals.clone(),
    };
    SuggestionView {
        problems: Vec::new(),
        refused: None,
        code: None,
        sensors: serde_json::to_string(&sensors).unwrap_or_default(),
        steps: found.steps.iter().map(step).collect(),
        whole: found.swapped.last().map(|swap| step(&swap.layout)),
        own: own.as_ref().map(step),
    }
}
