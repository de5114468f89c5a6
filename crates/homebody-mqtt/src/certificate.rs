//! The last day of a broker's certificate.
//!
//! The connection is refused once the certificate has come, before any message. Only the part of the certificate that holds this day is
//! parsed (RFC 5280, section 4.1): a certificate is a sequence that begins with a sequence of version, number, algorithm, issuer and
//! validity.

use jiff::Timestamp;
use jiff::civil::DateTime;
use jiff::tz::TimeZone;
use rumqttc::tokio_rustls::rustls;
use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
use rustls::crypto::ring;
use rustls::pki_types::{CertificateDer, ServerName, UnixTime};
use rustls::{ClientConfig, ClientConnection, DigitallySignedStruct, Error, SignatureScheme};
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

/// Time that a broker may take for it (our choice).
const WITHIN: Duration = Duration::from_secs(4);

/// When the certificate of who listens there ends.
pub(crate) fn last_day(host: &str, port: u16) -> Result<Timestamp, String> {
    let no_answer = |error: &dyn std::fmt::Display| error.to_string();
    let mut addresses = (host, port).to_socket_addrs().map_err(|error| no_answer(&error))?;
    let address = addresses.next().ok_or("the host is not known")?;
    let mut stream = TcpStream::connect_timeout(&address, WITHIN).map_err(|error| no_answer(&error))?;
    stream
        .set_read_timeout(Some(WITHIN))
        .and_then(|()| stream.set_write_timeout(Some(WITHIN)))
        .map_err(|error| no_answer(&error))?;
    let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()));
    let config = config.with_safe_default_protocol_versions().map_err(|error| no_answer(&error))?;
    let looks = Arc::new(CertificateCapture::default());
    let config = config.dangerous().with_custom_certificate_verifier(looks.clone()).with_no_client_auth();
    let name = ServerName::try_from(host.to_owned()).map_err(|error| no_answer(&error))?;
    let mut connection = ClientConnection::new(Arc::new(config), name).map_err(|error| no_answer(&error))?;
    let refused = connection.complete_io(&mut stream);
    match (looks.0.get(), refused) {
        (Some(certificate), _) => ends(certificate).ok_or_else(|| "it is in no form that is known".into()),
        (None, Err(error)) => Err(no_answer(&error)),
        (None, Ok(_)) => Err("there is none".into()),
    }
}

fn ends(certificate: &[u8]) -> Option<Timestamp> {
    const SEQUENCE: u8 = 0x30;
    const VERSION: u8 = 0xa0;
    let (tag, whole, _) = part(certificate)?;
    let (inner_tag, inner, _) = part(whole)?;
    if (tag, inner_tag) != (SEQUENCE, SEQUENCE) {
        return None;
    }
    let mut rest = inner;
    if part(rest)?.0 == VERSION {
        rest = part(rest)?.2;
    }
    // Number, algorithm and issuer.
    for _ in 0..3 {
        rest = part(rest)?.2;
    }
    let (_, validity, _) = part(rest)?;
    let (kind, last, _) = part(part(validity)?.2)?;
    time(kind, last)
}

fn part(bytes: &[u8]) -> Option<(u8, &[u8], &[u8])> {
    let (&tag, rest) = bytes.split_first()?;
    let (&first, mut rest) = rest.split_first()?;
    let mut length = usize::from(first);
    if first & 0x80 != 0 {
        let (digits, after) = rest.split_at_checked(usize::from(first & 0x7f))?;
        if digits.len() > 4 {
            return None;
        }
        length = digits.iter().fold(0, |length, &digit| length << 8 | usize::from(digit));
        rest = after;
    }
    let (content, rest) = rest.split_at_checked(length)?;
    Some((tag, content, rest))
}

/// `YYMMDDHHMMSSZ` or `YYYYMMDDHHMMSSZ`.
fn time(kind: u8, text: &[u8]) -> Option<Timestamp> {
    const UTC_TIME: u8 = 0x17;
    let text = str::from_utf8(text).ok()?.strip_suffix('Z')?;
    let whole = match kind {
        UTC_TIME => {
            let year: u32 = text.get(..2)?.parse().ok()?;
            format!("{}{text}", if year < 50 { "20" } else { "19" })
        }
        _ => text.to_owned(),
    };
    let at = DateTime::strptime("%Y%m%d%H%M%S", whole).ok()?;
    at.to_zoned(TimeZone::UTC).ok().map(|at| at.timestamp())
}

/// Keeps the certificate of the server, and refuses it.
#[derive(Debug, Default)]
struct CertificateCapture(OnceLock<CertificateDer<'static>>);

fn has_seen() -> Error {
    Error::General("the certificate was only looked at".into())
}

impl ServerCertVerifier for CertificateCapture {
    fn verify_server_cert(
        &self,
        certificate: &CertificateDer<'_>,
        _: &[CertificateDer<'_>],
        _: &ServerName<'_>,
        _: &[u8],
        _: UnixTime,
    ) -> Result<ServerCertVerified, Error> {
        let _ = self.0.set(certificate.clone().into_owned());
        Err(has_seen())
    }

    fn verify_tls12_signature(
        &self,
        _: &[u8],
        _: &CertificateDer<'_>,
        _: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        Err(has_seen())
    }

    fn verify_tls13_signature(
        &self,
        _: &[u8],
        _: &CertificateDer<'_>,
        _: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        Err(has_seen())
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        ring::default_provider().signature_verification_algorithms.supported_schemes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_only_the_last_day() {
        let mut params = rcgen::CertificateParams::new(["localhost".to_owned()]).unwrap();
        params.not_after = rcgen::date_time_ymd(2027, 3, 4);
        let key = rcgen::KeyPair::generate().unwrap();
        let certificate = params.self_signed(&key).unwrap();
        let der = certificate.der();
        assert_eq!(ends(der).unwrap().to_string(), "2027-03-04T00:00:00Z");
        for length in 0..der.len() {
            assert!(ends(&der[..length]).is_none(), "cut after {length} bytes");
        }
        assert_eq!(time(0x18, b"20510102030405Z").unwrap().to_string(), "2051-01-02T03:04:05Z");
        assert_eq!((time(0x17, b"991332000000Z"), ends(&[0x30, 0x84, 255, 255, 255, 255])), (None, None));
    }
}
