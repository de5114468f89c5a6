//! The home as a run uses it: checked, resolved, baked, and never changed.

use crate::plan::Plan;
use crate::plan::sun::{self, Sun};
use crate::resident::Build;

pub mod field;
pub mod form;
pub mod resolved;

use crate::numbers::Numbers;
use crate::posture::Posture;
use crate::sensors::{Sensor, SensorPlacement};
use crate::time::RunTime;
use field::Field;
use resolved::ResolvedHome;

/// A home and the bodies it was baked for.
#[derive(Clone, Debug)]
pub struct Home {
    /// Walls, doors, furniture and rooms, as bodies and beams meet them.
    pub plan: Plan,
    /// The sensors by [`SensorId`](crate::ids::SensorId); after those of the home's file, one for each place that a
    /// sensor is moved to.
    pub sensors: Vec<Sensor>,
    /// The sun at the start of the run, for sensors of light and temperature.
    pub sun: Sun,
    /// The parameters that the scenario sets.
    pub numbers: Numbers,
    /// One field for each size of body of the residents.
    pub fields: Vec<Field>,
    /// The resident's fields for standing, sitting and lying.
    postures: Vec<[usize; 3]>,
}

impl Home {
    /// Whether it is dark out of doors, so that lamps are lit.
    pub fn is_dark(&self, at: RunTime) -> bool {
        self.sun.elevation_sine(at) < self.numbers.of(&sun::DARK)
    }

    /// Bakes a home for the bodies of its residents.
    pub fn bake(home: &ResolvedHome, residents: &[Build]) -> Home {
        let (plan, sensors, numbers) = (home.plan().clone(), home.placed_sensors().to_vec(), home.numbers().clone());
        let mut home = Home { plan, sensors, sun: Sun::default(), numbers, fields: Vec::new(), postures: Vec::new() };
        for build in residents {
            let fields = [Posture::Standing, Posture::Sitting, Posture::Lying].map(|posture| {
                let size = build.size(posture, &home.numbers);
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

    /// The description of each sensor, in the order of [`Home::sensors`].
    pub fn sensor_infos(&self) -> Vec<SensorPlacement> {
        self.sensors.iter().map(|sensor| sensor.info(&self.plan)).collect()
    }

    /// The field of view of the sensors for a resident in a posture.
    pub fn field(&self, resident: usize, posture: Posture) -> &Field {
        let height = match posture {
            Posture::Standing => 0,
            Posture::Sitting | Posture::Bending | Posture::Kneeling => 1,
            Posture::Lying | Posture::Down => 2,
        };
        &self.fields[self.postures[resident][height]]
    }
}
