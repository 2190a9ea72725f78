#include "macreg/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "macreg/motor.h"
#include "registers/layout.h"
#include "registers/scale.h"
#include "text/edit_distance.h"
#include "text/text.h"

namespace nplc::macreg {

using registers::Field;
using registers::Model;
using registers::Register;
using registers::TextError;
using registers::Unit;
using spelling::lower;
using spelling::whole_number;

namespace {

/// The text before the unit, if it looks like a number but is malformed: 1,5 or 1e3.
std::string_view malformed_number(const Register& reg, Model model, std::string_view text) {
    for (std::size_t end = text.size(); end > 0; --end) {
        const std::string_view unit = text.substr(end);
        if (!unit.empty() && !registers::raw_per_unit(reg, model, unit)) continue;
        const std::string_view number = text.substr(0, text.find_last_not_of(' ', end - 1) + 1);
        const bool meant = number.find_first_of("0123456789") != std::string_view::npos &&
                           number.find_first_not_of("0123456789+-.,eE'") == std::string_view::npos;
        const bool flawed = number.find_first_of(",eE'") != std::string_view::npos ||
                            std::count(number.begin(), number.end(), '.') > 1;
        if (meant && flawed) return number;
    }
    return {};
}

/// The length of their longest common substring.
std::size_t in_common(std::string_view a, std::string_view b) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t length = most + 1; i + length <= a.size(); ++length) {
            if (b.find(a.substr(i, length)) == std::string_view::npos) break;
            most = length;
        }
    }
    return most;
}

/// "did you mean GP_MODE? If not, " of a mode or bit whose name has a part in common with what was typed.
std::string meant(const Register& reg, Model model, std::string_view text) {
    constexpr std::size_t kMostWrong = 3;
    std::string best;
    std::size_t least = std::min(kMostWrong, text.size() / 2) + 1;
    const auto look = [&](std::string_view name) {
        const std::size_t steps = spelling::edit_distance(text, name);
        if (steps >= least) return;
        least = steps;
        best = name;
    };
    for (const Field& field : registers::fields_of(model, reg.number)) {
        if (field.width == 1) look(field.name);
        for (const auto& one : field.values) look(one.name);
    }
    return best.empty() ? std::string() : fmt::format("did you mean {}? If not, ", best);
}

std::string why_not(TextError error, const Register& reg, Model model, std::string_view text) {
    if (const auto number = malformed_number(reg, model, text); !number.empty())
        return fmt::format(
            "'{}' is no number; write digits, with a point where one is needed, such as 1500 or 762.94",
            number);
    switch (error) {
        case TextError::wrong_unit: {
            std::string units;
            for (const auto unit : registers::units_of(reg.unit))
                units += (units.empty() ? "" : ", ") + std::string(unit);
            return units.empty()
                       ? fmt::format("'{}': {} is a plain number and takes no unit", text, reg.name)
                       : fmt::format("'{}': {} takes {}, or no unit for raw steps", text, reg.name, units);
        }
        case TextError::out_of_range:
            return fmt::format("'{}' is out of range: {} is {}", text, reg.name, range_text(reg, model));
        case TextError::too_small:
            return fmt::format(
                "'{}' is less than half a step of {}, nothing would be left of it; one step is {}", text,
                reg.name, number_text(reg, model, 1));
        case TextError::too_long:
            return fmt::format("'{}' has too many digits for {}", text, reg.name);
        default:
            return fmt::format("'{}' is no value of {}; {}write {}", text, reg.name, meant(reg, model, text),
                               whole_field(reg, model) != nullptr || reg.unit == Unit::bits
                                   ? fmt::format("a name or number (`macreg list {}`)", reg.name)
                                   : "a number with or without unit, 0x1F, or raw:31");
    }
}

