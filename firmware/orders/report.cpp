#include "orders/report.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/json_depth.h"

namespace nplc::orders {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "nanoplc-report-1";
constexpr std::size_t kLongestReport = std::size_t{16} * 1024;
constexpr std::size_t kDeepestReport = 16;
constexpr std::array<std::string_view, 9> kStates{
    "none", "fetching", "waiting", "activating", "trial", "failing", "confirmed", "rolled_back", "failed"};

Json or_null(const std::string& text) {
    return text.empty() ? Json() : Json(text);
}

Json or_null(std::uint64_t number) {
    return number == 0 ? Json() : Json(number);
}

void take(const Json& from, const char* key, std::string& out) {
    const auto found = from.find(key);
    if (found != from.end() && found->is_string()) out = found->get<std::string>();
}

template <class Number>
void take(const Json& from, const char* key, Number& out) {
    const auto found = from.find(key);
    if (found == from.end() || !found->is_number_unsigned()) return;
    const auto value = found->template get<std::uint64_t>();
    if (value <= std::numeric_limits<Number>::max()) out = static_cast<Number>(value);
}

Json part_of(const Json& document, const char* key) {
    const auto found = document.find(key);
    return found != document.end() && found->is_object() ? *found : Json::object();
}

}  // namespace

std::string_view name_of(State state) {
    return kStates.at(static_cast<std::size_t>(state));
}

std::optional<State> state_of(std::string_view name) {
    const auto place = std::find(kStates.begin(), kStates.end(), name);
    if (place == kStates.end()) return std::nullopt;
    return static_cast<State>(place - kStates.begin());
}

std::string write_report(const Report& report) {
    const Json document{
        {"format", kFormat},
        {"target", report.target},
        {"time", report.time},
        {"firmware", or_null(report.firmware)},
        {"state", or_null(report.run_state)},
        {"table",
         {{"sha256", or_null(report.table_sha256)},
          {"crc32", report.table_crc},
          {"bytes", report.table_bytes},
          {"name", or_null(report.table_name)},
          {"proof", or_null(report.proof)},
          {"since", or_null(report.running)}}},
        {"set_points", {{"sha256", or_null(report.set_points_sha256)}, {"recipe", report.recipe}}},
        {"settings", {{"sha256", or_null(report.settings_sha256)}}},
        {"order",
         {{"state", name_of(report.state)},
          {"counter", report.counter},
          {"sha256", or_null(report.order_sha256)},
          {"text", or_null(report.text)},
          {"since", or_null(report.since)}}},
        {"refused",
         {{"count", report.refusals}, {"last", or_null(report.refusal)}, {"at", or_null(report.refused)}}},
    };
    constexpr int kIndent = 2;
    return document.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Report> read_report(std::string_view text) {
    if (text.size() > kLongestReport || base::is_deeper(text, kDeepestReport)) return std::nullopt;
    const Json document = Json::parse(text, nullptr, false);
    if (!document.is_object() || document.value("format", Json()) != Json(kFormat)) return std::nullopt;
    Report report;
    take(document, "target", report.target);
    take(document, "time", report.time);
    take(document, "firmware", report.firmware);
    take(document, "state", report.run_state);
    const Json table = part_of(document, "table");
    take(table, "sha256", report.table_sha256);
    take(table, "crc32", report.table_crc);
    take(table, "bytes", report.table_bytes);
    take(table, "name", report.table_name);
    take(table, "proof", report.proof);
    take(table, "since", report.running);
    const Json set_points = part_of(document, "set_points");
    take(set_points, "sha256", report.set_points_sha256);
    take(set_points, "recipe", report.recipe);
    take(part_of(document, "settings"), "sha256", report.settings_sha256);
    const Json order = part_of(document, "order");
    std::string state;
    take(order, "state", state);
    const auto known = state_of(state);
    if (!known) return std::nullopt;
    report.state = *known;
    take(order, "counter", report.counter);
    take(order, "sha256", report.order_sha256);
    take(order, "text", report.text);
    take(order, "since", report.since);
    const Json refused = part_of(document, "refused");
    take(refused, "count", report.refusals);
    take(refused, "last", report.refusal);
    take(refused, "at", report.refused);
    return report;
}

}  // namespace nplc::orders
