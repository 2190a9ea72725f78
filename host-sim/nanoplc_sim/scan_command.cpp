#include "scan_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <iterator>
#include <optional>

#include "base/csv_row.h"
#include "input_file.h"
#include "sequencer/engine.h"
#include "table/terms.h"

namespace nplc::sim {
namespace {

constexpr std::string_view kHeader = "dt_ms,inputs,inpos,error";

struct Column {
    std::string_view name;
    std::uint32_t max;
};
constexpr std::array<Column, 4> kColumns{
    {{"dt_ms", 4'294'967'295U}, {"inputs", 63}, {"inpos", 1}, {"error", 1}}};

/// Makes any file content a single printable line.
std::string shown(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string result;
    for (const char c : text.substr(0, kLongest)) result += c >= ' ' && c <= '~' ? c : '?';
    return text.size() > kLongest ? result + "..." : result;
}

class Line {
  public:
    Line(std::string_view text, const std::string& file, std::size_t number)
        : text_(text), file_(file), number_(number) {}

    StimulusRow row() const {
        const auto commas = std::count(text_.begin(), text_.end(), ',');
        if (commas != 3) {
            fail(fmt::format("\"{}\" has {} fields; write the four {}", shown(text_),
                             text_.empty() ? 0 : commas + 1, kHeader));
        }
        std::array<std::uint32_t, 4> values{};
        std::string_view rest = text_;
        for (std::size_t i = 0; i < kColumns.size(); ++i) {
            const auto length = std::min(rest.find(','), rest.size());
            values[i] = number(rest.substr(0, length), kColumns[i]);
            rest.remove_prefix(std::min(length + 1, rest.size()));
        }
        return {values[0], static_cast<std::uint8_t>(values[1] | values[2] << 6U | values[3] << 7U)};
    }

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(fmt::format("{}:{}: {}", file_, number_, message));
    }

  private:
    std::uint32_t number(std::string_view field, const Column& column) const {
        std::uint64_t value = 0;
        const char* end = field.data() + field.size();
        const auto [stop, error] = std::from_chars(field.data(), end, value);
        if (error != std::errc{} || stop != end || value > column.max) {
            fail(fmt::format("{} is \"{}\"; write a whole number 0 to {}", column.name, shown(field),
                             column.max));
        }
        return static_cast<std::uint32_t>(value);
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t number_;
};

/// Up to and including the end of the line.
std::string_view take_line(std::string_view& text) {
    const auto length = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, length);
    if (line.ends_with('\r')) line.remove_suffix(1);
    text.remove_prefix(std::min(length + 1, text.size()));
    return line;
}

/// A number at the front of `text`, which is taken off; nothing without one.
template <typename Number>
bool take_number(std::string_view& text, Number& number) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return false;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return true;
}

bool take(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

std::optional<StimulusPreset> preset_in(std::string_view line) {
    StimulusPreset preset;
    if (!take(line, "# preset ") || !take_number(line, preset.value) || !take(line, " in term ")) return {};
    do {
        if (!take_number(line, preset.terms.emplace_back())) return {};
    } while (take(line, ", "));
    if (!line.empty() && line.front() != ':') return {};
    return preset;
}

std::string_view without_blank_end(std::string_view text) {
    const auto last = text.find_last_not_of(" \t\r\n");
    if (last == std::string_view::npos) return {};
    return text.substr(0, std::min(text.find('\n', last), text.size()));
}

void set_preset(std::vector<std::uint8_t>& table, const StimulusPreset& preset, const std::string& file) {
    for (const std::size_t term : preset.terms) {
        const std::size_t at = term * sequencer::kTermBytes;
        const bool is_there = term < sequencer::kMaxTerms && at + sequencer::kTermBytes <= table.size();
        const auto bytes = [&] { return std::span(table).subspan(at).first<sequencer::kTermBytes>(); };
        if (!is_there || sequencer::is_flex(bytes()))
            throw InputError(
                fmt::format("{}: the table has no preset in term {}; it is for another table", file, term));
        table::set_value(bytes(), preset.value);
    }
}

void append_word(std::string& words, const std::string& word) {
    if (!words.empty()) words += ' ';
    words += word;
}

}  // namespace

std::vector<StimulusPreset> parse_presets(std::string_view text, const std::string& file) {
    std::vector<StimulusPreset> presets;
    for (std::size_t number = 1; text.starts_with('#'); ++number) {
        const std::string_view line = take_line(text);
        auto preset = preset_in(line);
        if (!preset) Line(line, file, number).fail("write # preset 10000 in term 5, 9, or the header");
        presets.push_back(std::move(*preset));
    }
    return presets;
}

std::vector<StimulusRow> parse_stimulus(std::string_view text, const std::string& file) {
    text = without_blank_end(text);
    std::vector<StimulusRow> rows;
    std::size_t number = 0;
    std::size_t header = 1;
    do {
        const std::string_view line = take_line(text);
        ++number;
        if (number == header && preset_in(line)) {
            ++header;
            continue;
        }
        if (number > header && base::is_blank_row(line)) continue;
        if (number > header) {
            rows.push_back(Line(line, file, number).row());
        } else if (line != kHeader) {
            Line(line, file, number)
                .fail(fmt::format("the header is \"{}\"; write {}", shown(line), kHeader));
        }
    } while (!text.empty());
    if (number < header) Line({}, file, header).fail(fmt::format("the header is missing; write {}", kHeader));
    return rows;
}

std::string scan_csv(std::span<const std::uint8_t> bytes, const std::vector<StimulusRow>& rows) {
    const auto loaded = sequencer::Table::load(bytes);
    sequencer::Engine engine(loaded.table);
    std::string csv = "scan,step,timer,counter,outputs,fastmac,flexmac\n";
    std::size_t scan = 0;
    for (const StimulusRow& row : rows) {
        std::string fast;
        std::string flex;
        engine.scan(row.image, [&](const sequencer::MotorOrder& order) {
            if (order.is_register_write) {
                append_word(flex, fmt::format("{}={}", order.reg, order.value));
            } else {
                append_word(fast, fmt::format("{:02X}", order.command));
            }
        });
        engine.elapse(row.dt_ms);
        const sequencer::State& state = engine.state();
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{}\n", ++scan, state.step, state.timer,
                       state.counter, state.outputs, fast, flex);
    }
    return csv;
}

void run_scan(const std::string& table_file, const std::string& stimulus_file) {
    auto table = read_table(table_file);
    const std::string stimulus =
        read_long_input(stimulus_file, "a CSV file with a stimulus, or - for standard input");
    const std::string name = stimulus_file == "-" ? "standard input" : stimulus_file;
    for (const StimulusPreset& preset : parse_presets(stimulus, name)) set_preset(table, preset, name);
    const std::string csv = scan_csv(table, parse_stimulus(stimulus, name));
    std::fwrite(csv.data(), 1, csv.size(), stdout);
}

}  // namespace nplc::sim
