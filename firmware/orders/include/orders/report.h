#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nplc::orders {

/// State of an order.
enum class State : std::uint8_t {
    none,         ///< there was no order
    fetching,     ///< accepted; waits for its pieces
    waiting,      ///< complete and checked; waits until it may be activated
    activating,   ///< being stored or activated
    trial,        ///< active; not yet healthy as configured
    failing,      ///< was not healthy; waits until it may be rolled back
    confirmed,    ///< active, and healthy
    rolled_back,  ///< was not healthy; the former table is active again
    failed,       ///< failed, or there was no table to roll back to
};
std::string_view name_of(State state);
std::optional<State> state_of(std::string_view name);
constexpr bool is_final(State state) {
    return state == State::none || state == State::confirmed || state == State::rolled_back ||
           state == State::failed;
}

/// The report of an axis: what runs, and the state of its last order. Times are ms since 1970; empty texts
/// and times of 0 are unknown, and null in the JSON.
struct Report {
    std::string target{};
    std::uint64_t time = 0;  ///< time of the report
    std::string firmware{};
    std::string run_state{};

    std::string table_sha256{};  ///< as uploaded; empty without a table
    std::uint32_t table_crc = 0;
    std::uint32_t table_bytes = 0;
    std::string table_name{};   ///< name in the order that brought it
    std::string proof{};        ///< SHA-256 of its certificate
    std::uint64_t running = 0;  ///< since when it is the active one, if known

    std::string set_points_sha256{};  ///< of record and values; empty without set-points
    std::uint32_t recipe = 0;         ///< that was loaded last; 0: none
    std::string settings_sha256{};

    State state = State::none;  ///< of the last accepted order
    std::uint64_t counter = 0;  ///< of that order; the next one must have a greater counter
    std::string order_sha256{};
    std::string text{};       ///< reason
    std::uint64_t since = 0;  ///< of the state
    std::uint64_t refusals = 0;
    std::string refusal{};  ///< reason of the last one
    std::uint64_t refused = 0;
    bool operator==(const Report&) const = default;
};

/// JSON, indented, in one order; one document and an end of line.
std::string write_report(const Report& report);
/// Empty if invalid. Unknown members are ignored.
std::optional<Report> read_report(std::string_view text);

}  // namespace nplc::orders
