//! Cells of columns, whatever their type: as texts, and as instants.

use arrow_array::cast::AsArray;
use arrow_array::types::*;
use arrow_array::{Array, ArrayRef};
use arrow_schema::{DataType, TimeUnit};
use homebody_core::time::{DAY, SECOND, Span, UtcTime, WallTime};
use homebody_log::source::{LogInstant, since_1970};

/// A column of texts, or of numbers that are read as texts.
pub(super) struct TextCells<'a> {
    array: &'a dyn Array,
    kind: TextArray<'a>,
}

enum TextArray<'a> {
    Strings(&'a arrow_array::StringArray),
    Large(&'a arrow_array::LargeStringArray),
    Views(&'a arrow_array::StringViewArray),
    Dictionary(Vec<usize>, Box<TextCells<'a>>),
    Numbers(WriteNumber<'a>),
}

type WriteNumber<'a> = Box<dyn Fn(usize, &mut String) + 'a>;

impl<'a> TextCells<'a> {
    /// Of a column; None for a type that is neither.
    pub fn from_array(array: &'a ArrayRef) -> Option<TextCells<'a>> {
        let kind = match array.data_type() {
            DataType::Utf8 => TextArray::Strings(array.as_string_opt()?),
            DataType::LargeUtf8 => TextArray::Large(array.as_string_opt()?),
            DataType::Utf8View => TextArray::Views(array.as_string_view_opt()?),
            DataType::Dictionary(..) => {
                let dictionary = array.as_any_dictionary_opt()?;
                let values = TextCells::from_array(dictionary.values())?;
                // An empty dictionary has nothing to look up.
                let keys = if values.array.is_empty() { Vec::new() } else { dictionary.normalized_keys() };
                TextArray::Dictionary(keys, Box::new(values))
            }
            _ => TextArray::Numbers(numbers(array)?),
        };
        Some(TextCells { array, kind })
    }

    pub fn may_be(of: &DataType) -> bool {
        match of {
            DataType::Boolean | DataType::Float32 | DataType::Float64 => true,
            DataType::Dictionary(_, values) => TextCells::may_be(values),
            other => other.is_integer() || TextCells::are_texts(other),
        }
    }

    /// Whether its cells are texts and not numbers.
    pub fn are_texts(of: &DataType) -> bool {
        match of {
            DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => true,
            DataType::Dictionary(_, values) => TextCells::are_texts(values),
            _ => false,
        }
    }

    /// The text of a row, built in `buffer` where necessary; empty for a null.
    pub fn get<'b>(&'b self, row: usize, buffer: &'b mut String) -> &'b str {
        if self.array.is_null(row) {
            return "";
        }
        match &self.kind {
            TextArray::Strings(array) => array.value(row),
            TextArray::Large(array) => array.value(row),
            TextArray::Views(array) => array.value(row),
            TextArray::Dictionary(keys, values) => keys.get(row).map_or("", |&key| values.get(key, buffer)),
            TextArray::Numbers(write) => {
                buffer.clear();
                write(row, buffer);
                buffer
            }
        }
    }
}

fn numbers(array: &ArrayRef) -> Option<WriteNumber<'_>> {
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

pub(super) enum TimeCell<'t> {
    At(LogInstant),
    /// A number that is not a valid instant.
    OutOfRange,
    Text(&'t str),
}

pub(super) enum Times<'a> {
    /// By rows in units of so many microseconds, or so many to a microsecond; whether by the world's clock.
    Stamps(Box<dyn Fn(usize) -> i64 + 'a>, TimeScaling, bool),
    Numbers(Box<dyn Fn(usize) -> f64 + 'a>),
    Texts(TextCells<'a>),
}

#[derive(Clone, Copy)]
pub(super) enum TimeScaling {
    Micros(Span),
    OfAMicro(i64),
}

impl<'a> Times<'a> {
    /// Of a column; None for a type that tells no time.
    pub fn from_array(array: &'a ArrayRef) -> Option<Times<'a>> {
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
                TimeUnit::Second => stamps!(TimestampSecondType, TimeScaling::Micros(SECOND), zone.is_some()),
                TimeUnit::Millisecond => {
                    stamps!(TimestampMillisecondType, TimeScaling::Micros(Span::from_millis(1)), zone.is_some())
                }
                TimeUnit::Microsecond => {
                    stamps!(TimestampMicrosecondType, TimeScaling::Micros(Span::MICROSECOND), zone.is_some())
                }
                TimeUnit::Nanosecond => stamps!(TimestampNanosecondType, TimeScaling::OfAMicro(1000), zone.is_some()),
            },
            DataType::Date32 => stamps!(Date32Type, TimeScaling::Micros(DAY), false),
            DataType::Date64 => stamps!(Date64Type, TimeScaling::Micros(Span::from_millis(1)), false),
            DataType::Int32 => numbers!(Int32Type),
            DataType::UInt32 => numbers!(UInt32Type),
            DataType::Int64 => numbers!(Int64Type),
            DataType::UInt64 => numbers!(UInt64Type),
            DataType::Float32 => numbers!(Float32Type),
            DataType::Float64 => numbers!(Float64Type),
            _ => Times::Texts(TextCells::from_array(array)?),
        })
    }

    pub fn may_be(of: &DataType) -> bool {
        matches!(of, DataType::Timestamp(..) | DataType::Date32 | DataType::Date64) || TextCells::may_be(of)
    }

    pub fn get<'b>(&'b self, row: usize, buffer: &'b mut String) -> TimeCell<'b> {
        match self {
            Times::Stamps(stamp, unit, is_utc) => {
                let since_1970 = match unit {
                    TimeScaling::Micros(micros) => micros.saturating_mul(stamp(row)),
                    TimeScaling::OfAMicro(parts) => Span::from_micros(stamp(row).div_euclid(*parts)),
                };
                TimeCell::At(match *is_utc {
                    true => LogInstant::Utc(UtcTime::EPOCH + since_1970),
                    false => LogInstant::Local(WallTime::EPOCH + since_1970),
                })
            }
            Times::Numbers(number) => since_1970(number(row)).map_or(TimeCell::OutOfRange, TimeCell::At),
            Times::Texts(texts) => TimeCell::Text(texts.get(row, buffer)),
        }
    }
}
