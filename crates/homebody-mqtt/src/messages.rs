//! The messages of this crate.

homebody_core::messages! {
    /// Problems with the URL of a broker.
    pub(crate) enum AddressMessage in "mqtt-url" {
        /// Commands end up in histories and in lists of processes, which others can read.
        Password error "password" ("the URL of a broker has a password in it, where others can read it")
            hint ("remove the password, and add ?password-file=FILE to the URL or set HOMEBODY_MQTT_PASSWORD");
        /// The host is the part between `//` (or `@`) and `/`:
        ///
        /// ```text
        /// mqtt://localhost/homebody
        /// ```
        NoHost error "no-host" ("the URL of a broker has no host")
            hint ("write mqtt://HOST/PREFIX, such as mqtt://localhost/homebody");
        /// Brokers listen on port 1883, and on 8883 with TLS, unless configured otherwise.
        Port { usual: u16 } error "port" ("the port of the broker is not a number from 1 to 65535")
            hint ("write a number in this range, or leave the port out for {usual}");
        /// Homebody publishes below this topic. Spaces, `+` and `#` have a meaning for brokers, so topics consist of plain characters.
        Topic { name: String, text: String, most_levels: usize, longest_level: usize }
            error "topic" ("{name} {text:?} is not a valid topic")
            hint ("write up to {most_levels} levels of a-z, A-Z, 0-9, _ and -, each of up to {longest_level} characters, separated by /");
        /// In a URL, `%` and two hexadecimal digits are one byte, such as `%40` for `@`.
        Percent { name: String } error "percent" ("{name} has a % without two hexadecimal digits after it")
            hint ("write %25 for a %");
        /// This parameter accepts a few words.
        Word { name: String, value: String, known: String }
            error "unknown-value" ("{name} cannot be {value}") hint ("write {known}");
        /// This parameter is switched on or off.
        NotBoolean { name: String, value: String }
            error "not-boolean" ("{name}={value} is neither true nor false") hint ("write {name}=true or {name}=false");
        /// Home Assistant shows a motion sensor as off so many seconds after its last message.
        OffDelay { value: String }
            error "off-delay" ("off-delay={value} is not a number of seconds from 1 to 3600") hint ("write a number of seconds, such as off-delay=10");
        /// The parameter needs the path of a file.
        NoFile { name: String } error "no-file" ("{name} names no file") hint ("write {name}=FILE");
        /// docs/reference/mqtt.md lists the parameters of the URL.
        Unknown { name: String, known: Vec<&'static str> }
            error "unknown-parameter" ("there is no parameter {name:?}")
            hint ("the parameters are {known}", known = known.join(", "));
        /// Only a connection with TLS has certificates.
        CaWithoutTls error "ca-without-tls" ("\"ca\" names certificates, but a connection by mqtt:// does not use TLS")
            hint ("write mqtts:// to use TLS, or remove \"ca\"");
        /// A broker checks a password together with the name of a user.
        NoUser error "no-user" ("a password is set, but the URL names no user") hint ("write mqtt://USER@HOST/PREFIX");
        /// Discovery describes sensors to Home Assistant, which does not read the messages of the style `plain`.
        PlainDiscovery error "plain-discovery" ("\"discovery\" does not work with \"style=plain\"")
            hint ("remove \"discovery\", or write style=homeassistant");
        /// Home Assistant would take the messages of the sensors for descriptions of devices.
        DiscoveryPrefix { prefix: String }
            error "discovery-prefix" ("the prefix {prefix:?} is the one where Home Assistant looks for devices")
            hint ("name another prefix, such as homebody");
        /// A broker passes messages on as they happen, so a run that is faster than real time would flood its subscribers.
        TooFast { place: String }
            error "too-fast" ("{place} gets messages as they happen, and this run is faster than real time")
            hint ("pass --speed 1 to run in real time, or add ?allow-fast=true to the URL");
        /// Other users of this machine could read the password.
        OpenPassword { file: String } error "open-password" ("other users can read {file}, which has a password")
            hint ("chmod 600 {file}");
        /// The system does not open the file with the password.
        PasswordFile { file: String, reason: String }
            error "password-file" ("cannot read {file}: {reason}")
            hint ("correct the path; it starts from the folder in which the program was started");
    }
}

homebody_core::messages! {
    /// Problems with a broker.
    pub(crate) enum BrokerMessage in "mqtt" {
        /// The connection was closed in order, and nothing more can be sent on it.
        Ended error "ended" ("the connection has ended");
        /// Two runs that publish the same home below one prefix would mix their messages.
        AnotherRun error "another-run" ("another program has begun to publish this home below this prefix")
            hint ("stop one of them, or give each its own prefix");
        /// The broker is connected, and confirms no message. Homebody sends the unconfirmed messages again later.
        Silent { seconds: u64 }
            error "no-acknowledgement" ("the broker has not acknowledged a message for {seconds} s")
            hint ("check whether the broker is overloaded, or its disk is full");
        /// The broker does not speak TLS on this port, or does not accept the connection.
        Tls { reason: String } error "tls" ("cannot connect with TLS: {reason}")
            hint ("check the port, or write mqtt:// to connect without TLS, often on port 1883");
        /// Homebody checks the certificate of the broker against the certificates of this system, or of `?ca=FILE`.
        Untrusted { reason: String } error "untrusted" ("cannot trust the broker: {reason}")
            hint ("name the certificates to trust with ?ca=FILE, in PEM");
        /// A firewall drops the packets, or the host is switched off.
        NoAnswer error "no-answer" ("the broker does not answer")
            hint ("check the host, the port and the firewalls between");
        /// The connection broke while Homebody was sending.
        Lost { reason: String } error "connection-lost" ("the connection was lost: {reason}")
            hint ("see the log of the broker for the reason");
        /// The broker knows no such user, or the password is wrong.
        Login error "login" ("the broker rejects this user: the name or the password is wrong or missing")
            hint ("write mqtt://USER@HOST/PREFIX, with the password in ?password-file=FILE or HOMEBODY_MQTT_PASSWORD");
        /// Homebody speaks MQTT 5, which brokers have had since about 2020.
        Version error "version" ("the broker does not speak MQTT 5")
            hint ("use a newer broker, such as mosquitto 1.6 or later");
        /// The broker answers with this code instead of accepting the connection.
        Refused { code: String } error "refused" ("the broker does not accept the connection: {code}")
            hint ("see the log of the broker for the reason");
        /// Access lists of the broker say which user may publish where.
        NotAuthorized error "not-authorized" ("the broker does not let this user write here")
            hint ("change the broker's access list");
        /// The broker closes the connection with this code.
        SentAway { code: String } error "disconnected" ("the broker has ended the connection: {code}")
            hint ("see the log of the broker for the reason");
        /// Certificates are valid for some time and must be renewed.
        Expired error "certificate-expired" ("the certificate of the broker has expired")
            hint ("renew it, or set the clock of this machine if that is wrong");
        /// Certificates are valid from a date on.
        NotYetValid error "certificate-not-yet-valid" ("the certificate of the broker is not valid yet")
            hint ("check the clock of this machine");
        /// The authority that has signed the certificate is unknown to this system.
        UnknownIssuer error "unknown-issuer" ("nothing on this machine trusts the issuer of the broker's certificate")
            hint ("name the certificate of the issuer with ?ca=FILE");
        /// A certificate is valid for the names in it.
        OtherName error "certificate-name" ("the certificate of the broker is for another name")
            hint ("write the name of the host that the certificate has");
        /// The certificate cannot be checked for this reason.
        Certificate { reason: String } error "certificate" ("the certificate of the broker is not valid: {reason}")
            hint ("name the certificates to trust with ?ca=FILE");
        /// The broker ends the connection without a word. A port for TLS does so when it is addressed without TLS.
        Closed error "closed" ("the broker has closed the connection")
            hint ("see the log of the broker for the reason; if the port uses TLS, write mqtts://");
        /// No program listens on this port of the host.
        NoBroker error "no-broker" ("no broker listens on this host and port")
            hint ("start the broker, or correct host and port");
        /// The network has no route to the host.
        Unreachable error "unreachable" ("the host cannot be reached")
            hint ("check the host and the network");
        /// The name of the host has no address.
        UnknownHost { reason: String } error "unknown-host" ("cannot find the host: {reason}")
            hint ("correct the name of the host");
        /// The system reports this error of the network.
        Network { reason: String } error "network" ("{reason}") hint ("check host and port");
        /// Each connection needs a few open files of the system.
        NoRuntime { reason: String } error "no-resources" ("cannot start the connection: {reason}")
            hint ("allow this user more open files (ulimit -n)");
        /// Access lists of the broker say which user may publish where.
        NotTaken { base: String, code: String }
            error "publish-denied" ("the broker does not accept messages below {base}: {code}")
            hint ("let this user write there, in the broker's access list");
        /// Without a user, every person on the internet could read the home, and give it commands.
        Public error "public" ("the broker is on the internet and asks for no user, so any person could read and control the home")
            hint ("name a user in the URL, or add ?public=true to allow this");
        /// A broker passes on messages of sensors. A ground truth has several tables, and none of its rows is a message.
        RowsOnly error "rows-only" ("anything but the rows of a log")
            hint ("write the truth to a database or files");
        /// The program that uses this destination hands over rows of another table.
        OtherRow error "other-row" ("a row does not belong to the table of the log")
            hint ("pass rows of the table of the log to this destination");
        /// Each message is published on the topic of its sensor.
        NoSensor error "no-sensor" ("a row names no sensor")
            hint ("hand over the rows of the log's table");
        /// Each message is published on the topic of its sensor, and the run declares its sensors at its start.
        UnknownSensor { sensor: String } error "unknown-sensor" ("a row names the sensor {sensor:?}, which the run does not have")
            hint ("hand over rows of the sensors that the run has declared");
    }
}

/// The messages of this crate, by area.
pub const MESSAGES: &[&[homebody_core::messages::CatalogueEntry]] = &[
    <AddressMessage as homebody_core::messages::Catalogue>::ENTRIES,
    <BrokerMessage as homebody_core::messages::Catalogue>::ENTRIES,
];
