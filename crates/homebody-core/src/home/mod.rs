//! The home as a run uses it: checked, resolved, baked, and never changed.

pub mod bake;
pub mod field;
pub mod outlook;
pub mod plan;
pub mod resolved;
pub mod sun;

use crate::numbers::Numbers;
use crate::scenario::path::Posture;
use crate::scenario::resident::{self, ResidentFile};
use crate::sensors::{Sensor, SensorInfo};
use crate::time::Micros;
use field::{Field, Size};
use plan::Plan;
use resolved::ResolvedHome;
use sun::Sun;

crate::numbers! {
    /// Height of a person on a common chair, as a share of the standing height.
    static SITTING = "posture.sitting": 0.8, "1", [0.5, 1.0];
    /// Height of a person on a bed, as a share of the standing height.
    static LYING = "posture.lying": 0.4, "1", [0.1, 0.8];
}

/// A home and the bodies it was baked for.
#[derive(Clone, Debug)]
pub struct Home {
    /// Walls, doors, furniture and rooms, as bodies and beams meet them.
    pub plan: Plan,
    /// The sensors by [`SensorId`](crate::ids::SensorId); after those of the home's file, one for each place that a
    /// sensor is moved to.
    pub sensors: Vec<Sensor>,
    /// Where the sun stands as the run begins, for what measures light and warmth.
    pub sun: Sun,
    /// What the scenario sets otherwise in the models of people and sensors.
    pub numbers: Numbers,
    /// One field for each size of body that lives here.
    pub fields: Vec<Field>,
    /// The resident's fields: of who stands, of who sits, and of who lies.
    postures: Vec<[usize; 3]>,
}

/// The build of a resident's body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Build {
    /// The radius of the body seen from above, in metres.
    pub radius_m: f64,
    /// The height of the body when it stands, in metres.
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

    /// The body as sensors see it in a posture.
    pub fn size(&self, posture: Posture, numbers: &Numbers) -> Size {
        let share = match posture {
            Posture::Standing => 1.0,
            Posture::Sitting | Posture::Bending | Posture::Kneeling => numbers.of(&SITTING),
            Posture::Lying | Posture::Down => numbers.of(&LYING),
        };
        Size { radius_m: self.radius_m, top_m: self.height_m * share }
    }
}

impl Home {
    /// Whether it is dark out of doors, so that lamps are lit.
    pub fn is_dark(&self, at: Micros) -> bool {
        self.sun.elevation_sine(at) < self.numbers.of(&sun::DARK)
    }

    /// Bakes a home for the bodies that live there.
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

    /// What there is to say of each sensor, in the order of [`Home::sensors`].
    pub fn sensor_infos(&self) -> Vec<SensorInfo> {
        self.sensors.iter().map(|sensor| sensor.info(&self.plan)).collect()
    }

    /// What the sensors see of a resident in a posture.
    pub fn field(&self, resident: usize, posture: Posture) -> &Field {
        let height = match posture {
            Posture::Standing => 0,
            Posture::Sitting | Posture::Bending | Posture::Kneeling => 1,
            Posture::Lying | Posture::Down => 2,
        };
        &self.fields[self.postures[resident][height]]
    }
}
