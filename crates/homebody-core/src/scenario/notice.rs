//! What of the movement in its field a motion sensor of `home.json` notices.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which of the movements in its field a motion sensor notices.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "notice")]
pub enum Notice {
    /// Every movement, at once: the sensor of Godsey & Skubic 2009.
    All,
    /// By chance, the sooner the larger a movement looks and the further it is from the edge of the field.
    Chance(ChanceFile),
}

/// How likely a motion sensor notices a movement. A sensor at level `zones` counts pulses instead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "chance of notice")]
pub struct ChanceFile {
    /// How often it looks, in looks a second; each look notices a movement or not by itself.
    #[schemars(range(min = 0.01, max = 50))]
    pub looks_per_s: f64,
    /// A look surely notices what moves by this angle within a second, seen from the lens. Of what moves by half of it, it notices
    /// a quarter. Without it 22, but 64 for one on a wall with a preset of CASAS, where such a sensor watches a whole room beside
    /// narrow ones, and misses much.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 360))]
    pub sure_deg: Option<f64>,
    /// How wide the soft edge of the field is: there a look notices the less, the nearer a body is to where the field ends.
    #[schemars(range(min = 0, max = 10))]
    pub edge_m: f64,
    /// Share of what passes that it misses altogether: of spans of 4 s, in which it notices nothing of a body.
    #[schemars(range(min = 0, max = 1))]
    pub missed: f64,
}

/// Ours: the first three fitted, the share missed read off a real home whose narrow sensors see 82 to 91 % of those who pass. See
/// `docs/explanation/realism.md`.
impl Default for ChanceFile {
    fn default() -> Self {
        ChanceFile { looks_per_s: 7.0, sure_deg: None, edge_m: 0.25, missed: 0.12 }
    }
}
