#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal_linux/byte_server.h"

namespace nplc::hal_linux {

/// A place like a ByteServer's, with a connection for each client: who stays, who is read and how much is the
/// caller's to say. No call blocks, but for open() as there. At a pseudo-terminal there is one client at a
/// time, whoever has it open.
class Connections {
  public:
    struct Opened {
        std::unique_ptr<Connections> connections;
        std::string error;  ///< one line; empty when it was opened
    };
    static Opened open(const std::string& endpoint, const ByteServer::Settings& settings);

    virtual ~Connections() = default;
    Connections(const Connections&) = delete;
    Connections& operator=(const Connections&) = delete;

    using Id = std::uint64_t;  ///< 1 and so on, another one for each client
    enum class State : std::uint8_t {
        open,
        hears,  ///< it has closed its sending end
        gone,   ///< its connection is closed: its Id is nobody's
    };
    /// As far as the system tells.
    struct Peer {
        enum class Kind : std::uint8_t { user, address, terminal, serial_line };
        Kind kind = Kind::terminal;
        std::uint32_t number = 0;  ///< the user's; an IPv4 address, its first number in bits 31..24
        std::uint16_t port = 0;    ///< of an address
    };
    struct Got {
        std::size_t count = 0;
        State state = State::open;
        bool is_damaged = false;  ///< the next character was, and is left out; there may be more behind it
    };

    /// As a client would be told: the endpoint, with the port that the system chose.
    virtual const std::string& name() const = 0;
    /// Readable when a client comes, or one that is listened to has sent something or gone, or one takes what
    /// waits. That of a pseudo-terminal reports a hang-up all the time while it has no client.
    virtual int descriptor() const = 0;
    /// The next one that waits to be let in. Nothing, and lacks_room(): one waits that the process has no
    /// descriptor left for.
    virtual std::optional<Id> accept() = 0;
    virtual bool lacks_room() const { return false; }
    virtual Peer peer(Id client) const = 0;
    /// Those of whom something is to be read, or who have gone, or who can be written to again. Those who are
    /// not listened to, too: each time.
    virtual std::vector<Id> with_news() = 0;
    virtual Got read(Id client, std::span<std::uint8_t> out) = 0;
    /// How much was taken; nothing: it has gone.
    virtual std::optional<std::size_t> write(Id client, std::span<const std::uint8_t> bytes) = 0;
    /// Whether what it sends makes the descriptor readable.
    virtual void listen_to(Id client, bool on) = 0;
    /// Whether it makes the descriptor readable when it takes something.
    virtual void wait_to_write(Id client, bool on) = 0;
    virtual void close(Id client) = 0;
    /// Clients of a TCP socket that began as a browser does and were turned away (StreamOpening).
    virtual unsigned turned_away() const { return 0; }

  protected:
    Connections() = default;
};

}  // namespace nplc::hal_linux
