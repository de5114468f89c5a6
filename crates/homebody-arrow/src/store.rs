//! An object store, such as a bucket of S3: files by their names, below a prefix. Credentials come from the environment, as for programs
//! of AWS: `AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY`, `AWS_REGION`, `AWS_ENDPOINT` and so on.

use crate::fault::unwritten;
use crate::messages::StoreMessage;
use futures_util::TryStreamExt;
use homebody_core::problem::readable;
use homebody_core::scenario::scheme::NoPlace;
use homebody_log::LogError;
use homebody_log::examine::is_this_machine;
use object_store::aws::AmazonS3Builder;
use object_store::local::LocalFileSystem;
use object_store::path::Path as Key;
use object_store::{BackoffConfig, ClientOptions, Error, ObjectStore, ObjectStoreExt, PutPayload, RetryConfig};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::TempDir;
use tokio::runtime::{Builder, Runtime};
use url::Url;

/// Longest time for one request to a store, to connect, and to retry a request (our choice).
const ANSWERS_WITHIN: Duration = Duration::from_secs(30);
const CONNECTS_WITHIN: Duration = Duration::from_secs(3);
const AGAIN_FOR: Duration = Duration::from_secs(4);

/// Largest number of files in a data set (our choice).
const MOST_FILES: usize = 100_000;

/// A prefix in a store: what is below it, by name. Several threads may ask at once.
pub struct Store {
    place: String,
    store: Box<dyn ObjectStore>,
    prefix: Key,
    runtime: Runtime,
}

impl Store {
    /// Opens the store of a URL, such as `s3://bucket/logs`, without a request.
    pub fn open(url: &Path) -> Result<Store, LogError> {
        let text = url.to_string_lossy();
        let place = format!("parquet:{text}");
        let refused = |what: String| {
            let hint = "write parquet:s3://BUCKET/PREFIX".to_owned();
            LogError::from(NoPlace { what: readable(format!("{place}: {what}")), hint })
        };
        let parsed = Url::parse(&text).map_err(|why| refused(why.to_string()))?;
        let prefix = Key::from_url_path(parsed.path()).map_err(|why| refused(why.to_string()))?;
        let store: Box<dyn ObjectStore> = match parsed.scheme() {
            "s3" => {
                let options = ClientOptions::new().with_timeout(ANSWERS_WITHIN).with_connect_timeout(CONNECTS_WITHIN);
                let backoff = BackoffConfig { max_backoff: Duration::from_secs(1), ..BackoffConfig::default() };
                let retry = RetryConfig { backoff, max_retries: 3, retry_timeout: AGAIN_FOR };
                let is_near = |name: &str| std::env::var(name).is_ok_and(|endpoint| is_on_this_machine(&endpoint));
                let allows_http = ["AWS_ENDPOINT", "AWS_ENDPOINT_URL"].into_iter().any(is_near);
                let builder = AmazonS3Builder::from_env().with_url(text).with_client_options(options).with_retry(retry);
                let builder = if allows_http { builder.with_allow_http(true) } else { builder };
                Box::new(builder.build().map_err(|why| refused(why.to_string()))?)
            }
            "file" => Box::new(LocalFileSystem::new()),
            other => return Err(refused(format!("{other} is not a kind of store that Homebody knows"))),
        };
        let runtime = Builder::new_current_thread().enable_all().build();
        let runtime = runtime.map_err(|source| LogError::NoThread { place: place.clone(), source })?;
        Ok(Store { place, store, prefix, runtime })
    }

    /// The files of Parquet below a folder of it, by their names from there on.
    pub(crate) fn files(&self, below: &str) -> Result<Vec<String>, LogError> {
        self.names(below, MOST_FILES, |name| name.ends_with(".parquet"))
    }

    /// The name of a file below it, if there is any.
    pub fn any(&self) -> Result<Option<String>, LogError> {
        Ok(self.names("", 1, |_| true)?.pop())
    }

    fn names(&self, below: &str, most: usize, is_wanted: impl Fn(&str) -> bool) -> Result<Vec<String>, LogError> {
        let folder = self.key(below);
        let found = self.runtime.block_on(async {
            let mut listed = self.store.list(Some(&folder));
            let mut found = Vec::new();
            while found.len() < most
                && let Some(object) = listed.try_next().await?
            {
                if is_wanted(object.location.as_ref()) {
                    found.push(object.location);
                }
            }
            Ok(found)
        });
        let found: Vec<Key> = found.map_err(|error| self.store_error(error))?;
        let whole = self.prefix.as_ref();
        let name = |key: &Key| key.as_ref().strip_prefix(whole).unwrap_or_default().trim_start_matches('/').to_owned();
        let mut names: Vec<String> = found.iter().map(name).collect();
        names.sort();
        Ok(names)
    }