TypedValue raw_value(const Register& reg, Model model, std::string_view text,
                     std::optional<std::int64_t> raw) {
    TypedValue typed;
    if (!raw)
        typed.error = why_not(TextError::not_a_number, reg, model, text);
    else if (*raw < reg.min || *raw > reg.max)
        typed.error = why_not(TextError::out_of_range, reg, model, text);
    else
        typed.raw = *raw;
    return typed;
}

std::optional<std::uint32_t> named_bits(const Register& reg, Model model, std::string_view word) {
    const auto equals = word.find('=');
    if (equals == std::string_view::npos) return registers::bits_named(model, reg, word);
    const std::string_view part = word.substr(0, equals);
    const std::string_view value = word.substr(equals + 1);
    if (const auto bits = registers::bits_named(model, reg, part, value)) return bits;
    const Field* field = registers::field_of(model, reg.number, part);
    const auto number = whole_number(value);
    if (field == nullptr || !number || *number < 0 || *number > registers::mask_of(*field) >> field->first)
        return std::nullopt;
    return static_cast<std::uint32_t>(*number) << field->first;
}

/// Words joined by + or blanks, each a bit's or a value's name.
std::optional<std::uint32_t> bits_by_name(const Register& reg, Model model, std::string_view text) {
    std::uint32_t bits = 0;
    bool any = false;
    while (!text.empty()) {
        const auto end = std::min(text.find_first_of("+ "), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (word.empty()) continue;
        const auto one = named_bits(reg, model, word);
        if (!one) return std::nullopt;
        bits |= *one;
        any = true;
    }
    return any ? std::optional(bits) : std::nullopt;
}

/// The families write some names with and without underscores.
std::string squeezed(std::string_view name) {
    std::string letters = lower(name);
    std::erase(letters, '_');
    return letters;
}

/// The name that was probably meant: one letter in three may be wrong, or the text is part of the name.
std::string nearest(Model model, std::string_view text) {
    constexpr std::size_t kMostWrong = 2;
    constexpr std::size_t kLeastPart = 3;
    const std::string name = lower(text);
    std::string best;
    std::size_t least = std::min(kMostWrong, name.size() / 3) + 1;
    for (const Register& reg : registers::map_of(model)) {
        const std::size_t steps = spelling::edit_distance(name, reg.name);
        if (steps >= least) continue;
        least = steps;
        best = reg.name;
    }
    if (!best.empty()) return best;
    std::size_t most = kLeastPart;
    for (const Register& reg : registers::map_of(model)) {
        const std::size_t part = in_common(lower(reg.name), name);
        if (part <= most || 2 * part < reg.name.size()) continue;
        most = part;
        best = reg.name;
    }
    return best;
}

/// A unit as a word of its own, or one more bit's name.
bool belongs_to_value(const Register& reg, Model model, const std::string& word) {
    if (registers::find(model, std::string_view(word)) != nullptr) return false;
    if (reg.unit == registers::Unit::bits)
        return typed_value(reg, model, word).error.empty() && word.find_first_of("0123456789") != 0;
    return registers::raw_per_unit(reg, model, word).has_value();
}

ReadAssignments taken_apart(Model model, const std::vector<std::string>& words) {
    ReadAssignments read;
    for (std::size_t i = 0; i < words.size();) {
        const auto equals = words[i].find('=');
        const std::string name = words[i].substr(0, equals);
        const NamedRegister named = find_register(model, name);
        if (named.reg == nullptr) return {{}, named.error};
        Assignment one{.reg = named.reg,
                       .text = equals == std::string::npos ? "" : words[i].substr(equals + 1)};
        ++i;
        if (one.text.empty() && i < words.size()) one.text = words[i++];
        while (i < words.size() && belongs_to_value(*named.reg, model, words[i]))
            one.text += " " + words[i++];
        if (one.text.empty()) return {{}, fmt::format("'{}': write {} VALUE or {}=VALUE", name, name, name)};
        read.all.push_back(one);
    }
    return read;
}

struct Name {
    std::string_view reg;
    std::string_view name;
};

// By the names of both maps. 28 and 30 are labelled the wrong way round in 004: by what they do.
constexpr Name kNames[] = {
    {"P_SOLL", "Position"},
    {"V_SOLL", "Max velocity"},
    {"A_SOLL", "Acceleration"},
    {"T_SOLL", "Torque"},
    {"P_IST", "Actual position"},
    {"V_IST_16", "Actual velocity"},
    {"V_IST", "Actual velocity"},
    {"KVOUT", "Load"},
    {"GEARF1", "Input"},
    {"GEARF_1", "Input"},
    {"GEARF2", "Output"},
    {"GEARF_2", "Output"},
    {"I2T", "Motor load (mean)"},
    {"UIT", "Regenerative load"},
    {"FLWERR", "Follow error"},
    {"U_24V", "Logic supply"},
    {"FLWERRMAX", "EH:Follow error"},
    {"UV_HANDLE", "Set error bit, Go to passive, Set velocity to 0"},
    {"FNCERR", "Function error"},
    {"FNCERRMAX", "EH:Function error"},
    {"MIN_P_IST", "Position limit min"},
    {"MAX_P_IST", "Position limit max"},
    {"DEGC", "Temperature"},
    {"ACC_EMERG", "Error acceleration"},
    {"INPOSWIN", "In pos. window / At vel. window"},
    {"INPOSCNT", "In pos. count"},
    {"STARTMODE", "Mode"},
    {"START_MODE", "Mode"},
    {"P_HOME", "Zero search position"},
    {"V_HOME", "Zero search speed"},
    {"T_HOME", "Zero search torque"},
    {"HOME_MODE", "Zero search mode"},
    {"V_EXT", "Velocity of input"},
    {"VF_OUT", "Actual motor torque"},
    {"ANINP", "Analogue input"},
    {"ANINP_OFFSET", "Analogue input offset"},
    {"U_BUS", "Bus voltage"},
    {"U_SUPPLY", "Bus voltage"},
    {"MYADDR", "Motor address"},
    {"MY_ADDR", "Motor address"},
};
// POS0 to POS7, VEL0 ... ZERO3 of a MAC800 are P1 to P8, V1 ... Z4.
constexpr Name kNumbered[] = {{"POS", "P"}, {"VEL", "V"},  {"ACC", "A"},
                              {"TQ", "T"},  {"LOAD", "L"}, {"ZERO", "Z"}};
std::string numbered(std::string_view reg) {
    for (const Name& one : kNumbered) {
        const bool is_one = reg.size() == one.reg.size() + 1 && reg.starts_with(one.reg) &&
                            reg.back() >= '0' && reg.back() <= '7';
        if (is_one) return fmt::format("{}{}", one.name, static_cast<char>(reg.back() + 1));
    }
    return {};
}

}  // namespace

