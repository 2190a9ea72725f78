#pragma once

#include "registers/details.h"

namespace nplc::registers {

// In ascending order of number, as the maps; fields also of first bit.
std::span<const Details> small_details();
std::span<const Details> mac800_details();
std::span<const Field> small_fields();
std::span<const Field> mac800_fields();

}  // namespace nplc::registers
