#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "base/crc32.h"
#include "host/paths.h"
#include "language/names.h"
#include "language/reserved_words.h"
#include "seqc/symbol_file.h"
#include "sequencer/term.h"
#include "symbols/motors.h"
#include "symbols/symbol_file_format.h"

namespace nplc::seqc {
namespace {

using Json = nlohmann::json;

constexpr std::int64_t kMostLines = 0x7FFF'FFFF;
constexpr std::int64_t kMostBytes = 0x7FFF'FFFF;
constexpr std::int64_t kLastRegister = 127;
constexpr int kDeepest = 16;  // deeper than any valid file

/// An error in the file, with its position.
struct Wrong {
    std::string what;
};

/// A value in the file and its path, for messages.
class Node {
  public:
    Node(const Json& json, std::string path) : json_(json), path_(std::move(path)) {}

    [[noreturn]] void fail(std::string_view what) const {
        throw Wrong{fmt::format("{}: {}", path_.empty() ? "the file" : path_, what)};
    }

    bool has(const char* name) const { return json_.is_object() && json_.contains(name); }

    Node operator[](const char* name) const {
        if (!json_.is_object()) fail("this must be an object");
        const std::string path = path_.empty() ? name : fmt::format("{}.{}", path_, name);
        const auto found = json_.find(name);
        if (found == json_.end()) throw Wrong{fmt::format("{} is missing", path)};
        return {*found, path};
    }

    std::vector<Node> list() const {
        if (!json_.is_array()) fail("this must be a list");
        std::vector<Node> nodes;
        for (std::size_t i = 0; i < json_.size(); ++i)
            nodes.emplace_back(json_[i], fmt::format("{}[{}]", path_, i));
        return nodes;
    }

    std::string text() const {
        if (!json_.is_string()) fail("this must be a text");
        return json_.get<std::string>();
    }

    std::int64_t whole(std::int64_t min, std::int64_t max) const {
        const bool fits = json_.is_number_integer() &&
                          (!json_.is_number_unsigned() || json_.get<std::uint64_t>() <= INT64_MAX);
        const std::int64_t value = fits ? json_.get<std::int64_t>() : 0;
        if (!fits || value < min || value > max)
            fail(fmt::format("this must be a whole number, {} to {}", min, max));
        return value;
    }

    bool flag() const {
        if (!json_.is_boolean()) fail("this must be true or false");
        return json_.get<bool>();
    }

    double positive() const {
        const double value = json_.is_number() ? json_.get<double>() : 0;
        if (!(value > 0)) fail("this must be a number above 0");
        return value;
    }

    double any_number() const {
        if (!json_.is_number()) fail("this must be a number");
        return json_.get<double>();
    }

    /// Letters, digits and _, so that it can stand in any message.
    std::string word() const {
        std::string value = text();
        if (!is_identifier(value)) fail("this is no name: letters, digits and _, no digit first");
        return value;
    }

    /// A valid name of a program.
    std::string name() const {
        std::string value = word();
        if (is_reserved(value)) fail(fmt::format("'{}' is a word of the language, no name", value));
        return value;
    }

  private:
    const Json& json_;
    std::string path_;
};

/// Names that must be unique, case-insensitive.
class Different {
  public:
    void add(const Node& node, const std::string& name) {
        std::string key = upper(name);
        if (std::find(names_.begin(), names_.end(), key) != names_.end())
            node.fail(fmt::format("'{}' stands twice", name));
        names_.push_back(std::move(key));
    }

