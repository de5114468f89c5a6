//! What became of a run, as JSON.

use crate::fault::json;
use homebody_simulation::RunSummary;
use pyo3::PyResult;

/// What Python is told of a run that was stored.
pub fn lived(lived: &RunSummary) -> PyResult<String> {
    let recording = &lived.recording;
    // That of a run with a driver in Python, too, which cannot be gone on with.
    let folder = lived.truth.as_ref().and_then(|truth| truth.path().parent()).map(|path| path.display().to_string());
    json(&serde_json::json!({
        "seed": recording.seed,
        "simulated_s": lived.progress.done.seconds(),
        "stopped": lived.is_stopped(),
        "took_s": lived.took.as_secs_f64(),
        "firings": recording.firings,
        "sha256": recording.sha256,
        "sentences": lived.differences,
        "rows": lived.stored.rows,
        "rows_by_sensor": lived.rows_by_sensor().collect::<std::collections::BTreeMap<_, _>>(),
        "folder": folder,
    }))
}
