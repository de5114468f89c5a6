//! The sun over the home.

use crate::calendar::Calendar;
use crate::time::{DAY, HOUR, RunTime, Span};

/// Latitude of Columbia, the town of TigerPlace in Missouri, in degrees.
pub const COLUMBIA_DEG: f64 = 38.95;

crate::numbers! {
    /// Sine of the sun's elevation below which it is dark and lamps are lit.
    pub(crate) static DARK = "driver.dark": 0.08, "1", [-1.0, 1.0];
}

/// The sun at the home from the start of a run. Daylight saving does not move it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Days since the beginning of the year.
    pub day_of_year: f64,
    /// Since midnight by the clock of the home's zone in winter, which is taken for the sun's.
    pub time_of_day: Span,
    /// The latitude in degrees; below 0 in the south.
    pub latitude_deg: f64,
}

impl Sun {
    /// The sun as a run begins that this calendar dates, at a home so far north (degrees).
    pub fn new(calendar: &Calendar, latitude_deg: f64) -> Sun {
        let start = calendar.local(RunTime::START);
        let shift = if start.time_zone().to_offset_info(start.timestamp()).dst().is_dst() { HOUR } else { Span::ZERO };
        Sun {
            day_of_year: f64::from(start.day_of_year()) - 1.0,
            time_of_day: calendar.start_of_day() - shift,
            latitude_deg,
        }
    }

    /// The sine of the sun's height above the horizon at an instant of the run; below 0 it is dark.
    ///
    /// The declination is Cooper's (1969): 23.45 degrees times the sine of the year's turn.
    pub fn elevation_sine(&self, at: RunTime) -> f64 {
        let days = (at.since_zero() + self.time_of_day).ratio(DAY);
        let turn = |days: f64| days * core::f64::consts::TAU;
        let declination = 23.45_f64.to_radians() * libm::sin(turn((284.0 + 1.0 + self.day_of_year + days) / 365.25));
        let latitude = self.latitude_deg.to_radians();
        libm::sin(latitude) * libm::sin(declination)
            + libm::cos(latitude) * libm::cos(declination) * self.hour_angle_cosine(at)
    }

    /// The cosine of the sun's hour angle: 1 at noon, -1 at midnight.
    pub fn hour_angle_cosine(&self, at: RunTime) -> f64 {
        let days = (at.since_zero() + self.time_of_day).ratio(DAY);
        libm::cos((days - 0.5) * core::f64::consts::TAU)
    }
}

impl Default for Sun {
    /// The first of March, from midnight, in Missouri.
    fn default() -> Sun {
        Sun { day_of_year: 59.0, time_of_day: Span::ZERO, latitude_deg: COLUMBIA_DEG }
    }
}
