//! The conversation about a text: prompts, answers, and the best draft so far.

use crate::free_text::FreeText;
use crate::life_draft::{DraftLine, DraftStatement, LifeDraft};
use crate::messages::FreeTextError;
use crate::model_answer::{AnswerLine, lines_of};
use crate::model_server::{ChatMessage, ModelServer};
use crate::rounds_file::{ConversationRound, RoundsFile};
use crate::system_prompt::{capitalised, first_request, next_request, system_prompt};
use crate::trial::{PlacedStatement, StatementTrial};
use homebody_simulation::{Cancel, OpenScenario, SimulationError, VERSION};

/// Most answers of a conversation (our choice): later ones hardly better the routine.
pub const MOST_ROUNDS: usize = 4;

/// The work that a conversation is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConversationStage {
    /// The model writes the answer of this round, counted from 1.
    Asking(usize),
    /// The answer of this round is read and simulated.
    Checking(usize),
}

/// A text, a resident, and the answers so far.
pub struct Conversation {
    text: FreeText,
    trial: StatementTrial,
    system: String,
    rounds: Vec<ConversationRound>,
    /// The lines of the latest answer that had any.
    lines: Vec<AnswerLine>,
    /// The reason why the latest answer had none.
    no_lines: Option<String>,
    best: Option<LifeDraft>,
    is_over: bool,
    cancel: Cancel,
}

impl Conversation {
    /// A conversation at its beginning, about a resident of a scenario: by name, or the first with a routine.
    ///
    /// # Errors
    ///
    /// The text cannot be read, the scenario has no such resident, or its home has no room for a routine.
    pub fn new(opened: OpenScenario, resident: Option<&str>, text: &str) -> Result<Conversation, FreeTextError> {
        let text = FreeText::read(text)?;
        let trial = StatementTrial::of_resident(opened, resident)?;
        let system = system_prompt(&trial);
        let (rounds, lines) = (Vec::new(), Vec::new());
        let (no_lines, best, is_over, cancel) = (None, None, false, Cancel::new());
        Ok(Conversation { text, trial, system, rounds, lines, no_lines, best, is_over, cancel })
    }

    /// Ends requests and simulations early with [`SimulationError::Cancelled`] when this handle is cancelled.
    pub fn cancel(&mut self, cancel: &Cancel) {
        self.cancel = cancel.clone();
    }

    /// The file of the routine in the scenario.
    pub fn routine_file(&self) -> &str {
        &self.trial.file
    }

    /// The messages for the next answer: the instructions, the text, the latest answer, and its problems.
    pub fn messages(&self) -> Vec<ChatMessage> {
        let text = first_request(&self.text);
        let system = ChatMessage::system(&self.system);
        match self.rounds.last() {
            None => vec![system, ChatMessage::user(&text)],
            Some(_) if self.lines.is_empty() => {
                vec![system, ChatMessage::user(&format!("{text}\n\n{}", self.request()))]
            }
            Some(_) => {
                let answer = serde_json::json!({ "lines": self.lines }).to_string();
                vec![
                    system,
                    ChatMessage::user(&text),
                    ChatMessage::assistant(&answer),
                    ChatMessage::user(&self.request()),
                ]
            }
        }
    }

    /// The next prompt for an assistant that has seen the earlier ones.
    pub fn prompt(&self) -> String {
        match self.rounds.last() {
            None => format!("{}\n{}\n", self.system, first_request(&self.text)),
            Some(_) => self.request() + "\n",
        }
    }

    fn request(&self) -> String {
        match (&self.no_lines, self.rounds.last()) {
            (Some(why), _) => format!("Your answer cannot be read: {why}. Answer with the JSON object alone."),
            (None, Some(round)) => next_request(&round.problems, &round.differences),
            (None, None) => String::new(),
        }
    }

    /// Takes the next answer: reads its statements, simulates them if all are right, and keeps the draft if it is the best.
    ///
    /// # Errors
    ///
    /// The statements cannot be simulated, or the conversation was cancelled.
    pub fn take(&mut self, answer: &str) -> Result<(), SimulationError> {
        let prompt = if self.rounds.is_empty() { first_request(&self.text) } else { self.request() };
        let mut round = ConversationRound { prompt, answer: answer.to_owned(), ..ConversationRound::default() };
        let is_last = self.rounds.len() + 1 >= MOST_ROUNDS;
        match lines_of(answer) {
            Err(why) => {
                round.problems = vec![format!("the answer cannot be read: {why}")];
                // A model that answers the same again will do so next time.
                let is_repeated = self.rounds.last().is_some_and(|before| before.answer == answer);
                self.is_over = is_last || is_repeated;
                self.no_lines = Some(why);
            }
            Ok(lines) => {
                let is_repeated = self.lines == lines;
                let draft = self.tried(&lines, is_last || is_repeated)?;
                (round.problems, round.differences) = (draft.problems(), draft.differences());
                let is_right = round.problems.is_empty() && round.differences.is_empty();
                self.is_over = is_right || is_last || is_repeated;
                self.no_lines = None;
                self.lines = lines;
                if self.best.as_ref().is_none_or(|best| draft.faults() <= best.faults()) {
                    self.best = Some(draft);
                }
            }
        }
        self.rounds.push(round);
        Ok(())
    }

