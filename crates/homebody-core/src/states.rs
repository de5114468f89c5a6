//! Words of states: one table for the readers of logs and for all that is measured of them.
//!
//! Sensors say `ON`, `No motion`, `geschlossen`, `UNOCC` or `有人`. Each of these words stands here once, with its meaning. Case, accents,
//! blanks, `_` and `-` make no difference. Words for what a sensor is of may stand before a state, as in `Zone Open` and `is closed`, and
//! a word of negation turns it round, as in `keine Bewegung`.

use crate::names::words;
use crate::vocabulary::in_ascii;

/// The meaning of what a sensor said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Says {
    /// Something began: a movement, a press, a use.
    Begins,
    /// Something is over.
    Ends,
    /// A door, a drawer or a window is opened.
    Opens,
    /// It is closed.
    Closes,
    /// The state is not known: the sensor may still be on or not.
    Unknown,
    /// A number, or a word that is not known.
    Else,
}

impl Says {
    /// Whether something begins, ends, is opened or closed.
    pub fn is_sign(self) -> bool {
        !matches!(self, Says::Unknown | Says::Else)
    }

    /// Whether something is on from here, and open.
    pub fn is_on(self) -> bool {
        matches!(self, Says::Begins | Says::Opens)
    }

    /// Whether something is over or closed.
    pub fn is_off(self) -> bool {
        matches!(self, Says::Ends | Says::Closes)
    }

    fn opposite(self) -> Says {
        match self {
            Says::Begins => Says::Ends,
            Says::Ends => Says::Begins,
            Says::Opens => Says::Closes,
            Says::Closes => Says::Opens,
            other => other,
        }
    }
}

/// The words of states, in small letters without accents; several words are joined.
const WORDS: [(Says, &str); 5] = [
    (
        Says::Begins,
        "on fire fired true 1 present presence detected detection occupied occ motion movement moving in woke seen playing active \
        activated triggered trigger tripped alarm alert yes pressed push pushed started start begin begins running taken busy pir \
        an ein aktiv aktiviert ja besetzt belegt anwesend anwesenheit bewegung erkannt ausgelost ausgeloest gedruckt gedrueckt \
        allume allumee marche actif active oui occupe occupee present presente mouvement detecte detectee declenche declenchee \
        acceso accesa attivo attiva si occupato occupata presente presenza movimento rilevato rilevata rilevamento \
        encendido encendida activo activa activado activada ocupado ocupada movimiento detectado detectada presencia \
        ligado ligada ativo ativa sim presenca \
        aan actief bezet aanwezig beweging gedetecteerd \
        pa aktiverad upptagen narvarande narvaro rorelse detekterad \
        til tilstede aktivert aktiveret opptatt optaget bevegelse bevægelse oppdaget registreret taendt tændt \
        wlaczony wlaczone wlaczona wl aktywny aktywna aktywne tak zajete zajety obecny obecnosc ruch ruchu wykryto wykryty \
        zapnuto zapnuty aktivni ano obsazeno pritomen pritomnost pohyb pohybu detekovano \
        paalla kylla liike liiketta havaittu varattu lasna \
        вкл включено включен включена активен активно да занято присутствие движение движения обнаружено обнаружен сработал \
        开 開 开启 開啟 有人 有人移动 有人在 检测到 检测到移动 检测到人 检测到运动 触发 移动 是 \
        オン 在室 検知 検出 あり 動き検知 人感検知 はい",
    ),
    (
        Says::Ends,
        "off false 0 absent absence clear cleared unoccupied unocc vacant idle out slept paused standby inactive deactivated rest \
        still quiet normal no untriggered restored restore released stopped stop ended end nobody nomotion nomovement \
        aus inaktiv deaktiviert nein frei leer abwesend ruhe ruhig losgelassen \
        eteint eteinte arret inactif inactive non libre inoccupe inoccupee repos calme rien \
        spento spenta inattivo inattiva libero libera assente assenza riposo quiete \
        apagado apagada inactivo inactiva desactivado desocupado ausente ausencia reposo \
        desligado desligada inativo inativa nao livre repouso \
        uit inactief nee vrij afwezig rust \
        av inaktiv nej ledig franvarande franvaro fran stilla \
        fra nei inaktivt fravaerende fraværende fravaer fravær ro slukket \
        wylaczony wylaczone wylaczona wyl nieaktywny nieaktywna nieaktywne nie wolne wolny nieobecny spokoj brak \
        vypnuto vypnuty neaktivni ne volno nepritomen klid \
        pois ei vapaa poissa lepo \
        выкл выключено выключен выключена неактивен неактивно нет свободно отсутствие покой тихо норма \
        关 關 关 关闭状态 無人 无人 没人 静止 未检测到 无人移动 正常 否 \
        オフ 不在 未検知 未検出 なし 静止 いいえ",
    ),
    (
        Says::Opens,
        "open opened opening ajar \
        offen geoffnet geoeffnet auf ouvert ouverte ouverture aperto aperta apertura abierto abierta aberto aberta geopend \
        oppen oppet oppnad apen apent åben åbent aben abent otwarte otwarty otwarta otevreno otevreny otevrene auki avoinna \
        открыто открыт открыта открыты 打开 打開 已打开 开门 開門 開く 開いた 開放",
    ),
    (
        Says::Closes,
        "close closed closing shut \
        zu geschlossen ferme fermee fermeture chiuso chiusa chiusura cerrado cerrada fechado fechada dicht gesloten \
        stangd stangt lukket lukke zamkniete zamkniety zamknieta zavreno zavreny zavrene kiinni suljettu \
        закрыто закрыт закрыта закрыты 关闭 關閉 已关闭 关门 關門 閉 閉じた 閉鎖",
    ),
    (
        Says::Unknown,
        "unavailable unknown none null nan na n/a undefined undef uninit uninitialized offline disconnected notconnected unreachable \
        notavailable nodata nosignal lost error err fault failed failure invalid missing timeout stale dead \
        unbekannt nichtverfugbar nichterreichbar getrennt fehler inconnu indisponible horsligne erreur desconocido nodisponible \
        desconectado sconosciuto nondisponibile disconnesso errore onbekend nietbeschikbaar okand ukjent \
        desconhecido indisponivel nieznany niedostepny neznamy nedostupny неизвестно недоступно офлайн 未知 离线 離線 不可用 不明",
    ),
];

