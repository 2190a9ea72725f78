#pragma once

#include <cstddef>
#include <cstdint>

#include "ports/storage.h"

/// Checks of the contract in ports/storage.h.
namespace nplc::hal_linux {

constexpr bool is_inside(const ports::StorageGeometry& geometry, std::uint32_t address, std::size_t count) {
    return address <= geometry.size && count <= geometry.size - address;
}

constexpr bool may_program(const ports::StorageGeometry& geometry, std::uint32_t address, std::size_t count) {
    const bool whole_units = address % geometry.program_unit == 0 && count % geometry.program_unit == 0;
    const bool in_page = address % geometry.program_page + count <= geometry.program_page;
    return is_inside(geometry, address, count) && count != 0 && whole_units && in_page;
}

constexpr bool may_erase(const ports::StorageGeometry& geometry, std::uint32_t address) {
    return is_inside(geometry, address, geometry.erase_block) && address % geometry.erase_block == 0;
}

}  // namespace nplc::hal_linux
