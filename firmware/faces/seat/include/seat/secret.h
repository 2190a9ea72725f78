#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nplc::faces {

/// Minimum length of a secret that allows to operate or change something.
inline constexpr std::size_t kLeastSecret = 12;

/// The first line of a file. `error`: a one-line error; the file must be readable, and the secret between
/// kLeastSecret and `most` characters long.
struct Secret {
    std::string text{};
    std::string error{};
};
Secret read_secret(const std::string& path, std::size_t most);

/// Constant-time comparison; false if no secret is set.
bool same_secret(std::string_view given, std::string_view wanted);

}  // namespace nplc::faces
