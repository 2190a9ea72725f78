#include "seat/secret.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace nplc::faces {
namespace {

std::string wrong_length(const std::string& path, std::size_t most) {
    return path + ": its first line must be a secret of " + std::to_string(kLeastSecret) + " to " +
           std::to_string(most) + " characters";
}

}  // namespace

Secret read_secret(const std::string& path, std::size_t most) {
    std::ifstream file(path);
    if (!file.is_open()) return {.error = path + ": " + std::strerror(errno)};
    Secret secret;
    std::getline(file, secret.text);
    if (secret.text.starts_with("\xEF\xBB\xBF")) secret.text.erase(0, 3);
    if (secret.text.ends_with('\r')) secret.text.pop_back();
    if (secret.text.size() >= kLeastSecret && secret.text.size() <= most) return secret;
    return {.error = wrong_length(path, most)};
}

bool same_secret(std::string_view given, std::string_view wanted) {
    unsigned differing = given.size() == wanted.size() ? 0U : 1U;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const char other = wanted.empty() ? '\0' : wanted[i % wanted.size()];
        differing |= unsigned{static_cast<unsigned char>(given[i])} ^ static_cast<unsigned char>(other);
    }
    return differing == 0 && !wanted.empty();
}

}  // namespace nplc::faces
