#include "flash_file.h"

#include <fmt/format.h>

#include "sim/text.h"
#include "sim/value_file.h"

namespace nplc::sim {
namespace {

constexpr int kRegisters = 256;
constexpr const char* kForm = "REGISTER = VALUE";

std::string heading(registers::Model model) {
    return fmt::format("# parameter flash of a virtual {}", registers::name_of(model));
}

/// What stands in one memory cell: 16 bits, on MAC800 32.
bool fits(std::int64_t value, registers::Model model) {
    return value >= 0 && value <= (is_mac800(model) ? 0xFFFF'FFFF : 0xFFFF);
}

}  // namespace

std::string load_flash(const std::string& path, MacMotor& motor) {
    const ValueFile file = read_values(path, heading(motor.model()), kForm);
    if (!file.error.empty()) return file.error;
    if (!file.exists) return {};
    MotorMemory stored(motor.model());
    for (const NamedValue& line : file.values) {
        const auto reg = parse_integer(line.name);
        if (!reg || *reg < 1 || *reg >= kRegisters || !fits(line.value, motor.model()))
            return bad_value(path, line, kForm);
        stored.write(static_cast<std::uint8_t>(*reg), static_cast<std::uint32_t>(line.value),
                     is_mac800(motor.model()));
    }
    motor.set_stored(stored);
    motor.power_cycle();
    return {};
}

std::string save_flash(const std::string& path, const MacMotor& motor) {
    std::vector<NamedValue> values;
    for (int reg = 1; reg < kRegisters; ++reg) {
        const std::uint32_t value =
            motor.stored().read(static_cast<std::uint8_t>(reg), is_mac800(motor.model()));
        if (value != 0) values.push_back({std::to_string(reg), value});
    }
    return write_values(path, heading(motor.model()), values);
}

}  // namespace nplc::sim
