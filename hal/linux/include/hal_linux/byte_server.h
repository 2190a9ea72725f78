#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace nplc::hal_linux {

/// A server with which one outside client exchanges bytes, as over a serial line:
///     pty:PATH          a pseudo-terminal; PATH becomes a link to it
///     unix:PATH         a stream socket in the file system
///     tcp:ADDRESS:PORT  a listening TCP socket; ADDRESS is 127.0.0.1 or another of this machine's IPv4
///                       addresses, PORT 0 lets the system choose
/// A name has one server at a time: a second open() reports which program has it. Remains of a killed program
/// are replaced; any other file or link is left unchanged. As on a serial line there is no flow control:
/// bytes that a client does not read in time are lost, and so are bytes written without a client. A socket
/// has one client at a time and rejects further ones (Connections has many). No call blocks, except up to
/// half a second in open() while another program has the
/// name, unless the settings say `at_once`.
///
/// Over TCP a page in this machine's browser can send bytes, after the head of an HTTP request or a TLS
/// greeting. A client of a TCP socket that begins so (a method, a space and `/` or `*`; 16h, 03h and 00h to
/// 04h) is rejected; the bytes before that was detected contain no message.
class ByteServer {
  public:
    struct Opened {
        std::unique_ptr<ByteServer> server;
        std::string error;  ///< the error and its remedy, one line; empty when it was opened
    };
    struct Settings {
        unsigned mode = 0660;    ///< of a unix: socket, whatever the umask
        std::string group = {};  ///< of a unix: socket; empty: the process's group
        bool at_once = false;    ///< open() neither waits for a name nor looks up its holder
    };
    static Opened open(const std::string& endpoint, const Settings& settings);
    static Opened open(const std::string& endpoint) { return open(endpoint, Settings()); }

    virtual ~ByteServer() = default;
    ByteServer(const ByteServer&) = delete;
    ByteServer& operator=(const ByteServer&) = delete;

    /// The endpoint as a client writes it, with the port that the system chose.
    virtual const std::string& name() const = 0;
    virtual bool has_client() = 0;
    /// Returns the number of bytes in `out`.
    virtual std::size_t read(std::span<std::uint8_t> out) = 0;
    virtual void write(std::span<const std::uint8_t> bytes) = 0;
    /// Readable when there are bytes, or a client has connected or disconnected; always the same descriptor.
    /// For a pseudo-terminal it reports a hang-up all the time while it has no client.
    virtual int descriptor() const = 0;

  protected:
    ByteServer() = default;
};

}  // namespace nplc::hal_linux