std::string choice_text(const Register& reg, Model model) {
    constexpr std::int64_t kFirstOrder = 256;  // 256 to 258 act on the flash (001 §4.4.16)
    if (reg.number != registers::MODE_REG || reg.max < kFirstOrder) return range_text(reg, model);
    std::int64_t last = 0;
    for (const auto& one : whole_field(reg, model)->values) {
        if (one.value < kFirstOrder) last = std::max<std::int64_t>(last, one.value);
    }
    return fmt::format("0 to {}", last);
}

std::string range_text(const Register& reg, Model model) {
    const std::string raw = fmt::format("{} to {}", reg.min, reg.max);
    constexpr std::int64_t kMost = 0x7FFF'FFFF;
    if (reg.min <= -kMost && reg.max >= kMost) return "any number of 32 bits, signed";
    if (reg.unit == Unit::none || reg.unit == Unit::bits) {
        if (registers::one_in(reg.format) == 1) return raw;
    }
    return fmt::format("{} to {} (raw {})", number_text(reg, model, reg.min),
                       number_text(reg, model, reg.max), raw);
}

TypedValue typed_value(const Register& reg, Model model, std::string_view text) {
    if (lower(text.substr(0, 4)) == "raw:") {
        const std::string_view digits = text.substr(4);
        const bool hex = lower(digits.substr(0, 2)) == "0x";
        return raw_value(reg, model, text, whole_number(hex ? digits.substr(2) : digits, hex ? 16 : 10));
    }
    if (lower(text.substr(0, 2)) == "0x") {
        const auto bits = whole_number(text.substr(2), 16);
        const int width = 8 * registers::bytes_of(model, reg);
        if (bits && (*bits < 0 || *bits >> width != 0))
            return {.error = fmt::format("'{}': {} has {} bits", text, reg.name, width)};
        return raw_value(
            reg, model, text,
            bits ? std::optional(registers::value_of(reg.format, static_cast<std::uint32_t>(*bits)))
                 : std::nullopt);
    }
    if (reg.unit == Unit::bits && lower(text) == "none") return {};
    if (const auto bits = bits_by_name(reg, model, text)) return raw_value(reg, model, text, *bits);
    const auto parsed = registers::parse(text, reg, model);
    if (parsed.error != TextError::none) return {.error = why_not(parsed.error, reg, model, text)};
    TypedValue typed{.raw = parsed.raw};
    if (!parsed.exact)
        typed.rounding = fmt::format("{} falls between two steps of {}, taken as {} (raw {})", text, reg.name,
                                     number_text(reg, model, parsed.raw), parsed.raw);
    return typed;
}

