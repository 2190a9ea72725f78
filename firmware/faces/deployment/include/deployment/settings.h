#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/time.h"

namespace nplc::deployment {

/// When something is looked at: by the clock that faces read, and by the calendar.
struct Moment {
    base::Instant now{};
    std::uint64_t milliseconds = 0;  ///< since 1970
};

/// A part of each day, by the local time; it may go over midnight.
struct Window {
    int begin = 0;  ///< minutes since midnight
    int end = 0;

    bool contains(std::uint64_t milliseconds) const;
    std::string text() const;
};
/// "02:00-04:30"; nothing: it is none.
std::optional<Window> read_window(std::string_view text);

/// What a table may do to a sequence that runs in order to be activated.
enum class Activation : std::uint8_t {
    when_stopped,  ///< nothing: somebody else stops it
    stop,          ///< stop it
    restart,       ///< stop it, and run the table if it ran
};

struct Settings {
    std::string keys{};    ///< the folder of the keys that are trusted; empty: no order is taken
    std::string folder{};  ///< where each axis has its folder
    Activation activation = Activation::when_stopped;
    std::optional<Window> window{};              ///< only then; none: at any time
    base::Milliseconds healthy_after{60'000};    ///< it ran so long without ERROR
    base::Milliseconds healthy_within{300'000};  ///< within so much time that it ran
    std::optional<std::uint8_t> healthy_step{};  ///< and was in this step
    base::Milliseconds report_every{60'000};     ///< if nothing changes

    bool takes_orders() const { return !keys.empty(); }
};

}  // namespace nplc::deployment
