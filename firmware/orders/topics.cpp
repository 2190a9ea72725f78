#include "orders/topics.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace nplc::orders {
namespace {

constexpr std::string_view kArtifact = "nanoplc/v1/artifact/";

}  // namespace

std::string report_topic(std::string_view target) {
    return fmt::format("{}{}/report", kTopics, target);
}

std::string order_topic(std::string_view target) {
    return fmt::format("{}{}/order", kTopics, target);
}

std::string piece_topic(const Hash& hash, std::size_t number) {
    return fmt::format("{}{}/{}", kArtifact, hex(hash), number);
}

std::string pieces_topic(const Hash& hash) {
    return fmt::format("{}{}/+", kArtifact, hex(hash));
}

std::optional<std::string> target_of(std::string_view topic, std::string_view kind) {
    const std::string end = fmt::format("/{}", kind);
    if (!topic.starts_with(kTopics) || !topic.ends_with(end)) return std::nullopt;
    if (topic.size() <= kTopics.size() + end.size()) return std::nullopt;
    const std::string_view target = topic.substr(kTopics.size(), topic.size() - kTopics.size() - end.size());
    if (std::count(target.begin(), target.end(), '/') != 2) return std::nullopt;
    return std::string(target);
}

std::optional<PieceTopic> read_piece_topic(std::string_view topic) {
    constexpr std::size_t kDigits = 64;
    if (!topic.starts_with(kArtifact)) return std::nullopt;
    topic.remove_prefix(kArtifact.size());
    if (topic.size() < kDigits + 2 || topic[kDigits] != '/') return std::nullopt;
    PieceTopic piece;
    if (!read_hex(topic.substr(0, kDigits), piece.hash)) return std::nullopt;
    const std::string_view number = topic.substr(kDigits + 1);
    const char* const end = number.data() + number.size();
    const auto [at, error] = std::from_chars(number.data(), end, piece.number);
    if (error != std::errc{} || at != end) return std::nullopt;
    return piece;
}

}  // namespace nplc::orders
