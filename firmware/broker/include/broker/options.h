#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::broker {

/// An MQTT broker, and who we are to it.
struct Options {
    std::string host{};
    std::uint16_t port = 1883;
    std::string user{};           ///< empty: none
    std::string password_file{};  ///< its first line
    std::string ca_file{};        ///< with it TLS is spoken
    std::string certificate_file{};
    std::string key_file{};
};

/// "HOST:PORT", "[::1]:1883". False: it is none.
bool read_address(const std::string& text, Options& options);

struct Mistake {
    std::string_view key;  ///< of the file that the options are from, "key_file"
    std::string_view text;
};
/// What of user, password and certificates does not go together.
std::vector<Mistake> mistakes_of(const Options& options);

}  // namespace nplc::broker
