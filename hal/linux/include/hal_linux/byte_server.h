#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace nplc::hal_linux {

/// A place where an outside client exchanges bytes with us, as over a serial line:
///     pty:PATH          a pseudo-terminal; PATH becomes a link to it
///     unix:PATH         a stream socket in the file system
///     tcp:ADDRESS:PORT  a listening TCP socket; ADDRESS is 127.0.0.1 or another of this machine's IPv4
///                       addresses, PORT 0 lets the system choose
/// Like a serial line it knows no back pressure: what a client does not take in time is lost, and so is
/// what is written while there is none. A socket may have as many clients at once as open() says, each in a
/// seat of its own; one more is turned away. A pseudo-terminal has one seat. No call blocks.
class ByteServer {
  public:
    struct Opened {
        std::unique_ptr<ByteServer> server;
        std::string error;  ///< what went wrong and what to do, in one line; empty when it was opened
    };
    static Opened open(const std::string& endpoint, std::size_t seats = 1);

    virtual ~ByteServer() = default;
    ByteServer(const ByteServer&) = delete;
    ByteServer& operator=(const ByteServer&) = delete;

    /// As a client would be told: the endpoint, with the port that the system chose.
    virtual const std::string& name() const = 0;
    virtual bool has_client() = 0;
    virtual std::size_t seats() const { return 1; }
    /// Another number for each client that took the seat; 0: nobody has it. Always 1 where clients cannot be
    /// told apart.
    virtual std::uint64_t visit(std::size_t /*seat*/) { return 1; }
    /// From a seat's client; how many bytes it put into `out`.
    virtual std::size_t read_seat(std::size_t seat, std::span<std::uint8_t> out) = 0;
    virtual void write_seat(std::size_t seat, std::span<const std::uint8_t> bytes) = 0;
    std::size_t read(std::span<std::uint8_t> out) { return read_seat(0, out); }
    void write(std::span<const std::uint8_t> bytes) { write_seat(0, bytes); }
    /// Readable when something is to be read from any seat, or a client came or went; always the same one.
    /// That of a pseudo-terminal reports a hang-up all the time while it has no client.
    virtual int descriptor() const = 0;

  protected:
    ByteServer() = default;
};

}  // namespace nplc::hal_linux
