//! The home as a run uses it: checked, resolved, baked, and never changed.

pub mod bake;
pub mod field;
pub mod plan;
pub mod resolved;

use crate::scenario::calendar::Calendar;
use crate::scenario::path::Posture;
use crate::scenario::resident::{self, ResidentFile};
use crate::sensors::Sensor;
use crate::time::{DAY, Micros, SECOND};
use field::{Field, Size};
use plan::Plan;
use resolved::ResolvedHome;

/// A home and the bodies it was baked for.
#[derive(Clone, Debug)]
pub struct Home {
    pub plan: Plan,
    pub sensors: Vec<Sensor>,
    pub sun: Sun,
    /// One field for each size of body that lives here.
    pub fields: Vec<Field>,
    /// The resident's field in each posture, by [`Posture`].
    postures: Vec<[usize; 3]>,
}

/// What there is to know of the sun at the home: where it stands as a run begins. Daylight saving does not move it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Days since the beginning of the year.
    pub day_of_year: f64,
    /// Since midnight by the clock of the home's zone in winter, which is taken for the sun's.
    pub time_of_day: Micros,
    pub latitude_deg: f64,
}

impl Sun {
    pub fn of(calendar: &Calendar, latitude_deg: f64) -> Sun {
        let start = calendar.local(0);
        let shift = if start.time_zone().to_offset_info(start.timestamp()).dst().is_dst() { 3600 * SECOND } else { 0 };
        Sun {
            day_of_year: f64::from(start.day_of_year()) - 1.0,
            time_of_day: calendar.start_of_day() - shift,
            latitude_deg,
        }
    }

    /// The sine of the sun's height above the horizon at an instant of the run; below 0 it is dark.
    ///
    /// The declination is Cooper's (1969): 23.45 degrees times the sine of the year's turn.
    pub fn elevation_sine(&self, at: Micros) -> f64 {
        let days = (at + self.time_of_day) as f64 / DAY as f64;
        let turn = |days: f64| days * core::f64::consts::TAU;
        let declination = 23.45_f64.to_radians() * libm::sin(turn((284.0 + 1.0 + self.day_of_year + days) / 365.25));
        let latitude = self.latitude_deg.to_radians();
        libm::sin(latitude) * libm::sin(declination)
            + libm::cos(latitude) * libm::cos(declination) * self.hour_angle_cosine(at)
    }

    /// How near it is to noon: 1 at noon, -1 at midnight, in between the cosine of the sun's hour angle.
    pub fn hour_angle_cosine(&self, at: Micros) -> f64 {
        let days = (at + self.time_of_day) as f64 / DAY as f64;
        libm::cos((days - 0.5) * core::f64::consts::TAU)
    }
}

impl Default for Sun {
    /// The first of March, from midnight, in Missouri.
    fn default() -> Sun {
        Sun { day_of_year: 59.0, time_of_day: 0, latitude_deg: crate::scenario::home::latitude() }
    }
}

/// The build of a resident's body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Build {
    pub radius_m: f64,
    pub height_m: f64,
}

impl Build {
    /// The body that a resident's file describes.
    pub fn of(file: &ResidentFile) -> Build {
        Build { radius_m: file.radius_m, height_m: file.height_m }
    }

    /// An adult: the body of a resident's file that says nothing of it.
    pub fn adult() -> Build {
        Build { radius_m: resident::radius(), height_m: resident::height() }
    }

    /// The body as sensors see it in a posture. A seated adult reaches to about 0.8 of the standing
    /// height on a common chair, one who lies on a bed to about 0.4 (ours).
    pub fn size(&self, posture: Posture) -> Size {
        let share = match posture {
            Posture::Standing => 1.0,
            Posture::Sitting => 0.8,
            Posture::Lying => 0.4,
        };
        Size { radius_m: self.radius_m, top_m: self.height_m * share }
    }
}

impl Home {
    /// Bakes a home for the bodies that live there.
    pub fn bake(home: &ResolvedHome, residents: &[Build]) -> Home {
        let (plan, sensors) = (home.plan().clone(), home.placed_sensors().to_vec());
        let mut home = Home { plan, sensors, sun: Sun::default(), fields: Vec::new(), postures: Vec::new() };
        for build in residents {
            let fields = [Posture::Standing, Posture::Sitting, Posture::Lying].map(|posture| {
                let size = build.size(posture);
                let known = home.fields.iter().position(|field| field.size == size);
                known.unwrap_or_else(|| {
                    home.fields.push(Field::bake(&home.plan, &home.sensors, size));
                    home.fields.len() - 1
                })
            });
            home.postures.push(fields);
        }
        home
    }

    /// What the sensors see of a resident in a posture.
    pub fn field(&self, resident: usize, posture: Posture) -> &Field {
        &self.fields[self.postures[resident][posture as usize]]
    }
}
