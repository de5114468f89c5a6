//! The tables of a run in the database: made where they are missing, else held against what they should be, all at once.

use crate::connection::DatabaseConnection;
use crate::messages::{ServerMessage, TableSchemaMessage};
use crate::server::{Server, is_plain_name};
use crate::trouble::wrong;
use homebody_core::problem::{Problem, readable};
use homebody_core::scenario::logger::TimeFormat;
use homebody_log::table::{Column, ColumnKind, Table};
use homebody_log::{Begin, LogError, WriteMode};
use std::collections::BTreeMap;
use tokio_postgres::Row;

/// The table of runs and their watermarks.
pub(crate) const RUNS: &str = "homebody_run";

/// The table of the sensors of runs.
pub(crate) const SENSORS: &str = "homebody_sensor";

/// The default schema of a truth.
pub(crate) const TRUTH_SCHEMA: &str = "truth";

/// The advisory lock of programs that create tables: `homebody`, as a number.
const TURN: i64 = i64::from_be_bytes(*b"homebody");

/// The columns of the table of runs, and their types.
pub(crate) const RUN_COLUMNS: [(&str, &str); 12] = [
    ("run_id", "bigint"),
    ("holds", "text"),
    ("home", "text"),
    ("scenario", "text"),
    ("seed", "text"),
    ("version", "text"),
    ("zone", "text"),
    ("started_at", "timestamp with time zone"),
    ("ended_at", "timestamp with time zone"),
    ("tables", "text[]"),
    ("rows", "bigint[]"),
    ("commits", "bigint"),
];

/// A table as SQL names it.
#[derive(Clone, Debug)]
pub(crate) struct InTable {
    pub name: String,
    pub quoted: String,
    pub columns_quoted: String,
    pub run_column: String,
    pub is_numbered: bool,
}

/// The tables of a run, in a schema.
pub(crate) struct Schema {
    pub name: String,
    pub tables: Vec<InTable>,
    pub is_truth: bool,
}

impl Schema {
    /// Makes the tables that are missing; refuses those that rows do not fit into, with all that is wrong.
    pub fn make(connection: &DatabaseConnection, server: &Server, begin: &Begin) -> Result<Schema, LogError> {
        // Rows of a log are numbered, those of a truth are not. A log may have a table of activities besides.
        let is_truth = !begin.tables.iter().any(|table| table.is_numbered);
        let name = match (&server.schema, is_truth) {
            (Some(name), _) => name.clone(),
            (None, true) => TRUTH_SCHEMA.into(),
            (None, false) => usual(connection, server)?,
        };
        names_fit(server, &name, begin)?;
        let wanted: Vec<TableDefinition> = begin
            .tables
            .iter()
            .map(|table| TableDefinition::for_table(table, begin.time, &begin.run_column))
            .chain([TableDefinition::runs()])
            .collect();
        let found = SchemaState::look(connection, &name, &wanted)?;
        let problems = found.problems(&name, &wanted, begin.how);
        if !problems.is_empty() {
            return Err(all(server, problems));
        }
        let statements: Vec<String> = found.missing(&name, &wanted);
        if !statements.is_empty() {
            let sql = format!("BEGIN; SELECT pg_advisory_xact_lock({TURN}); {}; COMMIT", statements.join("; "));
            connection.wait(connection.client.batch_execute(&sql))?;
        }
        let tables = begin.tables.iter().map(|table| in_table(&name, table, &begin.run_column)).collect();
        Ok(Schema { name, tables, is_truth })
    }

    /// The table of runs, as SQL names it.
    pub fn runs(&self) -> String {
        quoted(&self.name, RUNS)
    }
}

/// The schema in which a connection creates tables by default.
pub(crate) fn usual(connection: &DatabaseConnection, server: &Server) -> Result<String, LogError> {
    let row = connection.wait(connection.client.query_one("SELECT current_schema()::text", &[]))?;
    let none = || wrong(server, ServerMessage::NoSchema);
    row.get::<_, Option<String>>(0).ok_or_else(none)
}

