#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "orders/crypto.h"

/// MQTT topics of orders and reports, besides Sparkplug's own. README.md.
namespace nplc::orders {

inline constexpr std::string_view kTopics = "nanoplc/v1/";

/// `target`: GROUP/NODE/AXIS.
std::string report_topic(std::string_view target);
std::string order_topic(std::string_view target);
std::string piece_topic(const Hash& hash, std::size_t number);
/// The topic filter for all its pieces.
std::string pieces_topic(const Hash& hash);

/// The target in the topic of an order or report.
std::optional<std::string> target_of(std::string_view topic, std::string_view kind);
struct PieceTopic {
    Hash hash{};
    std::size_t number = 0;
};
std::optional<PieceTopic> read_piece_topic(std::string_view topic);

}  // namespace nplc::orders
