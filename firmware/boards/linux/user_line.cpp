#include "user_line.h"

#include <array>
#include <utility>

namespace nplc::boards {

std::optional<hal_linux::Connections::Id> UserLine::accept() {
    if (std::exchange(is_there_, true)) return std::nullopt;
    return kClient;
}

hal_linux::Connections::Got UserLine::read(Id, std::span<std::uint8_t> out) {
    std::array<ports::ReceivedByte, 256> bytes;
    while (received_.size() < out.size()) {
        const std::size_t count = port_.read(bytes);
        if (count == 0) break;
        received_.insert(received_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    }
    Got got;
    while (!received_.empty() && got.count < out.size() && !got.is_damaged) {
        const ports::ReceivedByte byte = received_.front();
        received_.pop_front();
        got.is_damaged = byte.framing_error;
        if (!got.is_damaged) out[got.count++] = byte.value;
    }
    return got;
}

std::optional<std::size_t> UserLine::write(Id, std::span<const std::uint8_t> bytes) {
    return port_.write(bytes);
}

}  // namespace nplc::boards
