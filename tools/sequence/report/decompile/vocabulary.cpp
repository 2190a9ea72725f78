#include "report/decompile/vocabulary.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "registers/details.h"
#include "registers/scale.h"
#include "sequencer/state.h"
#include "symbols/commands.h"
#include "symbols/units.h"
#include "table/terms.h"

namespace nplc::seqc {
namespace {

using registers::Format;
using registers::Model;
using registers::Register;
using registers::Unit;

constexpr std::size_t kLongestDecimal = 10;

/// The signed number in a register's bits, in raw steps.
std::int64_t number_of(const Register& reg, std::uint32_t bits) {
    if (registers::is_32_bit(reg.format)) return static_cast<std::int32_t>(bits);
    if (reg.format == Format::word) return bits & 0xFFFFU;
    return static_cast<std::int16_t>(bits);
}

std::string_view text_of(table::Oddity oddity) {
    switch (oddity) {
        case table::Oddity::none:
        case table::Oddity::upper_word_not_sent:
            break;
        case table::Oddity::of_step_62:
            return "the step cannot have a name";
        case table::Oddity::level_without_care:
            return "INPUT has levels that CARE masks";
        case table::Oddity::next_is_63:
            return "NEXT 63 is no step";
        case table::Oddity::unused_bits:
            return "unused bits are set";
        case table::Oddity::command_not_sent:
            return "it holds a command that is not sent";
        case table::Oddity::counter_preset_of_0:
            return "CNT_TIME is set and nothing is preset";
        case table::Oddity::register_0:
            return "register 0 cannot be written";
    }
    return {};
}

std::string_view command_obstacle(std::uint8_t command) {
    if (!table::has_name(command)) return "the command has no name";
    const NamedCommand* named = table::named_command(command);
    return named != nullptr && named->is_of_link ? "the command changes how gateway and motor talk" : "";
}

std::string_view write_obstacle(const sequencer::MotorOrder& write, table::Oddity oddity, Model model) {
    const Register* reg = registers::find(model, write.reg);
    if (reg == nullptr) return "the motor has no register of this number";
    if (write.longword != registers::is_32_bit(reg->format))
        return write.longword ? "32 bits for a register of 16" : "16 bits for a register of 32";
    if (oddity == table::Oddity::upper_word_not_sent) return "the upper word is not sent";
    const std::int64_t number = number_of(*reg, write.value);
    return number < reg->min || number > reg->max ? "the value is out of the register's range" : "";
}

/// The unit for a register's value; empty: a unit adds no information.
std::string_view shown_unit(Unit unit) {
    if (unit == Unit::counts || unit == Unit::counts_16) return "rev";
    if (unit == Unit::samples) return "ms";
    const auto usual = registers::units_of(unit);
    return usual.empty() ? std::string_view() : usual.front();
}

std::string short_number(double value) {
    return std::fabs(value) >= 10'000 ? fmt::format("{:.0f}", value) : fmt::format("{:.5g}", value);
}

std::string bits_text(const Register& reg, std::uint32_t bits) {
    return registers::is_32_bit(reg.format) ? fmt::format("16#{:08X}", bits) : fmt::format("16#{:04X}", bits);
}

/// The suffix after the unit of SCALE; empty if SCALE does not apply.
std::optional<std::string_view> rate_of(Unit unit) {
    if (unit == Unit::counts || unit == Unit::counts_16) return "";
    if (unit == Unit::velocity || unit == Unit::velocity_16) return "/s";
    if (unit == Unit::acceleration_16) return "/s2";
    return std::nullopt;
}

/// Of the numbers that the compiler rounds to `number` steps the one with the fewest digits; empty if none is
/// short. `near`: near enough for no W002.
std::string fewest_digits(std::int64_t number, double steps, bool near) {
    constexpr int kMostDigits = 8;
    constexpr double kMostOff = 0.005;
    const auto wanted = static_cast<double>(number);
    for (int digits = 1; digits <= kMostDigits; ++digits) {
        std::string value = fmt::format("{:.{}g}", wanted / steps, digits);
        const double exact = std::stod(value) * steps;
        const bool is_near = !near || std::fabs(exact - wanted) <= kMostOff * std::fabs(wanted);
        const bool is_plain = value.find('e') == std::string::npos;
        if (is_plain && is_near && std::llround(exact) == number) return value;
    }
    return {};
}

/// "60 mm": the shortest text for this number of steps; empty without a scale, or if none is short.
std::string length_text(const Register& reg, std::int64_t number, const Symbols& symbols) {
    const auto rate = rate_of(reg.unit);
    if (!symbols.scale || !rate) return {};
    const Scale& scale = *symbols.scale;
    const LengthUnit unit{scale.unit, scale.length / scale.revolutions};
    const std::string written = fmt::format("{}{}", scale.unit, *rate);
    const auto steps = raw_per_unit(reg, symbols.motor, unit, written);
    if (!steps) return {};
    const std::string value = fewest_digits(number, *steps, !rate->empty());
    return value.empty() ? value : fmt::format("{} {}", value, written);
}

/// With SCALE no short text stands for exactly this number.
bool is_rounded(const Register& reg, std::int64_t number, const Symbols& symbols) {
    if (!symbols.scale) return false;
    const LengthUnit unit{symbols.scale->unit, symbols.scale->length / symbols.scale->revolutions};
    const auto steps = raw_per_unit(reg, symbols.motor, unit, symbols.scale->unit);
    const std::string length = length_text(reg, number, symbols);
    constexpr double kRounding = 1e-6;  // counts, as of W030
    return steps && (length.empty() ||
                     std::fabs(std::stod(length) * *steps - static_cast<double>(number)) > kRounding);
}

}  // namespace

std::string_view obstacle(sequencer::TermView term, Model model) {
    const table::Oddity oddity = table::oddity_of(term);
    if (const std::string_view text = text_of(oddity); !text.empty()) return text;
    if (!sequencer::has_order(term)) return {};
    const sequencer::MotorOrder order = sequencer::order_of(term);
    return order.is_register_write ? write_obstacle(order, oddity, model) : command_obstacle(order.command);
}

Send send_of(sequencer::TermView term, Model model) {
    const sequencer::MotorOrder order = sequencer::order_of(term);
    if (!order.is_register_write) return {nullptr, order.command, 0, {}};
    return {registers::find(model, order.reg), 0, order.value, {}};
}

ValueText value_text(const Register& reg, std::uint32_t bits, const Symbols& symbols, bool exact_places) {
    const Model model = symbols.motor;
    const std::int64_t number = number_of(reg, bits);
    const std::string length = length_text(reg, number, symbols);
    if (exact_places && reg.unit == Unit::counts && is_rounded(reg, number, symbols))
        return {fmt::format("{} counts", number), length};
    if (!length.empty()) return {length, {}};
    if (const std::string_view name = registers::name_of_value(model, reg, bits); !name.empty())
        return {std::string(name), {}};
    const double steps_in_one = raw_per_unit(reg, model, std::nullopt, {}).value_or(1);
    if (steps_in_one != 1) {
        const double value = static_cast<double>(number) / steps_in_one;
        const std::string decimal = fewest_digits(number, steps_in_one, true);
        const bool is_short = !decimal.empty() && decimal.size() <= kLongestDecimal;
        return is_short ? ValueText{decimal, {}} : ValueText{bits_text(reg, bits), short_number(value)};
    }
    const std::string_view unit = shown_unit(reg.unit);
    const auto steps = unit.empty() ? std::nullopt : raw_per_unit(reg, model, std::nullopt, unit);
    if (!steps || number == 0) return {std::to_string(number), {}};
    return {std::to_string(number),
            fmt::format("{} {}", short_number(static_cast<double>(number) / *steps), unit)};
}

}  // namespace nplc::seqc
