//! Problems with a database are reported all at once, with a hint, and never with a password.

use crate::stage::Server;
use crate::stage::life::{Life, patient};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::{LogError, Policy, Sink, Url, WriteMode};
use homebody_postgres::Postgres;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::time::{Duration, Instant};

/// The password that must not appear.
const CANARY: &str = "s3cr3t-canary";

fn live(url: &str, how: WriteMode) -> Result<(), LogError> {
    Life { how, ..Life::new(1, 200) }.live(url, None, Policy::default())
}

/// The error of a life, which tells all of this.
fn refused(url: &str, how: WriteMode, told: &[&str]) -> LogError {
    let error = live(url, how).expect_err(url);
    let text = error.to_string();
    for told in told {
        assert!(text.contains(told), "{told:?} is told: {text}");
    }
    assert!(!format!("{text} {error:?}").contains(CANARY), "{text}");
    error
}

#[test]
fn a_missing_server_is_reported_soon_and_may_pass() {
    let closed = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let silent = closed.local_addr().unwrap().port();
    for (url, told) in [
        ("postgresql://ann@127.0.0.1:1/homes".to_owned(), ["no server answers", "start the server"]),
        (
            format!("postgresql://ann@127.0.0.1:{silent}/homes"),
            ["has not answered for", "rows that it has confirmed are safe"],
        ),
        ("postgresql://ann@/homes?host=/nowhere".to_owned(), ["no server answers", "start the server"]),
    ] {
        let began = Instant::now();
        let error = refused(&url, WriteMode::Create, &[told[0], told[1], &url]);
        assert!(error.passes() && began.elapsed() < Duration::from_secs(30), "{:?}", began.elapsed());
    }
}

#[test]
fn reports_a_wrong_login_without_the_password() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("doors");
    server.psql(&database, &format!("CREATE ROLE ann LOGIN PASSWORD '{CANARY}'; GRANT CREATE ON SCHEMA public TO ann"));
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pgpass");
    let with = |line: &str, mode: u32| {
        fs::write(&file, line).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(mode)).unwrap();
        server.url("ann", &database, &format!("&passfile={}", file.display()))
    };
    let right = format!("*:*:*:ann:{CANARY}");
    refused(
        &with(&right, 0o644),
        WriteMode::Create,
        &["wants a password", "is ignored: others may read it", "chmod 600"],
    );
    refused(&with("*:*:*:bob:x", 0o600), WriteMode::Create, &["wants a password", "~/.pgpass", "PGPASSWORD"]);
    refused(
        &with(&format!("*:*:*:ann:{CANARY}x"), 0o600),
        WriteMode::Create,
        &["password authentication failed", "~/.pgpass"],
    );
    live(&with(&right, 0o600), WriteMode::Create).unwrap();
    let open: Url = with(&right, 0o600).parse().unwrap();
    assert!(!format!("{open:?} {open}").contains(CANARY));
    refused(&server.url("nobody", &database, ""), WriteMode::Create, &["\"nobody\" does not exist"]);
    refused(
        &server.url("postgres", "nowhere", ""),
        WriteMode::Create,
        &["\"nowhere\" does not exist", "createdb nowhere"],
    );
    let url = format!("postgresql://ann:{CANARY}@host/homes");
    assert!(!url.parse::<Url>().unwrap_err().to_string().contains(CANARY));
    let own = Url::new(homebody_core::scenario::scheme::Scheme::Postgresql, format!("ann:{CANARY}@host/homes"));
    let calendar = homebody_core::calendar::Calendar::new("2009-03-02T00:00:00", "UTC").unwrap();
    let run = homebody_log::RunInfo::of_log("flat", calendar, &homebody_log::Log::default());
    let begin = homebody_log::Begin::new(run.into(), Vec::new(), Default::default(), WriteMode::Create);
    let error = Postgres::new(&own).begin(&begin).unwrap_err();
    assert!(error.to_string().contains("the URL has a password") && !format!("{error} {error:?}").contains(CANARY));
}

