//! The summary of a stored run, as JSON.

use crate::fault::json;
use homebody_simulation::RunSummary;
use pyo3::PyResult;

pub fn summary(run: &RunSummary) -> PyResult<String> {
    let recording = &run.recording;
    // A run with a driver in Python has a folder, too, although it cannot be resumed.
    let folder = run.truth.as_ref().and_then(|truth| truth.path().parent()).map(|path| path.display().to_string());
    json(&serde_json::json!({
        "seed": recording.seed,
        "simulated_s": run.progress.done.seconds(),
        "stopped": run.is_stopped(),
        "took_s": run.took.as_secs_f64(),
        "firings": recording.firings,
        "sha256": recording.sha256,
        "sentences": run.differences,
        "rows": run.stored.rows,
        "rows_by_sensor": run.rows_by_sensor().collect::<std::collections::BTreeMap<_, _>>(),
        "folder": folder,
    }))
}
