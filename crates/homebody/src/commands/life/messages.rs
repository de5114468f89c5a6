//! The messages of `homebody life`.

use std::path::PathBuf;

homebody_core::messages! {
    /// Problems with the options of `homebody life from`.
    pub enum LifeMessage in "life-from" {
        /// A person accepts each line. Without a terminal, the command cannot ask.
        NoTerminal error "no-terminal"
            ("nothing is written yet: there is no terminal in which you could accept lines")
            hint ("run the same command with --yes to accept all lines and write the routine, or with --json to see them without writing a file");
        /// Standard input is either the text or the person who accepts lines.
        TextAndLines error "text-and-lines" ("the text comes from standard input, so that lines cannot be accepted there")
            hint ("name a file with the text, or add --yes or --json");
        /// The scenario is not in a folder, so the command needs the place of the routine.
        NoFolder error "no-folder" ("it is not clear where the routine should be written") hint ("add --out FILE");
        /// The answer has problems, which the assistant can correct.
        NotYet { problems: usize, differences: usize } error "not-yet"
            ("nothing is written yet; problems in the answer: {problems}; statements that do not happen as they say: {differences}")
            hint ("paste this prompt into the same chat, save its answer, and name it with another --answer; --yes takes the answer as it is");
        /// The routine was written, and something of the answer or of the text is not in it.
        Incomplete { lacks: Vec<String>, routine: PathBuf } error "incomplete"
            ("{} lacks a part of the text: {}", routine.display(), lacks.join("; "))
            hint ("write sentences for it in the places of its comments, then run `homebody check`");
        /// Some sentences are refused, or a part of the text has none. Nothing was written, as the options ask.
        NotAll { lacks: Vec<String> } error "not-all" ("a routine of these lines would lack a part of the text: {}", lacks.join("; "))
            hint ("give the problems back to the assistant (the same command without --json prints the prompt), or write with --yes what is understood");
        /// A routine needs at least one accepted line.
        NoneAccepted error "none-accepted" ("no line was accepted, and nothing was written")
            hint ("choose a larger model (--model-name) or correct its answer (--answer); without --yes, accept lines in a terminal");
        /// The statement needs another one that was not accepted, so it is a comment in the routine.
        NeedsOther { why: String } warning "needs-other" ("not in the routine: {why}")
            hint ("accept the line that it needs, too, or write the sentence anew");
        /// The resident follows another file, so that a run does not use the routine yet.
        NotDriver { resident: String, routine: PathBuf } warning "not-driver"
            ("{resident} does not follow {} yet", routine.display())
            hint ("name the routine as \"driver\" in the file of the resident");
    }
}
