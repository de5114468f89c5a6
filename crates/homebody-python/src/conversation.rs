//! Free text that becomes statements about a resident: a conversation with a model, or with an assistant by hand.

use crate::fault::{json, raised};
use crate::scenario::PythonScenario;
use crate::work::PythonProgress;
use homebody_life::{
    Conversation, ConversationStage, FreeTextError, KEY_VARIABLE, MOST_ROUNDS, ModelChoice, ModelServer, USUAL_TIMEOUT,
};
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A text, a resident, and the answers so far.
#[pyclass(frozen, name = "Conversation", module = "homebody._homebody")]
pub struct PythonConversation {
    inner: Mutex<Conversation>,
}

impl PythonConversation {
    fn locked(&self) -> MutexGuard<'_, Conversation> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Works without the lock of Python, until Python is interrupted.
    fn work(
        &self,
        py: Python<'_>,
        progress: Option<Py<PyAny>>,
        work: impl FnOnce(&mut Conversation, &PythonProgress) -> PyResult<()> + Send,
    ) -> PyResult<()> {
        let watched = PythonProgress::new(progress);
        let result = py.detach(|| {
            watched.interruptible(|| {
                let mut conversation = self.locked();
                conversation.cancel(&watched.cancel);
                work(&mut conversation, &watched)
            })
        });
        watched.finish(result)
    }
}

#[pymethods]
impl PythonConversation {
    #[new]
    fn new(
        py: Python<'_>,
        scenario: &PythonScenario,
        resident: Option<&str>,
        text: &str,
    ) -> PyResult<PythonConversation> {
        let conversation = py.detach(|| Conversation::new(scenario.opened.clone(), resident, text)).map_err(raised)?;
        Ok(PythonConversation { inner: Mutex::new(conversation) })
    }

    /// Asks a model until nothing is wrong. Returns its name, and a warning about the key.
    fn converse(
        &self,
        py: Python<'_>,
        url: Option<String>,
        name: Option<String>,
        key: Option<String>,
        timeout_s: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(String, Option<String>)> {
        let timeout = timeout_s.map_or(USUAL_TIMEOUT, Duration::from_secs_f64);
        let key = key.or_else(|| std::env::var(KEY_VARIABLE).ok());
        let server = py.detach(|| ModelServer::chosen(&ModelChoice { url, name, key, timeout }));
        let server = server.map_err(|error| raised(FreeTextError::Model(error)))?;
        let about = (server.name(), server.warning().map(|warning| warning.to_string()));
        self.work(py, progress, move |conversation, watched| {
            let converse = conversation.converse(&server, |stage, _| {
                let done = match stage {
                    ConversationStage::Asking(round) => 2 * round - 2,
                    ConversationStage::Checking(round) => 2 * round - 1,
                };
                watched.tell(done as f64, 2.0 * MOST_ROUNDS as f64);
            });
            converse.map_err(raised)
        })?;
        Ok(about)
    }

    /// Takes the next answer of an assistant.
    fn take(&self, py: Python<'_>, answer: &str) -> PyResult<()> {
        self.work(py, None, |conversation, _| conversation.take(answer).map_err(raised))
    }

    // Without the lock of Python: another thread that has the conversation may wait for it.

    /// The next prompt for an assistant that has seen the earlier ones.
    #[getter]
    fn prompt(&self, py: Python<'_>) -> String {
        py.detach(|| self.locked().prompt())
    }

    #[getter]
    fn is_over(&self, py: Python<'_>) -> bool {
        py.detach(|| self.locked().is_over())
    }

    #[getter]
    fn person(&self, py: Python<'_>) -> String {
        py.detach(|| self.locked().person())
    }

    /// The prompts and answers so far.
    #[getter]
    fn rounds(&self, py: Python<'_>) -> PyResult<String> {
        json(&py.detach(|| self.locked().rounds().to_vec()))
    }

    /// The best draft, its table, and its warnings.
    fn draft(&self, py: Python<'_>) -> PyResult<(String, String, Vec<String>)> {
        let draft = py.detach(|| self.locked().draft().cloned()).map_err(raised)?;
        let warnings = draft.warnings().iter().map(ToString::to_string).collect();
        Ok((json(&draft)?, draft.table(), warnings))
    }

    /// The routine of the accepted lines, and the statements that need one of another line.
    fn routine(&self, py: Python<'_>, accepted: Vec<bool>) -> PyResult<(String, Vec<String>)> {
        py.detach(|| self.locked().routine(&accepted)).map_err(raised)
    }
}
