//! The messages of this crate.

const INSTEAD: &str = "leave the password out, and write HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass, which only you may read \
                       (chmod 600), or set PGPASSWORD; ?passfile=FILE names another file";

homebody_core::messages! {
    /// Problems with the URL of a server.
    pub(crate) enum ServerUrlMessage in "postgresql-url" {
        /// Commands end up in histories and in lists of processes, which others can read.
        Password error "password" ("the URL has a password in it, where others can read it")
            hint ("{INSTEAD}");
        /// libpq tries several hosts one after the other. Homebody writes to one.
        SeveralHosts error "several-hosts" ("the URL or the environment names several hosts")
            hint ("name one host");
        /// `sslmode` has the values of libpq.
        SslMode { value: String, known: Vec<&'static str> }
            error "sslmode" ("{value:?} is not a valid value of sslmode")
            hint ("write one of {known}", known = known.join(", "));
        /// Names of schemas reach SQL, so they consist of plain characters.
        Schema { name: String } error "schema" ("{name:?} cannot be the name of a schema")
            hint ("use at most 63 characters from a-z, 0-9 and _; do not begin with a digit, and do not name a schema of the server, such as information_schema");
        /// The user is the part before `@`, or comes from PGUSER or USER.
        NoUser error "no-user" ("the URL names no user, and neither does the environment")
            hint ("write postgresql://USER@HOST/DATABASE");
        /// docs/reference/postgresql.md lists the parameters of the URL.
        Unknown { name: String, advice: String }
            error "unknown-parameter" ("there is no parameter {name:?}") hint ("{advice}");
        /// A parameter needs a value after `=`.
        NoValue { name: String } error "no-value" ("the parameter {name} has no value")
            hint ("write {name}=VALUE, or remove the parameter");
        /// In a URL, `%` and two hexadecimal digits are one byte, such as `%40` for `@`.
        Percent error "percent" ("a % is not followed by two hexadecimal digits")
            hint ("write %25 for a % itself");
        /// The bytes that are written with `%` must be text in UTF-8.
        NotUtf8 error "not-utf-8" ("the bytes written with % are not UTF-8")
            hint ("write text in UTF-8, such as %C3%B6 for ö");
        /// Ports go from 1 to 65535, and a connection may take up to an hour.
        Number { name: String, text: String, least: u64, most: u64 }
            error "number" ("the {name} {text:?} is not a number from {least} to {most}")
            hint ("write a number in this range");
        /// A run of a log is a whole number, and the database stores it as one.
        Run { run: String } error "run" ("run={run} is not a whole number")
            hint ("write a whole number, such as run=7, or leave the parameter out");
        /// Each home of a fleet is a run of its own in the database.
        FleetRun { run: String } error "fleet-run" ("run={run} names one run, but a fleet has a run for each home")
            hint ("leave the parameter out");
    }
}

homebody_core::messages! {
    /// Problems with a server.
    pub(crate) enum ServerMessage in "postgresql" {
        /// The server asks for a password and got none, or a wrong one. `ignored` tells why Homebody did not read a file of passwords.
        Login { answer: String, ignored: Option<String> }
            error "login" ("{answer}{more}", more = ignored.as_ref().map_or(String::new(), |ignored| format!("; {ignored}")))
            hint ("{INSTEAD}");
        /// `sslmode` and `sslrootcert` say whether the connection is encrypted, and whose certificate the server must have.
        Tls { reason: String } error "tls" ("cannot encrypt the connection: {reason}")
            hint ("check sslmode, and name the trusted certificates with sslrootcert=FILE");
        /// This build cannot encrypt connections.
        NoTls { reason: String } error "no-tls" ("cannot use TLS: {reason}")
            hint ("write sslmode=disable");
        /// The certificates to trust come from sslrootcert, from `~/.postgresql/root.crt` or from the system.
        NoCertificates { file: String, reason: String }
            error "no-certificates" ("{file} has no certificates: {reason}")
            hint ("name a file of certificates in PEM: sslrootcert=FILE, or sslrootcert=system");
        /// The system has no trusted certificates, or Homebody does not find them.
        NoSystemCertificates error "no-system-certificates" ("this system has no trusted certificates")
            hint ("name a file of certificates in PEM: sslrootcert=FILE");
        /// The certificates to trust cannot be used.
        BadCertificates { reason: String } error "bad-certificates" ("cannot use the trusted certificates: {reason}")
            hint ("name a file of certificates in PEM: sslrootcert=FILE, or sslrootcert=system");
        /// The server is not running, or listens elsewhere. A run tries again for some time.
        NoServer { reason: String } error "no-server" ("no server answers: {reason}")
            hint ("start the server, or correct host and port");
        /// The connection broke. A run tries again for some time, and writes no row twice.
        Lost { reason: String } error "connection-lost" ("the connection was lost: {reason}")
            hint ("start the server, or correct host and port");
        /// The system gives the program no connection.
        NoConnection { reason: String } error "no-connection" ("the system cannot open a connection: {reason}")
            hint ("allow this user more open files (ulimit -n)");
        /// The client library of PostgreSQL reports this error.
        Client { reason: String } error "client" ("{reason}")
            hint ("see docs/how-to/postgresql.md for what a server needs");
        /// A server has several databases, and none of this name.
        NoDatabase { answer: String, database: String }
            error "no-database" ("{answer}")
            hint ("run createdb {database}, or name another database");
        /// The user may connect, and lacks a right in the database.
        NoRight { answer: String } error "no-right" ("{answer}")
            hint ("ask an owner to GRANT the right to this user, or connect as another user");
        /// The server is a standby of another, or is set to read-only. A run tries again for some time.
        ReadOnly { answer: String } error "read-only" ("{answer}")
            hint ("name a server that takes changes, or wait until this one does");
        /// The rows of a run have a key, and another program has written rows with the same key.
        SameRows { answer: String } error "same-rows" ("{answer}")
            hint ("another program has written rows of this run: wait until it ends, or pass --replace-rows");
        /// The server reports an error that often passes, such as too many connections. A run tries again for some time.
        Passing { answer: String } error "temporary" ("{answer}")
            hint ("try again later: rows that the server has confirmed are safe");
        /// The server reports this error. The code in brackets is the SQLSTATE, which the manual of PostgreSQL explains.
        Answer { answer: String, sqlstate: String, advice: String }
            error "answer" ("{answer} [{sqlstate}]") hint ("{advice}");
        /// A schema has either logs or ground truths, so that a reader of one does not see the other.
        TruthInLogs { schema: String } error "schema-of-logs" ("the schema {schema:?} has logs")
            hint ("write the truth to a schema of its own: ?schema=NAME");
        /// A schema has either logs or ground truths, so that a reader of one does not see the other.
        LogInTruths { schema: String } error "schema-of-truths" ("the schema {schema:?} has truths")
            hint ("write the log to another schema: ?schema=NAME");
        /// A run is written once. The database has a run with this id.
        Exists { run: i64, scenario: String, schema: String }
            error "run-exists" ("the run {run} of {scenario:?} is already in the schema {schema:?}")
            hint ("pass --replace-rows to replace it, or --resume to continue it; or name another schema: ?schema=NAME");
        /// A fleet writes one run for each home.
        NoHomes error "no-homes" ("the fleet has no homes") hint ("ask for at least one home");
        /// A person or a program has deleted the run while the fleet was writing.
        RunGone { home: String } error "run-gone" ("the run of {home} is no longer in the database")
            hint ("check which other program changes the database");
        /// A fleet continues runs of its own version.
        ForeignRun { run: i64, holds: String, version: String }
            error "foreign-run" ("the run {run} already exists and is not of this fleet: it contains {holds} of version {version}")
            hint ("pass --replace-rows to replace it, or name another schema: ?schema=NAME");
        /// The tables go to the first schema of the user's search path that exists.
        NoSchema error "no-schema" ("this user has no schema")
            hint ("name a schema: ?schema=NAME");
        /// PostgreSQL stores no zero bytes in texts.
        ZeroByte { text: String } error "zero-byte" ("the text {text:?}")
            hint ("PostgreSQL takes no zero byte in texts: give the sensor another id");
        /// Homebody finds the columns of time, sensor and value by their names. `--mapping logger.json` gives other names:
        ///
        /// ```json
        /// {"table": "events", "columns": {"time": "at", "sensor": "device", "value": "state"}}
        /// ```
        MissingColumns { table: String, missing: Vec<String>, known: String }
            error "missing-columns" ("the table {table:?} has no column {missing}", missing = missing.join(", no column "))
            hint ("name the right columns with --mapping logger.json; the table has {known}");
        /// A log is one run. The table has others.
        NoRunInTable { table: String, run: String, known: String }
            error "no-run-in-table" ("the table {table:?} has no run {run}")
            hint ("name one of its runs: {known}");
        /// A log is one run. The table has several.
        SeveralRuns { table: String, runs: String, first: String }
            error "several-runs" ("the table {table:?} has several runs: {runs}")
            hint ("name one of them, such as ?run={first}");
        /// The table of runs has others.
        NoRun { run: String, known: String }
            error "no-run" ("there is no run {run}") hint ("name one of the runs: {known}");
        /// Homebody reads the table `firing` unless `--mapping logger.json` names another.
        NoTable { table: String, schema: String, advice: String }
            error "no-table" ("there is no table {table:?} in the schema {schema:?}") hint ("{advice}");
        /// The schema has ground truths of other runs.
        NoTruthOfRun { schema: String, run: String, known: String }
            error "no-truth-of-run" ("the schema {schema:?} has no ground truth of the run {run}")
            hint ("name one of its runs: {known}");
        /// A ground truth is of one run. The schema has several.
        SeveralTruths { schema: String, runs: String, first: i64 }
            error "several-truths" ("the schema {schema:?} has the ground truths of several runs: {runs}")
            hint ("name one of them, such as ?run={first}");
        /// The schema has the tables of a truth, and no rows in them.
        NoTruth { schema: String } error "no-truth" ("the schema {schema:?} has tables of ground truths, but no rows in them")
            hint ("write a ground truth there with --truth, or name another schema: ?schema=NAME");
    }
}

homebody_core::messages! {
    /// Differences between a database and the run that Homebody continues.
    pub(crate) enum ContinueMessage in "postgresql-resume" {
        /// The database has rows that the run did not make this time: it was stopped earlier than before, or the scenario has changed since.
        LaterRows error "later-rows" ("it has rows from after the end of this run")
            hint ("let the run last as long as before, or pass --replace-rows");
        /// The table of runs counts the rows of each run.
        NoRunRow error "no-run-row" ("its row in the table homebody_run is gone")
            hint ("restore the row, or pass --replace-rows");
        /// Two programs that write one run would overwrite each other's rows.
        OtherProgram error "other-program" ("another program has continued the run")
            hint ("stop the other program, or name another schema: ?schema=NAME");
        /// The server reports how many rows it has stored, and that differs from the number sent.
        OtherCount error "other-count" ("the server has stored another number of rows than Homebody sent")
            hint ("check triggers and rules of the table");
        /// The names of tables come from `logger.json`, which has changed since the run began.
        OtherTables { tables: Vec<String> } error "other-tables" ("its rows are in the tables {tables}", tables = tables.join(", "))
            hint ("restore the names in logger.json, or start a new run");
    }
}

homebody_core::messages! {
    /// Tables and rights that do not fit a log.
    pub(crate) enum TableSchemaMessage in "postgresql-schema" {
        /// The server is a standby of another, or the user is set to read-only.
        ReadOnly error "read-only" ("the server takes no changes from this user")
            hint ("name a server that takes changes, or turn default_transaction_read_only off with ALTER ROLE");
        /// The schema does not exist, and the user may not create it.
        NoSchema { schema: String, user: String }
            error "no-schema" ("there is no schema {schema:?}, and {user:?} may not create one")
            hint ("CREATE SCHEMA {schema} AUTHORIZATION {user}");
        /// The user may not use the schema.
        SchemaDenied { schema: String, user: String }
            error "schema-denied" ("{user:?} may not use the schema {schema:?}")
            hint ("GRANT USAGE ON SCHEMA {schema} TO {user}");
        /// The tables do not exist, and the user may not create them.
        TablesDenied { tables: String, schema: String, user: String }
            error "tables-denied" ("the schema {schema:?} lacks {tables}, and {user:?} may not create tables")
            hint ("GRANT CREATE ON SCHEMA {schema} TO {user}, or name another schema: ?schema=NAME");
        /// A run inserts rows and reads how far it is; with `--replace-rows` it deletes rows, too.
        NoRights { user: String, lacking: String, grant: String }
            error "no-rights" ("{user:?} has no right to {lacking}") hint ("{grant}");
        /// A view or another object has the name of the table.
        NotTable { name: String } error "not-a-table" ("{name:?} is not a table")
            hint ("rename it, or name another schema: ?schema=NAME");
        /// The table was created by another program, or by an older version.
        NoColumn { table: String, column: String, statement: String }
            error "no-column" ("the table {table:?} has no column {column:?}")
            hint ("{statement}, or rename the table so that Homebody creates it anew");
        /// The table was created by another program, or by an older version.
        ColumnType { table: String, column: String, has: String, wanted: String, statement: String }
            error "column-type" ("the column {column:?} of {table:?} is {has}, and not {wanted}")
            hint ("{statement}, or rename the table so that Homebody creates it anew");
        /// The column may not be empty, and a log has no value for it.
        MustBeGiven { table: String, column: String, statement: String }
            error "required-column" ("the column {column:?} of {table:?} needs a value, and a log has none")
            hint ("{statement}");
        /// With the key the server refuses a row that it has. Without it, a row could be in the table twice after a lost connection.
        NoKey { table: String, columns: String, statement: String }
            error "no-key" ("the table {table:?} has no key ({columns}), so that a row could be in it twice")
            hint ("{statement}");
        /// Several of these problems at once. `homebody doctor` lists them one by one.
        Several { problems: Vec<String>, codes: Vec<&'static str>, advice: String }
            error "several" ("{problems}", problems = problems.join("; ")) hint ("{advice}");
    }
}

/// The messages of this crate, by area.
pub const MESSAGES: &[&[homebody_core::messages::CatalogueEntry]] = &[
    <ServerUrlMessage as homebody_core::messages::Catalogue>::ENTRIES,
    <ServerMessage as homebody_core::messages::Catalogue>::ENTRIES,
    <ContinueMessage as homebody_core::messages::Catalogue>::ENTRIES,
    <TableSchemaMessage as homebody_core::messages::Catalogue>::ENTRIES,
];
