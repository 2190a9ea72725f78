#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "registers/family.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// The selection of MOTOR.
struct MotorChoice {
    registers::Model map = registers::Model::mac140;
    const registers::DriveModel* drive = nullptr;  ///< as in Symbols
};

/// MAC50 .. MAC800, MAC23, MAC34 (also MAC34_1 and MAC34_2, which are the same for a table).
/// Case-insensitive.
std::optional<MotorChoice> motor_named(std::string_view name);
/// All names for MOTOR, without aliases.
std::vector<std::string_view> motor_names();
/// "the motors are ...", by family.
std::string motor_names_text();

std::string_view motor_name(const Symbols& symbols);

}  // namespace nplc::seqc
