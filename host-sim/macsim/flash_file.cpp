#include "flash_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "sim/output_file.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

constexpr int kRegisters = 256;

std::string heading(registers::Model model) {
    return fmt::format("# parameter flash of a virtual {}", registers::name_of(model));
}

/// What stands in one memory cell: 16 bits, on MAC800 32.
bool fits(std::int64_t value, registers::Model model) {
    return value >= 0 && value <= (is_mac800(model) ? 0xFFFF'FFFF : 0xFFFF);
}

}  // namespace

std::string load_flash(const std::string& path, MacMotor& motor) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return {};
    errno = 0;
    std::ifstream file(path);
    if (!file) return fmt::format("{}: cannot be read: {}", path, std::strerror(errno));
    MotorMemory stored(motor.model());
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        const std::string text(trim(line.substr(0, line.find('#'))));
        if (number == 1 && trim(line) != heading(motor.model()))
            return fmt::format("{}:1: this is not the flash of a {}; its first line is \"{}\"", path,
                               registers::name_of(motor.model()), heading(motor.model()));
        if (text.empty()) continue;
        const auto equals = text.find('=');
        const auto reg = parse_integer(trim(text.substr(0, equals)));
        const auto value =
            equals == std::string::npos ? std::nullopt : parse_integer(trim(text.substr(equals + 1)));
        if (!reg || !value || *reg < 1 || *reg >= kRegisters || !fits(*value, motor.model()))
            return fmt::format("{}:{}: \"{}\" is no `REGISTER = VALUE`; mend or remove the file", path,
                               number, text.substr(0, 40));
        stored.write(static_cast<std::uint8_t>(*reg), static_cast<std::uint32_t>(*value),
                     is_mac800(motor.model()));
    }
    if (file.bad()) return fmt::format("{}: cannot be read: {}", path, std::strerror(errno));
    motor.set_stored(stored);
    motor.power_cycle();
    return {};
}

std::string try_flash(const std::string& path) try {
    OutputFile file(path);
    return {};
} catch (const FileError& error) {
    return error.what();
}

std::string save_flash(const std::string& path, const MacMotor& motor) try {
    OutputFile file(path);
    file.write(heading(motor.model()) + "\n");
    for (int reg = 1; reg < kRegisters; ++reg) {
        const std::uint32_t value =
            motor.stored().read(static_cast<std::uint8_t>(reg), is_mac800(motor.model()));
        if (value != 0) file.write(fmt::format("{} = {}\n", reg, value));
    }
    file.commit();
    return {};
} catch (const FileError& error) {
    return error.what();
}

}  // namespace nplc::sim
