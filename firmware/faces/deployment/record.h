#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "orders/report.h"

namespace nplc::deployment {

/// The stored state of an axis's orders.
struct Record {
    orders::State state = orders::State::none;
    std::uint64_t counter = 0;  ///< of the last accepted order
    std::string order{};        ///< its text
    std::string text{};         ///< reason of this state
    std::uint64_t since = 0;    ///< of the state, ms since 1970
    bool has_former = false;    ///< the last good table is in kFormerFile
    std::string former_sha256{};
    std::string former_name{};
    std::string runs_sha256{};  ///< the active table
    std::string runs_name{};
    std::uint64_t runs_since = 0;
    bool operator==(const Record&) const = default;
};

/// The last good table, next to the record.
inline constexpr const char* kFormerFile = "former.bin";
inline constexpr std::size_t kLongestRecord = std::size_t{16} * 1024;

/// One line of JSON with its CRC-32.
std::string write_record(const Record& record);
std::optional<Record> read_record(std::string_view text);

}  // namespace nplc::deployment
