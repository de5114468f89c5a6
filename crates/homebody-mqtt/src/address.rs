//! Which broker, and how it is spoken to: `mqtt://user@host:1883/prefix?style=zigbee2mqtt`, with all that can be wrong with it.

use crate::messages::AddressMessage;
use crate::names::is_level;
use homebody_core::problem::Problems;
use homebody_core::problems::UrlProblems;
use homebody_core::scenario::scheme::Scheme;
use homebody_log::files::plain::others_may_read;
use homebody_log::url::percent_decoded;
use homebody_log::{LogError, Url};
use std::fs;
use std::path::{Path, PathBuf};

/// The environment variable that may hold the password.
const PASSWORD: &str = "HOMEBODY_MQTT_PASSWORD";

/// The prefix of topics if the URL names none.
const USUAL_PREFIX: &str = "homebody";

/// Seconds that Home Assistant waits until a motion sensor that only sends ON is clear again (our choice): longer than
/// the 6 to 8 s after which such a sensor repeats it.
const OFF_DELAY_S: u32 = 10;

/// Largest number of levels of a prefix, and largest length of a level (our choice).
const MOST_LEVELS: usize = 8;
const LONGEST_LEVEL: usize = 64;

/// The form of messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// As Home Assistant's discovery has them.
    HomeAssistant,
    /// As Zigbee2MQTT sends them.
    Zigbee2Mqtt,
    /// One topic a sensor, what it says as JSON.
    Plain,
}

/// The messages that describe the devices to Home Assistant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Discovery {
    /// One message for each device, with all of its entities.
    Device,
    /// One message for each entity, for Home Assistant before 2024.11.
    Entity,
    Off,
}

#[derive(Clone, Debug, PartialEq)]
pub struct BrokerAddress {
    pub tls: bool,
    pub host: String,
    /// By default 1883, or 8883 over TLS.
    pub port: u16,
    /// None for a broker without logins.
    pub user: Option<String>,
    /// Below which all topics are: levels of letters, digits, `_` and `-`.
    pub prefix: String,
    pub style: Style,
    pub discovery: Discovery,
    /// The prefix below which Home Assistant listens for discovery.
    pub discovery_prefix: String,
    /// After how many seconds a motion sensor that only says ON is clear again.
    pub off_delay_s: u32,
    /// Whether a run may be faster than real time.
    pub allow_fast: bool,
    /// Whether the user wants a broker on the internet that asks for no name.
    pub public: bool,
    /// The certificates that are trusted, instead of those of the system.
    pub ca: Option<PathBuf>,
    pub password_file: Option<PathBuf>,
}

impl BrokerAddress {
    /// Reads the address from a URL.
    ///
    /// # Errors
    ///
    /// [`LogError::BadUrl`] with all problems. No error has a password in it.
    pub fn from_url(url: &Url) -> Result<BrokerAddress, LogError> {
        BrokerAddress::read(url).map_err(LogError::BadUrl)
    }

    pub fn is_broker(url: &Url) -> bool {
        matches!(url.scheme(), Scheme::Mqtt | Scheme::Mqtts)
    }

    /// Refuses a run that goes faster than life, unless the place allows it.
    ///
    /// # Errors
    ///
    /// [`LogError::BadUrl`], which says how to run in real time, and how to allow more.
    pub fn may_go_fast(&self) -> Result<(), LogError> {
        if self.allow_fast {
            return Ok(());
        }
        Err(wrong(AddressMessage::TooFast { place: self.place() }))
    }

    /// The broker and the prefix, as errors tell them: without a name, and so without a password.
    pub fn place(&self) -> String {
        let scheme = if self.tls { "mqtts" } else { "mqtt" };
        let host = if self.host.contains(':') { format!("[{}]", self.host) } else { self.host.clone() };
        format!("{scheme}://{host}:{}/{}", self.port, self.prefix)
    }

