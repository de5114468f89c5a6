//! `homebody life from`: a routine from a care plan, a diary or a persona.

use super::acceptance::accept;
use super::messages::LifeMessage;
use crate::commands::run_output::timeout;
use crate::commands::scenario::Trust;
use crate::failure::Failure;
use crate::print::{json_text, print_json, print_text, tell, tell_message, warn, write_file};
use crate::progress::bar;
use homebody_core::resident::DriverFile;
use homebody_life::{
    Conversation, ConversationStage, FreeTextError, KEY_VARIABLE, LifeDraft, MOST_ROUNDS, ModelChoice, ModelServer,
    RoundsFile,
};
use homebody_log::LogError;
use homebody_log::files::fresh::all_can_be_written;
use homebody_log::files::plain::read_text;
use homebody_simulation::{OpenScenario, ScenarioSource};
use serde_json::json;
use std::io::{IsTerminal, Read, stdin, stdout};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Make a routine from a care plan, a diary or a persona
///
/// A language model turns the text into sentences of the routine language. Homebody checks each sentence and simulates 60 days; what
/// is refused and what does not happen as it says goes back to the model, in at most four rounds. You see the text and the
/// sentences side by side, with what the model assumed and what the language cannot say, and accept line by line. Only then the
/// routine is written, with its sources as comments, and next to it the rounds as NAME.rounds.json.
#[derive(clap::Args)]
#[command(
    after_long_help = "Models: any server with the chat interface of OpenAI. Without --model, Homebody asks Ollama
(http://localhost:11434/v1) or llama.cpp (http://localhost:8080/v1) on this machine. Nothing is sent to
any other address. A key comes from the environment variable HOMEBODY_MODEL_KEY; it goes to the address
of --model only, and is neither printed nor stored.

Without a model: --prompt prints the prompt. Paste it into any assistant, save its answer, and name the
file with --answer. Homebody prints the next prompt, or the sentences.

Examples:
  homebody life from care-plan.txt --home my-home
  homebody life from care-plan.txt --home my-home --model http://localhost:8080/v1 --yes --force
  homebody life from diary.txt --home my-home --resident ruth --model-name qwen2.5:14b --out ruth.routine
  HOMEBODY_MODEL_KEY=... homebody life from diary.txt --home my-home --model https://HOST/v1 --model-name NAME
  homebody life from care-plan.txt --home my-home --prompt > prompt.txt
  homebody life from care-plan.txt --home my-home --answer first.txt --answer second.txt
  homebody life from --rounds my-home/margaret.rounds.json --out again.routine"
)]
pub struct LifeFromArguments {
    /// File with the text, or - for standard input
    #[arg(required_unless_present = "rounds")]
    text: Option<PathBuf>,
    /// Scenario folder, or its scenario.json, with the home of the person
    #[arg(long, value_name = "SCENARIO", required_unless_present = "rounds")]
    home: Option<PathBuf>,
    #[command(flatten)]
    trust: Trust,
    /// The resident whose routine it is (default: the first one with a routine)
    #[arg(long, value_name = "NAME")]
    resident: Option<String>,
    /// Address of the model's server, such as http://localhost:11434/v1
    #[arg(long, value_name = "URL", help_heading = "Model")]
    model: Option<String>,
    /// Name of the model (default: the server's only model, or the first one on this machine)
    #[arg(long, value_name = "NAME", help_heading = "Model")]
    model_name: Option<String>,
    /// Longest wait for each answer: 30s, 10m or 1h
    #[arg(long, value_name = "DURATION", value_parser = timeout, default_value = "10m", help_heading = "Model")]
    timeout: Duration,
    /// Print the prompt for any assistant, and ask no model
    #[arg(long, conflicts_with_all = ["model", "model_name", "answer", "rounds"], help_heading = "Without a model")]
    prompt: bool,
    /// File with an answer of an assistant, or -; once for each round
    #[arg(long, value_name = "FILE", conflicts_with_all = ["model", "model_name", "rounds"], help_heading = "Without a model")]
    answer: Vec<PathBuf>,
    /// Make the routine again from the rounds of an earlier command
    #[arg(long, value_name = "FILE", conflicts_with_all = ["text", "model", "model_name", "resident"], help_heading = "Without a model")]
    rounds: Option<PathBuf>,
    /// Accept all lines whose sentences are understood
    #[arg(short, long)]
    yes: bool,
    /// Print the result as one JSON object; without --yes, write no file
    #[arg(long)]
    json: bool,
    /// Write the routine here (default: the resident's routine in the folder of the scenario)
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace existing files
    #[arg(short, long)]
    force: bool,
}

/// Largest file of a text, an answer or rounds (our choice).
const LARGEST_BYTES: u64 = 32 << 20;

