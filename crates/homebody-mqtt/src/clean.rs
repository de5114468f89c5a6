//! Removes the retained messages of Homebody's homes below a prefix from a broker, with their discovery messages for Home Assistant.

use crate::address::BrokerAddress;
use crate::greeting::PROGRAM;
use crate::names::end_of_ids;
use crate::trouble::BrokerError;
use crate::visit::{lost, visit};
use homebody_log::{LogError, Url};
use rumqttc::{AsyncClient, Event, EventLoop, Packet, PublishOptions, QoS, SubscribeReasonCode};
use serde_json::Value;
use std::collections::BTreeSet;
use std::time::Duration;
use tokio::time::{Instant, timeout_at};

/// Silence after which a broker has sent all its retained messages (our choice): it sends them on request.
const QUIET: Duration = Duration::from_millis(700);

/// Longest time that a broker takes to send its retained messages, or to delete them (our choice).
const LONGEST: Duration = Duration::from_secs(60);

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cleaned {
    pub homes: Vec<String>,
    pub topics: Vec<String>,
    /// Topics below the prefix that are of no home of ours: they stay.
    pub others: usize,
}

/// Removes the retained messages of our homes below the prefix of a place. With `only_look` it lists them and keeps them.
pub fn clean(url: &Url, only_look: bool) -> Result<Cleaned, LogError> {
    let address = BrokerAddress::from_url(url)?;
    let cleaned = visit(&address, "clean", async |client, events| {
        let cleaned = ours(&address, kept(&address, client, events).await?.found);
        if !only_look {
            remove(client, events, &cleaned.topics).await?;
        }
        Ok(cleaned)
    });
    cleaned?.map_err(|trouble| trouble.error(&address.place()))
}

#[derive(Default)]
pub(crate) struct RetainedTopics {
    pub found: Vec<(String, Vec<u8>)>,
    pub refused: Vec<String>,
}

/// Reads the retained messages that may be ours.
pub(crate) async fn kept(
    address: &BrokerAddress,
    client: &AsyncClient,
    events: &mut EventLoop,
) -> Result<RetainedTopics, BrokerError> {
    let BrokerAddress { prefix, discovery_prefix, .. } = address;
    let filters = [format!("{prefix}/#"), format!("{discovery_prefix}/+/+/config")];
    for filter in &filters {
        client.subscribe(filter.clone(), QoS::AtLeastOnce).await.map_err(lost)?;
    }
    let mut kept = RetainedTopics::default();
    let mut quiet = None;
    let end = Instant::now() + LONGEST;
    let mut answered = 0;
    while let Ok(event) = timeout_at(quiet.unwrap_or(end), events.poll()).await {
        match event.map_err(|error| BrokerError::from_connection(&error))? {
            Event::Incoming(Packet::SubAck(ack)) => {
                // Answers come in the order of the subscriptions.
                if !ack.return_codes.iter().all(|code| matches!(code, SubscribeReasonCode::Success(_))) {
                    kept.refused.extend(filters.get(answered).cloned());
                }
                answered += 1;
            }
            Event::Incoming(Packet::Publish(publish)) if publish.retain => {
                kept.found.push((String::from_utf8_lossy(&publish.topic).into_owned(), publish.payload.to_vec()));
            }
            _ => {}
        }
        quiet = (answered == filters.len()).then(|| Instant::now() + QUIET).map(|at| at.min(end));
    }
    Ok(kept)
}

/// Which of them are of homes of ours: those below a topic whose `run` has our mark, and what names one in discovery.
pub(crate) fn ours(address: &BrokerAddress, kept: Vec<(String, Vec<u8>)>) -> Cleaned {
    let below = format!("{}/", address.prefix);
    let homes: BTreeSet<String> = kept
        .iter()
        .filter(|(_, payload)| {
            let mark: Option<Value> = serde_json::from_slice(payload).ok();
            mark.is_some_and(|mark| mark.get("program").and_then(Value::as_str) == Some(PROGRAM))
        })
        .filter_map(|(topic, _)| topic.strip_suffix("/run").filter(|home| home.starts_with(&below)).map(str::to_owned))
        .collect();
    let end = end_of_ids(&address.prefix);
    let is_ours = |topic: &str| match topic
        .strip_prefix(&address.discovery_prefix)
        .and_then(|rest| rest.strip_suffix("/config"))
    {
        Some(rest) => rest.rsplit('/').next().is_some_and(|id| id.ends_with(&end)),
        None => homes.iter().any(|home| topic.strip_prefix(home.as_str()).is_some_and(|rest| rest.starts_with('/'))),
    };
    let (mut topics, others): (Vec<String>, Vec<String>) =
        kept.into_iter().map(|(topic, _)| topic).partition(|topic| is_ours(topic));
    // The marks go last, so that a program that was killed on the way finds the rest again.
    topics.sort_by_key(|topic| (topic.ends_with("/run"), topic.clone()));
    topics.dedup();
    let others = others.iter().filter(|topic| topic.starts_with(&below)).count();
    Cleaned { homes: homes.into_iter().collect(), topics, others }
}

async fn remove(client: &AsyncClient, events: &mut EventLoop, topics: &[String]) -> Result<(), BrokerError> {
    let end = Instant::now() + LONGEST;
    for topic in topics {
        client
            .publish(topic.clone(), Vec::new(), PublishOptions::new(QoS::AtLeastOnce).retained())
            .await
            .map_err(lost)?;
        loop {
            let event = timeout_at(end, events.poll()).await.map_err(|_| BrokerError::silent(LONGEST))?;
            if let Event::Incoming(Packet::PubAck(_)) = event.map_err(|error| BrokerError::from_connection(&error))? {
                break;
            }
        }
    }
    Ok(())
}
