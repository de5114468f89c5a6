//! A message under way, and the chances that were drawn for it as it set out.

use crate::event::{Band, Provenance, Value};
use crate::ids::SensorId;
use crate::random::{DrawnValue, Stream};
use crate::time::RunTime;

/// A message that has left its device.
#[derive(Clone, Copy, Debug)]
pub struct MessageUnderWay {
    pub sent_at: RunTime,
    /// The sender.
    pub sensor: SensorId,
    /// The id in the message.
    pub id: SensorId,
    pub value: Value,
    pub provenance: Provenance,
    pub draws: Draws,
}

/// The random numbers of a message, from 0 up to 1, one for each possible fate.
///
/// All of them are there for every message, whatever it meets, so that another loss or delay changes nothing else.
#[derive(Clone, Copy, Debug)]
pub struct Draws(DrawnValue);

#[derive(Clone, Copy, Debug)]
pub enum LinkChance {
    Miss,
    Battery,
    Loss,
    BadLink,
    Corruption,
    Damage,
    Delay,
    Duplicate,
    /// The delay of the second copy.
    Again,
}

impl Draws {
    pub fn draw(stream: &mut Stream) -> Draws {
        Draws(stream.draw_many())
    }

    pub fn of(self, chance: LinkChance) -> f64 {
        self.0.unit(chance as u32)
    }
}

/// Ids are of eight bits, as those of X10: 16 house codes of 16 units.
pub const IDS: u32 = 256;

/// The id that a damaged one becomes, any of the others.
pub fn garbled_id(id: u32, damage: f64) -> u32 {
    (id + 1 + (damage * f64::from(IDS - 1)) as u32) % IDS
}

/// The value with damaged bits; `None` if the logger cannot understand it.
///
/// Of two values it becomes the other, of levels another one; of a reading, one of the lowest 16 bits is turned.
pub fn garbled_value(value: Value, damage: f64) -> Option<Value> {
    let below = |count: u32| (damage * f64::from(count)) as u32;
    let other_band = |band: Band| {
        let others = [Band::Low, Band::Normal, Band::High].into_iter().filter(move |&other| other != band);
        others.into_iter().nth(below(2) as usize)
    };
    match value {
        Value::Fire | Value::Seen => None,
        Value::On => Some(Value::Off),
        Value::Off => Some(Value::On),
        Value::Open => Some(Value::Close),
        Value::Close => Some(Value::Open),
        Value::In => Some(Value::Out),
        Value::Out => Some(Value::In),
        Value::Woke => Some(Value::Slept),
        Value::Slept => Some(Value::Woke),
        Value::Restless(level) => (1..=4).filter(|&other| other != level).nth(below(3) as usize).map(Value::Restless),
        Value::Pulse(band) => other_band(band).map(Value::Pulse),
        Value::Respiration(band) => other_band(band).map(Value::Respiration),
        Value::Reading(thousandths) => Some(Value::Reading(thousandths ^ (1 << below(16)))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LUCK: [f64; 5] = [0.0, 0.2, 0.5, 0.7, 0.999_999];

    #[test]
    fn a_damaged_id_is_another() {
        for id in [0, 7, 255] {
            let ids = LUCK.map(|damage| garbled_id(id, damage));
            assert!(ids.iter().all(|&other| other != id && other < IDS), "{id} becomes {ids:?}");
        }
        assert_eq!(garbled_id(0, 0.999_999), 255);
    }

    #[test]
    fn a_damaged_value_is_another() {
        let bands = [Band::Low, Band::Normal, Band::High];
        let values = [
            Value::On,
            Value::Off,
            Value::Open,
            Value::Close,
            Value::In,
            Value::Out,
            Value::Woke,
            Value::Slept,
            Value::Reading(-1),
        ];
        let levels = (1..=4).map(Value::Restless);
        for value in levels.chain(bands.map(Value::Pulse)).chain(bands.map(Value::Respiration)).chain(values) {
            for damage in LUCK {
                let other = garbled_value(value, damage);
                assert!(other.is_some_and(|other| other != value), "{value} becomes {other:?}");
            }
        }
        assert_eq!(LUCK.map(|damage| garbled_value(Value::Fire, damage)), [None; 5]);
    }
}
