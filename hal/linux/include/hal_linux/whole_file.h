#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace nplc::hal_linux {

/// Atomic: written beside the file, then renamed; on the disk when it returns. Does not follow or overwrite
/// an existing file under the temporary name. False with errno.
bool make_whole_file(const std::string& path, std::span<const std::uint8_t> bytes);

/// Overwrites in place, in one write, without following links; on the disk when it returns. May be partly
/// written after a power cut, so the data need a check sum. False with errno.
bool overwrite(const std::string& path, std::span<const std::uint8_t> bytes, std::uint32_t offset = 0);

}  // namespace nplc::hal_linux
