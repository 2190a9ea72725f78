#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nplc::faces {

/// Of what lets its reader operate or change something.
inline constexpr std::size_t kLeastSecret = 12;

/// The first line of a file. `error`: why there is none, one line; the file must be readable, and the secret
/// not shorter than kLeastSecret and not longer than `most`.
struct Secret {
    std::string text{};
    std::string error{};
};
Secret read_secret(const std::string& path, std::size_t most);

/// Equal texts, in a time that does not tell where they differ; never where none is wanted.
bool same_secret(std::string_view given, std::string_view wanted);

}  // namespace nplc::faces
