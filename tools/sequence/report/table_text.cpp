#include "report/table_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "language/names.h"
#include "lowering/cover.h"
#include "registers/details.h"
#include "symbols/commands.h"
#include "symbols/units.h"

namespace nplc::seqc {
namespace {

/// The cases in which ERROR is `value`, copied to both values of it.
Truth where_error(const Truth& truth, bool value) {
    const Truth high = truth_of_bit(kErrorBit);
    constexpr std::size_t kStep = std::size_t{1} << kErrorBit;
    return value ? (truth & high) | ((truth & high) >> kStep) : (truth & ~high) | ((truth & ~high) << kStep);
}

std::string product_text(Product product, const Symbols* symbols) {
    std::string text;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        if (((product.care >> bit) & 1) == 0) continue;
        append(text, bit_text(bit, ((product.value >> bit) & 1) != 0, symbols), " AND ");
    }
    return text;
}

/// "" if it is always true.
std::string sum_text(const Truth& need, const Truth& open, const Symbols* symbols, bool in_brackets) {
    const std::vector<Product> products = shortest_products(need, need | open);
    std::string text;
    for (const Product& product : products) append(text, product_text(product, symbols), " OR ");
    return in_brackets && products.size() > 1 ? "(" + text + ")" : text;
}

std::string after(std::string_view word, const std::string& rest) {
    return rest.empty() ? std::string(word) : fmt::format("{} AND {}", word, rest);
}

}  // namespace

std::string bit_text(std::size_t bit, bool level, const Symbols* symbols) {
    constexpr std::array<std::string_view, kBits - kInPosBit> kNames = {"INPOS", "ERROR", "TIMER.Q",
                                                                        "COUNTER.Q"};
    return bit < kInPosBit ? input_text(bit, level, symbols)
                           : fmt::format("{}{}", level ? "" : "NOT ", kNames[bit - kInPosBit]);
}

std::string condition_text(const Truth& need, const Truth& open, const Symbols* symbols) {
    const Truth good = where_error(need, false);
    const Truth bad = where_error(need, true);
    if (need.none()) return "never";
    if (bad.none()) {
        const std::string text = sum_text(good, where_error(open, false), symbols, false);
        return text.empty() ? "always" : text;
    }
    if (good.none()) return after("ERROR", sum_text(bad, where_error(open, true), symbols, true));
    const Truth either = good | bad;
    const Truth allowed = where_error(need | open, false) & where_error(need | open, true);
    if ((either & ~allowed).none()) return after("ANY ERROR", sum_text(either, allowed, symbols, true));
    return sum_text(need, open, symbols, false);
}

namespace {

constexpr std::uint8_t kLastCommonRegister = 88;  // the same on all motors up to here

}  // namespace

void append(std::string& text, std::string_view part, std::string_view separator) {
    if (!text.empty() && !part.empty()) text += separator;
    text += part;
}

std::string step_name(std::uint8_t number, const Symbols* symbols) {
    if (symbols != nullptr && number < symbols->steps.size() && !symbols->steps[number].empty())
        return symbols->steps[number];
    return fmt::format("step {}", number);
}

std::string input_text(std::size_t bit, bool level, const Symbols* symbols) {
    const std::string name = symbols != nullptr ? symbols->inputs[bit] : fmt::format("IN{}", bit);
    const bool holds = level != (symbols != nullptr && is_inverted(*symbols, bit));
    return holds ? name : "NOT " + name;
}

std::string output_name(std::size_t bit, const Symbols* symbols) {
    return symbols != nullptr ? symbols->outputs[bit] : fmt::format("OUT{}", bit);
}

std::string outputs_list(std::uint8_t outputs, const Symbols* symbols) {
    std::string text;
    for (std::size_t bit = 0; bit < 4; ++bit) {
        if (((outputs >> bit) & 1) != 0) append(text, output_name(bit, symbols), ", ");
    }
    return text;
}

const registers::Register* find_register(std::uint8_t number, const Symbols* symbols) {
    if (symbols == nullptr && number > kLastCommonRegister) return nullptr;
    return registers::find(symbols != nullptr ? symbols->motor : registers::Model::mac140, number);
}

std::string register_name(std::uint8_t number, const Symbols* symbols) {
    const registers::Register* reg = find_register(number, symbols);
    return reg != nullptr ? std::string(reg->name) : fmt::format("REG({})", number);
}

std::int64_t value_of(const sequencer::MotorOrder& write, const Symbols* symbols) {
    if (write.longword) return static_cast<std::int32_t>(write.value);
    const registers::Register* reg = find_register(write.reg, symbols);
    const bool is_signed = reg != nullptr && reg->format != registers::Format::word;
    return is_signed ? static_cast<std::int16_t>(write.value) : static_cast<std::int64_t>(write.value);
}

std::string value_text(const sequencer::MotorOrder& write, const Symbols* symbols) {
    const registers::Register* reg = find_register(write.reg, symbols);
    const auto model = symbols != nullptr ? symbols->motor : registers::Model::mac140;
    const std::string_view name =
        reg != nullptr ? registers::name_of_value(model, *reg, write.value) : std::string_view();
    return name.empty() ? std::to_string(value_of(write, symbols)) : std::string(name);
}

