#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "orders/crypto.h"

/// Where what is said of orders goes, beside Sparkplug's own topics. README.md.
namespace nplc::orders {

inline constexpr std::string_view kTopics = "nanoplc/v1/";

/// `target`: GROUP/NODE/AXIS.
std::string report_topic(std::string_view target);
std::string order_topic(std::string_view target);
std::string piece_topic(const Hash& hash, std::size_t number);
/// All pieces of it.
std::string pieces_topic(const Hash& hash);

/// Of an order or a report: its target.
std::optional<std::string> target_of(std::string_view topic, std::string_view kind);
struct PieceTopic {
    Hash hash{};
    std::size_t number = 0;
};
std::optional<PieceTopic> read_piece_topic(std::string_view topic);

}  // namespace nplc::orders
