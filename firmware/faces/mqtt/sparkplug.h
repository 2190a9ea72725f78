#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Sparkplug B's payload: the part of the published protobuf schema (sparkplug_b.proto) that an edge node
/// needs.
namespace nplc::mqtt {

/// Sparkplug 3.0 §6.4.16.
enum class DataType : std::uint32_t {
    int32 = 3,
    int64 = 4,
    uint32 = 7,
    uint64 = 8,
    real32 = 9,
    real64 = 10,
    boolean = 11,
    text = 12,
};

/// Null, or by the type of the metric.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct Metric {
    std::string name{};  ///< empty: identified by the alias
    std::optional<std::uint64_t> alias{};
    std::optional<std::uint64_t> timestamp{};  ///< ms since 1970
    DataType type = DataType::int64;
    bool is_historical = false;
    Value value{};
    std::string description{};              ///< from its metadata
    std::string unit{};                     ///< property engUnit
    std::optional<double> lowest{};         ///< property engLow
    std::optional<double> highest{};        ///< property engHigh
    std::optional<std::int32_t> quality{};  ///< property Quality: 192 good, 500 stale, 0 bad
};

struct Payload {
    std::optional<std::uint64_t> timestamp{};
    std::vector<Metric> metrics{};
    std::optional<std::uint64_t> seq{};
};

std::string encode(const Payload& payload);
/// Empty for invalid bytes. Other fields of the schema are ignored.
std::optional<Payload> decode(std::string_view bytes);

}  // namespace nplc::mqtt
