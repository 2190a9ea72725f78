// Lines `KEY SIGNATURE MESSAGE` in hexadecimal from standard input; `yes` or `no` for each.

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "signature/ed25519.h"

namespace {

std::vector<std::uint8_t> bytes_of(const std::string& text) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoul(text.substr(i, 2), nullptr, 16)));
    return bytes;
}

template <std::size_t kSize>
std::array<std::uint8_t, kSize> array_of(const std::string& text) {
    std::array<std::uint8_t, kSize> result{};
    const auto bytes = bytes_of(text);
    std::copy_n(bytes.begin(), std::min(bytes.size(), kSize), result.begin());
    return result;
}

}  // namespace

int main() {
    std::string key;
    std::string signature;
    std::string message;
    while (std::cin >> key >> signature >> message) {
        const bool is_good =
            nplc::signature::is_signed(bytes_of(message), array_of<64>(signature), array_of<32>(key), [] {});
        std::cout << (is_good ? "yes\n" : "no\n");
    }
}