/// Words that may come before a state: its subject, and forms of "be".
const BEFORE: &str = "is was are has been now state status zone sensor door window contact motion movement person occupancy presence \
    ist wurde tur fenster kontakt bewegung est porte fenetre mouvement e la puerta ventana esta movimiento contacto is deur raam \
    kontakti ovi dorr";

/// Words that turn a state round.
const NOT: &str = "no not non kein keine keinen nicht pas aucun aucune sans ne nessun nessuna senza sin ningun ninguna sem nenhum nenhuma \
    nao geen niet ingen inget ikke ej ei brak nie bez zadny zadna нет не 无 無 未 没有";

/// Largest number of letters of a state.
const LONGEST: usize = 40;

/// Largest number of words of a state.
const MOST_WORDS: usize = 5;

/// The meaning of a value.
pub fn says(value: &str) -> Says {
    let value = value.trim();
    // Nearly all values are numbers or one of these.
    match value.as_bytes() {
        b"" | b"-" | b"--" | b"---" | b"?" => return Says::Unknown,
        b"ON" | b"on" | b"1" => return Says::Begins,
        b"OFF" | b"off" | b"0" => return Says::Ends,
        [b'0'..=b'9' | b'+' | b'-' | b'.', ..] => return Says::Else,
        long if long.len() > LONGEST => return Says::Else,
        _ => {}
    }
    if let Some(says) = known(&in_ascii(&value.to_lowercase(), false)) {
        return says;
    }
    let words: Vec<String> = words(value).iter().map(|word| in_ascii(word, false)).collect();
    if words.len() > MOST_WORDS { Says::Else } else { of_words(&words) }
}