std::string order_text(const sequencer::MotorOrder& order, const Symbols* symbols) {
    if (!order.is_register_write) return describe_command(order.command);
    return fmt::format("{} := {}", register_name(order.reg, symbols), value_text(order, symbols));
}

std::string register_as_named(std::uint8_t number, const Symbols* symbols) {
    if (symbols == nullptr) return register_name(number, symbols);
    const auto& names = symbols->motor_names;
    const auto found =
        std::find_if(names.begin(), names.end(), [&](const MotorName& n) { return n.number == number; });
    return found == names.end() ? register_name(number, symbols) : found->name;
}

std::string time_text(std::uint16_t milliseconds) {
    const int seconds = milliseconds / 1000;
    const int rest = milliseconds % 1000;
    if (seconds == 0) return fmt::format("T#{}ms", rest);
    return rest == 0 ? fmt::format("T#{}s", seconds) : fmt::format("T#{}s{}ms", seconds, rest);
}

std::vector<std::string> action_texts(const table::Outcome& outcome, const Symbols* symbols) {
    std::vector<std::string> texts;
    for (const auto& order : outcome.orders) texts.push_back(order_text(order, symbols));
    if (outcome.timer != 0) texts.push_back("TIMER := " + time_text(outcome.timer));
    switch (outcome.counter) {
        case table::CounterChange::none:
            break;
        case table::CounterChange::clear:
            texts.emplace_back("CLEAR_COUNTER");
            break;
        case table::CounterChange::preset:
            texts.push_back(fmt::format("COUNTER := {}", outcome.counter_preset));
            break;
        case table::CounterChange::count_down:
            texts.emplace_back("COUNT_DOWN");
            break;
    }
    return texts;
}

