#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "registers/mac.h"
#include "sim/plant.h"

namespace nplc::sim::fmu {

/// Files in an FMU's folder `resources`.
inline constexpr std::string_view kMachineFile = "machine.txt";
inline constexpr std::string_view kTableFile = "table.bin";

/// Which machine an FMU holds.
struct Setup {
    registers::Model motor = registers::Model::mac140;
    /// What is uploaded into the gateway (the table, the record of its set-points behind it); without it
    /// there is no gateway.
    std::optional<std::vector<std::uint8_t>> table{};
    /// Of a plant file; without it the bare motor. Its stops are not kept.
    std::optional<Load> plant{};
};

/// Differs for machines that differ, and for versions of this program.
std::string token_of(const Setup& setup);

/// The text of kMachineFile.
std::string machine_text(const Setup& setup);

struct SetupReading {
    Setup setup;
    std::string problem;  ///< empty: all is well
};

/// Of a folder `resources`; the name ends in a separator or not.
SetupReading read_setup(const std::string& resources);

}  // namespace nplc::sim::fmu
