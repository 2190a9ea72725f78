#include "meaning/motors.h"

#include "syntax/names.h"

namespace nplc::seqc {

std::optional<MotorChoice> motor_named(std::string_view name) {
    using registers::Model;
    namespace midi = registers::midi;
    if (const auto model = registers::model_of(name)) return MotorChoice{*model, {}};
    if (same_name(name, "MAC23")) return MotorChoice{Model::mac140, midi::Model::mac23};
    if (same_name(name, "MAC34_2")) return MotorChoice{Model::mac140, midi::Model::mac34_2};
    if (same_name(name, "MAC34") || same_name(name, "MAC34_1"))
        return MotorChoice{Model::mac140, midi::Model::mac34_1};
    return std::nullopt;
}

std::string_view name_of(registers::midi::Model model) {
    return model == registers::midi::Model::mac23 ? "MAC23" : "MAC34";
}

std::string_view motor_name(const Symbols& symbols) {
    return symbols.midi ? name_of(*symbols.midi) : registers::name_of(symbols.motor);
}

}  // namespace nplc::seqc
