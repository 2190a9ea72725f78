#include "wiring.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "drive_support.h"

namespace nplc::boards {
namespace {

using Row = WiringRow;

std::string in_words(hal_linux::GpioBias bias) {
    switch (bias) {
        case hal_linux::GpioBias::as_is:
            return "";
        case hal_linux::GpioBias::off:
            return ", no bias";
        case hal_linux::GpioBias::pull_up:
            return ", pulled up";
        case hal_linux::GpioBias::pull_down:
            return ", pulled down";
    }
    return "";
}

Row input_row(std::size_t number, const std::optional<hal_linux::GpioLine>& line) {
    const std::string signal = fmt::format("IN{}", number);
    if (!line) return {signal, "none", "reads 0 always", fmt::format("input {}", number)};
    return {signal, line->where, (line->active_low ? "0 V = 1" : "high = 1") + in_words(line->bias),
            fmt::format("input {}", number)};
}

Row output_row(std::size_t number, const std::optional<hal_linux::GpioLine>& line, bool is_on_when_safe) {
    const std::string signal = fmt::format("OUT{}", number);
    const std::string safe = is_on_when_safe ? ", safe: 1" : ", safe: 0";
    if (!line) return {signal, "none", "goes nowhere", fmt::format("output {}", number)};
    return {signal, line->where, (line->active_low ? "1 = 0 V" : "1 = high") + safe,
            fmt::format("output {}", number)};
}

std::string table_of(const std::vector<Row>& rows) {
    std::array<std::size_t, 4> widths{};
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const Row& row : rows) {
        std::string line = "  ";
        for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("{:<{}}  ", row[i], widths[i]);
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string of_axis(const AxisConfig& axis) {
    using store::Setting;
    std::vector<Row> rows{{"signal", "this board", "level", "MAC00-R1/R3/R4"}};
    for (std::size_t i = 0; i < axis.inputs.size(); ++i) rows.push_back(input_row(i, axis.inputs[i]));
    const std::uint32_t safe = axis.settings.get(Setting::safe_outputs);
    for (std::size_t i = 0; i < axis.outputs.size(); ++i)
        rows.push_back(output_row(i, axis.outputs[i], (safe >> i & 1U) != 0));
    const std::vector<Row> motor =
        support_of(axis.motor).wiring(axis.motor, axis.settings.get(Setting::motor_baud));
    rows.insert(rows.end(), motor.begin(), motor.end());
    const bool is_serial = axis.user_port.is_there() && !is_endpoint(axis.user_port.text);
    rows.push_back({"user", axis.user_port.is_there() ? axis.user_port.text : "none",
                    is_serial ? fmt::format("{} baud, 8N1", axis.settings.get(Setting::user_baud)) : "",
                    "MacTalk port"});
    std::string text = fmt::format("Axis {}\n\n{}", axis.name, table_of(rows));
    if (const std::uint32_t enable = axis.settings.get(Setting::enable_input);
        enable != registers::gateway::kNone)
        text += fmt::format("\n  IN{} is the enable input: without it nothing runs.\n", enable);
    if (const std::uint32_t lamp = axis.settings.get(Setting::status_output);
        lamp != registers::gateway::kNone)
        text += fmt::format("\n  OUT{} shows the gateway's state and is not the sequence's.\n", lamp);
    return text + support_of(axis.motor).notes(axis.motor);
}

}  // namespace

std::string wiring(const Config& config) {
    std::string text;
    std::set<std::string> closing;
    for (const AxisConfig& axis : config.axes) {
        text += of_axis(axis) + "\n";
        closing.insert(support_of(axis.motor).closing_note());
    }
    for (const std::string& note : closing) text += note;
    return text +
           "A GPIO line of a board carries 3.3 V and a few mA: field signals (24 V) need opto-couplers, "
           "outputs a driver.\n"
           "Settings stored over the user's port go before the configuration's: see `nanoctl settings`.\n";
}

}  // namespace nplc::boards
