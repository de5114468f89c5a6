//! Free text that the page turns into statements: one text at a time, in a thread of its own. Nothing is written: the page puts
//! accepted lines into its drafts.

use crate::drafts::{DraftService, sentence_view};
use crate::messages::{DraftMessage, PageMessage};
use crate::request_error::{RequestError, code_of, sentence, unprocessable};
use crate::wire::{
    AcceptLines, AcceptedView, Answerer, DraftLineView, DraftStatementView, FreeTextRequest, FreeTextState,
    FreeTextView, RoundView,
};
use axum::http::StatusCode;
use homebody_core::problem::{Diagnose, Diagnostic, Problems};
use homebody_core::resident::DriverFile;
use homebody_life::{
    Conversation, ConversationRound, ConversationStage, DraftLine, DraftStatement, FreeTextError, ModelChoice,
    ModelServer, USUAL_TIMEOUT,
};
use homebody_simulation::{Cancel, SimulationError};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

/// The text that is being worked on, or was last. Clones share it.
#[derive(Clone)]
pub struct FreeTextService {
    drafts: DraftService,
    now: Arc<Mutex<Option<FreeTextJob>>>,
}

struct FreeTextJob {
    view: FreeTextView,
    cancel: Cancel,
    /// Once it is over.
    conversation: Option<Conversation>,
}

impl FreeTextService {
    pub fn new(drafts: DraftService) -> FreeTextService {
        FreeTextService { drafts, now: Arc::default() }
    }

    pub fn now(&self) -> Option<FreeTextView> {
        self.locked().as_ref().map(|job| job.view.clone())
    }

    pub fn is_active(&self) -> bool {
        self.locked().as_ref().is_some_and(FreeTextJob::is_active)
    }

    pub fn stop(&self) -> Option<FreeTextView> {
        if let Some(job) = self.locked().as_ref() {
            job.cancel.cancel();
        }
        self.now()
    }

    /// Starts a text, in place of an earlier one that is over.
    pub fn begin(&self, request: FreeTextRequest) -> Result<FreeTextView, RequestError> {
        let mut now = self.locked();
        if now.as_ref().is_some_and(FreeTextJob::is_active) {
            return Err(RequestError::new(StatusCode::CONFLICT, PageMessage::FreeTextBusy));
        }
        let view = FreeTextView {
            number: now.as_ref().map_or(0, |job| job.view.number) + 1,
            file: request.file.clone(),
            state: FreeTextState::Beginning,
            round: 1,
            model: None,
            warning: None,
            rounds: Vec::new(),
            prompt: None,
            lines: Vec::new(),
            left_out: Vec::new(),
            run_stops: None,
            problem: None,
            problem_code: None,
        };
        let cancel = Cancel::new();
        *now = Some(FreeTextJob { view: view.clone(), cancel: cancel.clone(), conversation: None });
        let service = self.clone();
        thread::spawn(move || {
            let job = || service.run(request, &cancel);
            let ended = catch_unwind(AssertUnwindSafe(job));
            let broke = |_| (None, Err(PageMessage::FreeTextBroke.diagnostic()));
            let (conversation, ended) = ended.unwrap_or_else(broke);
            service.end(conversation, ended, cancel.is_cancelled());
        });
        Ok(view)
    }

    /// The routine of the lines that a person accepts.
    pub fn accept(&self, AcceptLines { number, accepted }: &AcceptLines) -> Result<AcceptedView, RequestError> {
        let now = self.locked();
        let job = now.as_ref().filter(|job| job.view.number == *number);
        let conversation = job.and_then(|job| job.conversation.as_ref());
        let conversation =
            conversation.ok_or_else(|| RequestError::new(StatusCode::CONFLICT, PageMessage::FreeTextOther))?;
        let (text, lost) = conversation.routine(accepted).map_err(unprocessable)?;
        Ok(AcceptedView { text, lost })
    }

