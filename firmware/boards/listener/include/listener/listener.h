#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "listener/client.h"
#include "seat/seat.h"

namespace nplc::boards {

/// A user port for many clients, without its sockets: it is told about connections, received data and
/// disconnections, decides which client is removed, and passes the clients' messages to the gateway one at a
/// time. Each client gets the answers to its own messages. Clients take turns; a pending read is dropped when
/// its client sends another message.
///
/// A new client is always accepted. If there is no place left one client is removed: first one that floods or
/// leaves its answers unread, then one that has sent no message for long, then the one whose last message is
/// the oldest. A new client has kFirstMessage for its first message, and a client that waits for the answer
/// to a stop stays.
///
/// A stop, safe or hold does not wait: it ends another client's turn, and earlier messages of other clients
/// that would operate the gateway or the motor are refused. Each is carried out once for all clients that
/// request it at the same time, even if they have disconnected. An operating message is also refused if its
/// client has disconnected, if it may have waited longer than kLongestUnread, or if another client operates.
/// The client of a refused message gets no answer, and its RESULT reads the reason until its next write.
///
/// With a password, a client that has not given it may read, stop, and write what needs no operator.
class Listener {
  public:
    using Id = std::uint64_t;  ///< of a client; not 0, never reused
    static constexpr std::size_t kMostClients = 256;
    static constexpr base::Microseconds kLongestAnswer{
        1'500'000};  ///< time limit while others wait for their turn
    static constexpr base::Microseconds kLongestUnread{1'000'000};
    /// Data received between two looks are as old as the time between them.
    static constexpr base::Microseconds kBetweenLooks{250'000};
    static constexpr base::Microseconds kFirstMessage{
        2'000'000};  ///< time limit for a new client's first message
    /// Interval at which a flooding client is read.
    static constexpr base::Microseconds kAllowed{10'000};

    struct Options {
        std::string name;  ///< name of the port
        faces::Seat* operators =
            nullptr;  ///< decides which client of the axis is the operator; null: all clients may operate
        std::string password = {};          ///< empty: no password required
        std::size_t places = kMostClients;  ///< limit of clients
    };
    using Addresses = boards::Addresses;

    explicit Listener(Options options);
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    /// Called right before an operating message is handed out: false if its client has closed its sending
    /// side. Without it only left() and gone() report that.
    void ask_who_is_there(std::function<bool(Id client)> is_there) { is_there_ = std::move(is_there); }

    // Socket side. Clients are given in any order; looked() comes after all of them.

    void set_addresses(const Addresses& addresses) { addresses_ = addresses; }
    /// `who`: everything but its number.
    void connected(Id client, faces::Sitter who, base::Instant now);
    /// Number of bytes that may be read from a client now.
    std::size_t readable(Id client, base::Instant now) const;
    /// `is_all`: no more data are pending.
    void received(Id client, std::span<const std::uint8_t> bytes, bool is_all, base::Instant now);
    /// A received character was damaged.
    void damaged(Id client);
    /// The client has closed its sending side; all it sent has been received.
    void left(Id client);
    /// The client has closed its receiving side too.
    void gone(Id client, base::Instant now);
    void looked(base::Instant now);
    /// Removes one client, as for a new one.
    void make_room(base::Instant now);
    /// Latest time of the next look if no socket event comes.
    base::Instant next_look(base::Instant now) const;

    /// Answers not yet accepted by a client's socket; sent() removes the bytes that it has accepted.
    std::span<const std::uint8_t> unsent(Id client) const;
    void sent(Id client, std::size_t bytes, base::Instant now);
    /// The clients with such answers.
    std::vector<Id> with_unsent() const;
    /// Clients whose connections must be closed. They are no longer clients.
    std::vector<Id> take_dropped() { return std::exchange(dropped_, {}); }

    // Gateway side.

    /// The next message for the gateway, which replaces the one in progress; null: none.
    const Frame* next(base::Instant now);
    bool awaits_answer() const { return asked_.has_value(); }
    /// The answer to the message of the last next().
    void answer(std::span<const std::uint8_t> bytes, base::Instant now);
    /// That message has ended; `result` is RESULT.
    void ended(std::uint32_t result);
    /// The gateway has restarted, and its RESULT reads 0.
    void restarted();

    /// Wrong passwords since the start.
    unsigned wrong_passwords() const { return wrong_passwords_; }
    std::size_t clients() const { return clients_.size(); }

  private:
    struct Asked {
        Frame frame;
        std::vector<Id> askers;  ///< one client; for a stop one or several
        bool again = false;      ///< it replaced an earlier message of the same client
        base::Instant until{};   ///< other clients wait no longer than this
    };
    using Clients = std::map<Id, Client>;

    void take_byte(Client& client, std::uint8_t byte, base::Instant now);
    void take_frame(Client& client, Frame frame, base::Instant now);
    void take_stop(Client& client, Frame frame);
    bool is_about_password(Client& client, const protocol::mactalk::Request& message, base::Instant now);
    void take_password(Client& client, base::Instant now);
    int rank(const Client& client, base::Instant now) const;
    bool waits_for_stop(Id client) const;
    bool is_done_with(const Client& client) const;
    void drop(Clients::iterator client);
    void forget(Clients::iterator client);
    void queue(Id client, std::span<const std::uint8_t> bytes, base::Instant now);

    Client* next_client(base::Instant now);
    const Frame* begin_stop();
    bool take_too_late(Client& client, const Frame& frame);
    std::optional<std::uint32_t> refusal(const Client& client, const Frame& frame, base::Instant now);
    std::optional<std::uint32_t> refusal_for_anybody(const Client& client, const Frame& frame,
                                                     base::Instant now) const;
    bool is_about_operating(Client& client, const Frame& frame, base::Instant now);
    std::uint32_t operate(Client& client, const Frame& frame, base::Instant now);
    std::uint32_t shown_operator(const Client& client, std::uint8_t reg, base::Instant now) const;
    void tell(Client& client, std::uint8_t reg, std::uint32_t value, base::Instant now);
    bool is_dealt_with(Client& client, const Frame& frame, base::Instant now);
    bool is_for_somebody(std::uint8_t address) const;

    Options options_;
    std::function<bool(Id)> is_there_;
    Addresses addresses_{};
    Clients clients_;
    std::vector<Id> dropped_;
    std::vector<Asked> stops_;  ///< pending stops, one of each kind
    std::optional<Asked> asked_;
    Id last_ = 0;  ///< the client that had the last turn
    std::optional<base::Instant> looked_;
    std::uint64_t messages_ = 0;
    unsigned wrong_passwords_ = 0;
};

}  // namespace nplc::boards
