//! The words of scripts. The check, the engine and the manual use this table.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArgumentKind {
    /// A place, a piece of furniture or a room.
    Place,
    /// A piece of furniture to get on or into.
    Seat,
    /// A door or a piece of furniture, or a room for its lamp.
    Thing,
    Room,
    Seconds,
    /// Metres, degrees or a probability.
    Number,
    Manner,
    Text,
    List,
}

#[derive(Clone, Copy, Debug)]
pub struct ScriptWord {
    pub name: &'static str,
    /// Parameters with their names in the manual.
    pub wants: &'static [(&'static str, ArgumentKind)],
    /// One sentence.
    pub about: &'static str,
}

const fn word(name: &'static str, wants: &'static [(&'static str, ArgumentKind)], about: &'static str) -> ScriptWord {
    ScriptWord { name, wants, about }
}

const PLACE: &[(&str, ArgumentKind)] = &[("place", ArgumentKind::Place)];
const SEAT: &[(&str, ArgumentKind)] = &[("seat", ArgumentKind::Seat)];
const THING: &[(&str, ArgumentKind)] = &[("thing", ArgumentKind::Thing)];
const ROOM: &[(&str, ArgumentKind)] = &[("room", ArgumentKind::Room)];
const SECONDS: &[(&str, ArgumentKind)] = &[("seconds", ArgumentKind::Seconds)];
const NONE: &[(&str, ArgumentKind)] = &[];

/// Answers of `next` and `notice`, one or a list.
pub const STEPS: [ScriptWord; 21] = [
    word("go", PLACE, "Walks to a place and takes the usual posture there: lies in a bed, sits on a chair."),
    word(
        "go_to",
        &[("x", ArgumentKind::Number), ("y", ArgumentKind::Number)],
        "Walks to a point of the plan, in metres.",
    ),
    word("sit", SEAT, "Walks to a seat and sits down."),
    word("lie", SEAT, "Walks to a seat or bed and lies down."),
    word("stand", NONE, "Gets up and leaves the bed or the chair."),
    word(
        "step",
        &[("degrees", ArgumentKind::Number), ("metres", ArgumentKind::Number)],
        "Walks straight in a direction (0 is east, 90 is north) until an obstacle.",
    ),
    word("wander", SECONDS, "Wanders through the home without a goal."),
    word("pace", SECONDS, "Walks back and forth between two places."),
    word("lap", SECONDS, "Repeats the same round."),
    word("wait", SECONDS, "Stays in place, with a small movement now and then."),
    word(
        "wait",
        &[("seconds", ArgumentKind::Seconds), ("manner", ArgumentKind::Manner)],
        "Stays in place, with the movements of this manner.",
    ),
    word("rest", SECONDS, "Stays in place without a movement."),
    word("turn_on", THING, "Turns on a thing from the present place; the name of a room is its lamp. Takes no time."),
    word("turn_off", THING, "Turns off a thing. Takes no time."),
    word("open", THING, "Opens a thing. Takes no time."),
    word("close", THING, "Closes a thing. Takes no time."),
    word(
        "use",
        &[("thing", ArgumentKind::Thing), ("seconds", ArgumentKind::Seconds)],
        "Walks to a thing, turns it on or opens it for that time, and turns it off or closes it.",
    ),
    word(
        "activity",
        &[("label", ArgumentKind::Text)],
        "Labels the following steps in the ground truth; an empty text ends the label.",
    ),
    word("leave_home", NONE, "Goes out by the front door. The resident comes home before the next step in the home."),
    word("come_home", NONE, "Comes in by the front door."),
    word("instead", &[("steps", ArgumentKind::List)], "Does the steps of a list and drops the remaining steps."),
];

/// Random numbers from named streams.
pub const CHANCE: [ScriptWord; 12] = [
    word("random", &[("stream", ArgumentKind::Text)], "A random number from 0 to 1, from the stream of this name."),
    word(
        "random",
        &[("stream", ArgumentKind::Text), ("least", ArgumentKind::Number), ("most", ArgumentKind::Number)],
        "A random number between two numbers.",
    ),
    word(
        "chance",
        &[("stream", ArgumentKind::Text), ("probability", ArgumentKind::Number)],
        "True with this probability, from 0 to 1.",
    ),
    word(
        "pick",
        &[("stream", ArgumentKind::Text), ("list", ArgumentKind::List)],
        "A random item of a list, each equally likely.",
    ),
    word("sin", &[("degrees", ArgumentKind::Number)], "The sine of an angle."),
    word("cos", &[("degrees", ArgumentKind::Number)], "The cosine of an angle."),
    word("sqrt", &[("number", ArgumentKind::Number)], "The square root."),
    word("round", &[("number", ArgumentKind::Number)], "The nearest integer."),
    word("floor", &[("number", ArgumentKind::Number)], "The largest integer that is not above the number."),
    word("ceiling", &[("number", ArgumentKind::Number)], "The smallest integer that is not below the number."),
    word("to_int", &[("number", ArgumentKind::Number)], "The number without its decimals, as an integer."),
    word("to_float", &[("number", ArgumentKind::Number)], "The number as a floating-point number."),
];

/// Questions with brackets, such as `around.is_on("stove")`.
pub const QUESTIONS: [ScriptWord; 8] = [
    word("is_on", THING, "True if a thing is on; the name of a room is its lamp."),
    word("is_open", THING, "True if a thing is open."),
    word("is_light", ROOM, "True if a room is light: by day, or with its lamp on."),
    word("who", ROOM, "The names of the other people in a room, as a list."),
    word("distance", PLACE, "The straight distance to a place, in metres."),
    word("can_reach", PLACE, "True if a path leads to the place."),
    word("toward", PLACE, "The direction in which the path to the place begins, in degrees."),
    word(
        "free",
        &[("degrees", ArgumentKind::Number)],
        "The free distance straight in a direction, in metres, 5 at most.",
    ),
];

/// Properties without brackets, such as `around.room`.
pub const SEEN: [(&str, &str); 12] = [
    ("now", "Seconds since the run began."),
    ("hour", "The time of day on the wall clock, from 0 to 24: 7.5 is half past seven."),
    ("day", "The day of the run; the first is 0."),
    ("weekday", "The day of the week, such as `\"Monday\"`."),
    ("name", "The resident's name."),
    ("room", "The room of the resident; empty between rooms and while the resident is out."),
    ("place", "The place that the resident went to last; empty after the resident has left it."),
    ("posture", "`\"standing\"`, `\"sitting\"`, `\"lying\"`, or `\"out\"`."),
    ("x", "The position of the resident, in metres to the east."),
    ("y", "The position of the resident, in metres to the north."),
    ("dark", "True if it is dark outside."),
    ("others", "The other people at home: a list of maps with `name`, `room`, `posture`, `x`, `y` and `distance`."),
];

pub fn words() -> impl Iterator<Item = &'static ScriptWord> {
    STEPS.iter().chain(&CHANCE).chain(&QUESTIONS)
}
