//! Which broker, and how it is spoken to: `mqtt://user@host:1883/prefix?style=zigbee2mqtt`, with all that can be wrong with it.

use crate::messages::AddressMessage;
use crate::names::is_level;
use homebody_core::problem::{Diagnostic, Problems, readable};
use homebody_core::scenario::scheme::Scheme;
use homebody_log::files::plain::others_may_read;
use homebody_log::url::percent_decoded;
use homebody_log::{LogError, Url};
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// What the variable of the environment is called that a password may be in.
const PASSWORD: &str = "HOMEBODY_MQTT_PASSWORD";

/// Where topics are if nothing else is said.
const USUAL_PREFIX: &str = "homebody";

/// Seconds that Home Assistant waits until a motion sensor that only sends ON is clear again (our choice): longer than
/// the 6 to 8 s after which such a sensor repeats it.
const OFF_DELAY_S: u32 = 10;

/// Largest number of levels of a prefix, and largest length of a level (our choice).
const MOST_LEVELS: usize = 8;
const LONGEST_LEVEL: usize = 64;

/// How messages look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// As Home Assistant's discovery has them.
    HomeAssistant,
    /// As Zigbee2MQTT sends them.
    Zigbee2Mqtt,
    /// One topic a sensor, what it says as JSON.
    Plain,
}

/// How Home Assistant is told what there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Discovery {
    /// One message for each device, with all of its entities.
    Device,
    /// One message for each entity, for Home Assistant before 2024.11.
    Entity,
    /// Not at all.
    Off,
}

/// A broker, and how it is spoken to.
#[derive(Clone, Debug, PartialEq)]
pub struct Address {
    /// Whether it is over TLS.
    pub tls: bool,
    /// A name or an address.
    pub host: String,
    /// 1883 unless something else is said, 8883 over TLS.
    pub port: u16,
    /// None for a broker that lets anybody in.
    pub user: Option<String>,
    /// Below which all topics are: levels of letters, digits, `_` and `-`.
    pub prefix: String,
    /// How messages look.
    pub style: Style,
    /// How Home Assistant is told what there is.
    pub discovery: Discovery,
    /// Where Home Assistant listens for that.
    pub discovery_prefix: String,
    /// After how many seconds a motion sensor that only says ON is clear again.
    pub off_delay_s: u32,
    /// Whether a run may go faster than life.
    pub allow_fast: bool,
    /// Whether a broker on the internet is meant that asks for no name.
    pub public: bool,
    /// The certificates that are trusted, instead of those of the system.
    pub ca: Option<PathBuf>,
    /// The file with the password.
    pub password_file: Option<PathBuf>,
}

impl Address {
    /// What a place says.
    ///
    /// # Errors
    ///
    /// [`LogError::BadUrl`] with all problems. No error has a password in it.
    pub fn of(url: &Url) -> Result<Address, LogError> {
        Address::read(url).map_err(LogError::BadUrl)
    }

    /// Whether a place is a broker.
    pub fn is_of(url: &Url) -> bool {
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

    fn read(url: &Url) -> Result<Address, Problems> {
        let text = url.path().to_string_lossy();
        let (at, query) = text.split_once('?').map_or((&*text, ""), |(at, query)| (at, query));
        let (server, prefix) = at.split_once('/').unwrap_or((at, ""));
        let mut wrong = Wrong::default();
        let tls = url.scheme() == Scheme::Mqtts;
        let (user, host) = match server.rsplit_once('@') {
            Some((user, host)) => (Some(wrong.user(user)), host),
            None => (None, server),
        };
        let (host, port) = wrong.host(host, if tls { 8883 } else { 1883 });
        let prefix = match prefix.trim_end_matches('/') {
            "" => USUAL_PREFIX.to_owned(),
            prefix => wrong.levels("the prefix", prefix),
        };
        let mut address = Address {
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
            let value = &wrong.plain(key, value);
            match key {
                "style" => address.style = wrong.parsed(key, value).unwrap_or(address.style),
                "discovery" => discovery = wrong.parsed(key, value).or(discovery),
                "discovery-prefix" => address.discovery_prefix = wrong.levels(key, value),
                "off-delay" => wrong.seconds(&mut address.off_delay_s, value),
                "allow-fast" => wrong.truth(&mut address.allow_fast, key, value),
                "public" => wrong.truth(&mut address.public, key, value),
                "ca" => address.ca = wrong.file(key, value),
                "password-file" => address.password_file = wrong.file(key, value),
                key => wrong.unknown(key),
            }
        }
        let usual = if address.style == Style::HomeAssistant { Discovery::Device } else { Discovery::Off };
        address.discovery = discovery.unwrap_or(usual);
        wrong.together(&address);
        wrong.or(address)
    }
}

/// What may stand behind the question mark.
const KEYS: [&str; 8] =
    ["style", "discovery", "discovery-prefix", "off-delay", "allow-fast", "public", "ca", "password-file"];

impl FromStr for Style {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Style, &'static str> {
        match text {
            "homeassistant" => Ok(Style::HomeAssistant),
            "zigbee2mqtt" => Ok(Style::Zigbee2Mqtt),
            "plain" => Ok(Style::Plain),
            _ => Err("homeassistant, zigbee2mqtt or plain"),
        }
    }
}

