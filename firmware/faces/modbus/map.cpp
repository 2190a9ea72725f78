#include "modbus/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "registers/scale.h"

namespace nplc::modbus {
namespace {

constexpr Space D = Space::discrete_input;
constexpr Space I = Space::input_register;

constexpr ValueRow kRows[] = {
    {D, 0, 1, "ready"},
    {D, 1, 1, "running"},
    {D, 2, 1, "waiting"},
    {D, 3, 1, "held"},
    {D, 4, 1, "safe"},
    {D, 5, 1, "error"},
    {D, 6, 1, "in_position"},
    {D, 7, 1, "link_up"},
    {D, 8, 1, "forced"},
    {D, 9, 1, "at_breakpoint"},
    {D, 10, 1, "has_table"},
    {D, 11, 1, "enabled"},
    {D, 12, 1, "upload"},
    {D, 13, 1, "settings_differ"},
    {D, 14, 1, "cannot_go_on"},
    {D, 15, 1, "stop_unconfirmed"},
    {I, 2, 1, "run_state", 1, false, 4},
    {I, 3, 1, "step", 1, false, 62},
    {I, 4, 1, "counter"},
    {I, 5, 1, "inputs", 1, false, 63},
    {I, 6, 1, "terminals", 1, false, 63},
    {I, 7, 1, "outputs", 1, false, 15},
    {I, 8, 1, "written_outputs", 1, false, 15},
    {I, 9, 1, "safe_reason", 1, false, 15},
    {I, 10, 1, "last_event", 1, false, 255},
    {I, 11, 1, "last_event_step", 1, false, 63},
    {I, 12, 1, "last_event_detail"},
    {I, 13, 1, "heartbeat"},
    {I, 14, 1, "link", 1, false, 3},
    {I, 15, 1, "seat", 1, false, 2},
    {I, 16, 1, "control", 1, false, 2},
    {I, 18, 2, "timer"},
    {I, 20, 2, "event_count"},
    {I, 22, 2, "uptime"},
    {I, 24, 2, "scans"},
    {I, 26, 2, "scan_time"},
    {I, 28, 2, "worst_scan_time"},
    {I, 30, 2, "link_losses"},
    {I, 32, 2, "resent"},
    {I, 34, 2, "orders"},
    {I, 36, 2, "discarded"},
    {I, 38, 2, "table_crc"},
    {I, 46, 2, "worst_poll_gap"},
    {I, 48, 2, "late_polls"},
    {I, 50, 2, "stop_unconfirmed_time"},
    {I, 100, 2, "position_counts", 1, true},
    {I, 102, 2, "position", 1000, true},
    {I, 104, 2, "velocity", 1000, true},
    {I, 120, 2, "error_word"},
    {I, 122, 1, "mode"},
    {I, 123, 1, "torque", 10, true},
    {I, 124, 2, "follow_error", 1000, true},
    {I, 126, 2, "target", 1000, true},
    {I, 130, 1, "load", 10},
    {I, 140, 1, "temperature", 10, true},
    {I, kWhy, 1, "why"},
};

struct OwnRow {
    Space space;
    std::uint16_t address;
    std::string_view name;
    std::string_view unit;
    std::string_view access;
    std::string_view text;
    std::uint16_t words = 1;
    unsigned highest = 0;  ///< 0: what fits into it
};

constexpr Space C = Space::coil;
constexpr Space H = Space::holding_register;
constexpr OwnRow kOwn[] = {
    {C, kRun, "run", "", "read_write", "0 to 1: run, from the start or on from where it is held"},
    {C, kStop, "stop", "", "read_write", "1: the safe state; from everybody, always"},
    {C, kSafe, "make_safe", "", "read_write", "1: the safe state, forces and breakpoints end; always"},
    {C, kHold, "hold", "", "read_write", "1: hold at the end of the scan; always"},
    {C, kStep, "single_step", "", "read_write", "0 to 1: run until the step changes, then hold"},
    {C, kScan, "single_scan", "", "read_write", "0 to 1: one scan, then hold"},
    {C, kAcknowledge, "acknowledge", "", "read_write", "1: new_events counts from 0"},
    {C, kResetError, "reset_error", "", "read_write", "0 to 1: clears the motor's errors"},
    {H, kCommand, "command", "", "read_write",
     "1 run, 2 stop, 3 safe, 4 scan, 5 step, 6 hold, 32 acknowledge, 33 reset_error, 34 set the set-points "
     "written, 35 load the recipe"},
    {H, kCommandNumber, "command_number", "", "read_write",
     "another number than before carries the command out; 0 carries nothing out"},
    {H, kForceInputs, "force_inputs", "", "read_write",
     "bits 5..0 levels, 13..8 which; to be written again before force_timeout"},
    {H, kForceOutputs, "force_outputs", "", "read_write", "bits 3..0 levels, 11..8 which; likewise"},
    {H, kRecipe, "recipe", "", "read_write", "number of the recipe that command 35 loads"},
    {H, kSetPointsWritten, "set_points_written", "", "read_write",
     "bit n: set_point_n was written by this client, and command 34 has not taken it; a 0 forgets them"},
    {I, kSetPointCount, "set_point_count", "", "read", "set-points of the active table", 1, 16},
    {I, kSetPointState, "set_point_state", "", "read",
     "bit 0: changes wait for the sequence; 1: stored values are damaged; 2: they differ from the recipe", 1,
     7},
    {I, kActiveRecipe, "active_recipe", "", "read", "number of the recipe that was loaded last; 0: none", 1,
     255},
    {I, kRecipeRoom, "recipe_room", "", "read", "recipes that there is room for"},
    {I, kSetPointRecord, "set_point_record", "", "read",
     "CRC-32 of names, units and ranges: another one, another table", 2},
    {I, kSetPointChanges, "set_point_changes", "", "read", "values changed since the start", 2},
    {I, kWhySeverity, "why_severity", "", "read", "0 it cannot move, 1 it may soon stop, 2 good to know", 1,
     2},
    {I, kWhyText, "why_text", "", "read", "the cause in words; text as of set-points, cut at its end",
     kWhyEnd - kWhyText},
    {I, kMapVersion, "map_version", "", "read", "1"},
    {I, kStatusWord, "status_word", "", "read", "discrete inputs 0..15, a bit each"},
    {I, kDoneNumber, "done_number", "", "read", "the command_number that has been dealt with"},
    {I, kResult, "result", "", "read", "of it: 0 done, else REGISTERS.md, Results"},
    {I, kResultDetail, "result_detail", "", "read", "its detail"},
    {I, kNewEvents, "new_events", "", "read", "events since the last acknowledge"},
    {I, kMySeat, "my_seat", "", "read", "1: this client has the seat", 1, 1},
    {I, kImageAge, "image_age", "ms", "read", "of all values but the motor's; 1000 and more are not read"},
};

std::string_view word_of(Space space) {
    constexpr std::array<std::string_view, 4> kWords{"coil", "discrete_input", "input_register",
                                                     "holding_register"};
    return kWords[static_cast<std::size_t>(space)];
}

struct Line {
    Space space;
    std::uint16_t address;
    std::string name;
    std::string type;
    unsigned words;
    std::string scale;
    std::string unit;
    std::string range;
    std::string text;
    std::string access;
};

std::string in_digits(double value) {
    return fmt::format("{:.10g}", value);
}

std::string span_of(double low, double high, double scale) {
    return fmt::format("{}..{}", in_digits(low * scale), in_digits(high * scale));
}

/// "uint16" and its range.
struct Number {
    std::string type;
    std::string range;
};

/// highest 0: what fits into it.
Number number_of(unsigned words, bool is_signed, double scale, unsigned highest) {
    const double values = std::exp2(16.0 * words);
    const double low = is_signed ? -values / 2 : 0;
    const double most = is_signed ? values / 2 - 1 : values - 1;
    return {fmt::format("{}int{}", is_signed ? "" : "u", 16 * words),
            span_of(low, highest != 0 ? highest : most, scale)};
}

Line line_of(const OwnRow& row) {
    Line line{row.space,
              row.address,
              std::string(row.name),
              "bool",
              row.words,
              "1",
              std::string(row.unit),
              "0..1",
              std::string(row.text),
              std::string(row.access)};
    if (row.space == C) return line;
    const Number number = row.words <= 2 ? number_of(row.words, false, 1, row.highest) : Number{"text", ""};
    line.type = number.type;
    line.range = number.range;
    return line;
}

Line line_of(const ValueRow& row, const faces::Scaling& scaling) {
    const Number number = row.space == D ? Number{"bool", "0..1"}
                                         : number_of(row.words, row.is_signed, 1 / row.steps, row.highest);
    return {row.space,
            row.address,
            std::string(row.name),
            number.type,
            row.words,
            in_digits(1 / row.steps),
            faces::unit_of(*row.point, scaling),
            number.range,
            std::string(row.point->text),
            "read"};
}

/// A motor's register as the window has it: two words, extended by its sign.
Line line_of(const registers::Register& reg, registers::Model model) {
    const auto units = registers::units_of(reg.unit);
    const std::string unit(units.empty() ? "" : units.front());
    const std::string shown = unit == "°C" ? "C" : unit;  // as the other rows, in ASCII
    const auto steps = registers::raw_per_unit(reg, model, unit);
    const double scale =
        steps ? static_cast<double>(steps->denominator) / static_cast<double>(steps->numerator) : 1;
    return {Space::holding_register,
            static_cast<std::uint16_t>(kMotorWindow + 2 * reg.number),
            fmt::format("motor.{}", reg.name),
            reg.min < 0 ? "int32" : "uint32",
            2,
            in_digits(scale),
            shown,
            span_of(static_cast<double>(reg.min), static_cast<double>(reg.max), scale),
            fmt::format("register {} of the motor, manual {}", reg.number, reg.section),
            reg.access == registers::Access::read_only ? "read" : "read_write"};
}

struct SetPointRow {
    Space space;
    unsigned address;  ///< of the first one
    unsigned stride;   ///< words from one to the next
    unsigned words;
    std::string_view name;
    std::string_view text;
};
constexpr SetPointRow kSetPointRows[] = {
    {H, kSetPointsNew, 2, 2, "",
     "the wanted value, in its unit times 10^decimals, signed; what is written waits for command 34"},
    {I, kSetPointValues, 2, 2, "_in_force", "the value in force, in its unit times 10^decimals, signed"},
    {I, unsigned{kSetPointTexts} + kTextOfLowest, kTextWords, 2, "_lowest", "the range, likewise"},
    {I, unsigned{kSetPointTexts} + kTextOfHighest, kTextWords, 2, "_highest", "the same"},
    {I, unsigned{kSetPointTexts} + kTextOfDefault, kTextWords, 2, "_default",
     "the value that the program gives it"},
    {I, unsigned{kSetPointTexts} + kTextOfStep, kTextWords, 2, "_step", "the STEP of the program; 0: none"},
    {I, unsigned{kSetPointTexts} + kTextOfDecimals, kTextWords, 1, "_decimals", "digits behind the point"},
    {I, unsigned{kSetPointTexts} + kTextOfUnit, kTextWords, kTextOfName - kTextOfUnit, "_unit",
     "text, two characters a word, the first one high, filled up with 0"},
    {I, unsigned{kSetPointTexts} + kTextOfName, kTextWords, kTextWords - kTextOfName, "_name",
     "text likewise"},
};

Line line_of(const SetPointRow& row, unsigned index) {
    const Number number = row.words == 2   ? number_of(2, true, 1, 0)
                          : row.words == 1 ? Number{"uint16", "0..9"}
                                           : Number{"text", ""};
    return {row.space,
            static_cast<std::uint16_t>(row.address + row.stride * index),
            fmt::format("set_point_{}{}", index, row.name),
            number.type,
            row.words,
            "1",
            "",
            number.range,
            std::string(row.text),
            row.space == H ? "read_write" : "read"};
}

/// The first `count` set-points and recipes.
void add_set_points(std::vector<Line>& all, unsigned count) {
    for (const SetPointRow& row : kSetPointRows) {
        for (unsigned i = 0; i < std::min<unsigned>(count, registers::gateway::kSetPoints); ++i)
            all.push_back(line_of(row, i));
    }
    for (unsigned i = 0; i < std::min<unsigned>(count, kRecipes); ++i)
        all.push_back({I, static_cast<std::uint16_t>(kRecipeNames + kRecipeWords * i),
                       fmt::format("recipe_{}_name", i + 1), "text", kRecipeWords, "1", "", "",
                       "text; empty: there is none", "read"});
}

std::vector<Line> lines(const faces::Scaling& scaling, unsigned set_points) {
    std::vector<Line> all;
    add_set_points(all, set_points);
    for (const OwnRow& row : kOwn) all.push_back(line_of(row));
    for (const ValueRow& row : value_rows()) all.push_back(line_of(row, scaling));
    std::sort(all.begin(), all.end(), [](const Line& a, const Line& b) {
        return a.space != b.space ? a.space < b.space : a.address < b.address;
    });
    return all;
}

/// Quoted where that must be.
std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char one : text) quoted += one == '"' ? std::string("\"\"") : std::string(1, one);
    return quoted + "\"";
}

}  // namespace