/// The files that the command writes.
struct LifeFiles {
    routine: PathBuf,
    rounds: PathBuf,
}

impl LifeFromArguments {
    pub fn run(self) -> Result<(), Failure> {
        if let Some(path) = &self.rounds {
            return self.again(path);
        }
        let (text, home) = (self.text.clone().unwrap_or_default(), self.home.clone().unwrap_or_default());
        let is_asked = !self.yes && !self.json;
        if is_asked && !self.prompt && text == Path::new("-") {
            return Err(Failure::asked(LifeMessage::TextAndLines));
        }
        let opened = self.trust.source(&home)?.open()?;
        let mut conversation = Conversation::new(opened.clone(), self.resident.as_deref(), &read(&text)?)?;
        if self.prompt {
            return print_text(&conversation.prompt());
        }
        if !self.answer.is_empty() {
            for path in &self.answer {
                conversation.take(&read(path)?)?;
            }
            if is_asked && !conversation.is_over() {
                return not_yet(&conversation);
            }
        }
        if is_asked && !(stdin().is_terminal() && stdout().is_terminal()) {
            return self.unseen(&conversation);
        }
        let files = self.files(opened.source(), &conversation)?;
        let model = match self.answer.is_empty() {
            true => Some(self.converse(&mut conversation, is_asked)?),
            false => None,
        };
        let draft = conversation.draft()?;
        let accepted = self.accepted(draft)?;
        let rounds = conversation.file(&home.display().to_string(), model, accepted.clone().unwrap_or_default());
        self.finish(&opened, &conversation, accepted, &files, Some(rounds))
    }

    /// Without a terminal to accept lines in: the table of given answers, or nothing before a model is asked in vain.
    fn unseen(&self, conversation: &Conversation) -> Result<(), Failure> {
        if !conversation.rounds().is_empty() {
            tell_draft(conversation.draft()?);
        }
        Err(Failure::asked(LifeMessage::NoTerminal))
    }

    /// Asks the model. After an error in the middle, what it has answered is shown, and can be accepted in a terminal.
    fn converse(&self, conversation: &mut Conversation, is_asked: bool) -> Result<String, Failure> {
        let server = self.server()?;
        server.warning().into_iter().for_each(warn);
        tell(format_args!("asking {}", server.name()));
        let progress = bar(None, "{spinner} {msg}  {elapsed}");
        let begun = conversation.converse(&server, |stage, _| {
            progress.set_message(match stage {
                ConversationStage::Asking(round) => format!("round {round} of at most {MOST_ROUNDS}: the model writes"),
                ConversationStage::Checking(round) => format!("round {round}: checking and simulating 60 days"),
            });
        });
        progress.finish_and_clear();
        if let Err(error) = begun {
            let failure = Failure::from(error);
            let Ok(draft) = conversation.draft() else { return Err(failure) };
            if !is_asked {
                tell_draft(draft);
                return Err(failure);
            }
            if let Failure::Coded(message, _) = &failure {
                tell_message(message);
            }
            tell(format_args!("the lines of round {} follow", conversation.rounds().len()));
        }
        Ok(server.name())
    }

    fn server(&self) -> Result<ModelServer, FreeTextError> {
        let (url, name) = (self.model.clone(), self.model_name.clone());
        let key = std::env::var(KEY_VARIABLE).ok();
        Ok(ModelServer::chosen(&ModelChoice { url, name, key, timeout: self.timeout })?)
    }

    /// The files to write. They must be free, before a model has worked for nothing.
    fn files(&self, source: &ScenarioSource, conversation: &Conversation) -> Result<LifeFiles, Failure> {
        let in_folder = || source.folder().map(|folder| folder.join(conversation.routine_file()));
        let routine = self.out.clone().or_else(in_folder).ok_or_else(|| Failure::asked(LifeMessage::NoFolder))?;
        let rounds = routine.with_extension("rounds.json");
        if !self.json || self.yes {
            let all: Vec<&Path> = match self.rounds {
                Some(_) => vec![&routine],
                None => vec![&routine, &rounds],
            };
            all_can_be_written(&all, self.force)?;
        }
        Ok(LifeFiles { routine, rounds })
    }

    /// By line: whether it is accepted; `None` if nothing is to be written.
    fn accepted(&self, draft: &LifeDraft) -> Result<Option<Vec<bool>>, Failure> {
        let all = draft.usable();
        if self.json {
            return Ok(self.yes.then_some(all));
        }
        show(draft)?;
        if self.yes { Ok(Some(all)) } else { accept(draft, &mut stdin().lock()) }
    }

