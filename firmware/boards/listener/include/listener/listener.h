#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "listener/client.h"
#include "seat/seat.h"

namespace nplc::boards {

/// A user's port for many clients, without its sockets: it is told who came, what he sent and that he left,
/// says who is to go, and hands the clients' messages to the gateway one at a time. Each client hears the
/// answers to its own. Clients take turns; a read that its client has not waited for is dropped.
///
/// A newcomer is always taken. Where there is no place left one goes: first who floods or leaves its answers
/// unread, then who has said nothing for long, then whose last message is the longest ago; a newcomer has
/// time for its first message, and who waits for the answer of a stop stays.
///
/// A stop, safe or hold waits for nobody: it ends another client's turn, and what others sent before it and
/// would operate the gateway or the motor is refused. Each is carried out once for all that ask for it at the
/// same time, whether they wait for its answer or have gone. Such a message is refused too if its client has
/// left, or if more than kLongestUnread may have passed since it was sent, or if another client operates. The
/// client of a refused message hears nothing, and RESULT reads why for it until its next write.
///
/// With a password a client that has not given it may read and stop, and what needs no seat.
class Listener {
  public:
    using Id = std::uint64_t;  ///< of a client; not 0, and never that of another one again
    static constexpr std::size_t kMostClients = 256;
    static constexpr base::Microseconds kLongestAnswer{1'500'000};  ///< while others wait for their turn
    static constexpr base::Microseconds kLongestUnread{1'000'000};
    /// What came between two looks is as old as the time between them.
    static constexpr base::Microseconds kBetweenLooks{250'000};
    static constexpr base::Microseconds kFirstMessage{2'000'000};  ///< a newcomer's time for it
    /// Who floods is looked at so often.
    static constexpr base::Microseconds kAllowed{10'000};

    struct Options {
        std::string name;                   ///< of the port
        faces::Seat* operators = nullptr;   ///< who may operate, of all clients of the axis; null: everybody
        std::string password = {};          ///< empty: none is asked for
        std::size_t places = kMostClients;  ///< for so many clients at once
    };
    using Addresses = boards::Addresses;

    explicit Listener(Options options);
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    // What happens at the sockets, whose clients are given in any order; looked() comes after all of them.

    void set_addresses(const Addresses& addresses) { addresses_ = addresses; }
    /// `who`: all but its number.
    void connected(Id client, faces::Sitter who, base::Instant now);
    /// How much of what a client sent may be read now.
    std::size_t readable(Id client, base::Instant now) const;
    /// `is_all`: nothing more is there to be read.
    void received(Id client, std::span<const std::uint8_t> bytes, bool is_all, base::Instant now);
    /// A character was damaged on its way.
    void damaged(Id client);
    /// It sends no more; what it sent has been received.
    void left(Id client);
    /// It hears no more either.
    void gone(Id client, base::Instant now);
    void looked(base::Instant now);
    /// One goes, as for a newcomer.
    void make_room(base::Instant now);
    /// When that is wanted at the latest if nothing happens there.
    base::Instant next_look(base::Instant now) const;

    /// Answers that a client's socket has not taken, until sent() says how much of them it has.
    std::span<const std::uint8_t> unsent(Id client) const;
    void sent(Id client, std::size_t bytes, base::Instant now);
    /// Those who have some.
    std::vector<Id> with_unsent() const;
    /// Whose connections are to be closed. They are clients no more.
    std::vector<Id> take_dropped() { return std::exchange(dropped_, {}); }

    // Towards the gateway.

    /// The message that it is to take now, in the place of the one that is under way; null: none.
    const Frame* next(base::Instant now);
    bool awaits_answer() const { return asked_.has_value(); }
    /// To the message of the last next().
    void answer(std::span<const std::uint8_t> bytes, base::Instant now);
    /// It has ended, `result` is what RESULT reads.
    void ended(std::uint32_t result);
    /// The gateway has been started anew, and its RESULT reads 0.
    void restarted();

    /// Given by clients since the start.
    unsigned wrong_passwords() const { return wrong_passwords_; }
    std::size_t clients() const { return clients_.size(); }

  private:
    struct Asked {
        Frame frame;
        std::vector<Id> askers;  ///< one; of a stop several
        bool again = false;      ///< it took the place of another one of the same client
        base::Instant until{};   ///< others wait no longer
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
    Addresses addresses_{};
    Clients clients_;
    std::vector<Id> dropped_;
    std::vector<Asked> stops_;  ///< that wait; one of each
    std::optional<Asked> asked_;
    Id last_ = 0;  ///< whose turn it was
    std::optional<base::Instant> looked_;
    std::uint64_t messages_ = 0;
    unsigned wrong_passwords_ = 0;
};

}  // namespace nplc::boards
