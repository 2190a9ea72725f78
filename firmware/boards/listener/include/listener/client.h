#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"
#include "listener/purpose.h"
#include "protocol/mactalk.h"
#include "seat/seat.h"

namespace nplc::boards {

/// A decoded message of a client.
struct Frame {
    protocol::mactalk::Request message{};
    Purpose purpose{};
    bool needs_seat = false;
    base::Instant since{};             ///< the message was sent at this time or later
    std::vector<std::uint8_t> data{};  ///< data of a write
};

/// Rate limit of a client: excess data are not read, and a client that reaches the limit counts as flooding.
class Allowance {
  public:
    static constexpr std::size_t kAtOnce = 16'384;  ///< bytes
    static constexpr std::size_t kLeast = 1024;     ///< smallest amount worth a read
    static constexpr base::Microseconds kPerByte{16};
    static constexpr base::Microseconds kRemembered{2'000'000};

    /// Number of bytes that may be read now.
    std::size_t left(base::Instant now) const {
        const std::int64_t back = std::max<std::int64_t>(0, (paid_until_ - now).count()) / kPerByte.count();
        return back > static_cast<std::int64_t>(kAtOnce - kLeast) ? 0
                                                                  : kAtOnce - static_cast<std::size_t>(back);
    }
    void take(std::size_t bytes, base::Instant now) {
        paid_until_ = std::max(paid_until_, now) + kPerByte * static_cast<std::int64_t>(bytes);
        if (left(now) == 0) flooded_at_ = now;
    }
    bool floods(base::Instant now) const { return flooded_at_ && now - *flooded_at_ < kRemembered; }

  private:
    base::Instant paid_until_{};
    std::optional<base::Instant> flooded_at_{};
};

/// State of a connected client.
struct Client {
    static constexpr std::size_t kMuchUnsent =
        1024;  ///< unread answer bytes beyond which it may not ask any more
    static constexpr std::size_t kMostUnsent = 4096;

    std::uint64_t id = 0;
    faces::Sitter sitter{};  ///< as an operator, with its number among the axis's clients
    base::Instant came{};
    protocol::mactalk::RequestDecoder decoder{};
    Allowance allowance{};
    std::deque<Frame> frames{};                   ///< pending messages
    base::Instant drained{};                      ///< time when all received data had been read
    bool has_more = false;                        ///< data were left unread the last time
    std::uint64_t heard = 0;                      ///< order of the last message over all clients; 0: none yet
    std::size_t before_first = 0;                 ///< bytes before its first message
    bool has_password = false;                    ///< the client has given the password
    bool has_left = false;                        ///< the client has closed its sending side
    std::optional<base::Instant> stopped{};       ///< time of its last stop
    std::optional<std::uint32_t> result{};        ///< RESULT for this client
    std::vector<std::uint8_t> unsent{};           ///< answers not yet accepted by its socket
    std::optional<base::Instant> unsent_since{};  ///< since when its socket has accepted nothing
};

}  // namespace nplc::boards