namespace {

std::optional<LengthUnit> length_of(const Symbols& symbols) {
    if (!symbols.scale) return std::nullopt;
    return LengthUnit{symbols.scale->unit, symbols.scale->length / symbols.scale->revolutions};
}

/// The customary unit; "" for a plain number.
std::string unit_for(const registers::Register& reg, const std::optional<LengthUnit>& length) {
    const std::vector<std::string> units = fitting_units(reg, length);
    if (units.empty()) return "";
    if (units.front() == "counts") return units.back();
    return units.front() == "samples" ? "ms" : units.front();
}

/// With the fewest digits that distinguish it from adjacent values, and no farther from it than `most`, a
/// share of it.
std::optional<std::string> shortest(std::int64_t value, const registers::Register& reg,
                                    const Symbols& symbols, const std::string& unit, double most = 1) {
    constexpr int kMostPlaces = 6;
    const auto raw = raw_per_unit(reg, symbols.motor, length_of(symbols), unit);
    if (!raw || *raw == 1) return std::nullopt;
    const double exact = static_cast<double>(value) / *raw;
    std::string text;
    for (int places = -kMostPlaces; places <= kMostPlaces; ++places) {
        const double tens = std::pow(10.0, std::max(-places, 0));
        const double rounded = places > 0 ? exact : std::round(exact / tens) * tens;
        text = fmt::format("{:.{}f}", rounded, std::max(places, 0));
        const double meant = std::strtod(text.c_str(), nullptr) * *raw;
        const double lost = std::fabs(meant - static_cast<double>(value));
        if (std::llround(meant) == value && lost <= most * std::fabs(static_cast<double>(value))) break;
    }
    return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

}  // namespace

std::optional<std::string> with_unit(std::int64_t value, std::uint8_t number, const Symbols* symbols) {
    const registers::Register* reg = symbols == nullptr ? nullptr : registers::find(symbols->motor, number);
    if (reg == nullptr) return std::nullopt;
    return shortest(value, *reg, *symbols, unit_for(*reg, length_of(*symbols)));
}

std::optional<std::string> with_machine_unit(std::int64_t value, std::uint8_t number,
                                             const Symbols* symbols) {
    const registers::Register* reg = symbols == nullptr ? nullptr : registers::find(symbols->motor, number);
    if (reg == nullptr || !symbols->scale) return with_unit(value, number, symbols);
    const std::vector<std::string> units = fitting_units(*reg, length_of(*symbols));
    const bool is_measured = !units.empty() && units.back().starts_with(symbols->scale->unit);
    return is_measured ? shortest(value, *reg, *symbols, units.back()) : with_unit(value, number, symbols);
}

namespace {

/// The unit of a set-point, or what the program writes the register in; empty for a plain number.
std::optional<std::string> unit_as_written(std::uint8_t number, const Symbols& symbols) {
    for (const set_points::SetPoint& point : symbols.set_points.values) {
        if (point.kind == set_points::ValueKind::motor_register && point.reg == number) return point.unit;
    }
    const auto found = symbols.units.find(number);
    return found == symbols.units.end() ? std::nullopt : std::optional(found->second);
}

/// As a program names it, "GP_MODE" or "BY_COMMAND = HOME1_MODE + HICLK"; nothing if a bit has no name.
std::optional<std::string> value_in_names(const registers::Register& reg, std::uint32_t bits,
                                          registers::Model model) {
    if (const std::string_view name = registers::name_of_value(model, reg, bits); !name.empty())
        return std::string(name);
    std::string text;
    std::uint32_t rest = bits;
    for (const registers::Field& field : registers::fields_of(model, reg.number)) {
        const std::uint32_t value = registers::value_in(field, bits);
        if (value == 0) continue;
        rest &= ~registers::mask_of(field);
        if (field.width == 1) {
            append(text, std::string(field.name), " + ");
        } else if (const registers::NamedValue* named = registers::named(field, value)) {
            append(text, fmt::format("{} = {}", field.name, named->name), " + ");
        } else {
            return std::nullopt;
        }
    }
    return text.empty() || rest != 0 ? std::nullopt : std::optional(text);
}

/// As `with_unit`, in the unit in which the program has it. A plain number is one of counts or samples.
std::optional<std::string> value_as_written(const sequencer::MotorOrder& write, const Symbols* symbols) {
    const registers::Register* reg =
        symbols == nullptr ? nullptr : registers::find(symbols->motor, write.reg);
    if (reg == nullptr) return std::nullopt;
    if (auto names = value_in_names(*reg, write.value, symbols->motor)) return names;
    const std::int64_t value = value_of(write, symbols);
    const std::vector<std::string> units = fitting_units(*reg, length_of(*symbols));
    const std::string own = units.empty() ? "" : units.front();
    const bool is_counted = own == "counts" || own == "samples";
    const auto written = unit_as_written(write.reg, *symbols);
    const bool is_plain = written ? written->empty() : !symbols->scale && own == "counts";
    if (is_counted && (is_plain || (written && same_name(*written, own))) &&
        raw_per_unit(*reg, symbols->motor, std::nullopt, own) == 1)
        return fmt::format("{} {}", value, own);
    constexpr double kTold = 0.01;  // what is rounded by more has a warning
    if (written && !written->empty()) return shortest(value, *reg, *symbols, *written, kTold);
    return with_unit(value, write.reg, symbols);
}

}  // namespace

std::string named_order_text(const sequencer::MotorOrder& order, const Symbols* symbols) {
    if (order.is_register_write) {
        return fmt::format("{} := {}", register_as_named(order.reg, symbols),
                           value_as_written(order, symbols).value_or(value_text(order, symbols)));
    }
    const std::string text = describe_command(order.command);
    const auto select = select_command(order.command);
    if (!select || symbols == nullptr) return text;
    return fmt::format("{}({})", text.substr(0, text.find('(')), shown_register(*symbols, select->selection));
}

namespace {

std::string counter_text(const StepAction& action) {
    switch (action.counter) {
        case table::CounterChange::none:
            break;
        case table::CounterChange::clear:
            return "clears the counter";
        case table::CounterChange::preset:
            return fmt::format("sets COUNTER := {}", action.counter_preset);
        case table::CounterChange::count_down:
            return "counts down";
    }
    return {};
}

std::string outputs_text(const KnownOutputs& outputs, const Symbols* symbols) {
    std::string text;
    for (std::uint8_t bit = 0; bit < 4; ++bit) {
        if (((outputs.known >> bit) & 1) == 0) continue;
        append(
            text,
            fmt::format("{} {}", output_name(bit, symbols), ((outputs.value >> bit) & 1) != 0 ? "on" : "off"),
            ", ");
    }
    return text.empty() ? text : "has " + text;
}

}  // namespace

bool StepAction::operator==(const StepAction& other) const {
    return next_id == other.next_id && orders == other.orders && timer == other.timer &&
           counter == other.counter && counter_preset == other.counter_preset && outputs == other.outputs;
}

StepAction step_action_of(const table::Outcome& outcome, std::size_t c) {
    StepAction action;
    action.orders = outcome.orders;
    action.timer = outcome.timer;
    action.counter = outcome.counter;
    action.counter_preset = outcome.counter_preset;
    const bool counter_zero = ((c >> kCounterZero) & 1) != 0;
    if (counter_zero && action.counter != table::CounterChange::preset)
        action.counter = table::CounterChange::none;
    return action;
}

std::string text_of(const StepAction& action, const Symbols* symbols) {
    std::vector<std::string> parts;
    const auto add = [&](std::string part) {
        if (!part.empty()) parts.push_back(std::move(part));
    };
    std::string orders;
    for (const auto& order : action.orders) append(orders, order_text(order, symbols), ", ");
    add(orders.empty() ? "" : "sends " + orders);
    add(action.timer == 0 ? "" : "sets TIMER := " + time_text(action.timer));
    add(counter_text(action));
    add(outputs_text(action.outputs, symbols));
    add(action.kept_outputs == 0 ? "" : "keeps " + outputs_list(action.kept_outputs, symbols));
    add(action.next.empty() ? "" : "goes to " + action.next);
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i)
        append(text, parts[i], i + 1 == parts.size() ? " and " : ", ");
    return text.empty() ? "nothing" : text;
}

}  // namespace nplc::seqc
