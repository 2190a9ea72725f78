#include "decompile/vocabulary.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "registers/details.h"
#include "registers/scale.h"
#include "semantics/commands.h"
#include "semantics/units.h"

namespace nplc::seqc {
namespace {

using registers::Format;
using registers::Model;
using registers::Register;
using registers::Unit;
using sequencer::FastStatement;
using sequencer::FlexStatement;
using sequencer::Term;

constexpr std::uint8_t kFirstNameless = 0x77;  // 17h - 1Ch are further NOPs (001 §5.2.1.4)
constexpr std::uint8_t kLastNameless = 0x7C;
constexpr std::size_t kLongestDecimal = 10;

/// The signed number in a register's bits, in raw steps.
std::int64_t number_of(const Register& reg, std::uint32_t bits) {
    if (registers::is_32_bit(reg.format)) return static_cast<std::int32_t>(bits);
    if (reg.format == Format::word) return bits & 0xFFFFU;
    return static_cast<std::int16_t>(bits);
}

std::uint32_t bits_of(const FlexStatement& flex) {
    return flex.low_word | (flex.longword ? static_cast<std::uint32_t>(flex.high_word) << 16 : 0U);
}

bool is_link_command(std::uint8_t command) {
    if (select_command(command)) return false;
    const NamedCommand* named = find_command(describe_command(command));
    return named != nullptr && !named->refusal.empty();
}

std::string_view fast_obstacle(const FastStatement& fast) {
    if (fast.next_step == sequencer::kEndOfTable) return "NEXT 63 is no step";
    if (fast.available_next_bit7 || fast.available_outputs != 0) return "unused bits are set";
    if (!fast.sends && fast.command != 0) return "it holds a command that is not sent";
    if (fast.presets_counter && fast.preset == 0) return "CNT_TIME is set and nothing is preset";
    if (!fast.sends) return {};
    if (fast.command >= kFirstNameless && fast.command <= kLastNameless) return "the command has no name";
    return is_link_command(fast.command) ? "the command changes how gateway and motor talk" : "";
}

std::string_view flex_obstacle(const FlexStatement& flex, Model model) {
    if (flex.reg == 0) return "register 0 cannot be written";
    const Register* reg = registers::find(model, flex.reg);
    if (reg == nullptr) return "the motor has no register of this number";
    if (flex.longword != registers::is_32_bit(reg->format))
        return flex.longword ? "32 bits for a register of 16" : "16 bits for a register of 32";
    if (!flex.longword && flex.high_word != 0) return "the upper word is not sent";
    const std::int64_t number = number_of(*reg, bits_of(flex));
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

/// What SCALE makes of the number has no short text that means exactly this number.
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

std::string_view obstacle(sequencer::TermView bytes, Model model) {
    const Term term = sequencer::decode(bytes);
    if (term.condition.step >= sequencer::kLastStep) return "the step cannot have a name";
    if ((term.condition.input & ~term.condition.care & 0x7F) != 0)
        return "it wants inputs it does not care for";
    return term.is_flex ? flex_obstacle(term.flex, model) : fast_obstacle(term.fast);
}

Send send_of(const Term& term, Model model) {
    if (!term.is_flex) return {nullptr, term.fast.command, 0, {}};
    return {registers::find(model, term.flex.reg), 0, bits_of(term.flex), {}};
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
