//! Records for as long as it is wanted: a connection that ends or breaks is made again, with a wait
//! between two attempts that doubles up to a bound. What is no measurement is left out and counted.
//! Memory is bounded: one line, one block of bytes, one complaint.

use crate::text::Text;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::thread::sleep;
use std::time::Duration;

use super::source::{Address, Connection, Received};
use super::{RecordError, Recorder};

/// First and longest wait before the next attempt.
const WAITS: [Duration; 2] = [Duration::from_millis(250), Duration::from_secs(5)];
/// Between two looks at whether it is still wanted.
const LOOK: Duration = Duration::from_millis(100);
/// No datagram is longer.
const BLOCK: usize = 1 << 16;

/// How the connection is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum State {
    /// It is being made.
    #[default]
    Connecting,
    /// It is there.
    Connected,
    /// It is not there, because of this; it is made again.
    Waiting(Text),
}

/// How a recording stands.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Standing {
    /// The connection.
    pub state: State,
    /// Lines that are in the file, without the headings.
    pub recorded: u64,
    /// Lines that were left out.
    pub refused: u64,
    /// Which they were since it was last heard, and why.
    pub left_out: Vec<Text>,
    /// How often the connection ended or broke.
    pub breaks: u64,
}

/// Hears how the recording stands, several times a second, and says whether it goes on.
pub type Listener<'a> = &'a mut dyn FnMut(&Standing) -> ControlFlow<()>;

/// Records until `hear` ends it, or as many lines as are wanted are in the file.
///
/// # Errors
/// The lines have no headings and none were given, or the file cannot be written.
pub fn record<F: FnOnce() -> io::Result<W>, W: Write>(
    address: &Address,
    recorder: &mut Recorder<F, W>,
    most: u64,
    hear: Listener<'_>,
) -> Result<Standing, RecordError> {
    recorder.tolerate();
    let mut standing = Standing::default();
    let mut wait = WAITS[0];
    while standing.recorded < most && hear(&standing).is_continue() {
        let why = match address.connect() {
            Err(error) => Text::verbatim(error.to_string()),
            Ok(connection) => {
                standing.state = State::Connected;
                let before = standing.recorded;
                let end = connected(connection, recorder, most, &mut standing, hear)?;
                if standing.recorded > before {
                    wait = WAITS[0];
                }
                standing.breaks += 1;
                match end {
                    End::Unwanted => {
                        standing.breaks -= 1;
                        break;
                    }
                    End::Closed => text!("the other side closed the connection"),
                    End::Broken(error) => Text::verbatim(error.to_string()),
                }
            }
        };
        standing.state = State::Waiting(why);
        if pause(wait, &standing, hear).is_break() {
            break;
        }
        wait = (2 * wait).min(WAITS[1]);
        standing.state = State::Connecting;
    }
    Ok(standing)
}

/// Why a connection ended.
#[derive(Debug)]
pub enum End {
    /// It is not wanted any more, or brought all that is wanted.
    Unwanted,
    /// The other side closed it.
    Closed,
    /// It broke.
    Broken(io::Error),
}

/// Records from a connection while it lasts.
///
/// # Errors
/// As [`record`]; of a recorder that tolerates nothing, also what the lines are not.
pub fn connected<F: FnOnce() -> io::Result<W>, W: Write>(
    mut connection: Connection,
    recorder: &mut Recorder<F, W>,
    most: u64,
    standing: &mut Standing,
    hear: Listener<'_>,
) -> Result<End, RecordError> {
    let mut bytes = vec![0; BLOCK];
    loop {
        let came = connection.read(&mut bytes);
        let over = match came {
            Ok(Received::Nothing) => None,
            Ok(Received::Bytes(count)) => {
                recorder.take(&bytes[..count], most)?;
                None
            }
            Ok(Received::Message(count)) => {
                recorder.take(&bytes[..count], most)?;
                recorder.end_of_message(most)?;
                None
            }
            Ok(Received::End) => Some(End::Closed),
            Err(error) => Some(End::Broken(error)),
        };
        if over.is_some() {
            recorder.end_of_stream();
        }
        standing.left_out = recorder.complaints();
        standing.refused = recorder.refused();
        standing.recorded = recorder.recorded();
        let heard = hear(standing);
        standing.left_out.clear();
        if let Some(end) = over {
            return Ok(end);
        }
        if standing.recorded >= most || heard.is_break() {
            return Ok(End::Unwanted);
        }
    }
}

