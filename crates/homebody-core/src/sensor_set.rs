//! Which of a home's sensors: a set of their ids.

use crate::ids::SensorId;
use std::ops::BitOr;

/// Sensors of a home, each once, in the order of their ids.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct SensorSet {
    /// A bit each; the last block has one, so that equal sets have equal blocks.
    blocks: Vec<Mask>,
}

impl SensorSet {
    /// Whether the set has no sensor.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// The number of sensors.
    pub fn len(&self) -> usize {
        self.blocks.iter().map(|block| block.count_ones() as usize).sum()
    }

    /// Whether the sensor is one of them.
    pub fn contains(&self, sensor: SensorId) -> bool {
        let block = self.blocks.get(sensor.index() / BLOCK);
        block.is_some_and(|block| block & bit(sensor.index()) != 0)
    }

    /// Adds a sensor, unless the set has it.
    pub fn insert(&mut self, sensor: SensorId) {
        let block = sensor.index() / BLOCK;
        if block >= self.blocks.len() {
            self.blocks.resize(block + 1, 0);
        }
        self.blocks[block] |= bit(sensor.index());
    }

    /// Its sensors, in the order of their ids.
    pub fn iter(&self) -> impl Iterator<Item = SensorId> {
        let of_block = |(block, &mask)| bits(mask).map(move |number| SensorId::new(block * BLOCK + number));
        self.blocks.iter().enumerate().flat_map(of_block)
    }
}

impl Extend<SensorId> for SensorSet {
    fn extend<T: IntoIterator<Item = SensorId>>(&mut self, sensors: T) {
        sensors.into_iter().for_each(|sensor| self.insert(sensor));
    }
}

impl FromIterator<SensorId> for SensorSet {
    fn from_iter<T: IntoIterator<Item = SensorId>>(sensors: T) -> SensorSet {
        let mut set = SensorSet::default();
        set.extend(sensors);
        set
    }
}

impl BitOr for SensorSet {
    type Output = SensorSet;

    /// The sensors of both.
    fn bitor(mut self, other: SensorSet) -> SensorSet {
        self.extend(other.iter());
        self
    }
}

/// Largest number of sensors of a home, with the positions that sensors are moved to (our choice): the keys of timers
/// have bits for them.
pub const MAX_SENSORS: usize = 1024;

/// One bit for each sensor of a block: sensor `n` is bit `n % BLOCK` of block `n / BLOCK`.
pub(crate) type Mask = u128;

/// The number of sensors that share a mask.
pub(crate) const BLOCK: usize = Mask::BITS as usize;

pub(crate) const BLOCKS: usize = MAX_SENSORS.div_ceil(BLOCK);

/// The number of blocks for a number of sensors, at least one.
pub(crate) fn blocks(sensors: usize) -> usize {
    sensors.div_ceil(BLOCK).max(1)
}

/// The bit of a sensor in the mask of its block.
pub(crate) fn bit(sensor: usize) -> Mask {
    1 << (sensor % BLOCK)
}

/// The numbers of the bits that are set, least first.
pub(crate) fn bits(mut mask: Mask) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = (mask != 0).then(|| mask.trailing_zeros() as usize)?;
        mask &= mask - 1;
        Some(bit)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_has_each_sensor_once_and_in_order() {
        let set: SensorSet = [700, 3, 128, 3, 127, 1023].map(SensorId).into_iter().collect();
        assert!(set.iter().eq([3, 127, 128, 700, 1023].map(SensorId)));
        assert_eq!((set.len(), set.is_empty()), (5, false));
        assert!([3, 128, 1023].into_iter().all(|sensor| set.contains(SensorId(sensor))));
        assert!([2, 129, 1022, 5000].into_iter().all(|sensor| !set.contains(SensorId(sensor))));
    }

    #[test]
    fn bits_come_least_first() {
        assert!(bits(1 << 127 | 0b1010).eq([1, 3, 127]));
        assert_eq!(bits(0).next(), None);
    }

    #[test]
    fn sets_are_equal_by_what_they_have() {
        let set = |sensors: &[u32]| -> SensorSet { sensors.iter().map(|&sensor| SensorId(sensor)).collect() };
        assert_eq!(set(&[5, 300]), set(&[300, 5]));
        assert_ne!(set(&[5]), set(&[5, 300]));
        assert_eq!(set(&[5, 300]) | set(&[5, 6]), set(&[5, 6, 300]));
        assert_eq!((set(&[]), set(&[]).len()), (SensorSet::default(), 0));
    }
}
