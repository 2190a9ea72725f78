#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/time.h"

namespace nplc::deployment {

/// A point in time: by the faces' clock, and by the calendar.
struct Moment {
    base::Instant now{};
    std::uint64_t milliseconds = 0;  ///< since 1970
};

/// A time window of each day, in local time; it may span midnight.
struct Window {
    int begin = 0;  ///< minutes since midnight
    int end = 0;

    bool contains(std::uint64_t milliseconds) const;
    std::string text() const;
};
/// "02:00-04:30"; empty: invalid.
std::optional<Window> read_window(std::string_view text);

/// What an order may do to a running sequence in order to activate its table.
enum class Activation : std::uint8_t {
    when_stopped,  ///< nothing: someone else must stop it
    stop,          ///< stop it
    restart,       ///< stop it, and start the table if the sequence ran before
};

struct Settings {
    std::string keys{};    ///< the folder of trusted keys; empty: no order is accepted
    std::string folder{};  ///< contains a folder for each axis
    Activation activation = Activation::when_stopped;
    std::optional<Window> window{};              ///< activation only then; empty: at any time
    base::Milliseconds healthy_after{60'000};    ///< required time of running without ERROR
    base::Milliseconds healthy_within{300'000};  ///< limit of the running time until then
    std::optional<std::uint8_t> healthy_step{};  ///< step that must have been active
    base::Milliseconds report_every{60'000};     ///< interval without changes

    bool takes_orders() const { return !keys.empty(); }
};

}  // namespace nplc::deployment
