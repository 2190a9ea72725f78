#pragma once

#include "registers/mac.h"

namespace nplc::registers {

std::span<const Register> small_map();
std::span<const Register> mac800_map();

}  // namespace nplc::registers
