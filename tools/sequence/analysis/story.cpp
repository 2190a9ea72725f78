#include "analysis/story.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace nplc::verify {
namespace {

std::string listed(const std::vector<std::string>& words) {
    return words.empty() ? "-" : fmt::format("{}", fmt::join(words, ","));
}

std::string image_text(std::uint8_t image, const Names& names) {
    std::vector<std::string> on;
    for (unsigned i = 0; i < 6; ++i) {
        if (input_holds(names, i, image)) on.push_back(input_name(names, i));
    }
    if ((image & sequencer::kInPos) != 0) on.emplace_back("INPOS");
    if ((image & sequencer::kError) != 0) on.emplace_back("ERROR");
    return listed(on);
}

/// As a trace has them.
std::string bare_orders(const std::vector<sequencer::MotorOrder>& orders) {
    std::string text;
    for (const auto& order : orders) {
        text += order.is_register_write ? fmt::format(" {}={}", order.reg, order.value)
                                        : fmt::format(" {:02X}h", order.command);
    }
    return text;
}

/// Lines that are no longer than they must be.
std::vector<std::string> order_lines(const std::vector<sequencer::MotorOrder>& orders, const Names& names) {
    constexpr std::size_t kLongest = 60;
    std::vector<std::string> lines;
    for (const auto& order : orders) {
        const std::string text = order_text(order, names);
        if (!lines.empty() && lines.back().size() + 2 + text.size() <= kLongest) {
            lines.back() += "; " + text;
        } else {
            if (!lines.empty()) lines.back() += ";";
            lines.push_back(text);
        }
    }
    return lines;
}

/// Rows of words, each column as wide as its longest.
class Columns {
  public:
    static constexpr std::size_t kCount = 7;
    using Row = std::array<std::string, kCount>;

    void add(Row row) {
        for (std::size_t i = 0; i < kCount; ++i) widths_[i] = std::max(widths_[i], row[i].size());
        rows_.push_back(std::move(row));
    }
    /// Below the row before: a time, and a line that is no part of the columns.
    void add_line(std::uint64_t time, const std::string& line) {
        lines_.emplace(rows_.size(), fmt::format("  {:>7}  {}\n", time, line));
    }

    std::string text() const {
        std::string text;
        for (std::size_t number = 0; number < rows_.size(); ++number) {
            const Row& row = rows_[number];
            std::string line;
            for (std::size_t i = 0; i < kCount; ++i)
                line += is_number(i) ? fmt::format("  {:>{}}", row[i], widths_[i])
                                     : fmt::format("  {:<{}}", row[i], widths_[i]);
            text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
            if (const auto found = lines_.find(number + 1); found != lines_.end()) text += found->second;
        }
        return text;
    }

  private:
    static bool is_number(std::size_t column) { return column == 0 || column == 4 || column == 5; }

    std::array<std::size_t, kCount> widths_{7};
    std::vector<Row> rows_;
    std::map<std::size_t, std::string> lines_;  ///< by the number of rows before
};

void add_scan(Columns& columns, std::uint64_t time, const PlayedScan& scan, const Names& names) {
    const std::string steps =
        scan.step == scan.after.step
            ? step_name(names, scan.step)
            : fmt::format("{} -> {}", step_name(names, scan.step), step_name(names, scan.after.step));
    const std::vector<std::string> orders = order_lines(scan.orders, names);
    columns.add({fmt::format("{}", time), image_text(scan.image, names), steps,
                 outputs_text(scan.after.outputs, names), fmt::format("{}", scan.after.timer),
                 fmt::format("{}", scan.after.counter), orders.empty() ? "" : orders.front()});
    for (std::size_t i = 1; i < orders.size(); ++i) columns.add({"", "", "", "", "", "", orders[i]});
}

/// Inputs that change between the scan that leads into a step and one that begins there, by name.
std::vector<std::string> changes_in(const Course& course, std::uint8_t step, const Names& names) {
    unsigned changed = 0;
    for (std::size_t i = 1; i < course.size(); ++i) {
        if (course[i].step == step) changed |= unsigned{course[i].image} ^ unsigned { course[i - 1].image };
    }
    std::vector<std::string> inputs;
    for (unsigned i = 0; i < 6; ++i) {
        if ((changed >> i & 1U) != 0) inputs.push_back(input_name(names, i));
    }
    return inputs;
}

std::string helpers_text(const Course& course, const Names& names) {
    std::uint64_t told = 0;
    std::string text;
    for (const PlayedScan& scan : course) {
        const std::uint64_t bit = std::uint64_t{1} << scan.after.step;
        if ((names.helpers & bit & ~told) == 0) continue;
        told |= bit;
        const std::vector<std::string> changed = changes_in(course, scan.after.step, names);
        text += fmt::format(
            "  {} is a helper step that the compiler made for a branch; it does not ask again{}\n",
            step_name(names, scan.after.step),
            changed.empty() ? "" : fmt::format(": write a step that tests {}", fmt::join(changed, " and ")));
    }
    return text;
}

/// The time and scan in which the course shows the result.
std::string end_text(const Result& result) {
    const Course& course = *result.course;
    std::uint64_t time = 0;
    for (const PlayedScan& scan : course) time += scan.dt_ms;
    const std::uint32_t last = course.back().dt_ms;
    const bool breaks = result.code.empty();
    const std::string what =
        fmt::format("here {} {}", breaks ? result.name : result.code, breaks ? "breaks" : "shows");
    if (result.is_late)
        return fmt::format("  {:>7}  {}: {} ms after scan {}\n", time, what, last, course.size());
    return fmt::format("  {:>7}  {}: in scan {}\n", time - last, what, course.size());
}

}  // namespace

