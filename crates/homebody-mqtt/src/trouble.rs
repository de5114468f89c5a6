//! Errors of a broker, each with advice.

use crate::messages::BrokerMessage;
use homebody_core::problem::{Diagnostic, readable};
use homebody_log::LogError;
use rumqttc::tokio_rustls::rustls;
use rumqttc::{ConnectReturnCode, ConnectionError, DisconnectReasonCode, StateError};
use rustls::CertificateError;
use std::error::Error;
use std::io;
use std::time::Duration;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct BrokerError {
    pub message: Box<Diagnostic>,
    pub is_final: bool,
}

impl BrokerError {
    pub fn new(message: impl Into<Diagnostic>) -> BrokerError {
        let message: Diagnostic = message.into();
        let message = Diagnostic { what: readable(message.what), ..message };
        BrokerError { message: Box::new(message), is_final: false }
    }

    pub fn finally(self) -> BrokerError {
        BrokerError { is_final: true, ..self }
    }

    pub fn ended() -> BrokerError {
        BrokerError::new(BrokerMessage::Ended).finally()
    }

    pub fn another() -> BrokerError {
        BrokerError::new(BrokerMessage::AnotherRun).finally()
    }

    /// A broker that does not acknowledge anything.
    pub fn silent(since: Duration) -> BrokerError {
        BrokerError::new(BrokerMessage::Silent { seconds: since.as_secs_f64().round() as u64 })
    }

    pub fn error(self, place: &str) -> LogError {
        let error = LogError::destination(place, *self.message);
        if self.is_final { error } else { error.passing() }
    }

    pub fn from_connection(error: &ConnectionError) -> BrokerError {
        if let Some(tls) = cause::<rustls::Error>(error) {
            return of_tls(tls);
        }
        match error {
            ConnectionError::ConnectionRefused(code)
            | ConnectionError::MqttState(StateError::ConnFail { reason: code }) => refused(*code),
            ConnectionError::MqttState(StateError::ServerDisconnect { reason_code, .. }) => sent_away(*reason_code),
            ConnectionError::Tls(error) => {
                let reason = error.to_string();
                let message = match cause::<io::Error>(error) {
                    // A broker without TLS hangs up, or answers something else.
                    Some(_) => BrokerMessage::Tls { reason },
                    None => BrokerMessage::Untrusted { reason },
                };
                BrokerError::new(message).finally()
            }
            ConnectionError::MqttState(StateError::ConnectionAborted) => closed(),
            // The error has in it what came instead of an answer.
            ConnectionError::MqttState(StateError::Deserialization(why))
                if why.to_string().contains("reset by peer") =>
            {
                closed()
            }
            ConnectionError::Timeout(_) => BrokerError::new(BrokerMessage::NoAnswer),
            error => match cause::<io::Error>(error) {
                Some(cause) => of_io(cause),
                None => BrokerError::new(BrokerMessage::Lost { reason: error.to_string() }),
            },
        }
    }
}

fn refused(code: ConnectReturnCode) -> BrokerError {
    use ConnectReturnCode::*;
    match code {
        BadUserNamePassword | NotAuthorized | BadAuthenticationMethod | Banned => {
            BrokerError::new(BrokerMessage::Login).finally()
        }
        RefusedProtocolVersion | UnsupportedProtocolVersion => BrokerError::new(BrokerMessage::Version).finally(),
        code => BrokerError::new(BrokerMessage::Refused { code: format!("{code:?}") }),
    }
}

fn sent_away(code: DisconnectReasonCode) -> BrokerError {
    match code {
        DisconnectReasonCode::NotAuthorized => BrokerError::new(BrokerMessage::NotAuthorized).finally(),
        code => BrokerError::new(BrokerMessage::SentAway { code: format!("{code:?}") }),
    }
}

fn of_tls(error: &rustls::Error) -> BrokerError {
    let message = match error {
        rustls::Error::InvalidCertificate(why) => match why {
            CertificateError::Expired | CertificateError::ExpiredContext { .. } => BrokerMessage::Expired,
            CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => BrokerMessage::NotYetValid,
            CertificateError::UnknownIssuer | CertificateError::BadSignature => BrokerMessage::UnknownIssuer,
            CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. } => {
                BrokerMessage::OtherName
            }
            why => BrokerMessage::Certificate { reason: format!("{why:?}") },
        },
        error => BrokerMessage::Tls { reason: error.to_string() },
    };
    BrokerError::new(message).finally()
}

fn closed() -> BrokerError {
    BrokerError::new(BrokerMessage::Closed)
}

fn of_io(error: &io::Error) -> BrokerError {
    use io::ErrorKind::*;
    match error.kind() {
        ConnectionRefused => BrokerError::new(BrokerMessage::NoBroker),
        HostUnreachable | NetworkUnreachable => BrokerError::new(BrokerMessage::Unreachable),
        UnexpectedEof | ConnectionReset | ConnectionAborted | BrokenPipe => closed(),
        _ if error.to_string().contains("lookup") => {
            BrokerError::new(BrokerMessage::UnknownHost { reason: error.to_string() })
        }
        _ => BrokerError::new(BrokerMessage::Network { reason: error.to_string() }),
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
            // An error that a system error wraps is missing from its sources.
            Some(inner) => Some(inner as &(dyn Error + 'static)),
            None => error.source(),
        };
    }
    None
}
