//! Options of reading a table whose rows do not decide them.

/// Options of reading a table whose rows do not decide them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TableOptions {
    /// Whether each column is a sensor.
    pub is_wide: bool,
    /// The column that says which home a row is of.
    pub home: Option<HomeColumn>,
    /// Which number of a date such as 02/03/2009 is the day.
    pub dates: Option<DateOrder>,
    /// Which mark parts the decimals of a number.
    pub decimals: Option<DecimalMark>,
}

/// The column of a table that says which home or person a row is of, and the home that is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HomeColumn {
    /// Its heading; without one its place, such as `column 2`.
    pub column: String,
    /// The home that is read, `*` for all together. `None`: the table has one home only.
    pub home: Option<String>,
}

/// Which number of a date in numbers comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DateOrder {
    /// 02/03/2009 is the second of March.
    DayFirst,
    /// 02/03/2009 is the third of February.
    MonthFirst,
}

/// The mark before the decimals of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecimalMark {
    /// As in 21,5.
    Comma,
    /// As in 21.5.
    Point,
}
