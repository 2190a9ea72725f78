#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "registers/family.h"
#include "set_points/record.h"
#include "sim/text.h"

namespace nplc::sim {

/// One command or register write from the sequence to the motor.
struct SentOrder {
    bool is_register_write = false;
    std::uint8_t command = 0;  ///< FastMAC, bits 6..0
    std::uint8_t reg = 0;
    std::uint32_t value = 0;
    bool operator==(const SentOrder&) const = default;
};

/// All values that a trace or a condition can use, at one instant. `inputs` are the levels at the terminals,
/// before the gateway's debouncing; `in_position` and `error` are the motor's status as accepted by the
/// gateway; `p_ist` and `v_ist` are the motor's actual values.
struct Snapshot {
    Time time{0};
    std::uint8_t step = 0;
    std::uint16_t timer = 0;  ///< ms
    std::uint16_t counter = 0;
    std::uint8_t inputs = 0;
    std::uint8_t outputs = 0;
    bool in_position = false;
    bool error = false;
    std::int32_t p_ist = 0;   ///< counts
    std::int32_t v_ist = 0;   ///< counts/sample
    std::int64_t shaft = 0;   ///< counts from the initial position, independent of P_IST
    std::int32_t torque = 0;  ///< VF_OUT, 1023 = full
    bool link_up = false;
    bool running = false;
    std::vector<SentOrder> orders;  ///< given since the previous snapshot
    std::array<std::int32_t, registers::set_points::kMost> set_points{};  ///< in force, in their steps
};

inline constexpr unsigned kInputs = 6;
inline constexpr unsigned kOutputs = 4;

/// The machine's unit, from the program's SCALE.
struct MachineUnit {
    std::string name;    ///< `mm`
    double per_rev = 1;  ///< of the motor
};

/// A program's names of steps and signals. Without names: `IN0`, `OUT0` and the step's number.
struct Names {
    std::array<std::string, kInputs> inputs;
    std::array<std::string, kOutputs> outputs;
    std::uint8_t inverted_inputs = 0;  ///< a bit for each input whose name holds while its terminal is off
    std::map<std::uint8_t, std::string> steps;
    std::map<std::uint8_t, std::uint8_t> copy_of;  ///< steps that are copies: `step = Name` includes them
    std::map<std::string, std::vector<std::uint8_t>> groups;  ///< meaning of `step in Name`
    std::map<std::string, std::uint32_t> times;               ///< in milliseconds
    std::map<std::string, std::string> registers;             ///< the motor's, by the program's names
    std::uint64_t numbers = 0;                                ///< bit n: the table has step n; 0: not known
    registers::Model motor = registers::Model::mac140;
    const registers::DriveModel* drive = nullptr;  ///< of another family, instead of the motor
    std::optional<MachineUnit> machine;
    set_points::Record set_points;
    bool motor_alone = false;  ///< no gateway and no line to it
    bool free_pins = false;    ///< the motor's user interface is its pulse input, not FastMAC

    std::string input(unsigned index) const;
    /// The levels of the terminals as what the names of the inputs say.
    std::uint8_t named(std::uint8_t levels) const {
        return static_cast<std::uint8_t>(levels ^ inverted_inputs);
    }
    bool is_inverted(unsigned index) const { return (inverted_inputs >> index & 1) != 0; }
    std::string output(unsigned index) const;
    std::string step(std::uint8_t number) const;
};

/// `POSITION(P2)`, `RESET_ERROR`, `V1 := 3146`.
std::string in_words(const SentOrder& order, registers::Model motor);

/// Two hex digits, or `65=3146`: register and value in decimal.
std::string in_numbers(const SentOrder& order);
/// Space separated, in the order given; empty without orders.
std::string in_numbers(const std::vector<SentOrder>& orders);

}  // namespace nplc::sim
