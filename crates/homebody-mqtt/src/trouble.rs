//! What can go wrong with a broker, in words that say what to do.

use homebody_core::problem::readable;
use homebody_log::LogError;
use rumqttc::tokio_rustls::rustls;
use rumqttc::{ConnectReturnCode, ConnectionError, DisconnectReasonCode, StateError};
use rustls::CertificateError;
use std::error::Error;
use std::io;
use std::time::Duration;

/// What went wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Trouble {
    /// As a part of a sentence.
    pub what: String,
    pub hint: Option<String>,
    /// Whether to try again is of no use.
    pub is_final: bool,
}

impl Trouble {
    pub fn new(what: impl Into<String>, hint: impl Into<String>) -> Trouble {
        Trouble { what: readable(what.into()), hint: Some(hint.into()), is_final: false }
    }

    pub fn finally(self) -> Trouble {
        Trouble { is_final: true, ..self }
    }

    pub fn ended() -> Trouble {
        Trouble { what: "the connection has ended".into(), hint: None, is_final: true }
    }

    /// Another run of the same home.
    pub fn another() -> Trouble {
        Trouble::new(
            "another program has begun to live this home below this prefix",
            "live one run of a home at a time, or give each a prefix of its own",
        )
        .finally()
    }

    /// A broker that does not acknowledge anything.
    pub fn silent(since: Duration) -> Trouble {
        let what = format!("the broker has acknowledged nothing for {:.0} s", since.as_secs_f64());
        Trouble::new(what, "look whether it is overloaded, or its disk full")
    }

    /// As an error of the destination.
    pub fn error(self, place: &str) -> LogError {
        let error = LogError::Destination {
            place: place.into(),
            what: self.what,
            hint: self.hint,
            passes: false,
            source: None,
        };
        if self.is_final { error } else { error.passing() }
    }

    /// What an error of the connection means.
    pub fn of(error: &ConnectionError) -> Trouble {
        if let Some(tls) = cause::<rustls::Error>(error) {
            return of_tls(tls);
        }
        match error {
            ConnectionError::ConnectionRefused(code)
            | ConnectionError::MqttState(StateError::ConnFail { reason: code }) => refused(*code),
            ConnectionError::MqttState(StateError::ServerDisconnect { reason_code, .. }) => sent_away(*reason_code),
            ConnectionError::Tls(error) => {
                let hint = match cause::<io::Error>(error) {
                    // Whoever does not speak TLS hangs up, or says something else.
                    Some(_) => "mqtt:// speaks without TLS, often on port 1883",
                    None => "?ca=FILE names the certificates to trust",
                };
                Trouble::new(format!("TLS does not come about: {error}"), hint).finally()
            }
            ConnectionError::MqttState(StateError::ConnectionAborted) => closed(),
            // What came instead of an answer is told with it.
            ConnectionError::MqttState(StateError::Deserialization(why))
                if why.to_string().contains("reset by peer") =>
            {
                closed()
            }
            ConnectionError::Timeout(_) => Trouble::new(
                "the broker does not answer",
                "check the host and the port, and whether a firewall is between",
            ),
            error => match cause::<io::Error>(error) {
                Some(cause) => of_io(cause),
                None => Trouble::new(format!("the connection was lost: {error}"), "the broker's own log says more"),
            },
        }
    }
}

fn refused(code: ConnectReturnCode) -> Trouble {
    use ConnectReturnCode::*;
    match code {
        BadUserNamePassword | NotAuthorized | BadAuthenticationMethod | Banned => Trouble::new(
            "the broker lets this user not in: name or password is wrong, or missing",
            "write mqtt://USER@HOST/PREFIX, with the password in ?password-file=FILE or HOMEBODY_MQTT_PASSWORD",
        )
        .finally(),
        RefusedProtocolVersion | UnsupportedProtocolVersion => {
            Trouble::new("the broker does not speak MQTT 5", "a newer one does, such as mosquitto from 1.6 on")
                .finally()
        }
        code => Trouble::new(format!("the broker takes no connection: {code:?}"), "the broker's own log says more"),
    }
}

fn sent_away(code: DisconnectReasonCode) -> Trouble {
    match code {
        DisconnectReasonCode::NotAuthorized => {
            Trouble::new("the broker does not let this user write here", "look at its list of rights").finally()
        }
        code => {
            Trouble::new(format!("the broker has ended the connection: {code:?}"), "the broker's own log says more")
        }
    }
}

fn of_tls(error: &rustls::Error) -> Trouble {
    let certificate = |what: &str, hint: &str| Trouble::new(what, hint).finally();
    match error {
        rustls::Error::InvalidCertificate(why) => match why {
            CertificateError::Expired | CertificateError::ExpiredContext { .. } => certificate(
                "the certificate of the broker has expired",
                "renew it, or set this machine's clock if that is wrong",
            ),
            CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => certificate(
                "the certificate of the broker is not valid yet",
                "look whether this machine's clock is right",
            ),
            CertificateError::UnknownIssuer | CertificateError::BadSignature => certificate(
                "the certificate of the broker is of nobody that is trusted",
                "?ca=FILE names the certificate of who has issued it",
            ),
            CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. } => certificate(
                "the certificate of the broker is for another name",
                "write the host as the certificate has it",
            ),
            why => certificate(
                &format!("the certificate of the broker is not good: {why:?}"),
                "?ca=FILE names what is trusted",
            ),
        },
        error => {
            Trouble::new(format!("TLS does not come about: {error}"), "mqtt:// speaks without TLS, often on port 1883")
                .finally()
        }
    }
}

fn closed() -> Trouble {
    let hint = "the broker's own log says why; one with TLS listens on a port of its own, for mqtts://";
    Trouble::new("the broker has closed the connection", hint)
}

fn of_io(error: &io::Error) -> Trouble {
    use io::ErrorKind::*;
    match error.kind() {
        ConnectionRefused => Trouble::new("no broker listens there", "start the broker, or correct host and port"),
        HostUnreachable | NetworkUnreachable => {
            Trouble::new("the host cannot be reached", "check the host and the network")
        }
        UnexpectedEof | ConnectionReset | ConnectionAborted | BrokenPipe => closed(),
        _ if error.to_string().contains("lookup") => {
            Trouble::new(format!("the host is not known: {error}"), "correct the name of the host")
        }
        _ => Trouble::new(error.to_string(), "check host and port"),
    }
}

/// The cause of this kind that an error comes of.
fn cause<'e, T: Error + 'static>(error: &'e (dyn Error + 'static)) -> Option<&'e T> {
    let mut at = Some(error);
    while let Some(error) = at {
        if let Some(found) = error.downcast_ref() {
            return Some(found);
        }
        let inner = error.downcast_ref::<io::Error>().and_then(|error| error.get_ref());
        at = match inner {
            // What an error of the system wraps is not among its sources.
            Some(inner) => Some(inner as &(dyn Error + 'static)),
            None => error.source(),
        };
    }
    None
}