  private:
    std::vector<std::string> names_;
};

template <std::size_t Count>
void read_signals(const Node& node, std::array<std::string, Count>& names, Different& different) {
    const std::vector<Node> list = node.list();
    if (list.size() != Count) node.fail(fmt::format("there must be {} names", Count));
    for (std::size_t i = 0; i < Count; ++i) {
        names[i] = list[i].name();
        different.add(list[i], names[i]);
    }
}

void read_steps(const Node& node, SymbolFile& file) {
    Different different;
    for (const Node& step : node.list()) {
        const auto number = static_cast<std::size_t>(step["number"].whole(0, 62));
        std::string& name = file.symbols.steps[number];
        if (!name.empty()) step["number"].fail("this step stands twice");
        const Node written = step["name"];
        name = number == 0 && written.text() == "POWER_UP" ? written.word() : written.name();
        different.add(written, name);
        if (step.has("copy_of"))
            file.symbols.copy_of[number] = static_cast<std::uint8_t>(step["copy_of"].whole(0, 62));
        if (step.has("timer_is_limit") && step["timer_is_limit"].flag())
            file.symbols.timer_is_limit |= std::uint64_t{1} << number;
        if (step.has("made_for")) file.symbols.made_for[number] = step["made_for"].text();
        file.step_lines[number] = static_cast<std::uint32_t>(step["line"].whole(0, kMostLines));
        file.step_outputs[number] = static_cast<std::uint8_t>(step["outputs"].whole(0, 15));
    }
}

void read_groups(const Node& node, SymbolFile& file) {
    Different different;
    for (const Node& entry : node.list()) {
        StepGroup group{entry["name"].name(), 0};
        different.add(entry["name"], group.name);
        for (const Node& step : entry["steps"].list()) group.steps |= std::uint64_t{1} << step.whole(0, 62);
        file.symbols.groups.push_back(std::move(group));
    }
}

void read_times(const Node& node, SymbolFile& file) {
    constexpr std::int64_t kLongest = 3'600'000;
    Different different;
    for (const Node& entry : node.list()) {
        NamedTime time{entry["name"].name(), static_cast<std::uint32_t>(entry["ms"].whole(0, kLongest))};
        different.add(entry["name"], time.name);
        file.symbols.times.push_back(std::move(time));
    }
}

void read_registers(const Node& node, Symbols& symbols, Different& different) {
    for (const Node& entry : node.list()) {
        MotorName named{entry["name"].name(),
                        entry["register"].word(),
                        static_cast<std::uint8_t>(entry["number"].whole(1, kLastRegister)),
                        {}};
        if (entry.has("initial")) named.initial = entry["initial"].whole(INT32_MIN, UINT32_MAX);
        different.add(entry["name"], named.name);
        symbols.motor_names.push_back(std::move(named));
    }
}

void read_units(const Node& node, Symbols& symbols) {
    for (const Node& entry : node.list())
        symbols.units.insert_or_assign(static_cast<std::uint8_t>(entry["number"].whole(1, kLastRegister)),
                                       entry["unit"].text());
}

set_points::SetPoint read_set_point(const Node& node) {
    using set_points::ValueKind;
    set_points::SetPoint point;
    point.name = node["name"].name();
    if (node.has("preset")) {
        const std::string preset = node["preset"].text();
        if (preset != "timer" && preset != "counter") node["preset"].fail("this must be timer or counter");
        point.kind = preset == "timer" ? ValueKind::timer : ValueKind::counter;
    } else {
        point.reg = static_cast<std::uint8_t>(node["register"].whole(1, kLastRegister));
        point.longword = node["longword"].flag();
        point.at_power_up = node["at_power_up"].flag();
    }
    point.unit = node["unit"].text();
    point.unit_code = static_cast<std::uint8_t>(node["unit_code"].whole(0, 255));
    point.steps_per_unit = node["steps_per_unit"].positive();
    if (node.has("step")) point.step = node["step"].positive();
    if (node.has("grid_from")) point.grid_from = node["grid_from"].any_number();
    const auto number = [&](const char* name) {
        return static_cast<std::int32_t>(node[name].whole(INT32_MIN, INT32_MAX));
    };
    point.initial = number("initial");
    point.lowest = number("lowest");
    point.highest = number("highest");
    for (const Node& term : node["terms"].list())
        point.places.push_back(static_cast<std::uint16_t>(term.whole(0, UINT16_MAX)));
    return point;
}

void read_set_points(const Node& root, Symbols& symbols) {
    Different different;
    for (const Node& entry : root["set_points"].list()) {
        symbols.set_points.values.push_back(read_set_point(entry));
        different.add(entry["name"], symbols.set_points.values.back().name);
    }
    for (const Node& step : root["takes_set_points"].list())
        symbols.set_points.takes |= std::uint64_t{1} << step.whole(0, 62);
}

std::uint32_t read_crc(const Node& node) {
    const std::string text = node.text();
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (error != std::errc{} || text.size() != 8 || end != text.data() + text.size())
        node.fail("this must be a text of 8 hex digits");
    return value;
}

void read_table(const Node& table, const Node& terms, SymbolFile& file) {
    file.table_bytes = static_cast<std::size_t>(table["bytes"].whole(0, kMostBytes));
    file.crc32 = read_crc(table["crc32"]);
    for (const Node& term : terms.list()) {
        file.terms.push_back({static_cast<std::uint32_t>(term["line"].whole(0, kMostLines)),
                              static_cast<std::uint32_t>(term["column"].whole(0, kMostLines))});
    }
    const auto count = static_cast<std::size_t>(table["terms"].whole(1, kMostBytes));
    if (count * sequencer::kTermBytes != file.table_bytes)
        table["terms"].fail(fmt::format("{} terms are not {} bytes", count, file.table_bytes));
    if (count != file.terms.size()) terms.fail(fmt::format("there must be {} of them", count));
}

void read_motor(const Node& node, Symbols& symbols) {
    const auto choice = motor_named(node.text());
    if (!choice) node.fail(motor_names_text());
    symbols.motor = choice->map;
    symbols.drive = choice->drive;
}

SymbolFile read(const Node& root) {
    if (!root.has("format") || root["format"].text() != kSymbolsFormat)
        throw Wrong{fmt::format("this is no symbol file: \"format\" is not \"{}\"", kSymbolsFormat)};
    const auto version = root["version"].whole(1, kMostLines);
    if (version > kSymbolsVersion) {
        throw Wrong{fmt::format("version {} was written by a newer seqc; this one reads version {}", version,
                                kSymbolsVersion)};
    }
    SymbolFile file;
    file.symbols.program = root["program"].name();
    file.source = root["source"].text();
    read_motor(root["motor"], file.symbols);
    if (root.has("scale")) {
        const Node scale = root["scale"];
        file.symbols.scale = {scale["revolutions"].positive(), scale["length"].positive(),
                              scale["unit"].word()};
    }
    read_steps(root["steps"], file);
    if (root.has("groups")) read_groups(root["groups"], file);
    if (root.has("times")) read_times(root["times"], file);
    Different different;
    read_signals(root["inputs"], file.symbols.inputs, different);
    if (root.has("inverted_inputs")) {
        for (const Node& input : root["inverted_inputs"].list()) {
            const auto bit = static_cast<std::size_t>(input.whole(0, 5));
            if (same_name(file.symbols.inputs[bit], fmt::format("IN{}", bit)))
                input.fail(fmt::format("the name IN{} is the input itself and cannot be inverted", bit));
            file.symbols.inverted_inputs |= static_cast<std::uint8_t>(1U << bit);
        }
    }
    read_signals(root["outputs"], file.symbols.outputs, different);
    read_registers(root["registers"], file.symbols, different);
    if (root.has("units")) read_units(root["units"], file.symbols);
    if (root.has("set_points")) read_set_points(root, file.symbols);
    read_table(root["table"], root["terms"], file);
    return file;
}

}  // namespace

SymbolReading read_symbols(std::string_view text) {
    try {
        const Json json =
            Json::parse(text, [](int depth, Json::parse_event_t, const Json&) { return depth <= kDeepest; });
        return {read(Node(json, "")), {}};
    } catch (const Json::parse_error& error) {
        const std::size_t before = error.byte == 0 ? 0 : error.byte - 1;
        const Position at = position_of(text, static_cast<std::uint32_t>(std::min(before, text.size())));
        return {{}, fmt::format("this is not JSON, from line {}, column {} on", at.line, at.column)};
    } catch (const Json::exception& error) {
        return {{}, fmt::format("this JSON cannot be read: {}", error.what())};
    } catch (const Wrong& wrong) {
        return {{}, wrong.what};
    }
}

SymbolReading read_symbols(std::string_view text, std::span<const std::uint8_t> table) {
    SymbolReading reading = read_symbols(text);
    const std::uint32_t crc = base::crc32(table);
    const SymbolFile& file = reading.file;
    if (!reading.error.empty() || (file.table_bytes == table.size() && file.crc32 == crc)) return reading;
    return {{},
            fmt::format("it belongs to another table ({} bytes, CRC-32 {:08X}; this one: {} bytes, {:08X})",
                        file.table_bytes, file.crc32, table.size(), crc)};
}

std::string symbol_file_beside(std::string_view table_file) {
    const std::string beside = host::name_of(host::path_of(table_file).replace_extension(".sym"));
    return beside == table_file ? std::string() : beside;
}

}  // namespace nplc::seqc
