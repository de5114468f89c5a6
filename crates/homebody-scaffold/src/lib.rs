//! New scenarios: a folder that appears as a whole, with the schemas of its files.

mod error;
pub mod catalogue;
mod messages;

mod texts;
mod residents;
mod empty;
mod furniture;
mod sensor_table;
mod plan_picture;
mod from_log;

pub use empty::empty;
pub use error::ScaffoldError;
pub use from_log::{GivenLog, ScenarioFromLog, from_log};
pub use furniture::furnish;
pub use messages::NewMessage;
pub use plan_picture::{KnownPoint, PlanPicture};
pub use residents::{InhabitedHome, NewScenario, inhabited, inhabited_texts, lack};
pub use sensor_table::{SensorRow, read_table};
pub use texts::{ScenarioTexts, create, from_template, write};
