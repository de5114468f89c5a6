//! The cells of a table's column by its first rows: instants, numbers, words, and how often each comes again.

use super::measured::{is_money, is_unit, measured};
use crate::source::instant::date_parts::may_be_date;
use crate::source::instant::{InstantReader, LogInstant, is_day_number};
use crate::source::options::DateOrder;
use homebody_core::states::says;
use homebody_core::time::{DAY, WallTime};
use std::collections::BTreeMap;

/// Words of two states that tell of no person, or of one who is in the home or not, in lower case. All others have their meanings in
/// `homebody_core::states`.
const SWITCHES: [&str; 10] = ["t", "f", "0.0", "1.0", "home", "not_home", "wet", "dry", "locked", "unlocked"];

/// Those of them that say that something is over.
const OFFS: [&str; 4] = ["f", "0.0", "not_home", "dry"];

/// Words for kinds of sensors and of what they measure, in lower case.
const KINDS: [&str; 61] = [
    "motion", "pir", "presence", "occupancy", "contact", "door", "window", "magnetic", "reed", "pressure", "bed",
    "seat", "mat", "flush", "electric", "power", "energy", "voltage", "current", "temperature", "temp", "humidity",
    "light", "illuminance", "illumination", "lux", "luminance", "battery", "vibration", "acceleration", "tilt",
    "water", "moisture", "leak", "smoke", "gas", "co2", "co", "tvoc", "sound", "noise", "switch", "button", "plug",
    "outlet", "item", "float", "photocell", "binary", "numeric", "binary_sensor", "sensor", "bewegung", "kontakt",
    "temperatur", "feuchte", "helligkeit", "radar", "camera", "rssi", "linkquality",
];

/// Words that say how grave a line of a program's log is.
const SEVERITIES: [&str; 14] = [
    "trace", "debug", "info", "information", "informational", "notice", "warn", "warning", "error", "err", "critical",
    "fatal", "crit", "severe",
];

/// So many words make a sentence: states have fewer.
const WORDS_OF_SENTENCE: usize = 4;

#[derive(Default)]
pub(crate) struct CellCounts {
    pub filled: usize,
    /// Dates with a time of day.
    pub instants: usize,
    /// Numbers since 1970.
    pub epochs: usize,
    /// Dates alone.
    pub dates: usize,
    /// Times of day alone.
    pub times: usize,
    pub numbers: usize,
    /// Words of two states, 0 and 1 among them.
    pub switches: usize,
    pub kinds: usize,
    pub severities: usize,
    /// Texts of several words.
    pub sentences: usize,
    /// Numbers with a unit, or in a list of their own: they count as numbers.
    pub measured: usize,
    pub money: usize,
    /// Units alone.
    pub units: usize,
    /// Numbers that may be those of days in a spreadsheet, with a fraction.
    pub day_numbers: usize,
    /// Each text with how often it comes.
    pub texts: BTreeMap<String, usize>,
    /// Whether each is the number after the one before, from 0 or 1 on.
    pub is_numbering: bool,
    /// Whether each is the whole number after the one before.
    pub is_counting: bool,
    pub order: DateOrders,
    last: Option<f64>,
}

