//! The messages about free text, about answers of language models, and about their servers.

use homebody_simulation::SimulationError;

homebody_core::messages! {
    /// Problems with a free text and with the routine that is made of it.
    #[non_exhaustive]
    pub enum FreeTextError in "free-text" {
        /// A language model reads a limited length with care, and forgets parts of a longer one. The limit is our choice.
        TooLong { characters: usize, most: usize } error "too-long"
            ("the text has {characters} characters; at most {most} are read at once")
            hint ("split the text into parts, make a routine of each, and join the routines");
        /// A text has at least one sentence with letters.
        Empty error "empty" ("the text has no sentence")
            hint ("give a care plan, a diary or a description of a person's days");
        /// A routine belongs to a resident.
        NoResident { scenario: String } error "no-resident" ("{scenario} has no resident")
            hint ("add a file to \"residents\", as in a scenario of `homebody new`");
        /// The scenario has residents of other names.
        UnknownResident { name: String, known: Vec<String> } error "unknown-resident"
            ("the scenario has no resident {name:?}")
            hint ("choose one of: {known}", known = known.join(", "));
        /// A rounds file is written next to a routine that was made from a text.
        NotRounds { why: String } error "not-rounds" ("this is no file of rounds: {why}")
            hint ("name the file NAME.rounds.json in the folder of a routine that was made from a text");
        /// No answer had a line that can be used.
        NothingUsable { rounds: usize, why: String } error "nothing-usable" ("no answer in {rounds} rounds has lines: {why}")
            hint ("choose a larger model (--model-name), or paste the prompt (--prompt) into an assistant");
        => inner {
            /// The server of the model.
            Model(ModelMessage);
            /// The scenario has problems, or a run cannot be simulated.
            Simulation(SimulationError);
        }
    }
}

impl From<ModelMessage> for FreeTextError {
    fn from(message: ModelMessage) -> FreeTextError {
        FreeTextError::Model(message)
    }
}

impl From<SimulationError> for FreeTextError {
    fn from(error: SimulationError) -> FreeTextError {
        FreeTextError::Simulation(error)
    }
}

homebody_core::messages! {
    /// Warnings about parts of a free text that a routine does not have, or not as the text says.
    pub enum FreeTextWarning in "free-text" {
        /// The model left this sentence out in its answer. The routine has nothing of it.
        LeftOut { sentence: String } warning "left-out" ("the answer leaves out: {sentence:?}")
            hint ("write a sentence for it into the routine, or try again");
        /// The model gave a source that is not a sentence of the text. Its statements may be invented.
        NoSource { said: String } warning "no-source" ("not a sentence of the text: {said:?}")
            hint ("accept the line only if its statements are true");
        /// The reader of routines refuses this sentence of the model, so it is not part of the routine.
        Refused { line: u32, statement: String, why: String } warning "refused"
            ("refused, for line {line} of the routine: {statement:?}: {why}")
            hint ("write another sentence for it into the routine");
        /// A sentence of the routine language stands among the notes of the answer. Notes are not simulated, so that it is lost unless
        /// a person accepts it.
        Misplaced { statement: String, list: String } warning "misplaced"
            ("the answer has this sentence under {list:?}, where nothing is simulated: {statement:?}")
            hint ("accept its line at the end of the table if it is true, or write it into the routine");
        /// In the simulated days, this sentence did not happen as it says.
        NotAsSaid { statement: String, expected: String, simulated: String } warning "not-as-said"
            ("{statement:?}: expected {expected}; simulated {simulated}")
            hint ("leave more time for it, or change the sentences that take its time");
        /// With the sentences of the answer, a run stops before its end.
        RunStops { why: String } warning "run-stops" ("with these sentences, a run stops: {why}")
            hint ("accept fewer lines, above all fewer rules");
    }
}

homebody_core::messages! {
    /// Problems with the server of a language model.
    pub enum ModelMessage in "model" {
        /// Without --model, Homebody looks for a server on this machine.
        NoServer { tried: Vec<String> } error "no-server"
            ("no language model answers on this machine: {tried}", tried = tried.join(", "))
            hint ("start one (`ollama serve`, or `llama-server -m MODEL.gguf`), name the address of one (--model), or use the prompt (--prompt) without a model");
        /// The address of a server begins with http:// or https://.
        BadUrl { url: String } error "bad-url" ("{url:?} is no address of a model's server")
            hint ("write it as http://localhost:11434/v1 or https://HOST/v1");
        /// The server has several models, and Homebody sends the text to none that was not chosen.
        SeveralModels { url: String, known: Vec<String> } error "several-models" ("{url} has several models")
            hint ("choose one (--model-name): {known}", known = known.join(", "));
        /// The server cannot be reached, or it closed the connection before its answer was complete.
        Unreachable { url: String, why: String } error "unreachable" ("{url} does not answer: {why}")
            hint ("check that the server runs and that the address is right, then try again");
        /// The answer was not complete in time.
        Slow { url: String, seconds: f64 } error "slow" ("{url} gave no complete answer in {seconds} s")
            hint ("allow more time (--timeout 30m), or choose a smaller model (--model-name)");
        /// The server refuses the key, or it needs one.
        Key { url: String, status: u16, is_sent: bool } error "key" ("{url} refuses the request with status {status}: {}",
            if *is_sent { "the key is wrong or may not be used" } else { "it needs a key" })
            hint ("give the right key, as in the environment variable HOMEBODY_MODEL_KEY; it is neither printed nor stored");
        /// The server does not know this path or this model.
        NotFound { url: String, why: String } error "not-found" ("{url} has no such path or model: {why}")
            hint ("the address usually ends with /v1; choose one of the server's models (--model-name)");
        /// The server has an error of its own, or refuses the request.
        Status { url: String, status: u16, why: String } error "status" ("{url} answers with status {status}: {why}")
            hint ("look at the server's log, then try again");
        /// The server redirects to another address. Homebody sends the text to the named address only.
        Redirect { url: String, to: String } error "redirect" ("{url} redirects to {to}, where nothing was sent")
            hint ("if you trust that address, name it (--model)");
        /// The answer is not that of a chat, for example because the address is that of a web page.
        NotChat { url: String, why: String } error "not-chat" ("the answer of {url} is no chat completion: {why}")
            hint ("the address usually ends with /v1, as http://localhost:11434/v1");
        /// A longer answer is not read. The limit is our choice.
        Babble { url: String, most: usize } error "babble" ("the answer of {url} is longer than {most} bytes")
            hint ("choose another model (--model-name); this one does not stop");
        /// The key goes over the network in a form that others can read.
        OpenKey { url: String } warning "open-key" ("the key is sent to {url} without encryption")
            hint ("use an address that begins with https://");
    }
}
