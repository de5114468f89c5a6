//! Problems with a broker are reported at once, with a hint.

use crate::servers::broker::{Broker, firings, free_port, is_installed, live, logger};
use homebody_core::event::Firing;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::Span;
use homebody_log::examine::CheckOptions;
use homebody_log::{LogError, Logger, Url, WriteMode};
use homebody_mqtt::MqttSink;
use rcgen::{BasicConstraints, CertificateParams, DnType, IsCa, Issuer, KeyPair, date_time_ymd};
use std::fs;
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

fn error(url: &Url) -> String {
    match logger(MqttSink::in_real_time(url), WriteMode::Create) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("{url} is refused"),
    }
}

#[test]
fn a_broker_that_is_away_is_an_error_within_five_seconds() {
    let begun = Instant::now();
    let refused =
        |url: &str| logger(MqttSink::in_real_time(&url.parse().unwrap()), WriteMode::Create).err().unwrap().code();
    assert_eq!(refused(&format!("mqtt://127.0.0.1:{}/homebody", free_port())), "mqtt::no-broker");
    // One that takes the connection and says nothing.
    let silent = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = silent.local_addr().unwrap().port();
    let code = refused(&format!("mqtt://127.0.0.1:{port}/homebody"));
    assert!(["mqtt::no-answer", "log::no-answer"].contains(&code), "{code}");
    assert!(begun.elapsed() < Duration::from_secs(10), "5 s each, took {:?}", begun.elapsed());
    let said = error(&"mqtt://no-such-host.invalid/homebody".parse().unwrap());
    assert!(said.contains("host"), "{said}");
}

#[test]
fn reads_a_password_file_and_never_repeats_a_wrong_password() {
    if !is_installed() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let users = folder.path().join("users");
    let made = Command::new("mosquitto_passwd").arg("-b").arg("-c").arg(&users).args(["ann", "hunter2"]).status();
    assert!(made.unwrap().success());
    let broker = Broker::with(&format!("allow_anonymous false\npassword_file {}\n", users.display())).unwrap();
    let with = |name: &str, password: &str| -> Url {
        let file = folder.path().join(format!("{name}-{password}"));
        fs::write(&file, password).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
        let text = format!("mqtt://{name}@127.0.0.1:{}/homebody?password-file={}", broker.port, file.display());
        text.parse().unwrap()
    };
    live(&with("ann", "hunter2"), 20);
    for wrong in [with("ann", "hunter3"), with("bob", "hunter2"), broker.url("homebody")] {
        let said = error(&wrong);
        assert!(said.contains("rejects this user") && !said.contains("hunter"), "{said}");
    }
    let at = format!("ann:hunter2@127.0.0.1:{}/homebody", broker.port);
    assert!(!format!("mqtt://{at}").parse::<Url>().unwrap_err().to_string().contains("hunter2"));
    let written = Url::new(Scheme::Mqtt, at);
    let refused = logger(MqttSink::in_real_time(&written), WriteMode::Create).err().unwrap();
    assert!(matches!(refused, LogError::BadUrl(_)), "exit code 2");
    assert!(!refused.to_string().contains("hunter2") && refused.to_string().contains("password-file"));
}

/// A certificate of an issuer made here, for 127.0.0.1, until this year.
fn certificate(folder: &Path, name: &str, until: i32) {
    let issuer_key = KeyPair::generate().unwrap();
    let mut of_issuer = CertificateParams::new(Vec::<String>::new()).unwrap();
    of_issuer.distinguished_name.push(DnType::CommonName, format!("{name} issuer"));
    of_issuer.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    fs::write(folder.join(format!("{name}-ca.pem")), of_issuer.self_signed(&issuer_key).unwrap().pem()).unwrap();
    let issuer = Issuer::new(of_issuer, issuer_key);
    let key = KeyPair::generate().unwrap();
    let mut params = CertificateParams::new(vec!["127.0.0.1".to_owned(), "localhost".to_owned()]).unwrap();
    params.not_before = date_time_ymd(2001, 1, 1);
    params.not_after = date_time_ymd(until, 1, 1);
    fs::write(folder.join(format!("{name}.pem")), params.signed_by(&key, &issuer).unwrap().pem()).unwrap();
    fs::write(folder.join(format!("{name}.key")), key.serialize_pem()).unwrap();
}

