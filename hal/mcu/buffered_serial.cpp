#include "hal_mcu/buffered_serial.h"

namespace nplc::hal_mcu {

std::size_t BufferedSerial::write(std::span<const std::uint8_t> bytes) {
    std::size_t taken = 0;
    while (taken < bytes.size() && to_send_.push(bytes[taken])) ++taken;
    if (taken != 0) wake_transmitter();
    return taken;
}

std::size_t BufferedSerial::read(std::span<ports::ReceivedByte> out) {
    std::size_t count = 0;
    while (count < out.size()) {
        const auto received = received_.pop();
        if (!received) break;
        out[count++] = {received->value, received->fault};
    }
    return count;
}

void BufferedSerial::take_received(std::uint8_t value, bool framing_error) {
    if (framing_error) ++faults_.framing;
    if (gap_ && received_.push({0, true})) gap_ = false;
    if (!gap_ && received_.push({value, framing_error})) return;
    note_overrun();
}

void BufferedSerial::note_overrun() {
    ++faults_.overruns;
    gap_ = true;
}

}  // namespace nplc::hal_mcu
