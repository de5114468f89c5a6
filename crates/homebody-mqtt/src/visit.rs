//! A short connection to a broker, to ask what it keeps: it is begun, asked, and ended in order.

use crate::address::BrokerAddress;
use crate::connection::open;
use crate::messages::BrokerMessage;
use crate::trouble::BrokerError;
use homebody_log::LogError;
use rumqttc::{AsyncClient, ClientError, Event, EventLoop, Outgoing};
use tokio::runtime::Builder;

/// Requests that wait inside the client (our choice).
const IN_CLIENT: usize = 10;

/// Visits a broker, under a name that tells visitors from homes. Retained messages may have any length.
pub(crate) fn visit<T>(
    address: &BrokerAddress,
    name: &str,
    ask: impl AsyncFnOnce(&AsyncClient, &mut EventLoop) -> Result<T, BrokerError>,
) -> Result<Result<T, BrokerError>, LogError> {
    let mut options = match open(address, &format!("homebody-{name}-{}", std::process::id())) {
        Ok(options) => options,
        Err(trouble) => return Ok(Err(trouble.finally())),
    };
    options.set_unlimited_incoming_packet_size();
    let runtime = Builder::new_current_thread().enable_all().build();
    let runtime = runtime.map_err(|source| LogError::NoThread { place: address.place(), source })?;
    let asked = runtime.block_on(async {
        let (client, mut events) = AsyncClient::builder(options).capacity(IN_CLIENT).build();
        let answer = ask(&client, &mut events).await?;
        let _ = client.disconnect().await;
        while !matches!(events.poll().await, Ok(Event::Outgoing(Outgoing::Disconnect)) | Err(_)) {}
        Ok(answer)
    });
    Ok(asked.map_err(BrokerError::finally))
}

/// A connection that was lost during a request.
pub(crate) fn lost(error: ClientError) -> BrokerError {
    BrokerError::new(BrokerMessage::Lost { reason: error.to_string() })
}
