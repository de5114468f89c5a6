//! The words of scripts: what each is called, what it wants, and what it does. Check, engine and manual read this table.

/// What a word wants in a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The name of a place, a piece of furniture or a room.
    Place,
    /// The name of a piece of furniture that people get on or into.
    Seat,
    /// The name of a door, a piece of furniture, or of a room, whose lamp is meant.
    Thing,
    /// The name of a room.
    Room,
    /// How many seconds, more than 0.
    Seconds,
    /// A number: metres, degrees, a probability.
    Number,
    /// The name of a manner of staying.
    Manner,
    /// Any text.
    Text,
    /// A list.
    List,
}

/// One word of the language.
#[derive(Clone, Copy, Debug)]
pub struct Word {
    /// What it is called.
    pub name: &'static str,
    /// What it wants, each by what the manual calls it.
    pub wants: &'static [(&'static str, Kind)],
    /// What it does or gives, as a sentence.
    pub about: &'static str,
}

const fn word(name: &'static str, wants: &'static [(&'static str, Kind)], about: &'static str) -> Word {
    Word { name, wants, about }
}

const PLACE: &[(&str, Kind)] = &[("place", Kind::Place)];
const SEAT: &[(&str, Kind)] = &[("seat", Kind::Seat)];
const THING: &[(&str, Kind)] = &[("thing", Kind::Thing)];
const ROOM: &[(&str, Kind)] = &[("room", Kind::Room)];
const SECONDS: &[(&str, Kind)] = &[("seconds", Kind::Seconds)];
const NONE: &[(&str, Kind)] = &[];

/// Steps: what `next` and `notice` answer with, one or a list.
pub const STEPS: [Word; 21] = [
    word("go", PLACE, "Walks to a place and takes the usual posture there: lies in a bed, sits on a chair."),
    word("go_to", &[("x", Kind::Number), ("y", Kind::Number)], "Walks to a point of the plan, in metres."),
    word("sit", SEAT, "Walks to a seat and sits down."),
    word("lie", SEAT, "Walks to a seat or bed and lies down."),
    word("stand", NONE, "Gets up and leaves the bed or the chair."),
    word(
        "step",
        &[("degrees", Kind::Number), ("metres", Kind::Number)],
        "Walks straight in a direction (0 is east, 90 is north) until an obstacle.",
    ),
    word("wander", SECONDS, "Wanders through the home without a goal."),
    word("pace", SECONDS, "Walks back and forth between two places."),
    word("lap", SECONDS, "Repeats the same round."),
    word("wait", SECONDS, "Stays in place, with a small movement now and then."),
    word(
        "wait",
        &[("seconds", Kind::Seconds), ("manner", Kind::Manner)],
        "Stays in place, with the movements of this manner.",
    ),
    word("rest", SECONDS, "Stays in place without a movement."),
    word("turn_on", THING, "Turns on a thing from the present place; the name of a room is its lamp. Takes no time."),
    word("turn_off", THING, "Turns off a thing. Takes no time."),
    word("open", THING, "Opens a thing. Takes no time."),
    word("close", THING, "Closes a thing. Takes no time."),
    word(
        "use",
        &[("thing", Kind::Thing), ("seconds", Kind::Seconds)],
        "Walks to a thing, turns it on or opens it for that time, and turns it off or closes it.",
    ),
    word(
        "activity",
        &[("label", Kind::Text)],
        "Labels the following steps in the ground truth; an empty text ends the label.",
    ),
    word("leave_home", NONE, "Goes out by the front door. The resident comes home before the next step in the home."),
    word("come_home", NONE, "Comes in by the front door."),
    word("instead", &[("steps", Kind::List)], "Does the steps of a list and drops the remaining steps."),
];

/// Chance, from named streams, and numbers.
pub const CHANCE: [Word; 12] = [
    word("random", &[("stream", Kind::Text)], "A random number from 0 to 1, from the stream of this name."),
    word(
        "random",
        &[("stream", Kind::Text), ("least", Kind::Number), ("most", Kind::Number)],
        "A random number between two numbers.",
    ),
    word(
        "chance",
        &[("stream", Kind::Text), ("probability", Kind::Number)],
        "True with this probability, from 0 to 1.",
    ),
    word("pick", &[("stream", Kind::Text), ("list", Kind::List)], "A random item of a list, each equally likely."),
    word("sin", &[("degrees", Kind::Number)], "The sine of an angle."),
    word("cos", &[("degrees", Kind::Number)], "The cosine of an angle."),
    word("sqrt", &[("number", Kind::Number)], "The square root."),
    word("round", &[("number", Kind::Number)], "The nearest integer."),
    word("floor", &[("number", Kind::Number)], "The largest integer that is not above the number."),
    word("ceiling", &[("number", Kind::Number)], "The smallest integer that is not below the number."),
    word("to_int", &[("number", Kind::Number)], "The number without its decimals, as an integer."),
    word("to_float", &[("number", Kind::Number)], "The number as a floating-point number."),
];

/// What `around` is asked for with brackets, such as `around.is_on("stove")`.
pub const QUESTIONS: [Word; 8] = [
    word("is_on", THING, "True if a thing is on; the name of a room is its lamp."),
    word("is_open", THING, "True if a thing is open."),
    word("is_light", ROOM, "True if a room is light: by day, or with its lamp on."),
    word("who", ROOM, "The names of the other people in a room, as a list."),
    word("distance", PLACE, "The straight distance to a place, in metres."),
    word("can_reach", PLACE, "True if a path leads to the place."),
    word("toward", PLACE, "The direction in which the path to the place begins, in degrees."),
    word("free", &[("degrees", Kind::Number)], "The free distance straight in a direction, in metres, 5 at most."),
];

/// What `around` has without brackets, such as `around.room`.
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

/// Every word with brackets.
pub fn words() -> impl Iterator<Item = &'static Word> {
    STEPS.iter().chain(&CHANCE).chain(&QUESTIONS)
}