pub(crate) fn quoted(schema: &str, table: &str) -> String {
    format!("{}.{}", ident(schema), ident(table))
}

/// A table as people write it: in quotes where it needs them.
fn written(schema: &str, table: &str) -> String {
    let part = |name: &str| if is_plain_name(name) { name.to_owned() } else { ident(name) };
    format!("{}.{}", part(schema), part(table))
}

/// A name as SQL wants it.
pub(crate) fn ident(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

fn in_table(schema: &str, table: &Table, run_column: &str) -> InTable {
    let names = std::iter::once(run_column).chain(table.columns.iter().map(|column| column.name.as_str()));
    InTable {
        name: table.name.clone(),
        quoted: quoted(schema, &table.name),
        columns_quoted: names.map(ident).collect::<Vec<_>>().join(", "),
        run_column: ident(run_column),
        is_numbered: table.is_numbered,
    }
}

/// The tables of a schema before anything is written: the names of those that exist, and all problems, with advice.
pub(crate) fn look(
    connection: &DatabaseConnection,
    schema: &str,
    tables: &[Table],
    time: TimeFormat,
    run_column: &str,
) -> Result<(Vec<String>, Vec<Problem>), LogError> {
    let wanted: Vec<TableDefinition> = tables
        .iter()
        .map(|table| TableDefinition::for_table(table, time, run_column))
        .chain([TableDefinition::runs()])
        .collect();
    let found = SchemaState::look(connection, schema, &wanted)?;
    let problems = found.problems(schema, &wanted, WriteMode::Create);
    Ok((found.tables.into_keys().collect(), problems))
}

/// Refuses names that could be SQL, of any origin.
fn names_fit(server: &Server, schema: &str, begin: &Begin) -> Result<(), LogError> {
    let refused = |what, name: &str| Err(LogError::Name { what, name: name.to_owned() });
    // One that the server gave may have any name; it is quoted.
    if server.schema.is_some() && !is_plain_name(schema) {
        return refused("schema", schema);
    }
    for table in begin.tables.iter() {
        if !is_plain_name(&table.name) {
            return refused("table", &table.name);
        }
        if table.name == RUNS || table.name == SENSORS {
            return Err(LogError::SameName { what: "table", name: table.name.clone() });
        }
        let columns = table.columns.iter().map(|column| column.name.as_str()).chain([begin.run_column.as_str()]);
        if let Some(name) = columns.into_iter().find(|name| !is_plain_name(name)) {
            return refused("column", name);
        }
    }
    Ok(())
}

struct TableDefinition {
    name: String,
    /// By name: the type, and what else will do.
    columns: Vec<(String, &'static str)>,
    key: Vec<String>,
    is_runs: bool,
}

impl TableDefinition {
    fn for_table(table: &Table, time: TimeFormat, run_column: &str) -> TableDefinition {
        let typed = |column: &Column| (column.name.clone(), column_type(column.kind, time));
        let run = run_column.to_owned();
        let columns = std::iter::once((run.clone(), "bigint")).chain(table.columns.iter().map(typed)).collect();
        let key = if table.is_numbered { vec![run, table.columns[0].name.clone()] } else { Vec::new() };
        TableDefinition { name: table.name.clone(), columns, key, is_runs: false }
    }

    fn runs() -> TableDefinition {
        let columns = RUN_COLUMNS.map(|(name, is)| (name.to_owned(), is)).to_vec();
        TableDefinition { name: RUNS.into(), columns, key: vec!["run_id".into()], is_runs: true }
    }

    fn create(&self, schema: &str) -> String {
        let columns: Vec<String> = self.columns.iter().map(|(name, is)| format!("{} {is}", ident(name))).collect();
        let key = match &self.key[..] {
            [] => String::new(),
            key => format!(", PRIMARY KEY ({})", key.iter().map(|name| ident(name)).collect::<Vec<_>>().join(", ")),
        };
        format!("CREATE TABLE IF NOT EXISTS {} ({}{key})", quoted(schema, &self.name), columns.join(", "))
    }
}

fn column_type(kind: ColumnKind, time: TimeFormat) -> &'static str {
    match kind {
        ColumnKind::Instant => match time {
            TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => "timestamp with time zone",
            TimeFormat::EpochS => "double precision",
            TimeFormat::EpochMs => "bigint",
        },
        ColumnKind::Integer => "bigint",
        ColumnKind::Real => "double precision",
        ColumnKind::Text => "text",
    }
}

/// Whether a column of the found type takes the bytes of the wanted type.
fn will_do(wanted: &str, found: &str) -> bool {
    wanted == found || wanted == "text" && found == "character varying"
}

struct SchemaState {
    is_read_only: bool,
    user: String,
    may_make_schemas: bool,
    schema: Option<(bool, bool)>,
    tables: BTreeMap<String, FoundTable>,
}

#[derive(Default)]
struct FoundTable {
    is_table: bool,
    columns: BTreeMap<String, FoundColumn>,
    /// The columns of its unique keys.
    keys: Vec<Vec<String>>,
    may: [bool; 4],
}

struct FoundColumn {
    is: String,
    must_be_given: bool,
}

/// The rights to a table, in the order of `may`.
const RIGHTS: [&str; 4] = ["INSERT", "SELECT", "UPDATE", "DELETE"];

impl SchemaState {
    fn look(
        connection: &DatabaseConnection,
        schema: &str,
        wanted: &[TableDefinition],
    ) -> Result<SchemaState, LogError> {
        const ABOUT: &str = "SELECT current_setting('transaction_read_only') = 'on', current_user::text, \
             has_database_privilege(current_database(), 'CREATE'), \
             (SELECT has_schema_privilege(oid, 'USAGE') FROM pg_namespace WHERE nspname = $1), \
             (SELECT has_schema_privilege(oid, 'CREATE') FROM pg_namespace WHERE nspname = $1)";
        const TABLES: &str = "SELECT c.relname::text, c.relkind IN ('r', 'p'), has_table_privilege(c.oid, 'INSERT'), \
             has_table_privilege(c.oid, 'SELECT'), has_table_privilege(c.oid, 'UPDATE'), has_table_privilege(c.oid, 'DELETE') \
             FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace \
             WHERE n.nspname = $1 AND c.relname::text = ANY($2) AND c.relkind IN ('r', 'p', 'v', 'm', 'f')";
        const COLUMNS: &str = "SELECT c.relname::text, a.attname::text, format_type(a.atttypid, a.atttypmod), \
             a.attnotnull AND NOT a.atthasdef AND a.attidentity = '' \
             FROM pg_attribute a JOIN pg_class c ON c.oid = a.attrelid JOIN pg_namespace n ON n.oid = c.relnamespace \
             WHERE n.nspname = $1 AND c.relname::text = ANY($2) AND a.attnum > 0 AND NOT a.attisdropped";
        const KEYS: &str = "SELECT c.relname::text, array_agg(a.attname::text) \
             FROM pg_index i JOIN pg_class c ON c.oid = i.indrelid JOIN pg_namespace n ON n.oid = c.relnamespace \
             JOIN pg_attribute a ON a.attrelid = c.oid AND a.attnum = ANY(i.indkey) \
             WHERE n.nspname = $1 AND c.relname::text = ANY($2) AND i.indisunique AND i.indpred IS NULL \
             GROUP BY c.relname, i.indexrelid";
        let names: Vec<&str> = wanted.iter().map(|wanted| wanted.name.as_str()).collect();
        let about = connection.wait(connection.client.query_one(ABOUT, &[&schema]))?;
        let usage: Option<bool> = about.get(3);
        let mut found = SchemaState {
            is_read_only: about.get(0),
            user: about.get(1),
            may_make_schemas: about.get(2),
            schema: usage.zip(about.get(4)),
            tables: BTreeMap::new(),
        };
        for row in connection.wait(connection.client.query(TABLES, &[&schema, &names]))? {
            let table = FoundTable {
                is_table: row.get(1),
                may: [2, 3, 4, 5].map(|right| row.get(right)),
                ..Default::default()
            };
            found.tables.insert(row.get(0), table);
        }
        let mut each = |sql: &str, take: &dyn Fn(&mut FoundTable, &Row)| -> Result<(), LogError> {
            for row in connection.wait(connection.client.query(sql, &[&schema, &names]))? {
                if let Some(table) = found.tables.get_mut(row.get::<_, &str>(0)) {
                    take(table, &row);
                }
            }
            Ok(())
        };
        each(COLUMNS, &|table, row| {
            let column = FoundColumn { is: row.get(2), must_be_given: row.get(3) };
            table.columns.insert(row.get(1), column);
        })?;
        each(KEYS, &|table, row| table.keys.push(row.get(1)))?;
        Ok(found)
    }

    fn problems(&self, schema: &str, wanted: &[TableDefinition], how: WriteMode) -> Vec<Problem> {
        let mut problems = Vec::new();
        let user = &self.user;
        if self.is_read_only {
            problems.push(TableSchemaMessage::ReadOnly.into());
        }
        match self.schema {
            None if !self.may_make_schemas => {
                problems.push(TableSchemaMessage::NoSchema { schema: schema.into(), user: user.clone() }.into());
            }
            Some((false, _)) => {
                problems.push(TableSchemaMessage::SchemaDenied { schema: schema.into(), user: user.clone() }.into());
            }
            _ => {}
        }
        let may_make_tables = !matches!(self.schema, Some((true, false)));
        let mut unmade = Vec::new();
        for wanted in wanted {
            match self.tables.get(&wanted.name) {
                Some(table) => table.problems(&written(schema, &wanted.name), wanted, &mut problems),
                None if !may_make_tables => unmade.push(wanted.name.as_str()),
                None => {}
            }
        }
        if !unmade.is_empty() {
            let (tables, schema, user) = (listed(&unmade), schema.to_owned(), user.clone());
            problems.push(TableSchemaMessage::TablesDenied { tables, schema, user }.into());
        }
        problems.extend(self.rights(schema, wanted, how));
        problems
    }

    /// The rights that the user lacks, in one problem: it is one role that lacks them.
    fn rights(&self, schema: &str, wanted: &[TableDefinition], how: WriteMode) -> Option<Problem> {
        let lacks = |right: usize| -> Vec<&str> {
            let is_lacking = |wanted: &&TableDefinition| {
                let needed = match (wanted.is_runs, how) {
                    (true, _) => [true, true, true, false],
                    (false, how) => [true, true, false, how == WriteMode::Overwrite],
                };
                needed[right] && self.tables.get(&wanted.name).is_some_and(|table| table.is_table && !table.may[right])
            };
            wanted.iter().filter(is_lacking).map(|wanted| wanted.name.as_str()).collect()
        };
        // Rights that the same tables lack are reported together.
        let mut by_tables: Vec<(Vec<&str>, Vec<&str>)> = Vec::new();
        for (right, name) in RIGHTS.iter().enumerate() {
            let tables = lacks(right);
            match by_tables.iter_mut().find(|(known, _)| *known == tables) {
                _ if tables.is_empty() => {}
                Some((_, rights)) => rights.push(name),
                None => by_tables.push((tables, vec![name])),
            }
        }
        let user = &self.user;
        let what = by_tables.iter().map(|(tables, rights)| format!("{} in {}", rights.join(", "), listed(tables)));
        let grant = |(tables, rights): &(Vec<&str>, Vec<&str>)| {
            let on = match tables.len() {
                ..=MOST_LISTED => tables.iter().map(|name| written(schema, name)).collect::<Vec<_>>().join(", "),
                _ => format!("ALL TABLES IN SCHEMA {schema}"),
            };
            format!("GRANT {} ON {on} TO {user}", rights.join(", "))
        };
        let what: Vec<String> = what.collect();
        let hint = by_tables.iter().map(grant).collect::<Vec<_>>().join("; ");
        let (user, lacking) = (user.clone(), what.join(", and to "));
        (!what.is_empty()).then(|| TableSchemaMessage::NoRights { user, lacking, grant: hint }.into())
    }

    fn missing(&self, schema: &str, wanted: &[TableDefinition]) -> Vec<String> {
        let mut statements = Vec::new();
        if self.schema.is_none() {
            statements.push(format!("CREATE SCHEMA IF NOT EXISTS {}", ident(schema)));
        }
        let missing = wanted.iter().filter(|wanted| !self.tables.contains_key(&wanted.name));
        statements.extend(missing.map(|wanted| wanted.create(schema)));
        statements
    }
}

impl FoundTable {
    /// Adds the problems of its columns and keys; `at` is its name in hints.
    fn problems(&self, at: &str, wanted: &TableDefinition, problems: &mut Vec<Problem>) {
        let name = &wanted.name;
        if !self.is_table {
            problems.push(TableSchemaMessage::NotTable { name: name.clone() }.into());
            return;
        }
        let table = || name.clone();
        let mut wants = |message: TableSchemaMessage| problems.push(message.into());
        for (column, is) in &wanted.columns {
            match self.columns.get(column) {
                None => wants(TableSchemaMessage::NoColumn {
                    table: table(),
                    column: column.clone(),
                    statement: format!("ALTER TABLE {at} ADD {column} {is}"),
                }),
                Some(found) if !will_do(is, &found.is) => wants(TableSchemaMessage::ColumnType {
                    table: table(),
                    column: column.clone(),
                    has: found.is.clone(),
                    wanted: (*is).to_owned(),
                    statement: format!("ALTER TABLE {at} ALTER {column} TYPE {is}"),
                }),
                Some(_) => {}
            }
        }
        let is_ours = |column: &String| wanted.columns.iter().any(|(name, _)| name == column);
        for (column, _) in self.columns.iter().filter(|(name, found)| found.must_be_given && !is_ours(name)) {
            let statement = format!("ALTER TABLE {at} ALTER {column} DROP NOT NULL");
            wants(TableSchemaMessage::MustBeGiven { table: table(), column: column.clone(), statement });
        }
        let mut key = wanted.key.clone();
        key.sort();
        let has_key = self.keys.iter().any(|found| {
            let mut found = found.clone();
            found.sort();
            found == key
        });
        if !key.is_empty() && !has_key {
            let columns = wanted.key.join(", ");
            let statement = format!("ALTER TABLE {at} ADD PRIMARY KEY ({columns})");
            wants(TableSchemaMessage::NoKey { table: table(), columns, statement });
        }
    }
}

/// Number of tables above which they are counted instead of listed (our choice).
const MOST_LISTED: usize = 3;

fn listed(names: &[&str]) -> String {
    match names.len() {
        ..=MOST_LISTED => names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", "),
        many => format!("{many} tables"),
    }
}

fn all(server: &Server, mut problems: Vec<Problem>) -> LogError {
    if problems.len() == 1 {
        return wrong(server, problems.remove(0));
    }
    let mut hints: Vec<String> = problems.iter().filter_map(|problem| problem.hint.clone()).collect();
    hints.dedup();
    let codes = problems.iter().map(|problem| problem.code).collect();
    let problems = problems.into_iter().map(|problem| readable(problem.what)).collect();
    LogError::destination(
        server.place.as_str(),
        TableSchemaMessage::Several { problems, codes, advice: hints.join("; ") },
    )
}
