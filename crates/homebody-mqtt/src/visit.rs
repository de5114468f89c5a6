//! A short connection to a broker, to ask what it keeps: it is begun, asked, and ended in order.

use crate::address::Address;
use crate::connection::open;
use crate::messages::BrokerMessage;
use crate::trouble::Trouble;
use homebody_log::LogError;
use rumqttc::{AsyncClient, ClientError, Event, EventLoop, Outgoing};
use tokio::runtime::Builder;

/// Requests that wait inside the client (our choice).
const IN_CLIENT: usize = 10;

/// Visits a broker, under a name that tells visitors from homes. What is kept there may be of any length.
///
/// # Errors
///
/// There is no thread to wait on; what the visit itself has found wrong is in the result.
pub(crate) fn visit<T>(
    address: &Address,
    name: &str,
    ask: impl AsyncFnOnce(&AsyncClient, &mut EventLoop) -> Result<T, Trouble>,
) -> Result<Result<T, Trouble>, LogError> {
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
    Ok(asked.map_err(Trouble::finally))
}

/// A connection that was lost while something was said on it.
pub(crate) fn lost(error: ClientError) -> Trouble {
    Trouble::new(BrokerMessage::Lost { reason: error.to_string() })
}
