#include "report/decompile/naming.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "language/names.h"
#include "language/reserved_words.h"

namespace nplc::seqc {
namespace {

/// IN0, OUT12 and so on.
bool is_address(std::string_view name) {
    const std::string text = upper(name);
    const std::size_t word = text.starts_with("IN") ? 2 : text.starts_with("OUT") ? 3 : 0;
    return word != 0 && text.size() > word &&
           std::all_of(text.begin() + static_cast<std::ptrdiff_t>(word), text.end(),
                       [](char c) { return c >= '0' && c <= '9'; });
}

class Names {
  public:
    bool has(std::string_view name) const {
        return std::any_of(taken_.begin(), taken_.end(),
                           [&](const std::string& other) { return same_name(other, name); });
    }
    std::string take(std::string name) {
        while (has(name)) name += '_';
        taken_.push_back(name);
        return name;
    }

  private:
    std::vector<std::string> taken_;
};

bool can_name_a_signal(std::string_view name, registers::Model motor) {
    return is_name(name) && !is_address(name) && registers::find(motor, name) == nullptr;
}

/// Given names first, so that generated ones avoid them.
template <std::size_t N, class Usable>
void choose(std::array<std::string, N>& names, std::size_t count, const std::array<std::string, N>* given,
            char letter, Names& taken, const Usable& usable) {
    for (std::size_t i = 0; i < count; ++i) {
        const bool good = given != nullptr && usable((*given)[i]) && !taken.has((*given)[i]);
        names[i] = good ? taken.take((*given)[i]) : std::string();
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (names[i].empty()) names[i] = taken.take(fmt::format("{}{}", letter, i));
    }
}

template <std::size_t N>
void keep_addresses(std::array<std::string, N>& names, const std::array<std::string, N>& given,
                    const char* word, std::array<bool, N>& declared) {
    for (std::size_t i = 0; i < N; ++i) {
        const std::string address = fmt::format("{}{}", word, i);
        if (!same_name(given[i], address)) continue;
        names[i] = address;
        declared[i] = false;
    }
}

}  // namespace

Naming naming_of(const Symbols* given, const std::string& program, registers::Model motor) {
    Naming naming;
    naming.made_up = given == nullptr;
    Symbols& symbols = naming.symbols;
    symbols.motor = motor;
    symbols.program = given != nullptr && is_name(given->program) ? given->program
                      : is_name(program)                          ? program
                                                                  : "Table";
    Names steps;
    choose(symbols.steps, sequencer::kLastStep, given != nullptr ? &given->steps : nullptr, 'S', steps,
           is_name);
    Names signals;
    const auto usable = [&](const std::string& name) { return can_name_a_signal(name, motor); };
    choose(symbols.inputs, symbols.inputs.size(), given != nullptr ? &given->inputs : nullptr, 'I', signals,
           usable);
    choose(symbols.outputs, symbols.outputs.size(), given != nullptr ? &given->outputs : nullptr, 'Q',
           signals, usable);
    naming.declared_inputs.fill(true);
    naming.declared_outputs.fill(true);
    if (given != nullptr) {
        keep_addresses(symbols.inputs, given->inputs, "IN", naming.declared_inputs);
        keep_addresses(symbols.outputs, given->outputs, "OUT", naming.declared_outputs);
        for (std::size_t i = 0; i < symbols.inputs.size(); ++i) {
            if (naming.declared_inputs[i] && is_inverted(*given, i))
                symbols.inverted_inputs |= static_cast<std::uint8_t>(1U << i);
        }
    }
    if (given != nullptr) {
        symbols.scale = given->scale;
        for (const MotorName& one : given->motor_names) {
            if (!usable(one.name) || signals.has(one.name) || registers::find(motor, one.number) == nullptr)
                continue;
            if (naming.registers.try_emplace(one.number, one.name).second) signals.take(one.name);
        }
    }
    std::copy(symbols.inputs.begin(), symbols.inputs.end(), naming.bits.name.begin());
    naming.bits.inverted = symbols.inverted_inputs;
    naming.bits.name[kInPosBit] = "INPOS";
    naming.bits.name[kErrorBit] = "ERROR";
    naming.bits.name[kTimerZero] = "TIMER.Q";
    naming.bits.name[kCounterZero] = "COUNTER.Q";
    return naming;
}

const set_points::SetPoint* Naming::set_point(set_points::ValueKind kind, std::uint8_t reg,
                                              std::int32_t value) const {
    for (const set_points::SetPoint& point : set_points) {
        if (point.kind == kind && point.reg == reg && point.initial == value && !point.at_power_up)
            return &point;
    }
    return nullptr;
}

const set_points::SetPoint* Naming::set_point_of(std::uint8_t reg) const {
    for (const set_points::SetPoint& point : set_points) {
        if (point.at_power_up && point.reg == reg) return &point;
    }
    return nullptr;
}

std::string Naming::value_name(std::string_view reg) const {
    Names signals;
    for (const std::string& name : symbols.inputs) signals.take(name);
    for (const std::string& name : symbols.outputs) signals.take(name);
    for (const auto& [number, name] : registers) signals.take(name);
    return signals.take(fmt::format("{}_Value", reg));
}

}  // namespace nplc::seqc