impl CellCounts {
    pub fn count<'r>(column: impl Iterator<Item = &'r str>, read: &mut Reads) -> CellCounts {
        let mut cells = CellCounts { is_numbering: true, is_counting: true, ..CellCounts::default() };
        column.map(str::trim).filter(|cell| !is_blank(cell)).for_each(|cell| cells.take(cell, read));
        cells.is_numbering &= cells.filled > 1;
        cells.is_counting &= cells.filled > 2;
        cells
    }

    fn take(&mut self, cell: &str, read: &mut Reads) {
        self.filled += 1;
        *self.texts.entry(cell.to_owned()).or_default() += 1;
        match read.shape(cell) {
            CellShape::Instant(orders) => {
                self.instants += 1;
                self.order.add(orders);
            }
            CellShape::Epoch => self.epochs += 1,
            CellShape::Date(orders) => {
                self.dates += 1;
                self.order.add(orders);
            }
            CellShape::Time { is_of_twelve } => {
                self.times += 1;
                self.order.of_twelve += usize::from(is_of_twelve);
            }
            CellShape::Else => {}
        }
        let with_unit = measured(cell);
        let number = number(with_unit.map_or(cell, |(number, _)| number));
        self.numbers += usize::from(number.is_some());
        self.measured += usize::from(with_unit.is_some() && number.is_some());
        self.money += usize::from(is_money(cell));
        self.units += usize::from(is_unit(cell));
        self.day_numbers += usize::from(number.is_some_and(|number| is_day_number(number) && number.fract() != 0.0));
        self.is_counting &= match (self.last, number) {
            (None, first) => first.is_some_and(|first| first.fract() == 0.0),
            (Some(last), next) => next == Some(last + 1.0),
        };
        self.is_numbering &= match (self.last, number) {
            (None, Some(first)) => first == 0.0 || first == 1.0,
            (Some(last), Some(next)) => next == last + 1.0,
            (_, None) => false,
        };
        self.last = number;
        let word = cell.to_lowercase();
        let is_of = |words: &[&str]| usize::from(words.contains(&word.as_str()));
        self.switches += if says(&word).is_sign() { 1 } else { is_of(&SWITCHES) };
        self.kinds += is_of(&KINDS);
        self.severities += is_of(&SEVERITIES);
        self.sentences += usize::from(cell.split_whitespace().count() >= WORDS_OF_SENTENCE);
    }

    /// Whether nearly all of the filled cells are such.
    pub fn are(&self, count: usize) -> bool {
        self.filled > 0 && 10 * count >= 9 * self.filled
    }

    /// Whether most of the filled cells are such.
    pub fn are_mostly(&self, count: usize) -> bool {
        2 * count > self.filled
    }

    /// Instants of any kind.
    pub fn moments(&self) -> usize {
        self.instants + self.epochs
    }

    /// Numbers and words of two states.
    pub fn values(&self) -> usize {
        let both = self.texts.iter().filter(|(text, _)| matches!(text.as_str(), "0" | "1" | "0.0" | "1.0"));
        self.numbers + self.switches - both.map(|(_, times)| times).sum::<usize>()
    }

    /// Whether few texts come again and again, as names of sensors do.
    pub fn come_again(&self) -> bool {
        self.filled > 0 && (self.filled < FEW || 2 * self.texts.len() <= self.filled)
    }

    /// Whether nearly each text is another one, as no names of sensors are.
    pub fn hardly_come_again(&self) -> bool {
        self.filled >= ENOUGH && 10 * self.texts.len() >= 7 * self.filled
    }

    /// Whether it has the same text in all of several rows.
    pub fn is_constant(&self) -> bool {
        self.filled >= FEW && self.texts.len() == 1
    }

    /// Whether all are whole numbers of several digits, or texts of signs alone.
    pub fn are_whole(&self) -> bool {
        self.filled > 0 && self.texts.keys().all(|text| text.bytes().all(|byte| byte.is_ascii_digit()))
    }

    /// Whether each cell is 0 or 1, or a word of two states, and both come.
    pub fn is_switch(&self) -> bool {
        self.are(self.switches) && (self.texts.len() > 1 || self.numbers == 0)
    }
}

/// Fewer cells do not show how often they come again.
const FEW: usize = 8;

/// So many cells are enough to say that they do not come again.
const ENOUGH: usize = 20;

pub(crate) fn is_blank(cell: &str) -> bool {
    matches!(cell, "" | "-" | "NaN" | "nan" | "NA" | "N/A" | "n/a" | "null" | "NULL" | "None")
}

pub(crate) fn is_off(cell: &str) -> bool {
    says(cell).is_off() || OFFS.iter().any(|word| word.eq_ignore_ascii_case(cell))
}

/// A number with a point or a comma before its decimals.
fn number(cell: &str) -> Option<f64> {
    let is_number = cell.bytes().all(|byte| byte.is_ascii_digit() || b"+-.,eE".contains(&byte));
    if !is_number {
        return None;
    }
    if let Ok(number) = cell.parse::<f64>() {
        return Some(number).filter(|number| number.is_finite());
    }
    let count = |mark: char| cell.matches(mark).count();
    match (count(','), count('.')) {
        (1, _) => cell.replace('.', "").replace(',', ".").parse().ok(),
        (_, 0 | 1) => cell.replace(',', "").parse().ok(),
        _ => None,
    }
}

/// Whether an instant is before 2100: a number that would be later is something else.
fn is_near(at: LogInstant) -> bool {
    at.on_wall() < WallTime::EPOCH + 47_482 * DAY
}

/// In which orders dates in numbers can be read.
#[derive(Clone, Copy, Default)]
pub(crate) struct DateOrders {
    /// Dates that are one with the day first alone, with the month first alone, and with both.
    pub day: usize,
    pub month: usize,
    pub both: usize,
    /// Dates parted by points, which all who write them so begin with the day.
    pub with_points: usize,
    /// Instants by a clock of twelve hours.
    pub of_twelve: usize,
}

impl DateOrders {
    pub fn add(&mut self, other: DateOrders) {
        self.day += other.day;
        self.month += other.month;
        self.both += other.both;
        self.with_points += other.with_points;
        self.of_twelve += other.of_twelve;
    }
}

/// The part of an instant that a cell may be.
enum CellShape {
    Instant(DateOrders),
    Epoch,
    Date(DateOrders),
    Time { is_of_twelve: bool },
    Else,
}

/// Reads cells as instants in each order of day and month.
pub(crate) struct Reads {
    plain: InstantReader,
    day: InstantReader,
    month: InstantReader,
}

