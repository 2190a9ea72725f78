#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nplc::deployment {

/// A file to be written.
struct File {
    std::string path;
    std::vector<std::uint8_t> bytes;
};

}  // namespace nplc::deployment
