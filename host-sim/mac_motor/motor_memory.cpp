#include "sim/motor_memory.h"

namespace nplc::sim {

std::int32_t MotorMemory::get(Cell cell) const {
    const std::uint8_t number = number_of(cell);
    if (number == 0) return 0;
    if (is_mac800(model_) || cell.kind == Cell::Kind::long_int) {
        return static_cast<std::int32_t>(read(number, true));
    }
    const auto word = static_cast<std::uint16_t>(read(number, false));
    return cell.kind == Cell::Kind::integer ? static_cast<std::int16_t>(word) : word;
}

void MotorMemory::set(Cell cell, std::int32_t value) {
    const std::uint8_t number = number_of(cell);
    if (number == 0) return;
    write(number, static_cast<std::uint32_t>(value), is_mac800(model_) || cell.kind == Cell::Kind::long_int);
}

std::uint32_t MotorMemory::read(std::uint8_t reg, bool longword) const {
    if (is_mac800(model_)) return longword ? cells_[reg] : cells_[reg] & 0xFFFF;
    return longword ? cells_[reg] | (cells_[reg + 1U] << 16) : cells_[reg];
}

void MotorMemory::write(std::uint8_t reg, std::uint32_t value, bool longword) {
    if (is_mac800(model_)) {
        cells_[reg] = longword ? value : (cells_[reg] & 0xFFFF0000) | (value & 0xFFFF);
        return;
    }
    cells_[reg] = value & 0xFFFF;
    if (longword) cells_[reg + 1U] = value >> 16;
}

}  // namespace nplc::sim