NamedRegister find_register(Model model, std::string_view text) {
    const std::string family = family_words(model);
    if (const auto number = whole_number(text)) {
        const bool fits = *number >= 0 && *number <= 255;
        const Register* reg = fits ? registers::find(model, static_cast<std::uint8_t>(*number)) : nullptr;
        if (reg != nullptr) return {reg, {}};
        const Register* holder =
            fits ? registers::holder_of(model, static_cast<std::uint8_t>(*number)) : nullptr;
        if (holder != nullptr)
            return {nullptr, fmt::format("{} is the upper word of register {}, {}; name that one", *number,
                                         holder->number, holder->name)};
        return {nullptr, fmt::format("{} has no register {}; `macreg list` shows them", family, text)};
    }
    if (const Register* reg = registers::find(model, text)) return {reg, {}};
    const Model other = model == Model::mac800 ? Model::mac140 : Model::mac800;
    const std::string near = nearest(model, text);
    if (registers::find(other, text) != nullptr && squeezed(near) != squeezed(text))
        return {nullptr, fmt::format("{} has no register '{}', but {} has; `macreg list` shows them", family,
                                     text, other == Model::mac800 ? "MAC800" : "each of MAC50 to MAC141")};
    return {nullptr, fmt::format("{} has no register '{}'{}; `macreg list` shows them", family, text,
                                 near.empty() ? "" : fmt::format(", did you mean {}?", near))};
}

ReadAssignments read_assignments(Model model, const std::vector<std::string>& words) {
    ReadAssignments read = taken_apart(model, words);
    for (std::size_t i = 0; i < read.all.size(); ++i) {
        Assignment& one = read.all[i];
        TypedValue typed = typed_value(*one.reg, model, one.text);
        if (!typed.error.empty()) return {{}, typed.error};
        for (std::size_t k = 0; k < i; ++k) {
            if (read.all[k].reg == one.reg)
                return {{}, fmt::format("{} is named twice; name it once", one.reg->name)};
        }
        one.raw = typed.raw;
        one.rounding = std::move(typed.rounding);
    }
    return read;
}

std::string mactalk_name(const registers::Register& reg) {
    const auto found = std::find_if(std::begin(kNames), std::end(kNames),
                                    [&](const Name& one) { return one.reg == reg.name; });
    return found != std::end(kNames) ? std::string(found->name) : numbered(reg.name);
}

}  // namespace nplc::macreg