fn of_words(words: &[String]) -> Says {
    let Some(first) = words.first() else { return Says::Else };
    if let Some(says) = known(&words.concat()) {
        return says;
    }
    match &words[1..] {
        [] => Says::Else,
        rest if has(NOT, first) => of_words(rest).opposite(),
        rest if has(BEFORE, first) => of_words(rest),
        _ => Says::Else,
    }
}

fn known(word: &str) -> Option<Says> {
    WORDS.iter().find(|(_, words)| has(words, word)).map(|(says, _)| *says)
}

fn has(words: &str, word: &str) -> bool {
    words.split_ascii_whitespace().any(|known| known == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_are_known_in_any_language_and_in_whatever_way_they_are_written() {
        #[rustfmt::skip]
        let cases = [
            ("ON", "Off"), ("true", "FALSE"), ("1", "0"), ("active", "inactive"), ("Movement", "No movement"),
            ("Motion detected", "No motion"), ("motion", "noMotion"), ("motion", "no_motion"),
            ("detected", "Not detected"), ("Present", "No present"), ("OCC", "UNOCC"), ("Yes", "no"),
            ("alarm", "normal"), ("Triggered", "Idle"), ("EIN", "AUS"), ("an", "aus"), ("Bewegung", "keine Bewegung"),
            ("détection", "repos"), ("mouvement", "aucun mouvement"), ("movimiento", "sin movimiento"),
            ("movimento", "nessun movimento"), ("beweging", "geen beweging"), ("rörelse", "ingen rörelse"),
            ("bevegelse", "ingen bevegelse"), ("ruch", "brak ruchu"), ("pohyb", "klid"), ("движение", "нет движения"),
            ("有人", "无人"), ("开", "关"), ("オン", "オフ"),
        ];
        for (on, off) in cases {
            assert_eq!((says(on), says(off)), (Says::Begins, Says::Ends), "{on} {off}");
        }
        #[rustfmt::skip]
        let cases = [
            ("Open", "CLOSED"), ("is open", "is closed"), ("auf", "zu"), ("offen", "geschlossen"), ("ouvert", "Fermé"),
            ("Abierto", "cerrado"), ("aperto", "chiuso"), ("open", "dicht"), ("öppen", "stängd"), ("åpen", "lukket"),
            ("otwarte", "zamknięte"), ("打开", "关闭"), ("Door open", "not open"),
        ];
        for (open, closed) in cases {
            assert_eq!((says(open), says(closed)), (Says::Opens, Says::Closes), "{open} {closed}");
        }
        assert_eq!((says("Zone Open"), says("Zone Restored")), (Says::Opens, Says::Ends));
    }

    #[test]
    fn a_number_and_another_word_are_no_states() {
        #[rustfmt::skip]
        let cases = [
            "21.5", "01", "-5", "zone", "no zone", "not", "Kitchen", "light", "20:15",
            "the door was left open all night",
        ];
        for value in cases {
            assert_eq!(says(value), Says::Else, "{value}");
        }
    }

    #[test]
    fn words_for_no_state_say_that_it_is_unknown() {
        #[rustfmt::skip]
        let cases = [
            "", " ", "-", "--", "unavailable", "N/A", "None", "NULL", "NaN", "offline", "UNDEF", "UNINIT", "undef",
            "not available", "not_available", "disconnected", "lost", "error", "dead", "No data", "nicht verfügbar",
            "离线",
        ];
        for value in cases {
            assert_eq!(says(value), Says::Unknown, "{value:?}");
        }
        for value in ["online", "connected", "available", "-1", "errors today"] {
            assert_ne!(says(value), Says::Unknown, "{value:?}");
        }
    }

    #[test]
    fn no_word_has_two_meanings() {
        for (says, words) in &WORDS {
            for (other, others) in WORDS.iter().filter(|(other, _)| other != says) {
                let twice: Vec<&str> = words.split_ascii_whitespace().filter(|word| has(others, word)).collect();
                assert!(twice.is_empty(), "{says:?} {other:?}: {twice:?}");
            }
        }
    }
}
