#include "nanoctl/reconnecting.h"

#include <algorithm>

namespace nplc::nanoctl {
namespace {

constexpr base::Milliseconds kBetweenTries{20};

}  // namespace

/// A pause between attempts, for an end that closes every connection at once.
bool Reconnecting::connect() {
    if (is_connected_) return true;
    sleep_(kBetweenTries);
    Opened opened = open_();
    if (!opened.client) return false;
    client_ = std::move(opened.client);
    is_connected_ = true;
    return true;
}

bool Reconnecting::write(std::span<const std::uint8_t> bytes) {
    if (connect() && client_->write(bytes)) return true;
    is_connected_ = false;
    return now() < end_;
}

/// The pending request was sent on the old connection: no answer will come.
std::optional<std::size_t> Reconnecting::read(std::span<std::uint8_t> out, base::Microseconds wait) {
    if (is_connected_) {
        if (const auto count = client_->read(out, wait)) return count;
        is_connected_ = false;
    }
    if (now() >= end_) return std::nullopt;
    sleep_(std::min<base::Microseconds>(wait, kBetweenTries));
    return 0;
}

}  // namespace nplc::nanoctl
