#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::broker {

/// An MQTT broker, and the credentials for it.
struct Options {
    std::string host{};
    std::uint16_t port = 1883;
    std::string user{};           ///< empty: none
    std::string password_file{};  ///< the first line is the password
    std::string ca_file{};        ///< enables TLS
    std::string certificate_file{};
    std::string key_file{};
};

/// "HOST:PORT", "[::1]:1883". False: invalid.
bool read_address(const std::string& text, Options& options);

struct Mistake {
    std::string_view key;  ///< key in the options' file, "key_file"
    std::string text;
};
/// Contradictions between user, password and certificates.
std::vector<Mistake> mistakes_of(const Options& options);

}  // namespace nplc::broker