std::span<const ValueRow> value_rows() {
    static const auto rows = [] {
        auto all = std::to_array(kRows);
        for (ValueRow& row : all) row.point = faces::find_point(row.name);
        return all;
    }();
    return rows;
}

const ValueRow* find_row(Space space, std::uint16_t address) {
    for (const ValueRow& row : value_rows()) {
        if (row.space == space && address >= row.address && address < row.address + row.words) return &row;
    }
    return nullptr;
}

bool is_second_word(Space space, unsigned address) {
    const auto is_of = [&](const auto& row) {
        return row.space == space && row.words == 2 && address == row.address + 1U;
    };
    if (std::any_of(std::begin(kRows), std::end(kRows), is_of)) return true;
    if (std::any_of(std::begin(kOwn), std::end(kOwn), is_of)) return true;
    return std::any_of(std::begin(kSetPointRows), std::end(kSetPointRows), [&](const SetPointRow& row) {
        const unsigned offset = address - row.address;  // before the first one it is large
        return row.space == space && row.words == 2 && offset % row.stride == 1 &&
               offset / row.stride < registers::gateway::kSetPoints;
    });
}

std::string map_as_csv(const faces::Scaling& scaling, registers::Model model) {
    std::vector<Line> all = lines(scaling, registers::gateway::kSetPoints);
    for (const registers::Register& reg : registers::map_of(model)) all.push_back(line_of(reg, model));
    std::string text = "address,block,name,type,words,scale,unit,range,meaning,access\n";
    for (const Line& line : all)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", line.address, word_of(line.space),
                            csv_field(line.name), line.type, line.words, line.scale, csv_field(line.unit),
                            line.range, csv_field(line.text), line.access);
    return text;
}

std::string map_as_markdown() {
    std::string text =
        "| address | block | name | type | words | scale | unit | range | meaning | access |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Line& line : lines({}, 1))
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", line.address,
                            word_of(line.space), line.name, line.type, line.words, line.scale, line.unit,
                            line.range, line.text, line.access);
    return text;
}

}  // namespace nplc::modbus