impl Reads {
    pub fn new() -> Reads {
        Reads {
            plain: InstantReader::default(),
            day: InstantReader::with_order(Some(DateOrder::DayFirst)),
            month: InstantReader::with_order(Some(DateOrder::MonthFirst)),
        }
    }

    fn shape(&mut self, cell: &str) -> CellShape {
        if !may_be_date(cell) {
            return CellShape::Else;
        }
        let has_time = cell.contains(':') || cell.contains('T');
        if let Some(orders) = self.orders(cell).filter(|_| has_time || cell.contains(' ')) {
            return CellShape::Instant(orders);
        }
        match () {
            () if self.plain.read(cell).is_some_and(is_near) => CellShape::Epoch,
            () if has_time && self.plain.read(&format!("1970-01-01 {cell}")).is_some() => {
                CellShape::Time { is_of_twelve: cell.ends_with(['M', 'm', '.']) }
            }
            () => self.orders(&format!("{cell} 00:00")).map_or(CellShape::Else, CellShape::Date),
        }
    }

    fn orders(&mut self, cell: &str) -> Option<DateOrders> {
        let ends_in_m = cell.trim_end_matches('.').ends_with(['M', 'm']);
        let of_twelve = usize::from(ends_in_m);
        // A number since 1970 has no order.
        if cell.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.') {
            return None;
        }
        if self.plain.read(cell).is_some() {
            return Some(DateOrders { of_twelve, ..DateOrders::default() });
        }
        let (day, month) = (self.day.read(cell).is_some(), self.month.read(cell).is_some());
        let count = |is: bool| usize::from(is);
        let orders = DateOrders {
            day: count(day && !month),
            month: count(month && !day),
            both: count(day && month),
            with_points: count(cell.split([' ', ',']).next().is_some_and(|date| date.contains('.'))),
            of_twelve,
        };
        (day || month).then_some(orders)
    }

    /// The instant in a cell, on whatever clock.
    pub fn moment(&mut self, cell: &str, order: Option<DateOrder>) -> Option<WallTime> {
        let instants = match order {
            None => &mut self.plain,
            Some(DateOrder::DayFirst) => &mut self.day,
            Some(DateOrder::MonthFirst) => &mut self.month,
        };
        instants.read(cell.trim()).map(LogInstant::on_wall)
    }

    /// The number of dates that follow on the day before, if dates are read in this order.
    pub fn next_days<'r>(&mut self, column: impl Iterator<Item = &'r str>, order: DateOrder) -> usize {
        let (mut last, mut next) = (None, 0);
        for cell in column {
            let whole = self.moment(cell, Some(order)).or_else(|| self.moment(&format!("{cell} 00:00"), Some(order)));
            let Some(day) = whole.map(WallTime::day_number) else { continue };
            next += usize::from(last.is_some_and(|last| day == last + 1));
            last = Some(day);
        }
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(column: &[&str]) -> CellCounts {
        CellCounts::count(column.iter().copied(), &mut Reads::new())
    }

    #[test]
    fn cells_are_counted_by_what_they_are() {
        for (cell, counts) in [
            ("2009-03-02 07:12:03", [1, 0, 0, 0, 0]),
            ("26.01.2026 21:00:30", [1, 0, 0, 0, 0]),
            ("3/28/2026 9:00 PM", [1, 0, 0, 0, 0]),
            ("1235977923", [0, 1, 0, 0, 1]),
            ("2009-03-02", [0, 0, 1, 0, 0]),
            ("28/3/2026", [0, 0, 1, 0, 0]),
            ("8:00:38 AM", [0, 0, 0, 1, 0]),
            ("06:00", [0, 0, 0, 1, 0]),
            ("21,5", [0, 0, 0, 0, 1]),
            ("-1.234,5", [0, 0, 0, 0, 1]),
            ("M001", [0, 0, 0, 0, 0]),
            ("31.02.2026", [0, 0, 0, 0, 0]),
            ("1,234,567.5", [0, 0, 0, 0, 1]),
        ] {
            let CellCounts { instants, epochs, dates, times, numbers, .. } = cells(&[cell]);
            assert_eq!([instants, epochs, dates, times, numbers], counts, "{cell}");
        }
    }

    #[test]
    fn names_come_again_and_keys_do_not() {
        let keys: Vec<String> = (0..40).map(|key| format!("key{key}")).collect();
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        assert!(cells(&keys).hardly_come_again() && !cells(&keys).come_again());
        let names = ["hall", "kitchen", "bath"].repeat(20);
        assert!(cells(&names).come_again() && !cells(&names).hardly_come_again());
    }

    #[test]
    fn one_hundred_rows_in_order_are_a_numbering() {
        assert!(cells(&["0", "1", "2", "3"]).is_numbering);
        assert!(!cells(&["0", "1", "1", "2"]).is_numbering);
        assert!(!cells(&["3", "4", "5"]).is_numbering);
    }
}
