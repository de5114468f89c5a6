//! A server of language models with the chat interface of OpenAI, such as Ollama and llama.cpp.

use crate::messages::ModelMessage;
use crate::model_answer::schema;
use homebody_core::scenario::scheme::without_password;
use homebody_simulation::Cancel;
use rustls::crypto::ring;
use serde::Serialize;
use serde_json::{Value, json};
use std::cell::Cell;
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;
use ureq::http::{Response, Uri};
use ureq::tls::{Certificate, RootCerts, TlsConfig};
use ureq::{Agent, Body, Error};

/// The addresses of Ollama and llama.cpp.
pub const LOCAL_SERVERS: [&str; 2] = ["http://localhost:11434/v1", "http://localhost:8080/v1"];

/// The environment variable with the key for the named server.
pub const KEY_VARIABLE: &str = "HOMEBODY_MODEL_KEY";

/// Longest wait for an answer, where none is chosen (our choice): a small machine writes 2,000 words in it.
pub const USUAL_TIMEOUT: Duration = Duration::from_secs(600);

/// Longest answer (our choice): a routine of the longest text has a tenth.
pub const MOST_ANSWER_BYTES: usize = 2_000_000;

/// Longest wait for a connection, and for the list of models (our choice).
const CONNECT_TIME: Duration = Duration::from_secs(5);

/// Longest quotation of a server's error, in characters (our choice).
const QUOTED_CHARACTERS: usize = 200;

/// Most models that an error lists (our choice).
const MOST_MODELS: usize = 12;

/// Interval at which a request looks whether it was cancelled (our choice).
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// The choice of a server and a model. It has no `Debug`, which would print the key.
#[derive(Clone)]
pub struct ModelChoice {
    /// `None` for the first of [`LOCAL_SERVERS`] that answers.
    pub url: Option<String>,
    /// `None` for the only model of the server, or the first on this machine.
    pub name: Option<String>,
    /// It goes to a named server only.
    pub key: Option<String>,
    /// Longest wait for each answer.
    pub timeout: Duration,
}

/// A message of a chat.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChatMessage {
    role: &'static str,
    content: String,
}

impl ChatMessage {
    /// The instructions, before all else.
    pub fn system(content: &str) -> ChatMessage {
        ChatMessage { role: "system", content: content.to_owned() }
    }

    /// A request.
    pub fn user(content: &str) -> ChatMessage {
        ChatMessage { role: "user", content: content.to_owned() }
    }

    /// An earlier answer.
    pub fn assistant(content: &str) -> ChatMessage {
        ChatMessage { role: "assistant", content: content.to_owned() }
    }
}

/// A server with one of its models. It sends requests to its own address only: it follows no redirection, and asks no proxy for an
/// address of this machine.
pub struct ModelServer {
    /// Without a slash at the end.
    url: String,
    /// `None` if the server lists none.
    model: Option<String>,
    key: Option<String>,
    timeout: Duration,
    agent: Agent,
    /// Whether it takes a schema for its answer; false once it has refused one.
    is_structured: Cell<bool>,
}

impl ModelServer {
    /// The chosen server.
    ///
    /// # Errors
    ///
    /// Those of [`ModelServer::at`], or of [`ModelServer::first_of`] without an address.
    pub fn chosen(choice: &ModelChoice) -> Result<ModelServer, ModelMessage> {
        let ModelChoice { url, name, key, timeout } = choice;
        match url {
            Some(url) => ModelServer::at(url, name.as_deref(), key.clone(), *timeout),
            None => ModelServer::first_of(&LOCAL_SERVERS, name.as_deref(), *timeout),
        }
    }

    /// The server at an address. Without a name, its only model is asked, or of a server on this machine the first.
    ///
    /// # Errors
    ///
    /// The address is not one, the server does not answer, or it has several models.
    pub fn at(
        url: &str,
        model: Option<&str>,
        key: Option<String>,
        timeout: Duration,
    ) -> Result<ModelServer, ModelMessage> {
        let bad = || ModelMessage::BadUrl { url: without_password(url).into_owned() };
        let address: Uri = url.parse().map_err(|_| bad())?;
        let is_http = matches!(address.scheme_str(), Some("http" | "https"));
        let host = address.host().filter(|host| is_http && !host.is_empty()).ok_or_else(bad)?;
        let is_local = matches!(host, "localhost" | "127.0.0.1" | "[::1]" | "::1");
        let mut server = ModelServer {
            url: url.trim_end_matches('/').to_owned(),
            model: model.map(str::to_owned),
            key: key.filter(|key| !key.trim().is_empty()),
            timeout,
            agent: agent(is_local),
            is_structured: Cell::new(true),
        };
        if server.model.is_none() {
            let known = server.models()?;
            server.model = match &known[..] {
                [_, _, ..] if !is_local => {
                    let known = known.into_iter().take(MOST_MODELS).collect();
                    return Err(ModelMessage::SeveralModels { url: server.shown(), known });
                }
                known => known.first().cloned(),
            };
        }
        Ok(server)
    }

