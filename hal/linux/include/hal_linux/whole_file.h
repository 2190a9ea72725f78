#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace nplc::hal_linux {

/// Written beside its place, then moved there; on the disk when it returns. What somebody has prepared under
/// the first name is not written to. False: errno says why.
bool make_whole_file(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace nplc::hal_linux
