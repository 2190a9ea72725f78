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

/// A client's message, decoded.
struct Frame {
    protocol::mactalk::Request message{};
    Purpose purpose{};
    bool needs_seat = false;
    base::Instant since{};             ///< it was sent then or later
    std::vector<std::uint8_t> data{};  ///< of a write
};

/// How much a client may send: more is left where it is, and who is held up so floods.
class Allowance {
  public:
    static constexpr std::size_t kAtOnce = 16'384;  ///< bytes
    static constexpr std::size_t kLeast = 1024;     ///< worth a look
    static constexpr base::Microseconds kPerByte{16};
    static constexpr base::Microseconds kRemembered{2'000'000};

    /// How many bytes may be read now.
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

/// Who is connected, as a listener knows him.
struct Client {
    static constexpr std::size_t kMuchUnsent = 1024;  ///< bytes that it has left unread: it asks no more
    static constexpr std::size_t kMostUnsent = 4096;

    std::uint64_t id = 0;
    faces::Sitter sitter{};  ///< among the axis's clients
    base::Instant came{};
    protocol::mactalk::RequestDecoder decoder{};
    Allowance allowance{};
    std::deque<Frame> frames{};                   ///< that wait
    base::Instant drained{};                      ///< nothing was left to be read then
    bool has_more = false;                        ///< something was left the last time
    std::uint64_t heard = 0;                      ///< rises with every message of any client; 0: none yet
    std::size_t before_first = 0;                 ///< bytes before its first message
    bool has_password = false;                    ///< it has given it
    bool has_left = false;                        ///< it sends no more
    std::optional<base::Instant> stopped{};       ///< its last stop was taken then
    std::optional<std::uint32_t> result{};        ///< what RESULT reads for it
    std::vector<std::uint8_t> unsent{};           ///< answers that its socket has not taken
    std::optional<base::Instant> unsent_since{};  ///< it takes nothing
};

}  // namespace nplc::boards
