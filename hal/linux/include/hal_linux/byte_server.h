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
/// what is written while there is none. A socket has one client at a time, and turns another one away
/// (Connections has many). No call blocks, but for half a second in open() while another program has the
/// name, unless the settings say `at_once`.
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
    virtual bool has_client() = 0;
    /// How many bytes it put into `out`.
    virtual std::size_t read(std::span<std::uint8_t> out) = 0;
    virtual void write(std::span<const std::uint8_t> bytes) = 0;
    /// Readable when something is to be read, or a client came or went; always the same one.
    /// That of a pseudo-terminal reports a hang-up all the time while it has no client.
    virtual int descriptor() const = 0;

  protected:
    ByteServer() = default;
};

}  // namespace nplc::hal_linux
