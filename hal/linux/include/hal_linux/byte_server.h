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
/// A name has one server at a time: a second open() says which program has it. What a program that was
/// killed left of a name is replaced; any other file or link there is left alone.
/// Like a serial line it knows no back pressure: what a client does not take in time is lost, and so is
/// what is written while there is none. A socket may have as many clients at once as its settings say, each
/// in a seat of its own. One more is turned away where there is one seat; where there are several it takes
/// the seat of the client whose last whole message (note_message) is the longest ago. A pseudo-terminal has
/// one seat. No call blocks, but for half a second in open() while another program has the name, unless the
/// settings say `at_once`.
///
/// Over TCP a page in this machine's browser can send bytes, behind the head of a request or a greeting of
/// TLS. A client of a TCP socket that begins so (a method, a space and `/` or `*`; 16h, 03h and 00h to 04h)
/// is turned away; what it sent before that was clear held no message.
class ByteServer {
  public:
    struct Opened {
        std::unique_ptr<ByteServer> server;
        std::string error;  ///< what went wrong and what to do, in one line; empty when it was opened
    };
    struct Settings {
        std::size_t seats = 1;
        unsigned mode = 0660;    ///< of a unix: socket, whatever the umask
        std::string group = {};  ///< of a unix: socket; empty: the process's
        bool at_once = false;    ///< open() neither waits for a name nor looks which program has it
    };
    static Opened open(const std::string& endpoint, const Settings& settings);
    static Opened open(const std::string& endpoint) { return open(endpoint, Settings()); }

    virtual ~ByteServer() = default;
    ByteServer(const ByteServer&) = delete;
    ByteServer& operator=(const ByteServer&) = delete;

    /// As a client would be told: the endpoint, with the port that the system chose.
    virtual const std::string& name() const = 0;
    /// Where there are several seats, nobody comes in or loses a seat between two calls of this.
    virtual bool has_client() = 0;
    virtual std::size_t seats() const { return 1; }
    /// Another number for each client that took the seat; 0: nobody has it. Always 1 where clients cannot be
    /// told apart.
    virtual std::uint64_t visit(std::size_t /*seat*/) { return 1; }
    /// The seat's client has closed its sending end, or all of it; what it sent before may still be read.
    virtual bool has_left(std::size_t seat) = 0;
    /// The seat's client has sent a whole message.
    virtual void note_message(std::size_t /*seat*/) {}
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
