//! The postures of a body.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Posture of a body. It sets the height of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema, Default)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "posture")]
pub enum Posture {
    /// On the feet, with the whole height of the body.
    #[default]
    Standing,
    /// On a seat. The parameter `posture.sitting` sets the height.
    Sitting,
    /// On a bed or on the floor. The parameter `posture.lying` sets the height, the lowest of all.
    Lying,
    /// Bent forward, as to an oven: as high as when sitting.
    Bending,
    /// On both knees, or on hands and knees while the body moves: as high as when sitting.
    Kneeling,
    /// On the floor after a fall: as low as when lying.
    Down,
}

impl Posture {
    /// All of them, from the highest to the lowest.
    pub const ALL: [Posture; 6] =
        [Posture::Standing, Posture::Bending, Posture::Sitting, Posture::Kneeling, Posture::Lying, Posture::Down];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Posture::Standing => "standing",
            Posture::Sitting => "sitting",
            Posture::Lying => "lying",
            Posture::Bending => "bending",
            Posture::Kneeling => "kneeling",
            Posture::Down => "down",
        }
    }

    /// The posture of a name.
    pub fn named(name: &str) -> Option<Posture> {
        Posture::ALL.into_iter().find(|posture| posture.name() == name)
    }
}
