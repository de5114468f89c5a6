//! The home or person whose rows are read of a text of JSON: the one that is asked for, or else the only one.

use super::above::Above;
use super::said::text;
use crate::error::LogError;
use crate::limits::beginning;
use crate::log::ColumnRole;
use crate::source::columns::{plain, role_of};
use crate::source::gathered::Gathered;
use crate::source::messages::TableMessage;
use serde_json::Value;
use std::collections::BTreeSet;

/// Names of columns of homes and persons that are keys of something else in objects, such as the user who turns a lock.
const NO_HOMES: [&str; 9] = ["user", "username", "client", "clientid", "site", "hid", "pid", "propertyid", "casa"];

/// So many homes are named.
const NAMED: usize = 10;

#[derive(Default)]
pub(crate) struct OneHome {
    first: Option<String>,
    /// The others that have come next to the one that is asked for, and whether that has.
    others: BTreeSet<String>,
    has_asked: bool,
}

impl OneHome {
    /// Whether a row is read: of the home that is asked for, or else of the only one. Refuses rows of a second home or person.
    pub fn admit(
        &mut self,
        members: &[(String, &Value)],
        above: &Above,
        out: &mut Gathered<'_, '_>,
    ) -> Result<bool, LogError> {
        let asked = out.reading.options.home.clone();
        let is_key = |name: &str| asked.as_ref().map_or(is_home(name), |asked| asked.column == name);
        let own = members.iter().find(|(name, said)| is_key(name) && !said.is_null());
        let named = own.map(|(name, said)| (name.as_str(), *said)).or_else(|| above.member(&is_key));
        let Some((key, said)) = named.filter(|(_, said)| said.is_string() || said.is_number()) else {
            return Ok(asked.is_none_or(|asked| asked.home.is_none_or(|home| home == "*")));
        };
        let home = text(said);
        if let Some(wanted) = asked.and_then(|asked| asked.home) {
            out.column(key, ColumnRole::Home, "--home-column names it");
            let is_asked = wanted == "*" || wanted == home;
            self.has_asked |= is_asked;
            if !is_asked && self.others.len() < NAMED {
                self.others.insert(home.into_owned());
            }
            return Ok(is_asked);
        }
        match &self.first {
            None => {
                out.column(key, ColumnRole::Home, "its key; all rows are of one");
                self.first = Some(home.into_owned());
                Ok(true)
            }
            Some(first) if *first == home => Ok(true),
            Some(first) => Err(out.refused(TableMessage::SeveralHomes {
                column: format!("the key {key:?}"),
                homes: format!("{}, {} ...", beginning(first), beginning(&home)),
                key: key.to_owned(),
                first: first.clone(),
            })),
        }
    }

    /// Refuses a text without a row of the home that was asked for.
    pub fn end(&self, out: &Gathered<'_, '_>) -> Result<(), LogError> {
        let Some(asked) = &out.reading.options.home else { return Ok(()) };
        match asked.home.as_deref() {
            None | Some("*") => Ok(()),
            Some(_) if self.has_asked => Ok(()),
            Some(home) => {
                let homes = self.others.iter().map(|home| beginning(home)).collect();
                let column = format!("the key {:?}", asked.column);
                Err(out.refused(TableMessage::NoSuchHome { column, home: beginning(home), homes }))
            }
        }
    }
}

/// Whether a key names the home or the person of a row.
pub(crate) fn is_home(key: &str) -> bool {
    role_of(key).is_some_and(|(role, _)| role == ColumnRole::Home) && !NO_HOMES.contains(&plain(key).as_str())
}
