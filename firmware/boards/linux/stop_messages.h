#pragma once

#include <optional>
#include <string_view>

#include "base/time.h"
#include "gateway/vocabulary.h"
#include "journal.h"
#include "log_messages.h"

namespace nplc::boards {

/// The journal's messages on a stop that the motor does not confirm: a warning after kLongest, one a stop,
/// and how its wait ended.
class StopMessages {
  public:
    static constexpr base::Milliseconds kLongest{1'000};
    /// Of a motor that has not answered since the start: it may be powered up together with the board.
    static constexpr base::Milliseconds kFirstAnswer{5'000};

    struct Look {
        bool is_unconfirmed;
        bool link_is_usable;
        bool is_logged;                    ///< the log has had its confirmation since the last look
        std::uint32_t last_command;        ///< COMMAND, of a stop that is open
        std::string_view operator_name{};  ///< empty: none
    };
    struct Message : LogMessage {
        JournalEvent event;
    };

    /// To be called with a new log.
    void restart() { *this = {}; }
    std::optional<Message> look(const Look& look, base::Instant now);
    /// A stop is not confirmed, or how it ended has not been told: last_command counts.
    bool is_open() const { return warn_at_.has_value(); }
    /// Latest time of the next look.
    base::Instant next() const;

  private:
    void begin(const Look& look, base::Instant now);
    bool is_given_up(const Look& look) const;

    std::optional<base::Instant> warn_at_;  ///< a stop is not confirmed
    std::uint32_t command_before_ = 0;      ///< COMMAND when it began
    bool has_answered_ = false;
    bool is_told_ = false;
    bool is_logged_ = false;
    bool is_over_ = false;  ///< its entry in the log comes with the next poll, if there is one
};

}  // namespace nplc::boards