    /// The first of these servers that answers.
    ///
    /// # Errors
    ///
    /// [`ModelMessage::NoServer`] if none does, or the error of one that answers otherwise than a model's server.
    pub fn first_of(urls: &[&str], model: Option<&str>, timeout: Duration) -> Result<ModelServer, ModelMessage> {
        for url in urls {
            // A key is for a server that was named.
            let server = ModelServer::at(url, None, None, timeout);
            match server {
                Ok(server) => return Ok(ModelServer { model: model.map(str::to_owned).or(server.model), ..server }),
                Err(ModelMessage::Unreachable { .. } | ModelMessage::Slow { .. } | ModelMessage::NotFound { .. }) => {}
                Err(ModelMessage::NotChat { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        Err(ModelMessage::NoServer { tried: urls.iter().map(|url| (*url).to_owned()).collect() })
    }

    /// The model and its address, without a password.
    pub fn name(&self) -> String {
        match &self.model {
            Some(model) => format!("{model} at {}", self.shown()),
            None => self.shown(),
        }
    }

    /// A warning if others on the way can read the key.
    pub fn warning(&self) -> Option<ModelMessage> {
        let is_open = self.key.is_some()
            && self.url.starts_with("http://")
            && !self.url.contains("//localhost")
            && !self.url.contains("//127.0.0.1");
        is_open.then(|| ModelMessage::OpenKey { url: self.shown() })
    }

    /// The names of its models; none if it has no list.
    fn models(&self) -> Result<Vec<String>, ModelMessage> {
        let request = self.agent.get(format!("{}/models", self.url));
        let request = request.config().timeout_global(Some(CONNECT_TIME.min(self.timeout))).build();
        let request = match &self.key {
            Some(key) => request.header("Authorization", format!("Bearer {key}")),
            None => request,
        };
        let text = match self.text_of(request.call().map_err(|error| self.failure(error))?)? {
            (404 | 405 | 501, _) => return Ok(Vec::new()),
            (200, text) => text,
            (status, text) => return Err(self.refusal(status, &text)),
        };
        let list: Value = serde_json::from_str(&text).map_err(|_| self.not_chat(&text))?;
        let models = list.get("data").and_then(Value::as_array).ok_or_else(|| self.not_chat(&text))?;
        Ok(models.iter().filter_map(|model| model.get("id")?.as_str().map(str::to_owned)).collect())
    }

    /// The answer to some messages. It is asked for by schema, and without one if the server refuses that. Once it is cancelled, the
    /// connection closes, and the server is of no further use.
    ///
    /// # Errors
    ///
    /// Everything that a server can do instead of answering.
    pub fn answer(&self, messages: &[ChatMessage], cancel: &Cancel) -> Result<String, ModelMessage> {
        let (asking, is_over) = mpsc::channel::<()>();
        let agent = self.agent.clone();
        thread::scope(|scope| {
            scope.spawn(move || {
                while is_over.recv_timeout(LOOK_EVERY) == Err(RecvTimeoutError::Timeout) {
                    if cancel.is_cancelled() {
                        return agent.shutdown();
                    }
                }
            });
            let answer = self.asked(messages);
            drop(asking);
            answer
        })
    }

    fn asked(&self, messages: &[ChatMessage]) -> Result<String, ModelMessage> {
        if self.is_structured.get() {
            match self.ask(messages, true)? {
                (400 | 415 | 422 | 500 | 501, _) => self.is_structured.set(false),
                answer => return self.content(answer),
            }
        }
        self.content(self.ask(messages, false)?)
    }

    fn ask(&self, messages: &[ChatMessage], is_structured: bool) -> Result<(u16, String), ModelMessage> {
        let mut body = json!({ "messages": messages, "stream": false });
        if let Some(model) = &self.model {
            body["model"] = model.as_str().into();
        }
        if is_structured {
            // The same answer to the same question, as far as the server allows it.
            body["temperature"] = 0.into();
            let form = json!({ "name": "life", "strict": true, "schema": schema() });
            body["response_format"] = json!({ "type": "json_schema", "json_schema": form });
        }
        let request = self.agent.post(format!("{}/chat/completions", self.url)).content_type("application/json");
        let request = request.config().timeout_global(Some(self.timeout)).build();
        let request = match &self.key {
            Some(key) => request.header("Authorization", format!("Bearer {key}")),
            None => request,
        };
        self.text_of(request.send(body.to_string()).map_err(|error| self.failure(error))?)
    }

    fn content(&self, (status, text): (u16, String)) -> Result<String, ModelMessage> {
        if status != 200 {
            return Err(self.refusal(status, &text));
        }
        let answer: Value = serde_json::from_str(&text).map_err(|_| self.not_chat(&text))?;
        let message = answer.get("choices").and_then(|choices| choices.get(0)?.get("message"));
        let content = message.map(|message| message.get("content").and_then(Value::as_str).unwrap_or_default());
        content.map(str::to_owned).ok_or_else(|| self.not_chat(&text))
    }

    fn text_of(&self, mut response: Response<Body>) -> Result<(u16, String), ModelMessage> {
        let status = response.status().as_u16();
        if let (300..400, Some(to)) = (status, response.headers().get("location")) {
            let to = self.quoted(&String::from_utf8_lossy(to.as_bytes()));
            return Err(ModelMessage::Redirect { url: self.shown(), to });
        }
        let body = response.body_mut().with_config().limit(MOST_ANSWER_BYTES as u64).lossy_utf8(true);
        let text = body.read_to_string().map_err(|error| self.failure(error))?;
        Ok((status, text))
    }

    fn failure(&self, error: Error) -> ModelMessage {
        match error {
            Error::Timeout(_) => ModelMessage::Slow { url: self.shown(), seconds: self.timeout.as_secs_f64() },
            Error::BodyExceedsLimit(_) => ModelMessage::Babble { url: self.shown(), most: MOST_ANSWER_BYTES },
            Error::Http(_) | Error::BadUri(_) => ModelMessage::BadUrl { url: self.shown() },
            error => ModelMessage::Unreachable { url: self.shown(), why: self.quoted(&error.to_string()) },
        }
    }

    fn refusal(&self, status: u16, text: &str) -> ModelMessage {
        let (url, why) = (self.shown(), self.quoted(&error_in(text)));
        match status {
            401 | 403 => ModelMessage::Key { url, status, is_sent: self.key.is_some() },
            404 => ModelMessage::NotFound { url, why },
            _ => ModelMessage::Status { url, status, why },
        }
    }

    fn not_chat(&self, text: &str) -> ModelMessage {
        ModelMessage::NotChat { url: self.shown(), why: format!("it begins with {:?}", self.quoted(text)) }
    }

    /// The beginning of a server's words on one line, without the key.
    fn quoted(&self, text: &str) -> String {
        let text = match &self.key {
            Some(key) => text.replace(key.trim(), "…"),
            None => text.to_owned(),
        };
        let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
        line.chars().take(QUOTED_CHARACTERS).collect()
    }

    fn shown(&self) -> String {
        without_password(&self.url).into_owned()
    }
}

/// The error of a server in JSON or HTML, as text.
fn error_in(text: &str) -> String {
    let value: Value = serde_json::from_str(text).unwrap_or_default();
    let error = value.get("error").unwrap_or(&value);
    let said = error.get("message").or(Some(error)).and_then(Value::as_str);
    let (mut shown, mut is_tag) = (String::new(), false);
    for c in said.unwrap_or(text).chars() {
        match c {
            '<' => is_tag = true,
            '>' if is_tag => (is_tag, shown) = (false, shown + " "),
            _ if is_tag => {}
            c => shown.push(c),
        }
    }
    if shown.trim().is_empty() { "it says nothing more".to_owned() } else { shown }
}

fn agent(is_local: bool) -> Agent {
    let certificates = rustls_native_certs::load_native_certs().certs;
    let roots: Vec<Certificate<'static>> =
        certificates.iter().map(|certificate| Certificate::from_der(certificate).to_owned()).collect();
    let tls = TlsConfig::builder()
        .root_certs(RootCerts::Specific(Arc::new(roots)))
        .unversioned_rustls_crypto_provider(Arc::new(ring::default_provider()));
    let config = Agent::config_builder()
        .http_status_as_error(false)
        .max_redirects(0)
        .max_redirects_will_error(false)
        .timeout_connect(Some(CONNECT_TIME))
        .tls_config(tls.build());
    let config = if is_local { config.proxy(None) } else { config };
    config.build().into()
}
