//! A proxy before a server that can stand still: connections stay open, and nothing goes through any more, as where a network is cut.

use std::io::{Read, Result, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// A proxy at a port of its own.
pub struct Stalling {
    pub port: u16,
    is_stalled: Arc<AtomicBool>,
}

/// A connection to the server.
pub trait Line: Read + Write + Send + Sized + 'static {
    fn twin(&self) -> Result<Self>;
    fn cut(&self);
}

impl Line for TcpStream {
    fn twin(&self) -> Result<TcpStream> {
        self.try_clone()
    }

    fn cut(&self) {
        let _ = self.shutdown(Shutdown::Both);
    }
}

impl Line for UnixStream {
    fn twin(&self) -> Result<UnixStream> {
        self.try_clone()
    }

    fn cut(&self) {
        let _ = self.shutdown(Shutdown::Both);
    }
}

impl Stalling {
    /// A proxy before the server that `connect` reaches.
    pub fn before<L: Line>(connect: impl Fn() -> Result<L> + Send + 'static) -> Stalling {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = listener.local_addr().unwrap().port();
        let is_stalled = Arc::new(AtomicBool::new(false));
        let stalls = is_stalled.clone();
        thread::spawn(move || {
            for client in listener.incoming().flatten() {
                let Ok(server) = connect() else { continue };
                let (Ok(from_client), Ok(to_server)) = (client.try_clone(), server.twin()) else { continue };
                let (there, back) = (stalls.clone(), stalls.clone());
                thread::spawn(move || carry(from_client, to_server, &there));
                thread::spawn(move || carry(server, client, &back));
            }
        });
        Stalling { port, is_stalled }
    }

    /// From now on it stands still, or does not.
    pub fn stall(&self, is_stalled: bool) {
        self.is_stalled.store(is_stalled, Ordering::SeqCst);
    }
}

/// Carries what one end says to the other, but for while it stands still.
fn carry(mut from: impl Line, mut to: impl Line, is_stalled: &AtomicBool) {
    let mut buffer = [0; 1 << 14];
    loop {
        let length = from.read(&mut buffer);
        while is_stalled.load(Ordering::SeqCst) {
            thread::sleep(Duration::from_millis(5));
        }
        match length {
            Ok(length @ 1..) if to.write_all(&buffer[..length]).is_ok() => {}
            _ => break,
        }
    }
    from.cut();
    to.cut();
}
