#include "sim/endpoint.h"

#include <fmt/format.h>

#include <array>

namespace nplc::sim {

std::string Endpoint::open(const std::string& endpoint) {
    if (endpoint.empty()) return {};
    auto opened = hal_linux::ByteServer::open(endpoint);
    server_ = std::move(opened.server);
    return opened.error;
}

std::vector<std::uint8_t> Endpoint::read() {
    if (server_ == nullptr) return {};
    std::array<std::uint8_t, 4096> block{};
    const std::size_t count = server_->read(block);
    return {block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count)};
}

void Endpoint::write(const std::vector<std::uint8_t>& bytes) {
    if (server_ != nullptr && !bytes.empty()) server_->write(bytes);
}

std::string Endpoint::described(const std::string& label) const {
    return server_ == nullptr ? std::string{} : fmt::format("{}: {}\n", label, server_->name());
}

}  // namespace nplc::sim
