#include "record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/crc32.h"

namespace nplc::deployment {
namespace {

using Json = nlohmann::ordered_json;

std::string check_of(std::string_view line) {
    return fmt::format(
        "{:08x}\n", base::crc32(std::span(reinterpret_cast<const std::uint8_t*>(line.data()), line.size())));
}

bool take(const Json& from, const char* key, std::string& out) {
    const auto found = from.find(key);
    if (found == from.end() || !found->is_string()) return false;
    out = found->get<std::string>();
    return true;
}

bool take(const Json& from, const char* key, std::uint64_t& out) {
    const auto found = from.find(key);
    if (found == from.end() || !found->is_number_unsigned()) return false;
    out = found->get<std::uint64_t>();
    return true;
}

bool take(const Json& from, const char* key, bool& out) {
    const auto found = from.find(key);
    if (found == from.end() || !found->is_boolean()) return false;
    out = found->get<bool>();
    return true;
}

}  // namespace

std::string write_record(const Record& record) {
    const Json document{{"state", orders::name_of(record.state)},
                        {"counter", record.counter},
                        {"order", record.order},
                        {"text", record.text},
                        {"since", record.since},
                        {"has_former", record.has_former},
                        {"former_sha256", record.former_sha256},
                        {"former_name", record.former_name},
                        {"runs_sha256", record.runs_sha256},
                        {"runs_name", record.runs_name},
                        {"runs_since", record.runs_since}};
    const std::string line = document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    return line + check_of(line);
}

std::optional<Record> read_record(std::string_view text) {
    const std::size_t end = text.find('\n');
    if (text.size() > kLongestRecord || end == std::string_view::npos) return std::nullopt;
    const std::string_view line = text.substr(0, end + 1);
    if (text.substr(end + 1) != check_of(line)) return std::nullopt;
    const Json document = Json::parse(line, nullptr, false);
    if (!document.is_object()) return std::nullopt;
    Record record;
    std::string state;
    const bool is_whole =
        take(document, "state", state) && take(document, "counter", record.counter) &&
        take(document, "order", record.order) && take(document, "text", record.text) &&
        take(document, "since", record.since) && take(document, "has_former", record.has_former) &&
        take(document, "former_sha256", record.former_sha256) &&
        take(document, "former_name", record.former_name) &&
        take(document, "runs_sha256", record.runs_sha256) && take(document, "runs_name", record.runs_name) &&
        take(document, "runs_since", record.runs_since);
    const auto known = orders::state_of(state);
    if (!is_whole || !known) return std::nullopt;
    record.state = *known;
    return record;
}

}  // namespace nplc::deployment
