//! The scenario of a command.

use homebody_simulation::{ScenarioSource, SimulationError};
use std::path::{Path, PathBuf};

/// Which scenario, and whose.
#[derive(clap::Args)]
pub struct ScenarioArguments {
    /// Scenario folder, or its scenario.json
    scenario: PathBuf,
    #[command(flatten)]
    trust: Trust,
}

impl ScenarioArguments {
    pub fn name(&self) -> String {
        self.scenario.display().to_string()
    }

    pub fn source(&self) -> Result<ScenarioSource, SimulationError> {
        self.trust.source(&self.scenario)
    }
}

/// Trust in the files of a scenario.
#[derive(clap::Args)]
pub struct Trust {
    /// Trust the scenario: follow links that lead out of its folder, and read files of any size
    #[arg(long)]
    trust: bool,
}

impl Trust {
    pub fn is_given(&self) -> bool {
        self.trust
    }

    pub fn source(&self, path: &Path) -> Result<ScenarioSource, SimulationError> {
        let source = ScenarioSource::at(path)?;
        Ok(if self.trust { source.trusted() } else { source })
    }
}