    /// Writes the accepted lines, or says that nothing is written.
    fn finish(
        &self,
        opened: &OpenScenario,
        conversation: &Conversation,
        accepted: Option<Vec<bool>>,
        files: &LifeFiles,
        rounds: Option<RoundsFile>,
    ) -> Result<(), Failure> {
        let draft = conversation.draft()?;
        let is_any = accepted.iter().flatten().any(|is_accepted| *is_accepted);
        let (routine, lost) = conversation.routine(accepted.as_deref().unwrap_or_default())?;
        if self.json {
            print_json(&json!({
                "resident": conversation.person(),
                "rounds": conversation.rounds().len(),
                "draft": draft,
                "accepted": accepted,
                "routine": if is_any { Some(&files.routine) } else { None },
            }))?;
        }
        let lacks = lacks(draft, self.yes || self.json, lost.len());
        if !is_any {
            return match accepted {
                // The person who quits or the options ask for no file.
                None if self.json && lacks.is_empty() => Ok(()),
                None if self.json => Err(Failure::asked(LifeMessage::NotAll { lacks })),
                _ => Err(Failure::asked(LifeMessage::NoneAccepted)),
            };
        }
        lost.into_iter().for_each(|why| warn(LifeMessage::NeedsOther { why }));
        write_file(&files.routine, routine.as_bytes(), self.force)?;
        tell(format_args!("routine    {}", files.routine.display()));
        if let Some(rounds) = rounds {
            write_file(&files.rounds, json_text(&rounds)?.as_bytes(), self.force)?;
            tell(format_args!("rounds     {}", files.rounds.display()));
        }
        let is_followed = |driver: &DriverFile| *driver == DriverFile::Routine(conversation.routine_file().to_owned());
        if !opened.scenario().residents.iter().any(|resident| is_followed(&resident.file.driver)) {
            warn(LifeMessage::NotDriver { resident: conversation.person(), routine: files.routine.clone() });
        }
        match lacks.is_empty() {
            true => Ok(()),
            false => Err(Failure::asked(LifeMessage::Incomplete { lacks, routine: files.routine.clone() })),
        }
    }

    /// Makes a routine again from its rounds: the same answers, checked anew, and the same lines.
    fn again(&self, path: &Path) -> Result<(), Failure> {
        let rounds = RoundsFile::read(&read(path)?).map_err(|error| in_file(path, error))?;
        let home = self.home.clone().unwrap_or_else(|| PathBuf::from(&rounds.home));
        let opened = self.trust.source(&home)?.open()?;
        let mut conversation = Conversation::new(opened.clone(), Some(&rounds.resident), &rounds.text)?;
        for round in &rounds.rounds {
            conversation.take(&round.answer)?;
        }
        let files = self.files(opened.source(), &conversation)?;
        let draft = conversation.draft()?;
        let accepted = if self.json && !self.yes { None } else { Some(rounds.accepted.clone()) };
        if !self.json {
            show(draft)?;
        }
        self.finish(&opened, &conversation, accepted, &files, None)
    }
}

/// The next prompt on standard output, and the reason for it.
fn not_yet(conversation: &Conversation) -> Result<(), Failure> {
    print_text(&conversation.prompt())?;
    let (problems, differences) = conversation.latest_faults();
    Err(Failure::asked(LifeMessage::NotYet { problems, differences }))
}

/// Counts of what the routine lacks without a decision of a person.
fn lacks(draft: &LifeDraft, is_unseen: bool, lost: usize) -> Vec<String> {
    let refused = draft.lines.iter().flat_map(|line| &line.statements).filter(|of| of.refused.is_some()).count();
    let unlooked = if is_unseen { draft.misplaced().count() } else { 0 };
    let stops = usize::from(draft.run_stops.is_some());
    let all = [
        (refused, "refused sentences"),
        (lost, "sentences that need another one"),
        (draft.left_out.len(), "sentences of the text that the answer leaves out"),
        (unlooked, "sentences among the notes of the answer"),
        (stops, "a run stops"),
    ];
    all.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{what}: {count}")).collect()
}

fn show(draft: &LifeDraft) -> Result<(), Failure> {
    print_text(&draft.table())?;
    draft.warnings().iter().for_each(tell_message);
    Ok(())
}

/// The same on standard error: a command that fails prints no result.
fn tell_draft(draft: &LifeDraft) {
    tell(draft.table().trim_end());
    draft.warnings().iter().for_each(tell_message);
}

/// The text of a file, or of standard input.
fn read(path: &Path) -> Result<String, Failure> {
    let text = match path == Path::new("-") {
        true => {
            let mut text = String::new();
            stdin().lock().take(LARGEST_BYTES).read_to_string(&mut text).map(|_| text)
        }
        false => read_text(path, LARGEST_BYTES),
    };
    text.map_err(|error| LogError::file(path, error).into())
}

fn in_file(path: &Path, error: FreeTextError) -> Failure {
    let problem = homebody_core::problem::Problem::of_file(&path.display().to_string(), error, None);
    Failure::all(vec![problem])
}
