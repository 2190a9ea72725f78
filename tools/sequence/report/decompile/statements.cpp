#include "report/decompile/statements.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/scope.h"
#include "language/reserved_words.h"
#include "report/decompile/groups.h"
#include "report/decompile/vocabulary.h"
#include "report/describe.h"
#include "report/table_text.h"
#include "symbols/commands.h"
#include "table/step.h"

namespace nplc::seqc {
namespace {

using table::Mode;
using RegisterGroup = table::Group;

constexpr std::uint8_t kLastCommonRegister = 88;  // the same on all motors up to here

/// INIT, VELOCITY or POSITION with several registers, which the compiler sends in its own order.
struct SelectedText {
    std::string text;
    std::size_t count = 0;
};

int rank(const SelectCommand& select) {
    if (select.selection.group == RegisterGroup::p) return 2;
    return select.selection.group == RegisterGroup::v && select.mode == Mode::velocity ? 0 : 1;
}

/// "V1" of "INIT(V1)", or the register's given name.
std::string argument(std::uint8_t command, const Naming& naming) {
    const std::string text = describe_command(command);
    const std::size_t open = text.find('(');
    std::string name = text.substr(open + 1, text.size() - open - 2);
    // Registers that can be selected have the same number in all motors.
    const registers::Register* reg = registers::find(registers::Model::mac140, name);
    const auto given = reg != nullptr ? naming.registers.find(reg->number) : naming.registers.end();
    return given != naming.registers.end() ? given->second : name;
}

SelectedText selection_at(const std::vector<Send>& sends, std::size_t at, const Naming& naming) {
    SelectedText result{describe_command(sends[at].command), 1};
    const auto first = select_command(sends[at].command);
    if (!first) return result;
    result.text = fmt::format("{}({})", result.text.substr(0, result.text.find('(')),
                              argument(sends[at].command, naming));
    std::vector<SelectCommand> taken = {*first};
    result.text.pop_back();
    for (std::size_t i = at + 1; i < sends.size() && sends[i].reg == nullptr; ++i) {
        const auto next = select_command(sends[i].command);
        if (!next || next->mode != first->mode || rank(*next) < rank(taken.back())) break;
        const bool again = std::any_of(taken.begin(), taken.end(), [&](const SelectCommand& s) {
            return s.selection.group == next->selection.group;
        });
        if (again) break;
        taken.push_back(*next);
        result.text += ", " + argument(sends[i].command, naming);
        ++result.count;
    }
    result.text += ")";
    return result;
}

Line write_line(const Send& send, const WriterContext& context) {
    const auto number = static_cast<std::int32_t>(number_of_bits(send.value, send.reg->format));
    if (const auto* point =
            context.naming.set_point(set_points::ValueKind::motor_register, send.reg->number, number))
        return {fmt::format("{} := {};", register_text(*send.reg, context), point->name), {}};
    const ValueText value =
        value_text(*send.reg, send.value, context.naming.symbols, context.naming.exact_places);
    return {fmt::format("{} := {};", register_text(*send.reg, context), value.text), value.comment};
}

std::string condition_text(const sequencer::TermBytes& bytes, const WriterContext& context) {
    const Truth cases = table::cases_of(bytes);
    return formula_of(cases, cases, context.naming.bits).text;
}

}  // namespace

std::string register_text(const registers::Register& reg, const WriterContext& context) {
    const auto given = context.naming.registers.find(reg.number);
    return given != context.naming.registers.end() ? given->second : register_address(reg, context);
}

/// Up to 88 the names that commands use too: V1, not the MAC800's VEL0.
std::string register_address(const registers::Register& reg, const WriterContext& context) {
    const bool shared = reg.number <= kLastCommonRegister;
    const registers::Register* common =
        shared ? registers::find(registers::Model::mac140, reg.number) : nullptr;
    const std::string_view name = common != nullptr ? common->name : reg.name;
    const registers::Register* named = registers::find(context.motor, name);
    const bool usable =
        (shared || context.motor_is_sure) && is_name(name) && named != nullptr && named->number == reg.number;
    return usable ? std::string(name) : fmt::format("REG({})", reg.number);
}

std::vector<Line> statements_of(const Action& action, const WriterContext& context) {
    std::vector<Line> lines;
    for (std::size_t i = 0; i < action.sends.size();) {
        if (action.sends[i].reg != nullptr) {
            lines.push_back(write_line(action.sends[i++], context));
            continue;
        }
        const SelectedText selection = selection_at(action.sends, i, context.naming);
        lines.push_back({selection.text + ";", {}});
        i += selection.count;
    }
    if (action.clears_counter) lines.push_back({"CLEAR_COUNTER;", {}});
    if (action.counts_down) lines.push_back({"COUNT_DOWN;", {}});
    const auto preset = [&](set_points::ValueKind kind, std::uint16_t value, const std::string& constant) {
        const auto* point = context.naming.set_point(kind, 0, value);
        return point != nullptr ? point->name : constant;
    };
    if (action.timer)
        lines.push_back({fmt::format("TIMER := {};", preset(set_points::ValueKind::timer, *action.timer,
                                                            time_text(*action.timer))),
                         {}});
    if (action.counter)
        lines.push_back({fmt::format("COUNTER := {};", preset(set_points::ValueKind::counter, *action.counter,
                                                              std::to_string(*action.counter))),
                         {}});
    return lines;
}

std::string next_text(std::uint8_t step, const WriterContext& context) {
    const bool power_up = step == 0 && context.has_power_up;
    return fmt::format("NEXT := {};", power_up ? "POWER_UP" : context.naming.symbols.steps[step]);
}

std::string outputs_text(std::uint8_t outputs, const Naming& naming) {
    std::string text;
    for (std::size_t bit = 0; bit < naming.symbols.outputs.size(); ++bit) {
        if (((outputs >> bit) & 1) == 0) continue;
        text += (text.empty() ? "OUT " : ", ") + naming.symbols.outputs[bit];
    }
    return text + ";";
}

Line term_line(sequencer::TermView term, bool inside, const WriterContext& context) {
    sequencer::TermBytes bytes{};
    std::copy(term.begin(), term.end(), bytes.begin());
    if (sequencer::is_end(bytes)) return {byte_line(bytes), describe(bytes, nullptr)};
    const std::string_view why = obstacle(bytes, context.motor);
    if (!why.empty())
        return {byte_line(bytes), fmt::format("{}: {}", why, describe(bytes, &context.naming.symbols))};
    const std::vector<Group> groups = groups_of({bytes}, context.motor);
    const Action& action = groups.front().action;
    const std::string name = inside ? "" : context.naming.symbols.steps[sequencer::step_of(bytes)] + ": ";
    Line line{fmt::format("TERM {}IF {} THEN ", name, condition_text(bytes, context)), {}};
    for (const Line& statement : statements_of(action, context)) {
        line.text += statement.text + " ";
        line.comment += statement.comment;
    }
    if (groups.front().outputs != 0) line.text += outputs_text(groups.front().outputs, context.naming) + " ";
    if (action.next) line.text += next_text(*action.next, context) + " ";
    line.text += "END_IF;";
    return line;
}

}  // namespace nplc::seqc
