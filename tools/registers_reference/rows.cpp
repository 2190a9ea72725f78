#include <fmt/format.h>

#include "parts.h"
#include "registers/convert.h"
#include "registers/layout.h"
#include "registers/scale.h"

namespace nplc::registers_reference {
namespace {

using registers::Model;
using registers::Register;
using registers::Unit;

struct Group {
    int first;
    std::string_view title;
};

constexpr Group kSmallGroups[] = {
    {1, "Main control"}, {16, "Errors and limits"}, {36, "Set-up and homing"}, {43, "Register mode"},
    {89, "Filters"},     {112, "Recording"},        {117, "Outer loop"},       {124, "Inner loop (currents)"},
    {153, "Various"},
};

constexpr Group kMac800Groups[] = {
    {1, "Main control"}, {16, "Errors and limits"}, {36, "Set-up and homing"}, {43, "Register mode"},
    {121, "Filters"},    {158, "Recording"},        {163, "Outer loop"},       {172, "Inner loop (currents)"},
    {202, "Various"},
};

std::span<const Group> groups_of(Model model) {
    if (model == Model::mac800) return kMac800Groups;
    return kSmallGroups;
}

std::string numbers(Model model, const Register& reg) {
    if (registers::cells_of(model, reg).count == 1) return fmt::format("{}", reg.number);
    return fmt::format("{}, {}", reg.number, reg.number + 1);
}

/// `1 rpm = 2.09715`, with as many of the unit as make at least one step.
std::string factor(Model model, const Register& reg) {
    const auto units = registers::units_of(reg.unit);
    const std::string_view unit = units.empty() ? std::string_view() : units.front();
    const auto ratio = registers::raw_per_unit(reg, model, unit);
    double steps = static_cast<double>(ratio->numerator) / static_cast<double>(ratio->denominator);
    int amount = reg.unit == Unit::torque ? 100 : 1;
    steps *= amount;
    for (; steps < 1; steps *= 10) amount *= 10;
    return fmt::format("{}{}{} = {:.6g}", amount, unit.empty() ? "" : " ", unit, steps);
}

std::string unit_cell(Model model, const Register& reg) {
    if (!registers::fields_of(model, reg.number).empty()) {
        return fmt::format("[{}](#{})", reg.unit == Unit::bits ? "bits" : "values", anchor(reg));
    }
    const bool plain = reg.unit == Unit::none && registers::one_in(reg.format) == 1;
    return plain ? "" : factor(model, reg);
}

/// The ends of a 32-bit format are far beyond any motor.
bool is_out_of_this_world(std::int64_t from, std::int64_t to) {
    return from <= -INT32_MAX && to == INT32_MAX;
}

/// `-32767 .. 32767`, and where there is a unit or a point, after `before`, the same in it.
std::string range(std::int64_t from, std::int64_t to, const Register& reg, Model model,
                  std::string_view before) {
    const std::string text = fmt::format("{} .. {}", from, to);
    if (reg.unit == Unit::none && registers::one_in(reg.format) == 1) return text;
    if (reg.unit != Unit::none && is_out_of_this_world(from, to)) return text;
    const registers::Text start = registers::to_text(from, reg, model);
    const registers::Text end = registers::to_text(to, reg, model);
    const std::string_view number = start.view().substr(0, start.view().find(' '));
    return fmt::format("{}{}{} .. {}", text, before, number, end.view());
}

std::string range_cell(Model model, const Register& reg, const registers::Details& details) {
    if (reg.unit == Unit::bits) return "";
    std::string text = range(reg.min, reg.max, reg, model, "<br>");
    const auto [from, to] = details.recommended;
    if (from == 0 && to == 0) return text;
    if (from == to) return text + fmt::format("<br>nominal {}", from);
    return text + fmt::format("<br>recommended {}", range(from, to, reg, model, ": "));
}

std::string row(Model model, const Register& reg) {
    const registers::Details& details = *registers::details_of(model, reg.number);
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", numbers(model, reg), reg.name,
                       cell(details.title), name_of(reg.format), unit_cell(model, reg),
                       range_cell(model, reg, details), name_of(reg.access), reg.dangerous ? "**yes**" : "",
                       reg.section);
}

}  // namespace

std::string registers_by_group(Model model) {
    std::string text;
    const auto groups = groups_of(model);
    std::size_t next = 0;
    for (const Register& reg : registers::map_of(model)) {
        if (next < groups.size() && reg.number >= groups[next].first) {
            text += fmt::format(
                "\n### {}\n\n| no. | name | what it is | format | unit | range | access | danger | manual |\n"
                "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
                groups[next++].title);
        }
        text += row(model, reg);
    }
    return text;
}

}  // namespace nplc::registers_reference
