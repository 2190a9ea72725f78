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

/// A server like ByteServer with one connection per client: the caller decides which clients stay, and which
/// are read and how much. No call blocks, except open() as there. A pseudo-terminal has one client at a time,
/// any program that has it open.
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
        hears,  ///< it has closed its sending side
        gone,   ///< its connection is closed and its Id invalid
    };
    /// As far as the system reports it.
    struct Peer {
        enum class Kind : std::uint8_t { user, address, terminal, serial_line };
        Kind kind = Kind::terminal;
        std::uint32_t number = 0;  ///< user number; or an IPv4 address, first number in bits 31..24
        std::uint16_t port = 0;    ///< of an address
    };
    struct Got {
        std::size_t count = 0;
        State state = State::open;
        bool is_damaged = false;  ///< the next character was damaged and is left out; more may follow
    };

    /// The endpoint as a client writes it, with the port that the system chose.
    virtual const std::string& name() const = 0;
    /// Readable when a client connects, when one that is listened to has sent something or disconnected, or
    /// when one accepts pending output. For a pseudo-terminal it reports a hang-up all the time while it has
    /// no client.
    virtual int descriptor() const = 0;
    /// The next connecting client. Empty with lacks_room(): a client waits, but the process has no descriptor
    /// left.
    virtual std::optional<Id> accept() = 0;
    virtual bool lacks_room() const { return false; }
    virtual Peer peer(Id client) const = 0;
    /// Clients with data, disconnected ones, and those that accept output again. Those that are not listened
    /// to are included every time.
    virtual std::vector<Id> with_news() = 0;
    virtual Got read(Id client, std::span<std::uint8_t> out) = 0;
    /// As read() would report it, at this moment: false once the client has closed its sending side or is
    /// gone, even if data are still unread. Always true for a serial line.
    virtual bool is_open(Id client) const = 0;
    /// Number of accepted bytes; empty: the client has disconnected.
    virtual std::optional<std::size_t> write(Id client, std::span<const std::uint8_t> bytes) = 0;
    /// Whether received data make the descriptor readable.
    virtual void listen_to(Id client, bool on) = 0;
    /// Whether the client's readiness for output makes the descriptor readable.
    virtual void wait_to_write(Id client, bool on) = 0;
    virtual void close(Id client) = 0;
    /// Clients of a TCP socket that began as a browser does and were rejected (StreamOpening).
    virtual unsigned turned_away() const { return 0; }

  protected:
    Connections() = default;
};

}  // namespace nplc::hal_linux
