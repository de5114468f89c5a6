//! Checks a broker as a destination of logs: the connection, the end of its certificate, the rights to write and read below the prefix,
//! and the retained messages of our homes. The only message that it sends, if it may write, is not retained.

use crate::address::BrokerAddress;
use crate::certificate::last_day;
use crate::clean::{RetainedTopics, kept, ours};
use crate::trouble::BrokerError;
use crate::visit::{lost, visit};
use homebody_core::problem::counted;
use homebody_log::examine::{Check, CheckOptions, is_this_machine};
use homebody_log::{LogError, Url};
use jiff::Timestamp;
use rumqttc::{AsyncClient, Event, EventLoop, Packet, PubAckReason, PublishOptions, QoS};
use std::time::Duration;
use tokio::time::{Instant, timeout_at};

/// Time within which a sent message has to return (our choice).
const COMES_BACK: Duration = Duration::from_secs(3);

/// Days of remaining validity below which a certificate causes a warning (our choice).
const SOON_DAYS: i64 = 30;

/// Largest number of topics that are named (our choice).
const MOST_NAMED: usize = 5;

pub(crate) fn examine(url: &Url, asked: &CheckOptions) -> Result<Vec<Check>, LogError> {
    let address = BrokerAddress::from_url(url)?;
    let mut checks = Vec::new();
    if address.tls {
        certificate(&address, &mut checks);
    }
    let said = visit(&address, "doctor", async |client, events| {
        let kept = kept(&address, client, events).await?;
        let heard = match asked.may_write {
            true => Some(said_and_heard(&address, client, events).await?),
            false => None,
        };
        Ok((kept, heard))
    });
    match said? {
        Err(trouble) => checks.push(Check::of_error("broker", &trouble.error(&address.place()))),
        Ok((kept, heard)) => report(&address, kept, heard, &mut checks),
    }
    Ok(checks)
}

/// Checks the broker's certificate before all else.
fn certificate(address: &BrokerAddress, checks: &mut Vec<Check>) {
    let now = Timestamp::now();
    match last_day(&address.host, address.port) {
        Ok(last) => {
            let days = last.duration_since(now).as_hours().div_euclid(24);
            let on = last.strftime("%Y-%m-%d");
            checks.push(match days {
                ..0 => Check::wrong("certificate", format!("it expired on {on}"), "renew it, and restart the broker"),
                0..SOON_DAYS => {
                    let says = format!("it expires on {on}, in {}", counted(days as usize, "day", "days"));
                    Check::warning("certificate", says, "renew it before that day, and restart the broker")
                }
                _ => Check::ok("certificate", format!("it is valid until {on}")),
            });
        }
        Err(why) => checks.push(Check::warning(
            "certificate",
            format!("cannot read it: {why}"),
            "check that the port has TLS; brokers use 8883 for it",
        )),
    }
}

struct EchoResult {
    refused: Option<PubAckReason>,
    came_back: bool,
}

/// Sends a message below the prefix that is not retained, and waits until it comes back.
async fn said_and_heard(
    address: &BrokerAddress,
    client: &AsyncClient,
    events: &mut EventLoop,
) -> Result<EchoResult, BrokerError> {
    let topic = format!("{}/-doctor", address.prefix);
    let payload = crate::connection::instance();
    let options = PublishOptions::new(QoS::AtLeastOnce);
    client.publish(topic.clone(), payload.clone().into_bytes(), options).await.map_err(lost)?;
    let end = Instant::now() + COMES_BACK;
    let (mut taken, mut came_back) = (None, false);
    while taken.is_none() || !came_back {
        let Ok(event) = timeout_at(end, events.poll()).await else { break };
        match event.map_err(|error| BrokerError::from_connection(&error))? {
            Event::Incoming(Packet::PubAck(ack)) => {
                taken = Some(ack.reason);
                if !matches!(ack.reason, PubAckReason::Success | PubAckReason::NoMatchingSubscribers) {
                    return Ok(EchoResult { refused: taken, came_back: false });
                }
            }
            Event::Incoming(Packet::Publish(publish)) => came_back |= *publish.payload == *payload.as_bytes(),
            _ => {}
        }
    }
    match taken {
        Some(_) => Ok(EchoResult { refused: None, came_back }),
        None => Err(BrokerError::silent(COMES_BACK)),
    }
}

fn report(address: &BrokerAddress, kept: RetainedTopics, heard: Option<EchoResult>, checks: &mut Vec<Check>) {
    let who = address.user.as_ref().map_or_else(|| "any user".to_owned(), |user| format!("{user:?}"));
    let how = if address.tls { "over TLS" } else { "without encryption" };
    checks.push(Check::ok("broker", format!("{} speaks MQTT 5 and accepts {who}, {how}", address.place())));
    if !address.tls && !is_this_machine(&address.host) {
        let says = "messages and the password cross the network unencrypted";
        checks.push(Check::warning("encryption", says, "write mqtts:// if the broker has TLS"));
    }
    let below = &address.prefix;
    for filter in &kept.refused {
        let says = format!("this user may not subscribe to {filter}");
        checks.push(Check::wrong(
            "hearing",
            says,
            "change the broker's access list: commands and marks of homes arrive there",
        ));
    }
    checks.push(match heard {
        Some(EchoResult { refused: Some(reason), .. }) => {
            let says = format!("this user may not publish below {below}/: {reason:?}");
            Check::wrong("speaking", says, "let this user write there, in the broker's access list")
        }
        Some(EchoResult { came_back: false, .. }) => {
            let says = format!("a test message below {below}/ did not arrive, so this user may not subscribe there");
            Check::wrong("speaking", says, "let this user read there, too, in the broker's access list")
        }
        Some(_) => Check::ok("speaking", format!("a test message below {below}/ arrived")),
        None => Check::ok(
            "speaking",
            format!("not tried: --write publishes a test message below {below}/, which the broker does not keep"),
        ),
    });
    let found = ours(address, kept.found);
    checks.push(match (&found.homes[..], found.topics.len()) {
        ([], 0) => Check::ok("kept", format!("the broker keeps nothing of Homebody below {below}/")),
        (homes, topics) => {
            let named = homes.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join(", ");
            let more = if homes.len() > MOST_NAMED { " and more" } else { "" };
            let says = format!(
                "{} of {} are kept: {named}{more}",
                counted(topics, "topic", "topics"),
                counted(homes.len(), "home", "homes")
            );
            let hint = "homebody mqtt clean removes them; running homes publish them again";
            Check::warning("kept", says, hint)
        }
    });
}
