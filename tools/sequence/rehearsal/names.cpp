#include "rehearsal/names.h"

#include <algorithm>

namespace nplc::rehearsal {

sim::Names names_of(const seqc::Symbols& symbols) {
    sim::Names names;
    names.motor = symbols.motor;
    if (symbols.scale)
        names.machine = {symbols.scale->unit, symbols.scale->length / symbols.scale->revolutions};
    names.set_points = symbols.set_points;
    std::copy(symbols.inputs.begin(), symbols.inputs.end(), names.inputs.begin());
    names.inverted_inputs = symbols.inverted_inputs;
    std::copy(symbols.outputs.begin(), symbols.outputs.end(), names.outputs.begin());
    for (const seqc::MotorName& named : symbols.motor_names) names.registers[named.name] = named.reg;
    for (const seqc::NamedTime& time : symbols.times) names.times[time.name] = time.milliseconds;
    for (std::size_t step = 0; step < symbols.steps.size(); ++step) {
        const auto number = static_cast<std::uint8_t>(step);
        if (!symbols.steps[step].empty()) {
            names.steps[number] = symbols.steps[step];
            names.numbers |= std::uint64_t{1} << step;
        }
        if (symbols.copy_of[step]) names.copy_of[number] = *symbols.copy_of[step];
        for (const seqc::StepGroup& group : symbols.groups) {
            if (((group.steps >> step) & 1U) != 0) names.groups[group.name].push_back(number);
        }
    }
    return names;
}

}  // namespace nplc::rehearsal
