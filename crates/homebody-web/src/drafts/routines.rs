//! Routines of drafts: their interpretation, and some simulated days.

use super::draft_run::DraftRun;
use super::{DraftService, problems};
use crate::budget::SimulationBudget;
use crate::dates;
use crate::messages::DraftMessage;
use crate::wire::{ConditionView, Explain, ExplainView, Month, MonthView, ProblemView, SentenceView};
use homebody_core::problem::{Diagnose, Diagnostic, Problem};
use homebody_core::scenario::load::{Overlay, ResidentDriver, Scenario};
use homebody_routine::explain::{self, Explanation, ExplanationKind, Spread, explain};
use homebody_routine::household::{Household, RoutineReading};
use homebody_routine::language::is_english;
use homebody_routine::routine::Routine;
use homebody_simulation::{Cancel, SimulationError};
use std::sync::PoisonError;

/// Largest number of days of a month.
const LONGEST: u32 = 31;

/// The routine of a resident in a draft without problems in its other files.
pub(super) struct DraftRoutine<'f> {
    files: &'f Overlay<'f>,
    pub scenario: Scenario,
    resident: usize,
}

impl<'f> DraftRoutine<'f> {
    /// The routine in a file, or the problems of the draft. A routine without a resident is a problem.
    pub fn open(files: &'f Overlay<'f>, entry: &str, asked: &str) -> Result<DraftRoutine<'f>, Vec<Problem>> {
        let scenario = Scenario::load(files, entry).map_err(|wrong| wrong.0)?;
        let is_asked =
            |driver: &ResidentDriver| matches!(driver, ResidentDriver::Routine { file, .. } if *file == asked);
        let resident = scenario.residents.iter().position(|resident| is_asked(&resident.driver));
        let unused = || vec![Problem::of_file(asked, DraftMessage::UnusedRoutine, None)];
        Ok(DraftRoutine { files, resident: resident.ok_or_else(unused)?, scenario })
    }

    pub fn text(&self) -> &str {
        match &self.scenario.residents[self.resident].driver {
            ResidentDriver::Routine { text, .. } => text,
            _ => "",
        }
    }

    pub fn with_text(mut self, fresh: &str) -> DraftRoutine<'f> {
        if let ResidentDriver::Routine { text, .. } = &mut self.scenario.residents[self.resident].driver {
            *text = fresh.into();
        }
        self
    }

    pub fn reading(&self) -> Option<RoutineReading> {
        Household::understand(&self.scenario, self.files, self.resident)
    }

    /// The number of days of the scenario.
    pub fn days(&self) -> i32 {
        let length = self.scenario.calendar.span_of_days(self.scenario.file.days);
        dates::last_day(&self.scenario.calendar, length) as i32 + 1
    }
}

impl DraftService {
    pub fn explain(&self, Explain { draft, file: asked }: Explain) -> ExplainView {
        let files = self.with(draft);
        let asked = match DraftRoutine::open(&files, &self.folders.entry, &asked) {
            Ok(routine) => routine,
            Err(wrong) => return not_understood(problems(&wrong)),
        };
        let Some(known) = asked.reading() else { return ExplainView::default() };
        let (days, calendar) = (asked.days() as u32, &asked.scenario.calendar);
        let condition = |(name, routine): (&String, &Routine)| ConditionView {
            name: name.clone(),
            severity: (0..days).map(|day| known.severity(name, day as i32)).collect(),
            sentences: sentences(routine),
        };
        let RoutineReading { routine, unsaid, conditions, problems: wrong, words, .. } = &known;
        ExplainView {
            problems: problems(wrong),
            first: dates::date(calendar, 0),
            days,
            is_foreign: !is_english(asked.text()),
            sentences: views(explain(routine).dated(calendar, asked.days())),
            unsaid: sentences(unsaid),
            conditions: conditions.iter().map(condition).collect(),
            words: words.clone(),
        }
    }

    /// Some days of a draft, simulated without files, unless the request is cancelled.
    pub fn month(&self, Month { draft, from, days, without }: Month, cancel: &Cancel) -> MonthView {
        let with_problems = |wrong: &[Problem]| MonthView { problems: problems(wrong), ..MonthView::default() };
        let opened = match self.open(&self.with(draft)) {
            Ok(opened) => opened,
            Err(wrong) => return with_problems(&wrong),
        };
        let failed = |error: Diagnostic| with_problems(&[Problem::of_file(&self.folders.entry, error, None)]);
        let mut latest = self.draft_run.lock().unwrap_or_else(PoisonError::into_inner);
        let same = latest.take().filter(|run| run.is_of(opened.scenario(), &without));
        let mut run = match same.map_or_else(|| DraftRun::new(&opened, without), Ok) {
            Ok(run) => run,
            Err(SimulationError::Problems(wrong)) => return with_problems(&wrong.0),
            Err(error) => return failed(error.diagnostic()),
        };
        let month = run.month(from, days.clamp(1, LONGEST), SimulationBudget::new(cancel));
        *latest = Some(run);
        month.unwrap_or_else(|error| failed(error.diagnostic()))
    }
}

fn not_understood(problems: Vec<ProblemView>) -> ExplainView {
    ExplainView { problems, ..ExplainView::default() }
}

fn sentences(routine: &Routine) -> Vec<SentenceView> {
    views(explain(routine))
}

fn views(explanation: Explanation) -> Vec<SentenceView> {
    explanation.sentences.into_iter().map(sentence_view).collect()
}

pub fn sentence_view(row: explain::ExplanationRow) -> SentenceView {
    let kind = match row.kind {
        ExplanationKind::Person => "person",
        ExplanationKind::Habit => "habit",
        ExplanationKind::Rule => "rule",
        ExplanationKind::Change => "change",
        ExplanationKind::Remark => "remark",
    };
    let span = |spread: Option<Spread>| spread.map(|spread| [spread.p5, spread.mean, spread.p95]);
    SentenceView {
        line: row.line,
        said: row.said,
        kind: kind.to_owned(),
        what: row.place.map_or(row.what.clone(), |place| format!("{} ({place})", row.what)),
        days: row.dates.map_or(row.days.clone(), |dates| format!("{}; {dates}", row.days)),
        when: row.when,
        start_s: span(row.start),
        lasts_s: span(row.lasts),
        in_words: row.in_words,
    }
}
