#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace nplc::hal_linux {

/// Written beside its place, then moved there; on the disk when it returns. What somebody has prepared under
/// the first name is not written to. False: errno says why.
bool make_whole_file(const std::string& path, std::span<const std::uint8_t> bytes);

/// Over what stands there, in one piece, without a link being followed; on the disk when it returns. Half of
/// it may be there after a power cut, so it needs a check sum. False: errno says why.
bool overwrite(const std::string& path, std::span<const std::uint8_t> bytes, std::uint32_t offset = 0);

}  // namespace nplc::hal_linux
