//! Where lines come from: an address, and the connection to it. What comes is read and never run.

use crate::text::Text;
use std::io::{self, ErrorKind, Read};
use std::net::{SocketAddr, TcpStream, ToSocketAddrs, UdpSocket};
use std::time::Duration;

/// Longest wait for a server to answer.
const CONNECT: Duration = Duration::from_secs(2);
/// Longest wait for bytes, so that a recording can be stopped meanwhile.
const SILENCE: Duration = Duration::from_millis(200);

/// Where lines come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Address {
    /// A server that is connected to, `host:port`.
    Tcp(String),
    /// A port that is listened on, `host:port`.
    Udp(String),
}

impl Address {
    /// Reads `tcp://HOST:PORT` or `udp://:PORT`.
    ///
    /// # Errors
    /// What was found, and what was expected.
    pub fn parse(text: &str) -> Result<Self, Text> {
        let wrong = || {
            text!(
                "{source}: expected tcp://HOST:PORT or udp://:PORT, with PORT from 0 to 65535",
                source = text
            )
        };
        let (kind, address) = text.split_once("://").ok_or_else(wrong)?;
        let port = address.rsplit_once(':').ok_or_else(wrong)?.1;
        if port.parse::<u16>().is_err() {
            return Err(wrong());
        }
        match kind {
            "tcp" => Ok(Self::Tcp(address.to_owned())),
            "udp" if address.starts_with(':') => Ok(Self::Udp(format!("0.0.0.0{address}"))),
            "udp" => Ok(Self::Udp(address.to_owned())),
            _ => Err(wrong()),
        }
    }

    /// Connects, or begins to listen.
    ///
    /// # Errors
    /// What the system says.
    pub fn connect(&self) -> io::Result<Connection> {
        match self {
            Self::Tcp(address) => {
                let mut last = ErrorKind::AddrNotAvailable.into();
                for address in address.to_socket_addrs()? {
                    match TcpStream::connect_timeout(&address, CONNECT) {
                        Ok(stream) => {
                            stream.set_read_timeout(Some(SILENCE))?;
                            return Ok(Connection::Tcp(stream));
                        }
                        Err(error) => last = error,
                    }
                }
                Err(last)
            }
            Self::Udp(address) => {
                let socket = UdpSocket::bind(address)?;
                socket.set_read_timeout(Some(SILENCE))?;
                Ok(Connection::Udp(socket))
            }
        }
    }
}

/// A connection.
#[derive(Debug)]
pub enum Connection {
    /// A stream of bytes.
    Tcp(TcpStream),
    /// Messages.
    Udp(UdpSocket),
}

/// What came.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Received {
    /// So many bytes of a stream.
    Bytes(usize),
    /// A message of so many bytes.
    Message(usize),
    /// Nothing for a while.
    Nothing,
    /// The stream is over.
    End,
}

impl Connection {
    /// Where it is listened, of messages: port 0 is any.
    pub fn listens_on(&self) -> Option<SocketAddr> {
        match self {
            Self::Tcp(_) => None,
            Self::Udp(socket) => socket.local_addr().ok(),
        }
    }

    pub(super) fn read(&mut self, bytes: &mut [u8]) -> io::Result<Received> {
        let read = match self {
            Self::Tcp(stream) => stream.read(bytes).map(|count| match count {
                0 => Received::End,
                count => Received::Bytes(count),
            }),
            Self::Udp(socket) => socket.recv(bytes).map(Received::Message),
        };
        match read {
            Err(error) => match error.kind() {
                ErrorKind::Interrupted | ErrorKind::WouldBlock | ErrorKind::TimedOut => {
                    Ok(Received::Nothing)
                }
                _ => Err(error),
            },
            came => came,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_says_how_it_is_reached() {
        let tcp = Address::Tcp("tracker:4000".to_owned());
        assert_eq!(Address::parse("tcp://tracker:4000"), Ok(tcp));
        let udp = Address::Udp("0.0.0.0:0".to_owned());
        assert_eq!(Address::parse("udp://:0"), Ok(udp));
        for wrong in [
            "",
            "tracker:4000",
            "tcp://tracker",
            "http://a:80",
            "udp://:70000",
        ] {
            let says = Address::parse(wrong).unwrap_err();
            assert!(says.contains("expected tcp://HOST:PORT"), "{says}");
        }
    }
}