    /// The password: of the file, or of the environment.
    pub(crate) fn password(&self) -> Result<Option<String>, LogError> {
        let Some(file) = &self.password_file else {
            return Ok(self.user.as_ref().and_then(|_| std::env::var(PASSWORD).ok()));
        };
        only_its_owner_reads(file)?;
        let text = fs::read_to_string(file).map_err(|error| unreadable(file, &error))?;
        Ok(Some(text.lines().next().unwrap_or_default().to_owned()))
    }

    fn read(url: &Url) -> Result<BrokerAddress, Problems> {
        let text = url.path().to_string_lossy();
        let (at, query) = text.split_once('?').map_or((&*text, ""), |(at, query)| (at, query));
        let (server, prefix) = at.split_once('/').unwrap_or((at, ""));
        let mut reader = AddressReader::default();
        let tls = url.scheme() == Scheme::Mqtts;
        let (user, host) = match server.rsplit_once('@') {
            Some((user, host)) => (Some(reader.user(user)), host),
            None => (None, server),
        };
        let (host, port) = reader.host(host, if tls { 8883 } else { 1883 });
        let prefix = match prefix.trim_end_matches('/') {
            "" => USUAL_PREFIX.to_owned(),
            prefix => reader.levels("the prefix", prefix),
        };
        let mut address = BrokerAddress {
            tls,
            host,
            port,
            user,
            prefix,
            style: Style::HomeAssistant,
            discovery: Discovery::Off,
            discovery_prefix: "homeassistant".into(),
            off_delay_s: OFF_DELAY_S,
            allow_fast: false,
            public: false,
            ca: None,
            password_file: None,
        };
        let mut discovery = None;
        for said in query.split('&').filter(|said| !said.is_empty()) {
            let (key, value) = said.split_once('=').unwrap_or((said, ""));
            let value = &reader.plain(key, value);
            match key {
                "style" => address.style = reader.word(key, value, STYLES).unwrap_or(address.style),
                "discovery" => discovery = reader.word(key, value, DISCOVERIES).or(discovery),
                "discovery-prefix" => address.discovery_prefix = reader.levels(key, value),
                "off-delay" => reader.seconds(&mut address.off_delay_s, value),
                "allow-fast" => reader.truth(&mut address.allow_fast, key, value),
                "public" => reader.truth(&mut address.public, key, value),
                "ca" => address.ca = reader.file(key, value),
                "password-file" => address.password_file = reader.file(key, value),
                key => reader.unknown(key),
            }
        }
        let usual = if address.style == Style::HomeAssistant { Discovery::Device } else { Discovery::Off };
        address.discovery = discovery.unwrap_or(usual);
        reader.together(&address);
        reader.0.refuse().map(|()| address)
    }
}

/// The keys after the question mark.
const KEYS: [&str; 8] =
    ["style", "discovery", "discovery-prefix", "off-delay", "allow-fast", "public", "ca", "password-file"];

/// The words of URLs for styles.
const STYLES: [(&str, Style); 3] =
    [("homeassistant", Style::HomeAssistant), ("zigbee2mqtt", Style::Zigbee2Mqtt), ("plain", Style::Plain)];

/// The words of URLs for discovery.
const DISCOVERIES: [(&str, Discovery); 3] =
    [("device", Discovery::Device), ("entity", Discovery::Entity), ("off", Discovery::Off)];

impl Style {
    pub fn name(self) -> &'static str {
        STYLES.iter().find(|(_, style)| *style == self).map_or("", |(name, _)| name)
    }
}

/// Reads the parts of a URL, with all of their problems.
#[derive(Default)]
struct AddressReader(UrlProblems);

impl AddressReader {
    /// The name before the `@`. No error repeats a password there.
    fn user(&mut self, text: &str) -> String {
        let (user, password) = text.split_once(':').map_or((text, None), |(user, password)| (user, Some(password)));
        if password.is_some() {
            self.0.add(AddressMessage::Password);
        }
        self.plain("the user", user)
    }

