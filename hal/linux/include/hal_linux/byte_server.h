#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace nplc::hal_linux {

/// A place where one outside client at a time exchanges bytes with us, as over a serial line:
///     pty:PATH          a pseudo-terminal; PATH becomes a link to it
///     unix:PATH         a stream socket in the file system
///     tcp:ADDRESS:PORT  a listening TCP socket; ADDRESS is 127.0.0.1 or another of this machine's IPv4
///                       addresses, PORT 0 lets the system choose
/// Like a serial line it knows no back pressure: what a client does not take in time is lost, and so is
/// what is written while there is none. A second client of a socket is turned away. No call blocks.
class ByteServer {
  public:
    struct Opened {
        std::unique_ptr<ByteServer> server;
        std::string error;  ///< what went wrong and what to do, in one line; empty when it was opened
    };
    static Opened open(const std::string& endpoint);

    virtual ~ByteServer() = default;
    ByteServer(const ByteServer&) = delete;
    ByteServer& operator=(const ByteServer&) = delete;

    /// As a client would be told: the endpoint, with the port that the system chose.
    virtual const std::string& name() const = 0;
    virtual bool has_client() = 0;
    /// How many bytes it put into `out`.
    virtual std::size_t read(std::span<std::uint8_t> out) = 0;
    virtual void write(std::span<const std::uint8_t> bytes) = 0;
    /// Readable when something is to be read, or a client came or went; may change with every other call.
    virtual int descriptor() const = 0;

  protected:
    ByteServer() = default;
};

}  // namespace nplc::hal_linux