#[test]
fn reports_all_problems_of_unfit_tables() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("misfits");
    server.psql(
        &database,
        "CREATE TABLE firing (run_id bigint, seq bigint, fired_at timestamp, sensor integer, floor text NOT NULL)",
    );
    let url = server.url("postgres", &database, "");
    refused(
        &url,
        WriteMode::Create,
        &[
            "the column \"fired_at\" of \"firing\" is timestamp without time zone, and not timestamp with time zone",
            "the column \"sensor\" of \"firing\" is integer, and not text",
            "has no column \"value\"",
            "the column \"floor\" of \"firing\" needs a value",
            "has no key (run_id, seq)",
            "ALTER TABLE public.firing",
        ],
    );
    server.psql(&database, "DROP TABLE firing; CREATE VIEW firing AS SELECT 1 AS seq");
    refused(&url, WriteMode::Create, &["\"firing\" is not a table"]);
    let truth = Life::new(1, 20).live(
        &server.url("postgres", &database, "&schema=one"),
        Some(&server.url("postgres", &database, "&schema=one")),
        Policy::default(),
    );
    assert!(truth.unwrap_err().to_string().contains("write the truth to a schema of its own"));
    let log = Life::new(2, 20);
    log.live(
        &server.url("postgres", &database, "&schema=two"),
        Some(&server.url("postgres", &database, "&schema=three")),
        Policy::default(),
    )
    .unwrap();
    refused(&server.url("postgres", &database, "&schema=three"), WriteMode::Create, &["has truths"]);
}

#[test]
fn names_the_right_that_a_user_lacks() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("rights");
    live(&server.url("postgres", &database, ""), WriteMode::Create).unwrap();
    server.psql(
        &database,
        "CREATE ROLE reader LOGIN; GRANT SELECT ON firing, homebody_run TO reader; CREATE ROLE bare LOGIN",
    );
    server.psql(&database, "CREATE ROLE idle LOGIN; ALTER ROLE idle SET default_transaction_read_only = on");
    let url = |user: &str, more: &str| server.url(user, &database, more);
    refused(
        &url("reader", ""),
        WriteMode::Create,
        &[
            "no right to INSERT in \"firing\", \"homebody_run\", and to UPDATE in \"homebody_run\"",
            "GRANT INSERT ON public.firing, public.homebody_run TO reader; GRANT UPDATE ON public.homebody_run TO reader",
        ],
    );
    refused(&url("reader", ""), WriteMode::Overwrite, &["and to DELETE in \"firing\""]);
    refused(
        &url("bare", "&schema=home9"),
        WriteMode::Create,
        &["no schema \"home9\"", "\"bare\" may not create one", "CREATE SCHEMA home9"],
    );
    server.psql(&database, "CREATE SCHEMA shut; CREATE SCHEMA seen; GRANT USAGE ON SCHEMA seen TO bare");
    refused(&url("bare", "&schema=shut"), WriteMode::Create, &["may not use the schema \"shut\""]);
    refused(
        &url("bare", "&schema=seen"),
        WriteMode::Create,
        &["lacks \"firing\", \"homebody_run\"", "may not create tables", "GRANT CREATE ON SCHEMA seen TO bare"],
    );
    refused(&url("idle", ""), WriteMode::Create, &["takes no changes", "default_transaction_read_only"]);
}

#[test]
fn names_that_are_sql_never_reach_the_server() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("names");
    let url = server.url("postgres", &database, "");
    let names = ["a\"; DROP TABLE x; --", "A", "1a", "a b", "", "é", "$1", &"a".repeat(64), "sqlite_x"];
    for name in names {
        for place in 0..5 {
            let mut file = LoggerFile::default();
            match place {
                0 => file.table = Some(name.into()),
                1 => file.columns.run = name.into(),
                2 => file.columns.time = name.into(),
                3 => file.columns.sensor = name.into(),
                _ => file.columns.value = name.into(),
            }
            let refused = Life::new(1, 10).live_as(&url, None, Policy::default(), &file);
            assert!(matches!(refused, Err(LogError::Name { .. })), "{name:?}: {refused:?}");
        }
        let schema = format!("{url}&schema={}", name.replace(' ', "%20"));
        assert!(name == "sqlite_x" || live(&schema, WriteMode::Create).is_err(), "{name:?}");
    }
    let file = LoggerFile { table: Some("homebody_run".into()), ..Default::default() };
    assert!(matches!(Life::new(1, 10).live_as(&url, None, Policy::default(), &file), Err(LogError::SameName { .. })));
    let tables =
        "SELECT count(*) FROM pg_tables WHERE schemaname NOT IN ('pg_catalog', 'information_schema', 'sqlite_x')";
    assert_eq!(server.psql(&database, tables), "0");
    // Words of SQL are names as others are.
    let mut file = LoggerFile { table: Some("select".into()), ..Default::default() };
    (file.columns.run, file.columns.value) = ("from".into(), "table".into());
    Life::new(1, 10).live_as(&url, None, Policy::default(), &file).unwrap();
    assert_eq!(server.psql(&database, "SELECT count(\"table\") FROM \"select\" WHERE \"from\" = 1"), "10");
}