    fn host(&mut self, text: &str, usual: u16) -> (String, u16) {
        let (host, port) = match text.strip_prefix('[').and_then(|text| text.split_once(']')) {
            Some((host, rest)) => (host, rest.strip_prefix(':')),
            None => text.rsplit_once(':').map_or((text, None), |(host, port)| (host, Some(port))),
        };
        if host.is_empty() || host.contains(|letter: char| letter.is_whitespace() || letter.is_control()) {
            self.0.add(AddressMessage::NoHost);
        }
        match port.map(|port| port.parse::<u16>().map_err(|_| port)) {
            Some(Ok(port)) if port > 0 => (host.to_owned(), port),
            Some(_) => {
                self.0.add(AddressMessage::Port { usual });
                (host.to_owned(), usual)
            }
            None => (host.to_owned(), usual),
        }
    }

    fn levels(&mut self, what: &str, text: &str) -> String {
        let levels: Vec<&str> = text.split('/').collect();
        let fits = |level: &&str| is_level(level) && level.len() <= LONGEST_LEVEL;
        if levels.len() > MOST_LEVELS || !levels.iter().all(fits) {
            self.0.add(AddressMessage::Topic {
                name: what.into(),
                text: text.into(),
                most_levels: MOST_LEVELS,
                longest_level: LONGEST_LEVEL,
            });
        }
        text.to_owned()
    }

    /// A text with its `%20` decoded.
    fn plain(&mut self, what: &str, text: &str) -> String {
        let Some(bytes) = percent_decoded(text) else {
            self.0.add(AddressMessage::Percent { name: what.into() });
            return text.to_owned();
        };
        String::from_utf8_lossy(&bytes).into_owned()
    }

    /// The meaning of a word; an unknown one is a problem.
    fn word<T: Copy>(&mut self, key: &str, value: &str, words: [(&str, T); 3]) -> Option<T> {
        let found = words.iter().find(|(word, _)| *word == value).map(|(_, meaning)| *meaning);
        if found.is_none() {
            let [(first, _), (second, _), (third, _)] = words;
            let known = format!("{first}, {second} or {third}");
            self.0.add(AddressMessage::Word { name: key.into(), value: value.into(), known });
        }
        found
    }

    fn truth(&mut self, to: &mut bool, key: &str, value: &str) {
        match value {
            "true" => *to = true,
            "false" => *to = false,
            _ => self.0.add(AddressMessage::NotBoolean { name: key.into(), value: value.into() }),
        }
    }

    fn seconds(&mut self, to: &mut u32, value: &str) {
        match value.parse() {
            Ok(seconds) if (1..=3600).contains(&seconds) => *to = seconds,
            _ => self.0.add(AddressMessage::OffDelay { value: value.into() }),
        }
    }

    fn file(&mut self, key: &str, value: &str) -> Option<PathBuf> {
        if value.is_empty() {
            self.0.add(AddressMessage::NoFile { name: key.into() });
        }
        Some(value.into())
    }

    fn unknown(&mut self, key: &str) {
        self.0.add(AddressMessage::Unknown { name: key.into(), known: KEYS.to_vec() });
    }

    /// Adds the problems of values that do not fit together.
    fn together(&mut self, address: &BrokerAddress) {
        if address.ca.is_some() && !address.tls {
            self.0.add(AddressMessage::CaWithoutTls);
        }
        if address.password_file.is_some() && address.user.is_none() {
            self.0.add(AddressMessage::NoUser);
        }
        if address.style == Style::Plain && address.discovery != Discovery::Off {
            self.0.add(AddressMessage::PlainDiscovery);
        }
        let (prefix, found) = (&address.prefix, &address.discovery_prefix);
        if prefix == found || prefix.starts_with(&format!("{found}/")) {
            self.0.add(AddressMessage::DiscoveryPrefix { prefix: prefix.clone() });
        }
    }
}