#[test]
fn tls_trusts_named_certificates_and_explains_refusals() {
    let folder = tempfile::tempdir().unwrap();
    certificate(folder.path(), "good", 2100);
    certificate(folder.path(), "old", 2020);
    let ca = |name: &str| folder.path().join(format!("{name}-ca.pem"));
    let lines = |name: &str| {
        let path = folder.path().join(name);
        format!("allow_anonymous true\ncertfile {0}.pem\nkeyfile {0}.key\n", path.display())
    };
    let Some(good) = Broker::with(&lines("good")) else { return };
    let old = Broker::with(&lines("old")).unwrap();
    let url = |broker: &Broker, ca: Option<&Path>| -> Url {
        let ca = ca.map(|ca| format!("?ca={}", ca.display())).unwrap_or_default();
        format!("mqtts://127.0.0.1:{}/homebody{ca}", broker.port).parse().unwrap()
    };
    live(&url(&good, Some(&ca("good"))), 20);
    for (url, told) in [
        (url(&old, Some(&ca("old"))), "has expired"),
        (url(&good, None), "nothing on this machine trusts the issuer"),
        (url(&good, Some(&ca("old"))), "nothing on this machine trusts the issuer"),
        (url(&good, Some(Path::new("no-such-file.pem"))), "no-such-file.pem"),
        (good.url("homebody"), "closed the connection"),
    ] {
        let said = error(&url);
        assert!(said.contains(told), "{url}: {said}");
    }
    // The checks report the last day in spite of other problems.
    for (url, told) in [
        (url(&good, Some(&ca("good"))), "valid until 2100-01-01"),
        (url(&old, Some(&ca("old"))), "expired on 2020-01-01"),
        (url(&good, None), "nothing on this machine trusts the issuer"),
    ] {
        let asked = CheckOptions { mapping: &LoggerFile::default(), may_write: true };
        let checks = (homebody_mqtt::plugin().examine)(&url, &asked).unwrap();
        assert!(checks.iter().any(|check| check.says.contains(told)), "{url}: {checks:?}");
    }
    // The other way round: TLS to one that has none.
    let plain = Broker::start().unwrap();
    let said = error(&url(&plain, Some(&ca("good"))));
    assert!(said.contains("mqtt"), "{said}");
}

#[test]
fn a_broker_on_the_internet_that_asks_for_no_name_is_refused() {
    let said = error(&"mqtt://198.18.0.1/homebody".parse().unwrap());
    assert!(said.contains("on the internet") && said.contains("?public=true"), "{said}");
}

#[test]
fn a_second_run_of_the_same_home_sends_the_first_away_for_good() {
    let Some(broker) = Broker::start() else { return };
    let mut first = logger(MqttSink::in_real_time(&broker.url("homebody")), WriteMode::Create).unwrap();
    let second = logger(MqttSink::in_real_time(&broker.url("homebody")), WriteMode::Create).unwrap();
    let failed = firings(500).chunks(1).find_map(|firing| {
        thread::sleep(Duration::from_millis(50));
        store_one(&mut first, firing).err()
    });
    let failed = failed.expect("the first is sent away").to_string();
    assert!(failed.contains("another program has begun"), "{failed}");
    second.finish().unwrap();
}

fn store_one(logger: &mut Logger, firing: &[Firing]) -> Result<(), LogError> {
    logger.store(firing, firing[0].at + Span::MICROSECOND)?;
    logger.make_durable()?;
    logger.wait_durable()
}