    fn locked(&self) -> MutexGuard<'_, Option<FreeTextJob>> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn update(&self, change: impl FnOnce(&mut FreeTextView)) {
        if let Some(job) = self.locked().as_mut() {
            change(&mut job.view);
        }
    }

    /// The conversation as far as it came, and the reason of its end before that.
    fn run(&self, request: FreeTextRequest, cancel: &Cancel) -> (Option<Conversation>, Result<(), Diagnostic>) {
        let mut conversation = match self.conversation(&request) {
            Ok(conversation) => conversation,
            Err(error) => return (None, Err(error)),
        };
        conversation.cancel(cancel);
        let ended = self.answered(&mut conversation, request.by).map_err(|error| error.diagnostic());
        (Some(conversation), ended)
    }

    fn conversation(&self, request: &FreeTextRequest) -> Result<Conversation, Diagnostic> {
        let opened = self.drafts.open(&self.drafts.with(request.draft.clone()));
        let opened = opened.map_err(|wrong| SimulationError::Problems(Problems(wrong)).diagnostic())?;
        let is_asked = |driver: &DriverFile| *driver == DriverFile::Routine(request.file.clone());
        let resident = opened.scenario().residents.iter().find(|resident| is_asked(&resident.file.driver));
        let name = resident.map(|resident| resident.file.name.clone());
        let name = name.ok_or_else(|| DraftMessage::UnusedRoutine.diagnostic())?;
        Conversation::new(opened, Some(&name), &request.text).map_err(|error| error.diagnostic())
    }

    fn answered(&self, conversation: &mut Conversation, by: Answerer) -> Result<(), FreeTextError> {
        match by {
            Answerer::Assistant { answers } => {
                for (index, answer) in answers.iter().enumerate() {
                    self.at(ConversationStage::Checking(index + 1));
                    conversation.take(answer)?;
                }
            }
            Answerer::Model { url, name, key } => {
                let server = ModelServer::chosen(&ModelChoice { url, name, key, timeout: USUAL_TIMEOUT })?;
                let warning = server.warning().map(|warning| sentence(&warning.diagnostic()));
                self.update(|view| (view.model, view.warning) = (Some(server.name()), warning));
                conversation.converse(&server, |stage, rounds| {
                    let rounds = rounds.iter().map(round_view).collect();
                    self.update(|view| view.rounds = rounds);
                    self.at(stage);
                })?;
                // A model without a usable answer has failed.
                conversation.draft()?;
            }
        }
        Ok(())
    }

    fn at(&self, stage: ConversationStage) {
        let (state, round) = match stage {
            ConversationStage::Asking(round) => (FreeTextState::Asking, round),
            ConversationStage::Checking(round) => (FreeTextState::Checking, round),
        };
        self.update(|view| (view.state, view.round) = (state, round as u32));
    }

    /// Shows the lines of all rounds before the end, also after an error.
    fn end(&self, conversation: Option<Conversation>, ended: Result<(), Diagnostic>, is_cancelled: bool) {
        let mut now = self.locked();
        let Some(job) = now.as_mut() else { return };
        let view = &mut job.view;
        if let Some(conversation) = &conversation {
            view.rounds = conversation.rounds().iter().map(round_view).collect();
            view.prompt = (!conversation.is_over()).then(|| conversation.prompt());
            if let Ok(draft) = conversation.draft() {
                view.lines = draft.lines.iter().map(line_view).collect();
                (view.left_out, view.run_stops) = (draft.left_out.clone(), draft.run_stops.clone());
            }
        }
        view.state = match ended {
            Ok(()) => FreeTextState::Done,
            Err(_) if is_cancelled => FreeTextState::Stopped,
            Err(problem) => {
                (view.problem, view.problem_code) = (Some(sentence(&problem)), code_of(&problem));
                FreeTextState::Failed
            }
        };
        job.conversation = conversation;
    }
}

impl FreeTextJob {
    fn is_active(&self) -> bool {
        matches!(self.view.state, FreeTextState::Beginning | FreeTextState::Asking | FreeTextState::Checking)
    }
}

fn round_view(round: &ConversationRound) -> RoundView {
    RoundView { problems: round.problems.clone(), differences: round.differences.clone() }
}

fn line_view(line: &DraftLine) -> DraftLineView {
    let DraftLine { source, is_in_text, statements, mut assumed, cannot_be_said, stands_under } = line.clone();
    let statements = statements.into_iter().map(statement_view).collect();
    assumed.extend(stands_under.map(|list| format!("that this is a statement: the answer has it under {list:?}")));
    DraftLineView { source, is_in_text, statements, assumed, cannot_be_said }
}

fn statement_view(DraftStatement { text, refused, meaning, difference, .. }: DraftStatement) -> DraftStatementView {
    let sentences = meaning.into_iter().map(sentence_view).collect();
    let difference = difference.map(|of| [of.expected, of.lived]);
    DraftStatementView { text, refused, sentences, difference }
}
