//! Headings of tables, and what columns under them hold: one list of names for all readers.

use crate::log::ColumnRole;
use homebody_core::scenario::logger::LoggerFile;

/// The names of time, sensor and value that are certain, ours first; they are compared by letters and digits in lower case.
const TIMES: [&str; 9] =
    ["firedat", "time", "timestamp", "datetime", "lastchanged", "lastchangedts", "at", "ts", "createdat"];
const SENSORS: [&str; 9] =
    ["sensor", "device", "entityid", "sensorid", "deviceid", "item", "name", "code", "sensorname"];
const VALUES: [&str; 7] = ["value", "state", "message", "status", "event", "val", "reading"];
const LABELS: [&str; 3] = ["activity", "label", "activities"];

/// More names, in the languages of the plan importer, of what a column may be once its cells say so, too.
const OTHERS: [(ColumnRole, &[&str]); 11] = [
    (
        ColumnRole::Time,
        &[
            "date", "eventtime", "recordedat", "receivedat", "measuredat", "loggedat", "observedat", "start", "begin",
            "starttime", "utc", "utctime", "localtime", "tslocal", "epoch", "unix", "unixtime", "epochms", "when",
            "timeofday", "clock", "day", "zeit", "datum", "uhrzeit", "zeitstempel", "zeitpunkt", "datumzeit",
            "datumuhrzeit", "heure", "horodatage", "jour", "fecha", "hora", "fechahora", "data", "ora", "dataora",
            "tijd", "tijdstip", "lastupdated", "lastupdatedts", "resulttime", "phenomenontime", "sampledat",
        ],
    ),
    (
        ColumnRole::End,
        &[
            "endtime", "end", "stop", "stoptime", "endedat", "finish", "until", "to", "bis", "ende", "endzeit", "fin",
            "fine", "einde", "offtime", "dateend", "enddate", "tildato",
        ],
    ),
    (
        ColumnRole::Duration,
        &[
            "duration", "durations", "durationms", "durationmin", "durationsec", "durationseconds", "durationminutes",
            "length", "lengths", "dauer", "dauers", "duree", "duracion", "durata", "duur", "elapsed", "elapseds",
            "elapsedtime", "lasted", "lasteds",
        ],
    ),
    (
        ColumnRole::Sensor,
        &[
            "entity", "devicename", "friendlyname", "displayname", "thing", "node", "nodeid", "nodename", "geraet",
            "gerät", "geraete", "fuehler", "capteur", "appareil", "dispositivo", "sensore", "apparaat", "signal",
            "datapoint", "point", "channel", "topic", "itemname", "source", "mac", "addr", "address", "devicetype",
            "object", "objectid", "tag", "appliance",
        ],
    ),
    (
        ColumnRole::Value,
        &[
            "eventcode", "payload", "measurement", "result", "eventvalue", "sensorvalue", "sensorstate", "newstate",
            "newvalue", "action", "msg", "wert", "zustand", "messwert", "valeur", "etat", "état", "valor", "estado",
            "valore", "stato", "waarde", "toestand", "scaled", "scaledvalue", "info",
        ],
    ),
    (
        ColumnRole::Label,
        &[
            "roomactivity", "activityname", "activitytype", "aktivitaet", "aktivität", "activite", "activité",
            "actividad", "attivita",
        ],
    ),
    (
        ColumnRole::Home,
        &[
            "homeid", "home", "houseid", "house", "household", "householdid", "patientid", "patient", "subjectid",
            "subject", "participantid", "participant", "personid", "person", "residentid", "resident", "userid",
            "user", "clientid", "client", "apartment", "apartmentid", "dwelling", "dwellingid", "siteid", "site",
            "propertyid", "buildingid", "building", "flat", "flatid", "hid", "pid", "wohnung", "wohnungid", "haushalt",
            "haus", "bewohner", "proband", "foyer", "logement", "maison", "sujet", "vivienda", "hogar", "casa",
            "paciente", "sujeto", "abitazione", "paziente", "soggetto", "woning", "huis", "huishouden", "deelnemer",
            "residence", "residenceid", "homename", "housename", "tenant", "tenantid", "username",
        ],
    ),
    (
        ColumnRole::Kind,
        &[
            "kind", "type", "sensortype", "deviceclass", "category", "attribute", "property", "capability", "modality",
            "art", "typ", "tipo", "domain", "quantity", "measure", "observedproperty",
        ],
    ),
    (
        ColumnRole::Room,
        &[
            "room", "roomname", "location", "locationname", "place", "area", "areaname", "raum", "ort", "zimmer",
            "piece", "pièce", "habitacion", "habitación", "stanza", "locale", "kamer",
        ],
    ),
    (
        ColumnRole::Unit,
        &["unit", "units", "unitofmeasurement", "uom", "einheit", "unidad", "unite", "unité", "eenheid"],
    ),
    (
        ColumnRole::Unused,
        &["index", "unnamed0", "rowid", "rownumber", "id", "seq", "no", "nr", "record", "recordid", "nummer"],
    ),
];

/// Names of what a row tells of a device, where another column names the device.
pub(crate) const ATTRIBUTES: [&str; 30] = [
    "attribute", "capability", "property", "measurement", "measure", "quantity", "parameter", "metric", "variable",
    "characteristic", "observedproperty", "code", "dp", "dpid", "dpcode", "datapoint", "channel", "register", "point",
    "signal", "readingtype", "sensortype", "typeofreading", "messgroesse", "messgröße", "groesse", "größe", "grandeur",
    "grandezza", "magnitud",
];