    /// The draft of an answer. It is simulated if nothing else is wrong, or `at_last`.
    fn tried(&self, lines: &[AnswerLine], at_last: bool) -> Result<LifeDraft, SimulationError> {
        let mut draft = LifeDraft {
            lines: lines.iter().map(|line| self.draft_line(line)).collect(),
            left_out: self.text.left_out(lines.iter().map(|line| line.source.as_str())),
            ..LifeDraft::default()
        };
        place(&mut draft.lines, FIRST_LINE);
        let tried = self.trial.read(&placed(&draft.lines));
        draft.take(&tried);
        self.add_misplaced(&mut draft);
        if !at_last && !draft.problems().is_empty() {
            return Ok(draft);
        }
        match tried.simulate(&self.cancel) {
            Ok(differences) => {
                draft.is_simulated = true;
                for (line, difference) in differences {
                    draft.at(line).into_iter().for_each(|statement| {
                        statement.difference.get_or_insert_with(|| difference.clone());
                    });
                }
            }
            Err(SimulationError::Driver { why, .. }) => draft.run_stops = Some(why),
            Err(error) => return Err(error),
        }
        Ok(draft)
    }

    /// Adds a line for each sentence of the language among the notes of the answer.
    fn add_misplaced(&self, draft: &mut LifeDraft) {
        let mut notes: Vec<DraftLine> = draft.lines.iter().flat_map(lines_of_notes).collect();
        // A note that contradicts another one is read once that one has its line.
        while !notes.is_empty() {
            place(&mut notes, line_behind(&draft.lines));
            let all = [placed(&draft.lines), placed(&notes)].concat();
            let mut read = LifeDraft { lines: notes, ..LifeDraft::default() };
            read.take(&self.trial.read(&all));
            let (found, rest): (Vec<DraftLine>, Vec<DraftLine>) =
                read.lines.into_iter().partition(|line| !line.statements[0].meaning.is_empty());
            if found.is_empty() {
                break;
            }
            draft.lines.extend(found);
            place(&mut draft.lines, FIRST_LINE);
            notes = rest;
        }
    }

    fn draft_line(&self, line: &AnswerLine) -> DraftLine {
        let statement = |text: &String| DraftStatement { text: text.clone(), ..DraftStatement::default() };
        DraftLine {
            source: line.source.clone(),
            is_in_text: self.text.has(&line.source),
            statements: line.statements.iter().map(statement).collect(),
            assumed: line.assumed.clone(),
            cannot_be_said: line.cannot_be_said.clone(),
            stands_under: None,
        }
    }

    /// Asks a model until nothing is wrong, or for [`MOST_ROUNDS`]. Answers before an error stay. `at` gets each stage, with the
    /// rounds before it.
    ///
    /// # Errors
    ///
    /// The model does not answer, its statements cannot be simulated, or the conversation was cancelled.
    pub fn converse(
        &mut self,
        server: &ModelServer,
        at: impl Fn(ConversationStage, &[ConversationRound]),
    ) -> Result<(), FreeTextError> {
        while !self.is_over {
            let round = self.rounds.len() + 1;
            at(ConversationStage::Asking(round), &self.rounds);
            let answer = server.answer(&self.messages(), &self.cancel);
            if self.cancel.is_cancelled() {
                return Err(SimulationError::Cancelled.into());
            }
            let answer = answer?;
            at(ConversationStage::Checking(round), &self.rounds);
            self.take(&answer)?;
        }
        Ok(())
    }

    /// Whether no further answer is asked for.
    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// The numbers of problems and of differences of the latest answer.
    pub fn latest_faults(&self) -> (usize, usize) {
        self.rounds.last().map_or((0, 0), |round| (round.problems.len(), round.differences.len()))
    }

    /// The prompts and answers so far.
    pub fn rounds(&self) -> &[ConversationRound] {
        &self.rounds
    }

    /// The best draft.
    ///
    /// # Errors
    ///
    /// [`FreeTextError::NothingUsable`] if no answer had lines.
    pub fn draft(&self) -> Result<&LifeDraft, FreeTextError> {
        self.best.as_ref().ok_or_else(|| FreeTextError::NothingUsable {
            rounds: self.rounds.len(),
            why: self.no_lines.clone().unwrap_or_else(|| "there was none".to_owned()),
        })
    }

