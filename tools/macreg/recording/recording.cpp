#include "macreg/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/csv_row.h"
#include "macreg/values.h"
#include "registers/convert.h"
#include "text/text.h"

namespace nplc::macreg {
namespace {

using spelling::split;
using spelling::trimmed;

constexpr std::string_view kFirstLine = "# macreg recording 1";
constexpr std::string_view kTime = "time_s";
constexpr std::size_t kMostColumns = 64;

std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::size_t fields_in(std::string_view line) {
    return 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
}

}  // namespace

Recording::Column column_of(const registers::Register& reg) {
    return {std::string(reg.name), std::string(shown_unit(reg)), {}};
}

double shown_value(const registers::Register& reg, registers::Model model, std::int64_t raw) {
    if (reg.unit == registers::Unit::bits) return static_cast<double>(raw);
    const auto text = registers::to_text(raw, reg, model, shown_unit(reg));
    const std::string_view digits = text.view().substr(0, text.view().find(' '));
    return number(digits).value_or(0);
}

std::string to_csv(const Recording& recording) {
    std::string out =
        fmt::format("{}\n# model {}\n# address {}\n", kFirstLine, recording.model, recording.address);
    out += recording.rate_hz > 0
               ? fmt::format("# rate {} Hz\n", recording.rate_hz)
               : std::string("# rate polled: a row's registers are read one after the other\n");
    out += fmt::format("# start {}\n", recording.start);
    if (!recording.incomplete.empty()) out += fmt::format("# incomplete: {}\n", recording.incomplete);
    out += kTime;
    for (const auto& column : recording.columns)
        out += column.unit.empty() ? "," + column.name : fmt::format(",{} [{}]", column.name, column.unit);
    out += '\n';
    for (std::size_t i = 0; i < recording.size(); ++i) {
        out += fmt::format("{:.6f}", recording.time_s[i]);
        for (const auto& column : recording.columns) out += fmt::format(",{}", column.values[i]);
        out += '\n';
    }
    return out;
}

bool RecordingReader::take(std::string_view line) {
    ++line_;
    line = trimmed(line);
    if (base::is_blank_row(line)) return true;
    if (line.front() == '#')
        comment(trimmed(line.substr(1)));
    else if (header_)
        row(line);
    else
        header(line);
    return result_.error.empty();
}

void RecordingReader::refuse_line() {
    ++line_;
    fail("the line has no end; name a recording of `macreg record`");
}

RecordingReading RecordingReader::finish() {
    if (result_.error.empty() && !header_)
        fail("there is no header; a recording of `macreg record` has one that begins with time_s", 1);
    if (result_.error.empty() && result_.recording.size() == 0)
        fail("there are no samples; record again", line_);
    if (!result_.error.empty()) result_.recording = {};
    return std::move(result_);
}

void RecordingReader::comment(std::string_view line) {
    const auto starts = [&](std::string_view key) {
        if (!line.starts_with(key)) return false;
        line = trimmed(line.substr(key.size()));
        return true;
    };
    Recording& to = result_.recording;
    if (starts("model ")) {
        to.model = line;
    } else if (starts("address ")) {
        to.address = static_cast<unsigned>(number(line).value_or(0));
    } else if (starts("rate ")) {
        to.rate_hz = number(line.substr(0, line.find(' '))).value_or(0);
    } else if (starts("start ")) {
        to.start = line;
    } else if (starts("incomplete: ")) {
        to.incomplete = line;
    }
}

void RecordingReader::header(std::string_view line) {
    if (const std::size_t count = fields_in(line); count > kMostColumns)
        return fail(fmt::format("{} columns are more than {}", count, kMostColumns));
    const auto names = split(line, ',');
    if (names.front() != kTime)
        return fail(
            fmt::format("the header begins with '{}' and not with time_s; name a recording of "
                        "`macreg record`, or mend the header",
                        names.front()));
    if (names.size() < 2) return fail("the header names no register behind time_s");
    for (std::size_t i = 1; i < names.size(); ++i) {
        const std::size_t open = names[i].find('[');
        std::string_view unit;
        if (open != std::string_view::npos) {
            if (names[i].back() != ']') return fail(fmt::format("'{}': the unit's ] is missing", names[i]));
            unit = names[i].substr(open + 1, names[i].size() - open - 2);
        }
        const std::string_view name = trimmed(names[i].substr(0, open));
        if (name.empty()) return fail(fmt::format("column {} has no name", i + 1));
        result_.recording.columns.push_back({std::string(name), std::string(unit), {}});
    }
    header_ = true;
}

void RecordingReader::row(std::string_view line) {
    Recording& to = result_.recording;
    const std::size_t count = fields_in(line);
    if (count != to.columns.size() + 1)
        return fail(fmt::format("{} fields where the header has {}; the file is damaged or was cut off",
                                count, to.columns.size() + 1));
    const auto fields = split(line, ',');
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto value = number(fields[i]);
        if (!value) return fail(fmt::format("'{}' in column {} is no number", fields[i], i + 1));
        if (i > 0) {
            to.columns[i - 1].values.push_back(*value);
            continue;
        }
        if (!to.time_s.empty() && *value <= to.time_s.back())
            return fail(
                fmt::format("the time {} is not after {} of the row before", *value, to.time_s.back()));
        to.time_s.push_back(*value);
    }
}

void RecordingReader::fail(const std::string& what, std::size_t line) {
    result_.error = fmt::format("{}:{}: {}", name_, line, what);
}

RecordingReading from_csv(std::string_view text, const std::string& name) {
    RecordingReader reader(name);
    bool goes_on = true;
    while (goes_on && !text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        goes_on = reader.take(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return reader.finish();
}

}  // namespace nplc::macreg
