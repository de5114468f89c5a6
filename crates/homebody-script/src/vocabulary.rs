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
    word("go", PLACE, "Walks there, and is there as one usually is: in a bed one lies, on a chair one sits."),
    word("go_to", &[("x", Kind::Number), ("y", Kind::Number)], "Walks to a point of the plan, in metres."),
    word("sit", SEAT, "Walks there and sits down."),
    word("lie", SEAT, "Walks there and lies down."),
    word("stand", NONE, "Gets up, and steps out of the bed or the chair."),
    word(
        "step",
        &[("degrees", Kind::Number), ("metres", Kind::Number)],
        "Goes straight in a direction, 0 to the east and 90 to the north, as far as it is free.",
    ),
    word("wander", SECONDS, "Wanders through the home without a goal."),
    word("pace", SECONDS, "Walks to and fro between two places."),
    word("lap", SECONDS, "Walks the same round again and again."),
    word("wait", SECONDS, "Stays, and moves on the spot now and then."),
    word(
        "wait",
        &[("seconds", Kind::Seconds), ("manner", Kind::Manner)],
        "The same, with movements as those of this manner.",
    ),
    word("rest", SECONDS, "Stays without a movement."),
    word("turn_on", THING, "Turns a thing on from where one is; the name of a room is its lamp. Takes no time."),
    word("turn_off", THING, "Turns it off. Takes no time."),
    word("open", THING, "Opens it. Takes no time."),
    word("close", THING, "Closes it. Takes no time."),
    word(
        "use",
        &[("thing", Kind::Thing), ("seconds", Kind::Seconds)],
        "Walks to a thing, has it on or open so long, and turns it off or closes it.",
    ),
    word("activity", &[("label", Kind::Text)], "For the truth: what follows is called so; an empty text ends it."),
    word("leave_home", NONE, "Goes out by the front door. Who is out comes home before the next step in the home."),
    word("come_home", NONE, "Comes in by the front door."),
    word("instead", &[("steps", Kind::List)], "The steps of a list; what was still to be done is dropped."),
];

/// Chance, from named streams, and numbers.
pub const CHANCE: [Word; 12] = [
    word("random", &[("stream", Kind::Text)], "A number from 0 to 1, from the stream of this name."),
    word("random", &[("stream", Kind::Text), ("least", Kind::Number), ("most", Kind::Number)], "A number between two."),
    word(
        "chance",
        &[("stream", Kind::Text), ("probability", Kind::Number)],
        "True with this probability, from 0 to 1.",
    ),
    word("pick", &[("stream", Kind::Text), ("list", Kind::List)], "One of a list, each as likely."),
    word("sin", &[("degrees", Kind::Number)], "The sine of an angle."),
    word("cos", &[("degrees", Kind::Number)], "The cosine of an angle."),
    word("sqrt", &[("number", Kind::Number)], "The square root."),
    word("round", &[("number", Kind::Number)], "The nearest whole number, as an integer."),
    word("floor", &[("number", Kind::Number)], "The next whole number below, as an integer."),
    word("ceiling", &[("number", Kind::Number)], "The next whole number above, as an integer."),
    word("to_int", &[("number", Kind::Number)], "The number without what follows its point."),
    word("to_float", &[("number", Kind::Number)], "The same number as one with a point."),
];

/// What `around` is asked for with brackets, such as `around.is_on("stove")`.
pub const QUESTIONS: [Word; 8] = [
    word("is_on", THING, "Whether a thing is on; the name of a room is its lamp."),
    word("is_open", THING, "Whether a thing is open."),
    word("is_light", ROOM, "Whether it is light in a room: by day, or with its lamp on."),
    word("who", ROOM, "The names of the others in a room, as a list."),
    word("distance", PLACE, "How many metres it is to a place, as the crow flies."),
    word("can_reach", PLACE, "Whether a way leads there."),
    word("toward", PLACE, "In which direction the way there begins, in degrees."),
    word("free", &[("degrees", Kind::Number)], "How many metres the body can go straight in a direction, 5 at most."),
];

/// What `around` has without brackets, such as `around.room`.
pub const SEEN: [(&str, &str); 12] = [
    ("now", "Seconds since the run began."),
    ("hour", "The time of day by the clock on the wall, from 0 to 24: 7.5 is half past seven."),
    ("day", "The day of the run, 0 being its first."),
    ("weekday", "The day of the week, such as `\"Monday\"`."),
    ("name", "The resident's name."),
    ("room", "The room in which one is; empty between rooms, and while one is out."),
    ("place", "The place to which one went last; empty where one has gone on since."),
    ("posture", "`\"standing\"`, `\"sitting\"`, `\"lying\"`, or `\"out\"`."),
    ("x", "Where one is, in metres to the east."),
    ("y", "Where one is, in metres to the north."),
    ("dark", "Whether it is dark out of doors."),
    ("others", "Who else is at home: a list of maps with `name`, `room`, `posture`, `x`, `y` and `distance`."),
];

/// Every word with brackets.
pub fn words() -> impl Iterator<Item = &'static Word> {
    STEPS.iter().chain(&CHANCE).chain(&QUESTIONS)
}
