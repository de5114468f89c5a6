//! Cells of columns, whatever their type: as texts, and as instants.

use arrow_array::cast::AsArray;
use arrow_array::types::*;
use arrow_array::{Array, ArrayRef};
use arrow_schema::{DataType, TimeUnit};
use homebody_core::time::{DAY, SECOND, Span, UtcTime, WallTime};
use homebody_log::source::{LogInstant, since_1970};

/// A column whose cells are texts, or numbers that are told as texts.
pub(super) struct Texts<'a> {
    array: &'a dyn Array,
    kind: Kind<'a>,
}

enum Kind<'a> {
    Strings(&'a arrow_array::StringArray),
    Large(&'a arrow_array::LargeStringArray),
    Views(&'a arrow_array::StringViewArray),
    Dictionary(Vec<usize>, Box<Texts<'a>>),
    Numbers(Told<'a>),
}

/// Writes what a row says.
type Told<'a> = Box<dyn Fn(usize, &mut String) + 'a>;

impl<'a> Texts<'a> {
    /// Of a column; None for a type that is neither.
    pub fn of(array: &'a ArrayRef) -> Option<Texts<'a>> {
        let kind = match array.data_type() {
            DataType::Utf8 => Kind::Strings(array.as_string_opt()?),
            DataType::LargeUtf8 => Kind::Large(array.as_string_opt()?),
            DataType::Utf8View => Kind::Views(array.as_string_view_opt()?),
            DataType::Dictionary(..) => {
                let dictionary = array.as_any_dictionary_opt()?;
                let values = Texts::of(dictionary.values())?;
                // Where nothing is said there is nothing to look up.
                let keys = if values.array.is_empty() { Vec::new() } else { dictionary.normalized_keys() };
                Kind::Dictionary(keys, Box::new(values))
            }
            _ => Kind::Numbers(numbers(array)?),
        };
        Some(Texts { array, kind })
    }

    /// Whether a column of a type is one.
    pub fn may_be(of: &DataType) -> bool {
        match of {
            DataType::Boolean | DataType::Float32 | DataType::Float64 => true,
            DataType::Dictionary(_, values) => Texts::may_be(values),
            other => other.is_integer() || Texts::are_texts(other),
        }
    }

    /// Whether its cells are texts, and not numbers that are told as such.
    pub fn are_texts(of: &DataType) -> bool {
        match of {
            DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => true,
            DataType::Dictionary(_, values) => Texts::are_texts(values),
            _ => false,
        }
    }

    /// The text of a row, put together in `buffer` if it has to be; empty where there is none.
    pub fn get<'b>(&'b self, row: usize, buffer: &'b mut String) -> &'b str {
        if self.array.is_null(row) {
            return "";
        }
        match &self.kind {
            Kind::Strings(array) => array.value(row),
            Kind::Large(array) => array.value(row),
            Kind::Views(array) => array.value(row),
            Kind::Dictionary(keys, values) => keys.get(row).map_or("", |&key| values.get(key, buffer)),
            Kind::Numbers(write) => {
                buffer.clear();
                write(row, buffer);
                buffer
            }
        }
    }
}

/// Writes the numbers of a column.
fn numbers(array: &ArrayRef) -> Option<Told<'_>> {
    macro_rules! of {
        ($kind:ty) => {{
            let numbers = array.as_primitive_opt::<$kind>()?;
            Some(Box::new(move |row, text: &mut String| text.push_str(&numbers.value(row).to_string())))
        }};
    }
    match array.data_type() {
        DataType::Int8 => of!(Int8Type),
        DataType::Int16 => of!(Int16Type),
        DataType::Int32 => of!(Int32Type),
        DataType::Int64 => of!(Int64Type),
        DataType::UInt8 => of!(UInt8Type),
        DataType::UInt16 => of!(UInt16Type),
        DataType::UInt32 => of!(UInt32Type),
        DataType::UInt64 => of!(UInt64Type),
        DataType::Float32 => of!(Float32Type),
        DataType::Float64 => of!(Float64Type),
        DataType::Boolean => {
            let all = array.as_boolean_opt()?;
            Some(Box::new(move |row, text: &mut String| text.push_str(if all.value(row) { "true" } else { "false" })))
        }
        _ => None,
    }
}

/// What a cell of time says.
pub(super) enum Time<'t> {
    At(LogInstant),
    /// A number that is no instant.
    OutOfRange,
    /// As a text has it.
    Text(&'t str),
}

/// A column of time.
pub(super) enum Times<'a> {
    /// By rows in units of so many microseconds, or so many to a microsecond; whether by the world's clock.
    Stamps(Box<dyn Fn(usize) -> i64 + 'a>, Unit, bool),
    Numbers(Box<dyn Fn(usize) -> f64 + 'a>),
    Texts(Texts<'a>),
}

#[derive(Clone, Copy)]
pub(super) enum Unit {
    Micros(Span),
    OfAMicro(i64),
}

impl<'a> Times<'a> {
    /// Of a column; None for a type that tells no time.
    pub fn of(array: &'a ArrayRef) -> Option<Times<'a>> {
        macro_rules! stamps {
            ($kind:ty, $unit:expr, $is_utc:expr) => {{
                let all = array.as_primitive_opt::<$kind>()?;
                Times::Stamps(Box::new(move |row| i64::from(all.value(row))), $unit, $is_utc)
            }};
        }
        macro_rules! numbers {
            ($kind:ty) => {{
                let all = array.as_primitive_opt::<$kind>()?;
                Times::Numbers(Box::new(move |row| all.value(row) as f64))
            }};
        }
        Some(match array.data_type() {
            DataType::Timestamp(unit, zone) => match unit {
                TimeUnit::Second => stamps!(TimestampSecondType, Unit::Micros(SECOND), zone.is_some()),
                TimeUnit::Millisecond => {
                    stamps!(TimestampMillisecondType, Unit::Micros(Span::from_millis(1)), zone.is_some())
                }
                TimeUnit::Microsecond => {
                    stamps!(TimestampMicrosecondType, Unit::Micros(Span::MICROSECOND), zone.is_some())
                }
                TimeUnit::Nanosecond => stamps!(TimestampNanosecondType, Unit::OfAMicro(1000), zone.is_some()),
            },
            DataType::Date32 => stamps!(Date32Type, Unit::Micros(DAY), false),
            DataType::Date64 => stamps!(Date64Type, Unit::Micros(Span::from_millis(1)), false),
            DataType::Int32 => numbers!(Int32Type),
            DataType::UInt32 => numbers!(UInt32Type),
            DataType::Int64 => numbers!(Int64Type),
            DataType::UInt64 => numbers!(UInt64Type),
            DataType::Float32 => numbers!(Float32Type),
            DataType::Float64 => numbers!(Float64Type),
            _ => Times::Texts(Texts::of(array)?),
        })
    }

    /// Whether a column of a type is one.
    pub fn may_be(of: &DataType) -> bool {
        matches!(of, DataType::Timestamp(..) | DataType::Date32 | DataType::Date64) || Texts::may_be(of)
    }

    /// What a row that is not null says.
    pub fn get<'b>(&'b self, row: usize, buffer: &'b mut String) -> Time<'b> {
        match self {
            Times::Stamps(stamp, unit, is_utc) => {
                let since_1970 = match unit {
                    Unit::Micros(micros) => micros.saturating_mul(stamp(row)),
                    Unit::OfAMicro(parts) => Span::from_micros(stamp(row).div_euclid(*parts)),
                };
                Time::At(match *is_utc {
                    true => LogInstant::Utc(UtcTime::EPOCH + since_1970),
                    false => LogInstant::Local(WallTime::EPOCH + since_1970),
                })
            }
            Times::Numbers(number) => since_1970(number(row)).map_or(Time::OutOfRange, Time::At),
            Times::Texts(texts) => Time::Text(texts.get(row, buffer)),
        }
    }
}