    /// The routine of the accepted lines of the best draft, with the sources as comments. A statement that needs one of a line that
    /// was not accepted is a comment, too; its reason is in the second part.
    ///
    /// # Errors
    ///
    /// [`FreeTextError::NothingUsable`] if no answer had lines.
    pub fn routine(&self, accepted: &[bool]) -> Result<(String, Vec<String>), FreeTextError> {
        let draft = self.draft()?;
        let is_accepted = |index: usize| accepted.get(index).copied().unwrap_or(false);
        let lines = || draft.lines.iter().enumerate();
        let statements: Vec<PlacedStatement> =
            lines().filter(|(index, _)| is_accepted(*index)).flat_map(|(_, line)| placed_of(line)).collect();
        let mut refused = self.trial.read(&statements).refused;
        let mut lost = Vec::new();
        let mut text =
            "# A routine made of free text by homebody life from. Each comment is a sentence of the text, or a note about it.\n"
                .to_owned();
        for (index, line) in lines() {
            text += &format!("\n# {}\n", line.source);
            let notes = [("assumed", &line.assumed), ("cannot be said", &line.cannot_be_said)];
            for (what, note) in notes.iter().flat_map(|(what, notes)| notes.iter().map(move |note| (what, note))) {
                text += &format!("#   {what}: {note}\n");
            }
            for statement in &line.statements {
                let why = match (is_accepted(index), &statement.refused) {
                    (false, _) => Some("not accepted".to_owned()),
                    (true, Some(why)) => Some(format!("refused ({why})")),
                    (true, None) => refused.remove(&statement.line).map(|why| {
                        lost.push(format!("{:?}: {why}", statement.text));
                        format!("refused ({why})")
                    }),
                };
                text += &match why {
                    Some(why) => format!("#   {}: {}\n", one_line(&why), statement.text),
                    None => format!("{}\n", statement.text),
                };
            }
        }
        for sentence in &draft.left_out {
            text += &format!("\n# {sentence}\n#   left out by the model\n");
        }
        Ok((text, lost))
    }

    /// The conversation as a file.
    pub fn file(&self, home: &str, model: Option<String>, accepted: Vec<bool>) -> RoundsFile {
        let resident = self.trial.opened.scenario().residents[self.trial.resident].file.name.clone();
        RoundsFile {
            program: VERSION.to_owned(),
            home: home.to_owned(),
            resident,
            model,
            text: self.text.text.clone(),
            system: self.system.clone(),
            rounds: self.rounds.clone(),
            accepted,
        }
    }

    /// The name of the resident, with a capital letter.
    pub fn person(&self) -> String {
        capitalised(&self.trial.opened.scenario().residents[self.trial.resident].file.name)
    }
}

/// The line of a routine below the comment about its origin.
const FIRST_LINE: u32 = 2;

/// Gives each statement its line in the routine, as [`Conversation::routine`] writes it.
fn place(lines: &mut [DraftLine], mut next: u32) {
    for line in lines {
        // An empty line, the source and the notes.
        next += 2 + (line.assumed.len() + line.cannot_be_said.len()) as u32;
        for statement in &mut line.statements {
            statement.line = next;
            statement.meaning.iter_mut().for_each(|row| row.line = next);
            next += 1;
        }
    }
}

fn line_behind(lines: &[DraftLine]) -> u32 {
    let of_line =
        |line: &DraftLine| (2 + line.assumed.len() + line.cannot_be_said.len() + line.statements.len()) as u32;
    FIRST_LINE + lines.iter().map(of_line).sum::<u32>()
}

/// The statements that are not refused.
fn placed(lines: &[DraftLine]) -> Vec<PlacedStatement> {
    lines.iter().flat_map(placed_of).collect()
}

fn placed_of(line: &DraftLine) -> impl Iterator<Item = PlacedStatement> {
    let kept = line.statements.iter().filter(|statement| statement.refused.is_none());
    kept.map(|statement| PlacedStatement {
        text: statement.text.clone(),
        source: line.source.clone(),
        line: statement.line,
    })
}

/// A line for each note of a line, as if it were a statement. A note that repeats a statement has none.
fn lines_of_notes(line: &DraftLine) -> Vec<DraftLine> {
    let bare = |text: &str| text.trim_end_matches('.').to_lowercase();
    let is_said = |note: &String| line.accepted().any(|said| bare(said) == bare(note));
    let notes = [("assumed", &line.assumed), ("cannot_be_said", &line.cannot_be_said)];
    let notes = notes.into_iter().flat_map(|(list, notes)| notes.iter().map(move |note| (list, note)));
    let made = |(list, note): (&'static str, &String)| DraftLine {
        source: line.source.clone(),
        is_in_text: line.is_in_text,
        statements: vec![DraftStatement { text: note.clone(), ..DraftStatement::default() }],
        stands_under: Some(list),
        ..DraftLine::default()
    };
    notes.filter(|(_, note)| !is_said(note)).map(made).collect()
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
