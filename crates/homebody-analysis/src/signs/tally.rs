//! Counts over the rows of one sensor, which show what it may be.

use super::course::{RowMeaning, SensorCourse};
use homebody_core::states::Says;
use homebody_core::time::{Interval, SECOND, Span, WallTime};

/// Length below which half of the spans of a brief sensor lie. A bed or a stove is used for longer.
const BRIEF: Span = SECOND.times(20);

/// Length below which half of the spans of a blinking sensor lie. A door that people walk through is open for longer.
const BLINK: Span = SECOND.times(5);

/// Counts over the rows of one sensor, taken one by one in the order of time.
#[derive(Clone, Debug, Default)]
pub struct SensorTally {
    motion: u64,
    contact: u64,
    words: u64,
    reading: u64,
    /// The rows with 1 or 0 among them: where a sensor has other numbers, too, these are numbers as well.
    ones: u64,
    course: SensorCourse,
    /// It has reported an end or a closing.
    ends: bool,
    since: Option<WallTime>,
    /// The times that it was on for any time, and those of them for seconds, and for a moment.
    spans: u64,
    brief: u64,
    blinks: u64,
}

impl SensorTally {
    pub fn take(&mut self, at: WallTime, says: Says, is_number: bool, gaps: &[Interval<WallTime>]) -> RowMeaning {
        let said = self.course.take(at, says, gaps);
        match says {
            Says::Begins | Says::Ends => self.motion += 1,
            Says::Opens | Says::Closes => self.contact += 1,
            // Other words describe a state, such as how restless a sleeper is.
            Says::Else if is_number => self.reading += 1,
            Says::Else => self.words += 1,
            Says::Unknown => {}
        }
        self.ones += u64::from(is_number && says.is_sign());
        self.ends |= says.is_off();
        if said.unknown_from.is_some() {
            self.since = None;
        }
        match says {
            Says::Begins | Says::Opens => self.since = self.since.or(Some(at)),
            Says::Ends | Says::Closes => {
                if let Some(length) = self.since.take().map(|since| at - since).filter(|&length| length > Span::ZERO) {
                    self.spans += 1;
                    self.brief += u64::from(length < BRIEF);
                    self.blinks += u64::from(length < BLINK);
                }
            }
            Says::Unknown | Says::Else => {}
        }
        said
    }

    /// The rows at which something begins, ends, opens or closes.
    pub(super) fn signs(&self) -> u64 {
        self.motion + self.contact
    }

    /// Most of its rows have other words.
    pub(super) fn says_words(&self) -> bool {
        self.words > self.signs()
    }

    /// Most of its rows are `ON` and `OFF`, `OPEN` and `CLOSE`, or numbers.
    pub(super) fn says_numbers(&self) -> bool {
        let (motion, reading) = self.without_ones();
        reading > motion.max(self.contact)
    }

    pub(super) fn says_open(&self) -> bool {
        self.contact > self.without_ones().0
    }

    fn without_ones(&self) -> (u64, u64) {
        let ones = if self.reading > 0 { self.ones } else { 0 };
        (self.motion - ones, self.reading + ones)
    }

    /// It reports beginnings, and no ends.
    pub(super) fn only_begins(&self) -> bool {
        self.motion > 0 && !self.ends
    }

    pub(super) fn has_spans(&self) -> bool {
        self.spans > 0
    }

    /// It is on for seconds at a time, as motion sensors are.
    pub(super) fn is_brief(&self) -> bool {
        self.brief > 0 && 2 * self.brief >= self.spans
    }

    /// It is on for a moment at a time.
    pub(super) fn blinks(&self) -> bool {
        self.blinks > 0 && 2 * self.blinks >= self.spans
    }
}