#[test]
fn refuses_replaces_or_resumes_an_existing_run() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("again");
    let url = server.url("postgres", &database, "");
    live(&url, WriteMode::Create).unwrap();
    let sound = server.dump(&database, "public", 1);
    refused(
        &url,
        WriteMode::Create,
        &["the run 1 of \"a quiet night\" is already in the schema \"public\"", "--replace-rows", "--resume"],
    );
    server.psql(
        &database,
        "UPDATE firing SET value = 'changed' WHERE seq < 50; INSERT INTO firing VALUES (2, 0, now(), 'x', 'y')",
    );
    assert_ne!(server.dump(&database, "public", 1), sound);
    live(&url, WriteMode::Resume).unwrap();
    assert_ne!(server.dump(&database, "public", 1), sound, "what is there is not written again");
    live(&url, WriteMode::Overwrite).unwrap();
    assert_eq!(server.dump(&database, "public", 1), sound);
    assert_eq!(server.psql(&database, "SELECT count(*) FROM firing WHERE run_id = 2"), "1", "others stay");
    server.psql(&database, "DELETE FROM homebody_run");
    refused(&url, WriteMode::Create, &["already"]);
    refused(&format!("{url}&run=x"), WriteMode::Create, &["run=x is not a whole number"]);
    live(&format!("{url}&run=8"), WriteMode::Create).unwrap();
    assert_eq!(server.psql(&database, "SELECT count(*) FROM firing WHERE run_id = 8"), "200");
    // A run that could not begin leaves nothing that would be in the way.
    let truth = server.url("postgres", &database, "&schema=public");
    let life = Life::new(3, 20);
    assert!(life.live(&url, Some(&truth), Policy::default()).is_err());
    life.live(&url, None, Policy::default()).unwrap();
}

#[test]
fn only_a_longer_run_resumes_a_stopped_one() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("longer");
    let url = server.url("postgres", &database, "");
    let whole = Life::new(1, 900);
    whole.live(&url, Some(&url), Policy::default()).unwrap();
    let wanted = ["public", "truth"].map(|schema| server.dump(&database, schema, 1));
    Life::new(2, 400).live(&url, Some(&url), Policy::default()).unwrap();
    let long = Life { how: WriteMode::Resume, ..Life::new(2, 900) };
    long.live(&url, Some(&url), Policy::default()).unwrap();
    assert_eq!(["public", "truth"].map(|schema| server.dump(&database, schema, 2)), wanted);
    let short = Life { how: WriteMode::Resume, ..Life::new(2, 300) }.live(&url, None, Policy::default());
    assert!(matches!(short, Err(LogError::Changed { .. })), "{short:?}");
    assert_eq!(server.dump(&database, "public", 2), wanted[0]);
}

#[test]
fn a_server_that_dies_in_the_middle_is_an_error_that_passes() {
    let Some(mut server) = Server::start() else { return };
    let url = server.url("postgres", "postgres", "");
    let going = std::thread::spawn({
        let url = url.clone();
        move || {
            Life { rests: Duration::from_millis(3), settles: 2, ..Life::new(1, 50_000) }.live(
                &url,
                None,
                Policy::default(),
            )
        }
    });
    std::thread::sleep(Duration::from_millis(700));
    server.stop();
    let error = going.join().unwrap().unwrap_err();
    assert!(error.passes(), "{error}");
    server.restart();
    Life { how: WriteMode::Resume, ..Life::new(1, 50_000) }.live(&url, None, patient(10)).unwrap();
    assert_eq!(server.psql("postgres", "SELECT count(*), max(seq) FROM firing"), "50000|49999");
}
