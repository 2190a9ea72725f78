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

/// Configuration of the machine in an FMU.
struct Setup {
    registers::Model motor = registers::Model::mac140;
    /// The content uploaded into the gateway (the table, then the record of its set-points); empty: there is
    /// no gateway.
    std::optional<std::vector<std::uint8_t>> table{};
    /// From a plant file; empty: the bare motor. Mechanical stops are not supported.
    std::optional<Load> plant{};
};

/// Differs between machines, and between versions of this program.
std::string token_of(const Setup& setup);

/// The text of kMachineFile.
std::string machine_text(const Setup& setup);

struct SetupReading {
    Setup setup;
    std::string problem;  ///< empty on success
};

/// From a folder `resources`; its name may end in a separator.
SetupReading read_setup(const std::string& resources);

}  // namespace nplc::sim::fmu
