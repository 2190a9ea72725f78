#include "sim/midi_can_end.h"

namespace nplc::sim {

namespace can = protocol::midi_can;

using Ask = can::Request::Kind;
using Say = can::Answer::Kind;

void MidiCanEnd::receive(const can::Frame& frame) {
    if (module_.deaf()) return;
    const can::Request request = can::decode_request(frame);
    switch (request.kind) {
        case Ask::none:
            return;
        case Ask::sync:
            return module_.sync();
        case Ask::configure:
        case Ask::set_address:
        case Ask::operate:
            return configure(request);
        case Ask::command:
        case Ask::query:
        case Ask::other:
            return serve(request);
    }
}

/// 003 §V.5. R: out of order nothing happens, and an address outside 1..127 is answered with error code 1.
void MidiCanEnd::configure(const can::Request& request) {
    if (request.kind == Ask::configure) {
        configuring_ = true;
        new_address_.reset();
    } else if (configuring_ && request.kind == Ask::set_address) {
        const bool legal = request.data >= 1 && request.data <= can::kMaxAddress;
        if (legal) new_address_ = static_cast<std::uint8_t>(request.data);
        send({.kind = legal ? Say::address_taken : Say::address_refused});
    } else if (configuring_ && request.kind == Ask::operate) {
        configuring_ = false;
        if (new_address_) module_.set_address(*new_address_);
        new_address_.reset();
    }
}

void MidiCanEnd::serve(const can::Request& request) {
    const std::uint8_t own = module_.memory().address;
    const bool general = request.address == can::kGeneral;
    if (!general && request.address != own) return;
    std::optional<std::uint32_t> value;
    bool done = false;
    const bool known = (request.index & 0xFF00) == can::kIndices;
    const auto number = static_cast<std::uint8_t>(request.index);
    if (known && request.kind == Ask::query) value = module_.answer(number, request.sub_index);
    if (known && request.kind == Ask::command)
        done = module_.execute(number, request.sub_index, request.data);
    // 003 §V.8: of a general message address 1 alone answers.
    if (general && own != 1) return;
    send({.kind = value  ? Say::value
                  : done ? Say::accepted
                         : Say::refused,
          .address = own,
          .index = request.index,
          .sub_index = request.sub_index,
          .data = value.value_or(0)});
}

std::optional<can::Frame> MidiCanEnd::transmit() {
    if (out_.empty() && module_.wants_restart()) module_.restart();
    if (out_.empty() && module_.take_boot()) send({.kind = Say::booted, .address = module_.memory().address});
    if (out_.empty()) return std::nullopt;
    const can::Frame frame = out_.front();
    out_.pop_front();
    return frame;
}

}  // namespace nplc::sim
