//! Encryption and trusted certificates of a connection, as in `sslmode` and `sslrootcert`.

use crate::messages::ServerMessage;
use crate::server::{Server, Tls};
use crate::trouble::wrong;
use homebody_log::LogError;
use rustls::client::WebPkiServerVerifier;
use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
use rustls::crypto::{CryptoProvider, ring, verify_tls12_signature, verify_tls13_signature};
use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, ServerName, UnixTime};
use rustls::{CertificateError, ClientConfig, DigitallySignedStruct, Error, RootCertStore, SignatureScheme};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tokio_postgres::config::SslMode;
use tokio_postgres_rustls::MakeRustlsConnect;

/// The value of `sslrootcert` for the certificates that the system trusts.
const SYSTEM: &str = "system";

pub(crate) fn mode(tls: Tls) -> SslMode {
    match tls {
        Tls::Disable => SslMode::Disable,
        Tls::Prefer => SslMode::Prefer,
        Tls::Require | Tls::VerifyCa | Tls::VerifyFull => SslMode::Require,
    }
}

pub(crate) fn connector(server: &Server) -> Result<MakeRustlsConnect, LogError> {
    let provider = Arc::new(ring::default_provider());
    let said = server.root_certificates.clone().or_else(usual_file);
    let judges = match server.tls {
        Tls::Disable | Tls::Prefer => None,
        // As libpq has it: a file of trusted certificates is heeded where there is one.
        Tls::Require => said.filter(|file| file != Path::new(SYSTEM)).map(|file| (Some(file), Tls::VerifyCa)),
        Tls::VerifyCa | Tls::VerifyFull => Some((said.filter(|file| file != Path::new(SYSTEM)), server.tls)),
    };
    let judge = match judges {
        None => ServerCertificateCheck { trusted: None, provider: provider.clone(), asks_name: false },
        Some((file, tls)) => {
            let roots = Arc::new(roots(server, file.as_deref())?);
            let trusted = WebPkiServerVerifier::builder_with_provider(roots, provider.clone()).build();
            let trusted =
                trusted.map_err(|error| wrong(server, ServerMessage::BadCertificates { reason: error.to_string() }))?;
            ServerCertificateCheck {
                trusted: Some(trusted),
                provider: provider.clone(),
                asks_name: tls == Tls::VerifyFull,
            }
        }
    };
    let config = ClientConfig::builder_with_provider(provider).with_safe_default_protocol_versions();
    let config = config.map_err(|error| wrong(server, ServerMessage::NoTls { reason: error.to_string() }))?;
    let config = config.dangerous().with_custom_certificate_verifier(Arc::new(judge)).with_no_client_auth();
    Ok(MakeRustlsConnect::new(config))
}

/// The file that users of libpq have.
fn usual_file() -> Option<PathBuf> {
    let file = Path::new(&std::env::var_os("HOME")?).join(".postgresql/root.crt");
    file.is_file().then_some(file)
}

/// The trusted certificates: those of a file, else those of the system.
fn roots(server: &Server, file: Option<&Path>) -> Result<RootCertStore, LogError> {
    let mut roots = RootCertStore::empty();
    let Some(file) = file else {
        roots.add_parsable_certificates(rustls_native_certs::load_native_certs().certs);
        return match roots.is_empty() {
            true => Err(wrong(server, ServerMessage::NoSystemCertificates)),
            false => Ok(roots),
        };
    };
    let told =
        |reason: String| wrong(server, ServerMessage::NoCertificates { file: file.display().to_string(), reason });
    for certificate in CertificateDer::pem_file_iter(file).map_err(|error| told(error.to_string()))? {
        let certificate = certificate.map_err(|error| told(error.to_string()))?;
        roots.add(certificate).map_err(|error| told(error.to_string()))?;
    }
    if roots.is_empty() { Err(told("the file is empty".into())) } else { Ok(roots) }
}

#[derive(Debug)]
struct ServerCertificateCheck {
    /// None where whose certificate it is is not asked.
    trusted: Option<Arc<WebPkiServerVerifier>>,
    provider: Arc<CryptoProvider>,
    asks_name: bool,
}

impl ServerCertVerifier for ServerCertificateCheck {
    fn verify_server_cert(
        &self,
        end_entity: &CertificateDer<'_>,
        intermediates: &[CertificateDer<'_>],
        server_name: &ServerName<'_>,
        ocsp_response: &[u8],
        now: UnixTime,
    ) -> Result<ServerCertVerified, Error> {
        let Some(trusted) = &self.trusted else { return Ok(ServerCertVerified::assertion()) };
        match trusted.verify_server_cert(end_entity, intermediates, server_name, ocsp_response, now) {
            // The name is looked at last: all else is as it should be.
            Err(Error::InvalidCertificate(
                CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. },
            )) if !self.asks_name => Ok(ServerCertVerified::assertion()),
            judged => judged,
        }
    }

    fn verify_tls12_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        verify_tls12_signature(message, certificate, signed, &self.provider.signature_verification_algorithms)
    }

    fn verify_tls13_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        verify_tls13_signature(message, certificate, signed, &self.provider.signature_verification_algorithms)
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        self.provider.signature_verification_algorithms.supported_schemes()
    }
}
