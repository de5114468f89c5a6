//! A connection is encrypted if the URL asks for it, and only to a trusted server.

use crate::stage::Server;
use crate::stage::life::Life;
use homebody_log::Policy;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Makes an authority, and its certificate for `localhost`; false without OpenSSL.
fn certificates(folder: &Path) -> bool {
    let openssl = |args: &str| {
        let mut command = Command::new("openssl");
        command.args(args.split(' ')).current_dir(folder).stdin(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    fs::write(folder.join("names"), "subjectAltName=DNS:localhost").unwrap();
    let new = "-newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes";
    let is_made = openssl(&format!("req -x509 {new} -keyout ca.key -out ca.crt -subj /CN=ours -days 9"))
        && openssl(&format!("req -x509 {new} -keyout other.key -out other.crt -subj /CN=others -days 9"))
        && openssl(&format!("req {new} -keyout server.key -out server.csr -subj /CN=localhost"))
        && openssl(
            "x509 -req -in server.csr -CA ca.crt -CAkey ca.key -CAcreateserial -extfile names -out server.crt -days 9",
        );
    if !is_made {
        println!("skipped: there is no OpenSSL to make certificates with");
    }
    is_made
}

#[test]
fn a_connection_is_as_secret_as_the_url_wants() {
    let folder = tempfile::tempdir().unwrap();
    if !certificates(folder.path()) {
        return;
    }
    let files = ["server.crt", "server.key"].map(|name| (name, fs::read(folder.path().join(name)).unwrap()));
    let port = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let settings = ["fsync=off", "listen_addresses=127.0.0.1", "ssl=on", "log_connections=on", "log_line_prefix="];
    let Some(server) = Server::start_at(port, &settings, &files) else { return };
    let [ours, others] = ["ca.crt", "other.crt"].map(|name| folder.path().join(name));
    let mut run = 0;
    let mut live = |host: &str, mode: &str, trusted: &Path| {
        run += 1;
        let trusted = trusted.display();
        let url = format!(
            "postgresql://postgres@{host}:{port}/postgres?sslmode={mode}&sslrootcert={trusted}&application_name=run{run}"
        );
        let lived = Life::new(run, 20).live(&url, None, Policy::default());
        let log = fs::read_to_string(server.folder().join("log")).unwrap();
        let is_secret = log
            .lines()
            .any(|line| line.ends_with(')') && line.contains(&format!("application_name=run{run} SSL enabled")));
        lived.map(|()| is_secret).map_err(|error| error.to_string())
    };
    let system = Path::new("system");
    assert_eq!(live("127.0.0.1", "disable", system), Ok(false));
    assert_eq!(live("127.0.0.1", "prefer", system), Ok(true));
    assert_eq!(live("127.0.0.1", "require", system), Ok(true));
    assert_eq!(live("localhost", "verify-full", &ours), Ok(true));
    assert_eq!(live("127.0.0.1", "verify-ca", &ours), Ok(true), "its name is not asked for");
    for (host, mode, trusted) in [
        ("127.0.0.1", "verify-full", &*ours),
        ("localhost", "verify-full", &*others),
        ("localhost", "verify-ca", &*others),
        ("localhost", "require", &*others),
        ("localhost", "verify-full", system),
    ] {
        let error = live(host, mode, trusted).unwrap_err();
        assert!(
            error.contains("cannot encrypt the connection") && error.contains("sslrootcert"),
            "{mode} {host}: {error}"
        );
    }
    let error = live("localhost", "verify-full", &folder.path().join("names")).unwrap_err();
    assert!(error.contains("has no certificates"), "{error}");
}
