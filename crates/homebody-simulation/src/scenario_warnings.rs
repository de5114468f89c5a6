//! The warnings about a scenario whose files are right and whose runs still lack something.

use homebody_core::problem::{Advice, counted};

homebody_core::messages! {
    /// Warnings about a scenario.
    pub enum ScenarioWarning in "life" {
        /// A run of this scenario simulates the residents and writes the ground truth, and its log stays empty.
        NoSensors { example: String } warning "no-sensors" ("the home has no sensors, so a run has an empty log")
            hint ("add sensors to \"sensors\"{example}; run `homebody suggest-sensors` for positions, or drag sensors in the page's Plan");
        /// Sensors fire when residents move. A home without residents has only the firings of devices and of faults.
        NoResidents warning "no-residents" ("the scenario has no residents, so no sensor fires on movement")
            hint ("add a file to \"residents\", as in a scenario of `homebody new`");
        /// Residents sleep, sit, cook and eat at pieces of furniture.
        NoFurniture warning "no-furniture" ("the home has no furniture to sleep, sit or eat at")
            hint ("add pieces to \"furniture\", or import the plan with --furnish");
        /// Residents leave the home, and visitors enter it, by a door that leads outside.
        NoDoors warning "no-doors" ("the home has no doors, so residents cannot leave and visitors cannot enter")
            hint ("add the front door to \"doors\", with \"outside\": true");
        /// Residents leave the home, and visitors enter it, by a door that leads outside. This home has doors between rooms only.
        NoFrontDoor warning "no-front-door" ("no door leads outside, so residents cannot leave and visitors cannot enter")
            hint ("write \"outside\": true at the front door in \"doors\"");
        /// The path of this resident has only waits, as a new or imported scenario has it. A routine lets the resident lead an
        /// ordinary life.
        Waits { resident: String, path: String, file: String, driver: String, routine: String, line: &'static str }
            warning "waits" ("{resident} stands still for the whole run: {path} has no walk")
            hint ("for an ordinary life, write \"driver\": {driver} in {file}, and write {routine} with the line: {line}");
        /// The home lacks something that this resident needs for a routine. The text quotes the problem that the routine would have.
        Lacks { resident: String, problem: String, problem_code: &'static str, problem_hint: Option<Advice> }
            warning "lacks" ("{resident} cannot have a routine: {problem}")
            advice (problem_hint.clone());
        /// A body of the residents' size finds no way into these rooms, because they have no door or because a piece of furniture
        /// blocks it.
        ClosedRooms { rooms: Vec<String>, more: usize } warning "closed-rooms"
            ("no resident can enter {rooms}{more}", rooms = quoted(rooms), more = and_more(*more))
            hint ("add a door to \"doors\", or move the furniture in the way; ignore this if the room should stay closed");
        /// Homebody keeps sentences that it does not simulate as remarks, for example about a resident's character.
        Unsimulated { sentences: Vec<String>, more: usize } warning "not-simulated"
            ("sentences without effect on a run: {sentences}{more}", sentences = quoted(sentences), more = and_more(*more))
            hint ("`homebody routine explain` prints the effect of each sentence");
        /// The run is too short for this sentence, or begins too late for it.
        WithoutEffect { sentence: String, effect: String } warning "partial-effect"
            ("the effect of {sentence:?} in this run: {effect}")
            hint ("write an earlier beginning or days that the run has, or simulate a longer run");
        /// In the simulated days, this sentence did not happen as it says: it had no time in the days, no way to its place, or less time
        /// than it says.
        NotAsSaid { sentence: String, expected: String, simulated: String, days: String } warning "not-as-said"
            ("{sentence:?}: expected {expected}; simulated {simulated} ({days})")
            hint ("leave more time for it, or change the sentences that take its time");
        /// Homebody lists the sentences with the largest loss, and counts the others.
        MoreNotAsSaid { count: usize } warning "more-not-as-said"
            ("more sentences that do not happen as they say: {count}")
            hint ("`homebody routine check --lived` lists all of them");
        /// The run is too short for a sentence of this member, or begins too late for it.
        MemberWithoutEffect { member: String, sentence: String, effect: String } warning "partial-effect-of-member"
            ("{member}: the effect of {sentence:?} in this run: {effect}")
            hint ("write an earlier beginning or days that the run has, or simulate a longer run");
        /// The field of view of this sensor of movement covers no floor with room to stand, for example because it points at a wall. It never
        /// fires.
        Blind { sensor: String } warning "blind-sensor"
            ("the sensor {sensor:?} sees no floor on which a resident can stand")
            hint ("turn or move the sensor; `homebody coverage` draws the view of each sensor");
        /// The sensor fires when this thing is used, and no routine of the scenario uses it.
        Unused { sensor: String, thing: String } warning "unused-thing"
            ("the sensor {sensor:?} never fires: no resident uses {thing:?}")
            hint ("attach the sensor to a thing that residents use, such as a fridge, a cupboard or the front door");
    }
}

fn quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
}

fn and_more(count: usize) -> String {
    if count > 0 { format!(" and {}", counted(count, "more", "more")) } else { String::new() }
}