impl Style {
    /// As it is written.
    pub fn name(self) -> &'static str {
        match self {
            Style::HomeAssistant => "homeassistant",
            Style::Zigbee2Mqtt => "zigbee2mqtt",
            Style::Plain => "plain",
        }
    }
}

impl FromStr for Discovery {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Discovery, &'static str> {
        match text {
            "device" => Ok(Discovery::Device),
            "entity" => Ok(Discovery::Entity),
            "off" => Ok(Discovery::Off),
            _ => Err("device, entity or off"),
        }
    }
}

/// All problems of a URL.
#[derive(Default)]
struct Wrong(Vec<Diagnostic>);

impl Wrong {
    fn add(&mut self, message: AddressMessage) {
        let message: Diagnostic = message.into();
        self.0.push(Diagnostic { what: readable(message.what), hint: message.hint.map(readable), ..message });
    }

    fn or(self, address: Address) -> Result<Address, Problems> {
        if self.0.is_empty() { Ok(address) } else { Err(Problems::of_url(&self.0)) }
    }

    /// The name before the `@`. A password there is not told again.
    fn user(&mut self, text: &str) -> String {
        let (user, password) = text.split_once(':').map_or((text, None), |(user, password)| (user, Some(password)));
        if password.is_some() {
            self.add(AddressMessage::Password);
        }
        self.plain("the user", user)
    }

    fn host(&mut self, text: &str, usual: u16) -> (String, u16) {
        let (host, port) = match text.strip_prefix('[').and_then(|text| text.split_once(']')) {
            Some((host, rest)) => (host, rest.strip_prefix(':')),
            None => text.rsplit_once(':').map_or((text, None), |(host, port)| (host, Some(port))),
        };
        if host.is_empty() || host.contains(|letter: char| letter.is_whitespace() || letter.is_control()) {
            self.add(AddressMessage::NoHost);
        }
        match port.map(|port| port.parse::<u16>().map_err(|_| port)) {
            Some(Ok(port)) if port > 0 => (host.to_owned(), port),
            Some(_) => {
                self.add(AddressMessage::Port { usual });
                (host.to_owned(), usual)
            }
            None => (host.to_owned(), usual),
        }
    }

    fn levels(&mut self, what: &str, text: &str) -> String {
        let levels: Vec<&str> = text.split('/').collect();
        let fits = |level: &&str| is_level(level) && level.len() <= LONGEST_LEVEL;
        if levels.len() > MOST_LEVELS || !levels.iter().all(fits) {
            self.add(AddressMessage::Topic {
                name: what.into(),
                text: text.into(),
                most_levels: MOST_LEVELS,
                longest_level: LONGEST_LEVEL,
            });
        }
        text.to_owned()
    }

    /// A text without the `%20` that stand for letters in places.
    fn plain(&mut self, what: &str, text: &str) -> String {
        let Some(bytes) = percent_decoded(text) else {
            self.add(AddressMessage::Percent { name: what.into() });
            return text.to_owned();
        };
        String::from_utf8_lossy(&bytes).into_owned()
    }

    /// What a word says, where it is one that is known.
    fn parsed<T: FromStr<Err = &'static str>>(&mut self, key: &str, value: &str) -> Option<T> {
        let known = |known: &'static str| {
            self.add(AddressMessage::Word { name: key.into(), value: value.into(), known });
        };
        value.parse().map_err(known).ok()
    }

    fn truth(&mut self, to: &mut bool, key: &str, value: &str) {
        match value {
            "true" => *to = true,
            "false" => *to = false,
            _ => self.add(AddressMessage::NotBoolean { name: key.into(), value: value.into() }),
        }
    }

    fn seconds(&mut self, to: &mut u32, value: &str) {
        match value.parse() {
            Ok(seconds) if (1..=3600).contains(&seconds) => *to = seconds,
            _ => self.add(AddressMessage::OffDelay { value: value.into() }),
        }
    }

    fn file(&mut self, key: &str, value: &str) -> Option<PathBuf> {
        if value.is_empty() {
            self.add(AddressMessage::NoFile { name: key.into() });
        }
        Some(value.into())
    }

    fn unknown(&mut self, key: &str) {
        self.add(AddressMessage::Unknown { name: key.into(), known: KEYS.to_vec() });
    }

    /// What is wrong with several things together.
    fn together(&mut self, address: &Address) {
        if address.ca.is_some() && !address.tls {
            self.add(AddressMessage::CaWithoutTls);
        }
        if address.password_file.is_some() && address.user.is_none() {
            self.add(AddressMessage::NoUser);
        }
        if address.style == Style::Plain && address.discovery != Discovery::Off {
            self.add(AddressMessage::PlainDiscovery);
        }
        let (prefix, found) = (&address.prefix, &address.discovery_prefix);
        if prefix == found || prefix.starts_with(&format!("{found}/")) {
            self.add(AddressMessage::DiscoveryPrefix { prefix: prefix.clone() });
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

    fn read(text: &str) -> Result<Address, String> {
        let (name, at) = text.split_once("://").unwrap();
        let scheme = if name == "mqtts" { Scheme::Mqtts } else { Scheme::Mqtt };
        // One that people name is looked at before.
        Address::of(&Url::new(scheme, at)).map_err(|error| error.to_string())
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
    fn all_that_is_wrong_is_told_at_once_and_a_password_never() {
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
