#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nplc::orders {

/// Where an order stands.
enum class State : std::uint8_t {
    none,         ///< there was none
    fetching,     ///< taken; its pieces are awaited
    waiting,      ///< whole and checked; waits until it may be activated
    activating,   ///< on its way into the store, or to be made active
    trial,        ///< active; not yet as healthy as the configuration wants it
    failing,      ///< was not healthy; waits until it may go back
    confirmed,    ///< active, and healthy
    rolled_back,  ///< was not healthy; the former table is active again
    failed,       ///< came to nothing, or there was nothing to go back to
};
std::string_view name_of(State state);
std::optional<State> state_of(std::string_view name);
constexpr bool is_final(State state) {
    return state == State::none || state == State::confirmed || state == State::rolled_back ||
           state == State::failed;
}

/// What an axis says of itself: what runs, and where its last order stands. Times are ms since 1970; texts
/// that are empty and times that are 0 are not known, and null in the JSON.
struct Report {
    std::string target{};
    std::uint64_t time = 0;  ///< when this was said
    std::string firmware{};
    std::string run_state{};

    std::string table_sha256{};  ///< as it was uploaded; empty without a table
    std::uint32_t table_crc = 0;
    std::uint32_t table_bytes = 0;
    std::string table_name{};   ///< as the order called it that brought it
    std::string proof{};        ///< SHA-256 of its certificate
    std::uint64_t running = 0;  ///< since when it is the active one, as far as known

    std::string set_points_sha256{};  ///< of record and values; empty without set-points
    std::uint32_t recipe = 0;         ///< that was loaded last; 0: none
    std::string settings_sha256{};

    State state = State::none;  ///< of the last order that was taken
    std::uint64_t counter = 0;  ///< of that; a next order must have a greater one
    std::string order_sha256{};
    std::string text{};       ///< why
    std::uint64_t since = 0;  ///< of the state
    std::uint64_t refusals = 0;
    std::string refusal{};  ///< the last one
    std::uint64_t refused = 0;
    bool operator==(const Report&) const = default;
};

/// JSON, indented, in one order; one document and an end of line.
std::string write_report(const Report& report);
/// Nothing: it is none. What is not known to this program is left out.
std::optional<Report> read_report(std::string_view text);

}  // namespace nplc::orders
