//! A proxy between a program and a server that cuts the connection as a transaction ends.

use super::Chance;
use std::io::{Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// The client's request to end a transaction.
const COMMIT: &[u8] = b"Q\0\0\0\x0bCOMMIT\0";

/// When the connection is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    /// The server never hears of it.
    Before,
    /// It is sent, and both ends are cut at once.
    AsSent,
    /// The server has answered, and the answer is kept back.
    Unheard,
}

pub struct Proxy {
    pub port: u16,
    counts: Arc<Counts>,
}

struct Counts {
    socket: PathBuf,
    chance: Chance,
    left: AtomicUsize,
    cut: [AtomicUsize; 3],
}

impl Proxy {
    /// Cuts so many times, about every second transaction.
    pub fn start(socket: &Path, cuts: usize) -> Proxy {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = listener.local_addr().unwrap().port();
        let (left, cut) = (AtomicUsize::new(cuts), Default::default());
        let counts = Arc::new(Counts { socket: socket.into(), chance: Chance::new(7), left, cut });
        let all = counts.clone();
        thread::spawn(move || {
            for client in listener.incoming().flatten() {
                let counts = all.clone();
                thread::spawn(move || counts.carry(client));
            }
        });
        Proxy { port, counts }
    }

    /// The number of cuts before, during and after the request.
    pub fn cut(&self) -> [usize; 3] {
        [0, 1, 2].map(|cut| self.counts.cut[cut].load(Ordering::SeqCst))
    }
}

impl Counts {
    fn carry(&self, mut client: TcpStream) {
        let Ok(mut server) = UnixStream::connect(&self.socket) else { return };
        let (mut answers, mut out) = (server.try_clone().unwrap(), client.try_clone().unwrap());
        let back = thread::spawn(move || {
            let _ = std::io::copy(&mut answers, &mut out);
            let _ = out.shutdown(Shutdown::Both);
        });
        let mut buffer = [0; 1 << 16];
        while let Ok(length @ 1..) = client.read(&mut buffer) {
            let said = &buffer[..length];
            match self.cuts(said) {
                None => {
                    if server.write_all(said).is_err() {
                        break;
                    }
                    continue;
                }
                Some(Cut::Before) => {}
                Some(Cut::AsSent) => {
                    let _ = server.write_all(said);
                }
                Some(Cut::Unheard) => {
                    let _ = client.shutdown(Shutdown::Write);
                    let _ = server.write_all(said);
                    thread::sleep(Duration::from_millis(30));
                }
            }
            break;
        }
        let _ = client.shutdown(Shutdown::Both);
        let _ = server.shutdown(Shutdown::Both);
        let _ = back.join();
    }

    fn cuts(&self, said: &[u8]) -> Option<Cut> {
        if !said.ends_with(COMMIT) || self.chance.below(2) == 0 {
            return None;
        }
        let taken = self.left.fetch_update(Ordering::SeqCst, Ordering::SeqCst, |left| left.checked_sub(1));
        taken.ok()?;
        let cut = [Cut::Before, Cut::AsSent, Cut::Unheard][self.chance.below(3) as usize];
        self.cut[cut as usize].fetch_add(1, Ordering::SeqCst);
        Some(cut)
    }
}