    /// Puts a file there, whole or not at all.
    pub fn put(&self, name: &str, file: &Path) -> Result<(), LogError> {
        self.put_bytes(name, fs::read(file).map_err(|error| unwritten(file, error))?)
    }

    /// The same of what is in memory.
    pub fn put_bytes(&self, name: &str, bytes: Vec<u8>) -> Result<(), LogError> {
        let key = self.key(name);
        self.runtime
            .block_on(self.store.put(&key, PutPayload::from(bytes)))
            .map(drop)
            .map_err(|error| self.store_error(error))
    }

    /// The bytes of a file there; `None` if it is missing.
    pub fn bytes(&self, name: &str) -> Result<Option<Vec<u8>>, LogError> {
        match self.read(name) {
            // Of a bucket that is not there, the client says the same.
            Err(error) if matches!(error, Error::NotFound { .. }) && !error.to_string().contains("NoSuchBucket") => {
                Ok(None)
            }
            read => read.map(Some).map_err(|error| self.store_error(error)),
        }
    }

    fn read(&self, name: &str) -> Result<Vec<u8>, Error> {
        let key = self.key(name);
        let bytes = self.runtime.block_on(async { self.store.get(&key).await?.bytes().await });
        bytes.map(|bytes| bytes.to_vec())
    }

    pub(crate) fn get(&self, name: &str, to: &Path) -> Result<(), LogError> {
        let bytes = self.read(name).map_err(|error| self.store_error(error))?;
        let made = to.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(to, bytes));
        made.map_err(|error| unwritten(to, error))
    }

    /// Removes a file; one that is gone already is gone.
    pub(crate) fn remove(&self, name: &str) -> Result<(), LogError> {
        let key = self.key(name);
        match self.runtime.block_on(self.store.delete(&key)) {
            Err(Error::NotFound { .. }) | Ok(()) => Ok(()),
            Err(error) => Err(self.store_error(error)),
        }
    }

    fn key(&self, name: &str) -> Key {
        let parts = self.prefix.as_ref().split('/').chain(name.split('/')).filter(|part| !part.is_empty());
        parts.map(str::to_owned).fold(Key::default(), |key, part| Key::from(format!("{key}/{part}")))
    }

    fn store_error(&self, error: Error) -> LogError {
        let text = error.to_string();
        // Of a long answer the beginning says enough.
        let answer: String = text.chars().take(LONGEST_TOLD).collect();
        let told = |message| LogError::destination(self.place.as_str(), message);
        match () {
            // Of a bucket, the client passes on what the store has answered.
            _ if matches!(error, Error::NotFound { .. }) || text.contains("NoSuchBucket") => {
                told(StoreMessage::NotFound { answer })
            }
            _ if matches!(error, Error::PermissionDenied { .. } | Error::Unauthenticated { .. })
                || text.contains("AccessDenied") =>
            {
                told(StoreMessage::Denied { answer })
            }
            _ => told(StoreMessage::NoAnswer { answer }).passing(),
        }
    }
}

/// Whether the store is on this machine: only then it may be without encryption.
fn is_on_this_machine(endpoint: &str) -> bool {
    let host = Url::parse(endpoint).ok().and_then(|url| url.host_str().map(str::to_owned));
    host.is_some_and(|host| is_this_machine(host.trim_matches(['[', ']'])))
}

/// Largest number of characters of a store's answer in a message (our choice).
const LONGEST_TOLD: usize = 300;

/// Copies the files below a URL into a temporary folder, which is removed when it is dropped.
pub(crate) fn fetched(url: &Path) -> Result<(TempDir, PathBuf), LogError> {
    let store = Store::open(url)?;
    let folder = tempfile::tempdir().map_err(|error| unwritten(Path::new("a folder for temporary files"), error))?;
    let names = store.files("")?;
    if names.is_empty() {
        return Err(LogError::Missing { place: store.place });
    }
    for name in &names {
        store.get(name, &folder.path().join(if name.is_empty() { "log.parquet" } else { name }))?;
    }
    let path = folder.path().to_owned();
    Ok((folder, path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_store_on_this_machine_goes_without_encryption() {
        for near in ["http://127.0.0.1:9000", "http://localhost", "http://[::1]:9000/x"] {
            assert!(is_on_this_machine(near), "{near}");
        }
        for far in ["http://127.0.0.1.example.org", "http://127.0.0.1@example.org", "http://10.0.0.1", "127.0.0.1", ""]
        {
            assert!(!is_on_this_machine(far), "{far}");
        }
    }
}