/// Refuses a password that others can read.
fn only_its_owner_reads(file: &Path) -> Result<(), LogError> {
    let about = fs::metadata(file).map_err(|error| unreadable(file, &error))?;
    match others_may_read(&about) {
        false => Ok(()),
        true => Err(wrong(AddressMessage::OpenPassword { file: file.display().to_string() })),
    }
}

fn unreadable(file: &Path, error: &std::io::Error) -> LogError {
    wrong(AddressMessage::PasswordFile { file: file.display().to_string(), reason: error.to_string() })
}

fn wrong(message: AddressMessage) -> LogError {
    LogError::BadUrl(Problems(vec![message.into()]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<BrokerAddress, String> {
        let (name, at) = text.split_once("://").unwrap();
        let scheme = if name == "mqtts" { Scheme::Mqtts } else { Scheme::Mqtt };
        // One that people name is looked at before.
        BrokerAddress::from_url(&Url::new(scheme, at)).map_err(|error| error.to_string())
    }

    #[test]
    fn a_place_says_all_there_is_to_say() {
        let usual = read("mqtt://broker").unwrap();
        assert_eq!((usual.port, usual.prefix.as_str(), usual.style), (1883, "homebody", Style::HomeAssistant));
        assert_eq!((usual.discovery, usual.off_delay_s, usual.allow_fast), (Discovery::Device, 10, false));
        let text = "mqtts://ann%40home@[::1]:99/care/north?style=zigbee2mqtt&discovery=entity&off-delay=90&allow-fast=true\
                    &ca=my%20ca.pem&password-file=secret&discovery-prefix=ha";
        let all = read(text).unwrap();
        assert_eq!((all.tls, all.host.as_str(), all.port, all.user.as_deref()), (true, "::1", 99, Some("ann@home")));
        assert_eq!(
            (all.prefix.as_str(), all.style, all.discovery),
            ("care/north", Style::Zigbee2Mqtt, Discovery::Entity)
        );
        assert_eq!((all.off_delay_s, all.allow_fast, all.discovery_prefix.as_str()), (90, true, "ha"));
        assert_eq!(all.ca.as_deref(), Some(Path::new("my ca.pem")));
        assert_eq!(all.place(), "mqtts://[::1]:99/care/north");
        assert_eq!(read("mqtt://broker?style=plain").unwrap().discovery, Discovery::Off);
    }

    #[test]
    fn counts_problems_of_a_long_url() {
        let error = read(&format!("mqtt://broker?{}", "what=1&".repeat(100_000))).unwrap_err();
        assert!(error.len() < 20_000 && error.contains("there are 99980 more problems"), "{} bytes", error.len());
    }

    #[test]
    fn reports_all_problems_at_once_and_no_password() {
        let error = read("mqtt://ann:hunter2@:0/a//b/+/%23?style=esphome&discovery=all&allow-fast=yes&speed=2&ca=x")
            .unwrap_err();
        for told in [
            "password-file",
            PASSWORD,
            "has no host",
            "not a number from 1 to 65535",
            "is not a valid topic",
            "homeassistant, zigbee2mqtt or plain",
            "device, entity or off",
            "neither true nor false",
            "\"speed\"",
            "write mqtts://",
        ] {
            assert!(error.contains(told), "{told}: {error}");
        }
        assert!(!error.contains("hunter2"), "{error}");
        assert!(read("mqtt://broker/homeassistant").unwrap_err().contains("name another prefix"));
        assert!(read("mqtt://broker/$SYS").is_err() && read("mqtt://broker/a%2fb").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_password_that_others_can_read_is_refused() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("secret");
        fs::write(&file, "hunter2\n").unwrap();
        let address = read(&format!("mqtt://ann@broker?password-file={}", file.display())).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o644)).unwrap();
        let error = address.password().unwrap_err().to_string();
        assert!(error.contains("chmod 600") && !error.contains("hunter2"), "{error}");
        fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
        assert_eq!(address.password().unwrap().as_deref(), Some("hunter2"));
    }
}
