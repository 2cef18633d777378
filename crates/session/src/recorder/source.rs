//! Where lines come from: an address, and the connection to it. What comes is read and never run.

use crate::text::Text;
use std::io::{self, BufRead, BufReader, ErrorKind, Read};
use std::net::{SocketAddr, TcpStream, ToSocketAddrs, UdpSocket};
use std::time::Duration;

/// Longest wait for a server to answer.
const CONNECT: Duration = Duration::from_secs(2);
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

    /// Connects, or begins to listen: the stream, and where messages are listened for (port 0 is any).
    ///
    /// # Errors
    /// What the system says.
    pub fn connect(&self) -> io::Result<(Box<dyn BufRead>, Option<SocketAddr>)> {
        match self {
            Self::Tcp(address) => {
                let mut last = ErrorKind::AddrNotAvailable.into();
                for address in address.to_socket_addrs()? {
                    match TcpStream::connect_timeout(&address, CONNECT) {
                        Ok(stream) => return Ok((Box::new(BufReader::new(stream)), None)),
                        Err(error) => last = error,
                    }
                }
                Err(last)
            }
            Self::Udp(address) => {
                let socket = UdpSocket::bind(address)?;
                let here = socket.local_addr().ok();
                let stream = BufReader::with_capacity(LONGEST_MESSAGE, Messages(socket));
                Ok((Box::new(stream), here))
            }
        }
    }
}

/// No message of UDP is as long.
const LONGEST_MESSAGE: usize = 1 << 16;

/// Messages as a stream: each ends its last line.
struct Messages(UdpSocket);

impl Read for Messages {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        loop {
            let count = self.0.recv(bytes)?;
            match (bytes[..count].last(), bytes.get(count)) {
                (None, _) => {}
                (Some(b'\n'), _) | (_, None) => return Ok(count),
                _ => {
                    bytes[count] = b'\n';
                    return Ok(count + 1);
                }
            }
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
