#include "table_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/crc32.h"
#include "intel_hex/intel_hex.h"
#include "panel/names.h"
#include "sequencer/table.h"
#include "set_points/symbol_record.h"

namespace nplc::boards {
namespace {

constexpr std::size_t kLongest = (sequencer::kMaxTerms + 1) * sequencer::kTermBytes;
/// In Intel HEX a byte takes two digits, and a record of one byte twelve more and a line end.
constexpr std::size_t kLongestFile = kLongest * 16;
constexpr std::size_t kLongestSymbols = std::size_t{4} * 1024 * 1024;

std::string too_long(const std::string& path) {
    return fmt::format("{}: is longer than a table of {} terms; make it with `seqc build`", path,
                       sequencer::kMaxTerms);
}

std::string fault_of(const std::string& path, std::span<const std::uint8_t> bytes) {
    if (bytes.size() > kLongest) return too_long(path);
    const auto loaded = sequencer::Table::load(bytes);
    if (!loaded.ok)
        return fmt::format("{}: term {}: {}; make it with `seqc build`", path, loaded.fault.term,
                           sequencer::describe(loaded.fault.error));
    const std::size_t whole = (loaded.table.size() + 1) * sequencer::kTermBytes;
    if (bytes.size() == whole) return {};
    return fmt::format("{}: term {} ends the table and {} bytes follow it; make it with `seqc build`", path,
                       loaded.table.size(), bytes.size() - whole);
}

std::string content_of(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error) ||
        std::filesystem::file_size(path, error) > kLongestSymbols)
        return {};
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Appends the set-point record from the table's symbol file; a one-line error if it does not fit.
std::string add_record(std::vector<std::uint8_t>& table, const std::string& symbols) {
    const std::string text = content_of(symbols);
    if (text.empty() || !panel::is_for_table(text, base::crc32(table))) return {};
    const auto record = set_points::record_in(nlohmann::json::parse(text, nullptr, false), table);
    if (!record)
        return fmt::format("{}: its set-points do not fit the table; build both anew with `seqc build`",
                           symbols);
    table.insert(table.end(), record->begin(), record->end());
    return {};
}

}  // namespace

TableFile read_table(const std::string& path, const std::string& symbols) {
    std::error_code missing;
    if (!std::filesystem::is_regular_file(path, missing))
        return {.error = fmt::format("there is no file {}; make it with `seqc build`", path)};
    if (std::filesystem::file_size(path, missing) > kLongestFile) return {.error = too_long(path)};
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file.is_open() || file.bad())
        return {.error = fmt::format("{}: cannot be read: {}; the service's user must be allowed to", path,
                                     std::strerror(errno))};
    intel_hex::Image image = intel_hex::bytes_in(path, text);
    if (!image.error.empty())
        return {.error = fmt::format("{}: {}; make it with `seqc build`",
                                     image.line == 0 ? path : fmt::format("{}:{}", path, image.line),
                                     image.error)};
    TableFile table{.bytes = std::move(image.bytes)};
    if (std::string error = fault_of(path, table.bytes); !error.empty()) return {.error = std::move(error)};
    const std::string beside = std::filesystem::path(path).replace_extension(".sym").string();
    if (std::string error = add_record(table.bytes, symbols.empty() ? beside : symbols); !error.empty())
        return {.error = std::move(error)};
    return table;
}

std::optional<std::uint32_t> crc_of_table(const std::string& path) {
    const TableFile file = read_table(path, "");
    if (!file.error.empty()) return std::nullopt;
    const auto loaded = sequencer::Table::load(file.bytes);
    const std::size_t whole = (loaded.table.size() + 1) * sequencer::kTermBytes;
    return base::crc32(std::span(file.bytes).first(whole));
}

}  // namespace nplc::boards