std::string order_text(const sequencer::MotorOrder& order, const Names& names) {
    return names.order ? names.order(order) : bare_orders({order}).substr(1);
}

std::string input_name(const Names& names, unsigned input) {
    return names.inputs[input].empty() ? fmt::format("IN{}", input) : names.inputs[input];
}

bool input_holds(const Names& names, unsigned input, std::uint8_t image) {
    return (((unsigned{image} ^ names.inverted_inputs) >> input) & 1U) != 0;
}

std::string output_name(const Names& names, unsigned output) {
    return names.outputs[output].empty() ? fmt::format("OUT{}", output) : names.outputs[output];
}

std::string outputs_text(std::uint8_t outputs, const Names& names) {
    std::vector<std::string> on;
    for (unsigned i = 0; i < 4; ++i) {
        if (((unsigned{outputs} >> i) & 1U) != 0) on.push_back(output_name(names, i));
    }
    return listed(on);
}

std::string step_name(const Names& names, std::uint8_t step) {
    return names.steps[step].empty() ? fmt::format("{}", step) : names.steps[step];
}

std::string story_of(const Result& result, const Names& names) {
    const Course& course = *result.course;
    if (course.empty()) return {};
    Columns columns;
    columns.add({"ms", "on", "step", "outputs", "timer", "counter", "orders"});
    std::uint64_t time = 0;
    std::size_t number = 0;
    for (const PlayedScan& scan : course) {
        ++number;
        if (!scan.repeats) add_scan(columns, time, scan, names);
        if (scan.begins)
            columns.add_line(time, fmt::format("here the {} ms of {} begin: in scan {}", result.time_ms,
                                               result.name, number));
        time += scan.dt_ms;
    }
    return columns.text() + end_text(result) + helpers_text(course, names);
}

std::string stimulus_of(const Result& result) {
    std::string text;
    for (const SetValue& value : result.set_values)
        text += fmt::format("# preset {} in term {}: {} := {}\n", value.preset, fmt::join(value.places, ", "),
                            value.name, value.text);
    text += "dt_ms,inputs,inpos,error\n";
    for (const PlayedScan& scan : *result.course) {
        text += fmt::format("{},{},{},{}\n", scan.dt_ms, scan.image & sequencer::kInputsMask,
                            (scan.image & sequencer::kInPos) != 0 ? 1 : 0,
                            (scan.image & sequencer::kError) != 0 ? 1 : 0);
    }
    return text;
}

std::string trace_of(const Course& course) {
    std::string text = "time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n";
    const auto row = [&text](std::uint64_t time, const PlayedScan& scan, std::uint16_t timer,
                             std::string_view orders) {
        text += fmt::format("{},{},{},{},{},{},{},{},{},,\n", time, scan.after.step, timer,
                            scan.after.counter, scan.image & sequencer::kInputsMask, scan.after.outputs,
                            (scan.image & sequencer::kInPos) != 0 ? 1 : 0,
                            (scan.image & sequencer::kError) != 0 ? 1 : 0, orders);
    };
    std::uint64_t time = 0;
    for (const PlayedScan& scan : course) {
        const std::string orders = bare_orders(scan.orders);
        row(time, scan, scan.after.timer, orders.empty() ? orders : orders.substr(1));
        time += scan.dt_ms;
    }
    if (course.empty()) return text;
    const PlayedScan& last = course.back();
    const std::uint32_t left = last.after.timer > last.dt_ms ? last.after.timer - last.dt_ms : 0;
    row(time + (last.dt_ms == 0 ? 1 : 0), last, static_cast<std::uint16_t>(left), "");
    return text;
}

}  // namespace nplc::verify
