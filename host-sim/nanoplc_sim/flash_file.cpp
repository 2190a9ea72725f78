#include "flash_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "input_file.h"

namespace nplc::sim {

namespace fs = std::filesystem;

FlashFile::FlashFile(std::string path, const ports::StorageGeometry& geometry)
    : path_(std::move(path)), geometry_(geometry), bytes_(geometry.size, 0xFF) {
    std::error_code error;
    if (!fs::exists(path_, error)) return;
    const std::string text = read_input(path_, "a gateway's flash");
    if (text.size() != bytes_.size()) {
        throw InputError(fmt::format("{}: is no gateway's flash, which has {} bytes; name another file",
                                     path_, bytes_.size()));
    }
    std::copy(text.begin(), text.end(), bytes_.begin());
}

bool FlashFile::holds(std::uint32_t address, std::size_t size, std::uint32_t alignment) const {
    return size != 0 && address % alignment == 0 && size % alignment == 0 && address <= bytes_.size() &&
           size <= bytes_.size() - address;
}

base::Status FlashFile::read(std::uint32_t address, std::span<std::uint8_t> out) {
    if (address > bytes_.size() || out.size() > bytes_.size() - address) return base::Error::bad_geometry;
    std::copy_n(bytes_.begin() + address, out.size(), out.begin());
    return {};
}

base::Status FlashFile::program(std::uint32_t address, std::span<const std::uint8_t> bytes) {
    if (!holds(address, bytes.size(), geometry_.program_unit)) return base::Error::bad_geometry;
    const std::size_t last = address + bytes.size() - 1;
    if (address / geometry_.program_page != last / geometry_.program_page) return base::Error::bad_geometry;
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes_[address + i] &= bytes[i];
    save();
    return {};
}

base::Status FlashFile::erase(std::uint32_t address) {
    if (!holds(address, geometry_.erase_block, geometry_.erase_block)) return base::Error::bad_geometry;
    std::fill_n(bytes_.begin() + address, geometry_.erase_block, std::uint8_t{0xFF});
    save();
    return {};
}

void FlashFile::save() {
    const std::string part = path_ + ".part";
    std::ofstream file(part, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
    file.close();
    std::error_code error;
    if (file) fs::rename(part, path_, error);
    state_ = file && !error ? ports::StorageState::ready : ports::StorageState::failed;
}

}  // namespace nplc::sim
