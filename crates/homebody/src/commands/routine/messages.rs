//! The messages of `homebody routine`.

homebody_core::messages! {
    /// Problems with the routines of a scenario.
    pub enum RoutinesMessage in "routines" {
        /// The residents of the scenario follow paths or recordings, which have no sentences.
        NoRoutine { scenario: String } error "no-routine" ("{scenario}: no resident has a routine")
            hint ("name a routine as \"driver\" of a resident");
        /// A run begins with its scenario and lasts a hundred years at most, so it has no earlier day and no later one.
        NoDay { scenario: String, first: String, date: String } error "no-day"
            ("{scenario} starts on {first}, so it has no day {date}")
            hint ("choose a day from {first} to a hundred years later");
        /// `--json FILE` writes the sentences that a simulation did not follow, so Homebody must simulate the scenario.
        NeedsLived error "needs-lived" ("--json FILE needs --lived")
            hint ("add --lived, or use --json without a file");
    }
}