/// Whether a heading is that of ids: numbers that name something and measure nothing.
pub(crate) fn is_id(heading: &str) -> bool {
    const WORDS: [&str; 12] =
        ["id", "ids", "no", "nr", "uuid", "serial", "identifiant", "identifier", "kennung", "ean", "prm", "key"];
    const ENDINGS: [&str; 9] =
        ["dataid", "deviceid", "sensorid", "entryid", "eventid", "recordid", "rowid", "accountid", "meterid"];
    let mut words = heading.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let is_word =
        |word: &str| WORDS.contains(&word.to_lowercase().as_str()) || word.ends_with("ID") || word.ends_with("Id");
    words.any(is_word) || ENDINGS.iter().any(|ending| plain(heading).ends_with(ending))
}

/// Whether a heading is that of remarks, which people write into some rows.
pub(crate) fn is_remark(heading: &str) -> bool {
    const NAMES: [&str; 15] = [
        "remark", "remarks", "note", "notes", "comment", "comments", "bemerkung", "bemerkungen", "kommentar", "notiz",
        "remarque", "remarques", "commentaire", "observaciones", "opmerking",
    ];
    NAMES.contains(&plain(heading).as_str())
}

pub(crate) fn is_price(heading: &str) -> bool {
    const WORDS: [&str; 13] = [
        "cost", "costs", "price", "prices", "kosten", "preis", "prix", "cout", "coût", "coste", "precio", "costo",
        "prezzo",
    ];
    let mut words = heading.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.any(|word| WORDS.contains(&word.to_lowercase().as_str()))
}

/// Whether a heading says that its clock is UTC's, as `Date/time UTC` and `utc_time` do.
pub(crate) fn is_of_utc(heading: &str) -> bool {
    let lower = heading.to_lowercase();
    let mut words = lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.clone().any(|word| matches!(word, "utc" | "utctime" | "timeutc" | "zulu"))
        && !words.any(|word| matches!(word, "offset" | "local"))
}

/// A heading by its letters and digits, in lower case: `Start Time` is `starttime`. A unit in brackets is left out.
pub(crate) fn plain(heading: &str) -> String {
    let without_unit = heading.split(['(', '[']).next().filter(|name| !name.trim().is_empty()).unwrap_or(heading);
    without_unit.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// The role of a column with this heading, and the rank of its name among those of the role: less is more certain.
pub(crate) fn role_of(heading: &str) -> Option<(ColumnRole, usize)> {
    let name = plain(heading);
    let certain: [(ColumnRole, &[&str]); 4] = [
        (ColumnRole::Time, &TIMES),
        (ColumnRole::Sensor, &SENSORS),
        (ColumnRole::Value, &VALUES),
        (ColumnRole::Label, &LABELS),
    ];
    let find = |lists: &[(ColumnRole, &[&str])], after: usize| {
        lists
            .iter()
            .find_map(|(role, names)| names.iter().position(|known| *known == name).map(|rank| (*role, after + rank)))
    };
    find(&certain, 0).or_else(|| find(&OTHERS, CERTAIN))
}

/// The ranks of names that are certain are below this.
pub(crate) const CERTAIN: usize = 100;

/// Whether a sensor's heading can mean nothing else: `name` and `code` can.
pub(crate) fn is_certain_sensor(heading: &str) -> bool {
    matches!(plain(heading).as_str(), "sensor" | "device" | "entityid" | "sensorid" | "deviceid" | "sensorname")
}

/// The places of a row's time, sensor and value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColumnPlaces {
    /// The column of the time.
    pub time: usize,
    /// That of the sensor.
    pub sensor: usize,
    /// That of what it said.
    pub value: usize,
    /// The column of activities, if the rows have them.
    pub label: Option<usize>,
    /// Whether the columns have the names of the mapping: then cells keep the blanks at their ends.
    pub is_mapped: bool,
}

impl ColumnPlaces {
    /// By the names of a mapping or, failing them, the usual ones.
    pub fn by_name(names: &[String], file: &LoggerFile) -> Option<ColumnPlaces> {
        let exactly = |wanted: &str| names.iter().position(|name| name == wanted);
        let plain_names: Vec<String> = names.iter().map(|name| plain(name)).collect();
        let usual =
            |wanted: &[&str]| wanted.iter().find_map(|wanted| plain_names.iter().position(|name| name == wanted));
        let columns = &file.columns;
        let label = usual(&LABELS);
        let mapped = || {
            Some(ColumnPlaces {
                time: exactly(&columns.time)?,
                sensor: exactly(&columns.sensor)?,
                value: exactly(&columns.value)?,
                label,
                is_mapped: true,
            })
        };
        let guessed = || {
            let (time, sensor, value) = (usual(&TIMES)?, usual(&SENSORS)?, usual(&VALUES)?);
            Some(ColumnPlaces { time, sensor, value, label, is_mapped: false })
        };
        mapped().or_else(guessed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_compared_by_their_letters() {
        for (heading, role) in [
            ("Time", Some(ColumnRole::Time)),
            ("last_changed", Some(ColumnRole::Time)),
            ("Start Time", Some(ColumnRole::Time)),
            ("Sensor-ID", Some(ColumnRole::Sensor)),
            ("Temperature [°C]", None),
            ("Room|Activity", Some(ColumnRole::Label)),
            ("home_id", Some(ColumnRole::Home)),
            ("patientId", Some(ColumnRole::Home)),
            ("Dauer (s)", Some(ColumnRole::Duration)),
            ("Unnamed: 0", Some(ColumnRole::Unused)),
            ("hall", None),
            ("", None),
        ] {
            assert_eq!(role_of(heading).map(|(role, _)| role), role, "{heading}");
        }
        assert!(role_of("sensor").unwrap().1 < role_of("name").unwrap().1);
    }
}
