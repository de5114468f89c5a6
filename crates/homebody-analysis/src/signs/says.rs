//! The meanings of values.

/// The meaning of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Says {
    /// Something began: a movement, a press, a use.
    Begins,
    /// Something is over.
    Ends,
    /// A door, a drawer or a window is opened.
    Opens,
    /// It is closed.
    Closes,
    /// The state is not known: the sensor may still be on or not.
    Unknown,
    /// A number, or a word that is not known.
    Else,
}

impl Says {
    /// Whether something begins, ends, is opened or closed.
    pub fn is_sign(self) -> bool {
        !matches!(self, Says::Unknown | Says::Else)
    }

    /// Whether something is on from here, and open.
    pub fn is_on(self) -> bool {
        matches!(self, Says::Begins | Says::Opens)
    }
}

/// The meaning of a value, whatever the case of its letters.
pub fn says(value: &str) -> Says {
    const WORDS: [(Says, &[&str]); 5] = [
        (
            Says::Begins,
            &[
                "on", "fire", "fired", "true", "1", "present", "detected", "occupied", "motion", "in", "woke", "seen",
                "playing",
            ],
        ),
        (
            Says::Ends,
            &[
                "off",
                "false",
                "0",
                "absent",
                "clear",
                "cleared",
                "unoccupied",
                "vacant",
                "idle",
                "out",
                "slept",
                "paused",
                "standby",
            ],
        ),
        (Says::Opens, &["open", "opened"]),
        (Says::Closes, &["close", "closed"]),
        (Says::Unknown, &["unavailable", "unknown", "none", "null", "nan", "n/a", "undefined", ""]),
    ];
    let known = WORDS.iter().find(|(_, words)| words.iter().any(|word| word.eq_ignore_ascii_case(value.trim())));
    known.map_or(Says::Else, |&(says, _)| says)
}

/// Whether a value is a number.
pub fn is_number(value: &str) -> bool {
    value.parse::<f64>().is_ok_and(f64::is_finite)
}