/// Waits, unless it is not wanted any more.
fn pause(mut wait: Duration, standing: &Standing, hear: Listener<'_>) -> ControlFlow<()> {
    while !wait.is_zero() {
        hear(standing)?;
        let part = wait.min(LOOK);
        sleep(part);
        wait -= part;
    }
    ControlFlow::Continue(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{SocketAddr, TcpListener, UdpSocket};

    /// Records from an address until so many lines are there, on a thread.
    fn recording(
        address: Address,
        lines: u64,
    ) -> std::thread::JoinHandle<(String, Standing, String)> {
        std::thread::spawn(move || {
            let mut recorder = Recorder::new(|| Ok(Vec::new()), Vec::new());
            let mut states = 0;
            let mut last = String::new();
            let standing = record(&address, &mut recorder, lines, &mut |standing| {
                last = standing
                    .left_out
                    .last()
                    .map(Text::to_string)
                    .unwrap_or(std::mem::take(&mut last));
                states += 1;
                if states < 600 {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            });
            let text = String::from_utf8(recorder.out().cloned().unwrap_or_default());
            (text.unwrap(), standing.unwrap(), last)
        })
    }

    #[test]
    fn a_connection_that_breaks_comes_back_and_sends_rubbish_loses_no_line() {
        let server = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = Address::Tcp(server.local_addr().unwrap().to_string());
        let recording = recording(address, 4);
        let send = |bytes: &[u8]| {
            let (mut stream, _) = server.accept().unwrap();
            // The other side may have what it wants already.
            let _ = stream.write_all(bytes);
        };
        send(b"x_mm,y_mm\n1,2\n3,");
        send(b"x_mm,y_mm\n\xff\xfe\n$(reboot)\n5,6\n");
        let long = vec![b'7'; 3 << 20];
        send(&[&long[..], b"\n7,8\n9,1\n"].concat());
        let (text, standing, says) = recording.join().unwrap();
        assert_eq!(text, "x_mm,y_mm\n1,2\n5,6\n7,8\n9,1\n");
        assert_eq!((standing.recorded, standing.breaks), (4, 2));
        assert_eq!(standing.refused, 4, "cut, no UTF-8, one cell, too long");
        assert!(says.contains("a line of more than 1048576 bytes"), "{says}");
    }

    #[test]
    fn messages_are_lines_and_a_server_that_is_not_there_is_waited_for() {
        // A port that was free a moment ago, below those that the system hands out: nothing answers there.
        let own = u16::try_from(std::process::id() % 10_000).unwrap();
        let mut ports =
            (20_000 + own..30_000 + own).map(|port| SocketAddr::from(([127, 0, 0, 1], port)));
        let free = ports.find(|at| TcpListener::bind(at).is_ok());
        let address = Address::Tcp(free.unwrap().to_string());
        let mut waited = 0;
        let mut recorder = Recorder::new(|| Ok(Vec::new()), Vec::new());
        let standing = record(&address, &mut recorder, 1, &mut |standing| {
            waited += u8::from(matches!(standing.state, State::Waiting(_)));
            if waited < 5 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        assert_eq!((waited, standing.unwrap().recorded), (5, 0));

        let port = ports.find(|at| UdpSocket::bind(at).is_ok()).unwrap();
        let recording = recording(Address::Udp(port.to_string()), 2);
        let sender = UdpSocket::bind("127.0.0.1:0").unwrap();
        for _ in 0..400 {
            if recording.is_finished() {
                break;
            }
            // One message, as those before the port is listened on are lost.
            let _ = sender.send_to(b"x_mm,y_mm\n1,2", port);
            sleep(Duration::from_millis(20));
        }
        let (text, standing, _) = recording.join().unwrap();
        assert_eq!(standing.recorded, 2);
        assert!(text.starts_with("x_mm,y_mm\n"), "{text}");
    }
}
