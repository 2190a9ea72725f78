#include "sim/midi_v24_end.h"

namespace nplc::sim {

namespace v24 = protocol::midi_v24;

/// R: to FFh address 00 answers; what was damaged is answered by whom it seems to have been meant for.
bool MidiV24End::answers(std::uint8_t address) const {
    const std::uint8_t own = module_.memory().address;
    return address == own || (address == v24::kGeneral && own == 0);
}

void MidiV24End::receive(std::uint8_t byte, bool framing_error) {
    if (module_.deaf() || framing_error) {
        decoder_.abandon();
        return;
    }
    const auto event = decoder_.receive(byte);
    using Kind = v24::RequestDecoder::Event::Kind;
    if (event.kind == Kind::damaged && answers(event.request.address)) send(v24::kNack);
    if (event.kind == Kind::request) serve(event.request);
}

void MidiV24End::serve(const v24::Request& request) {
    const bool answered = answers(request.address);
    if (!answered && request.address != v24::kGeneral) return;
    const std::uint8_t own = module_.memory().address;
    std::optional<std::uint32_t> value;
    bool done = false;
    if (v24::is_query(request.index)) {
        value =
            module_.answer(static_cast<std::uint8_t>(request.index - v24::kFirstQuery), request.sub_index);
    } else {
        done = module_.execute(request.index, request.sub_index, request.data);
    }
    if (answered) {
        send(v24::kAck);
        send(v24::kXoff);
        if (value)
            send(v24::encode_reply({.address = own, .digit = v24::digit_of(request.index), .data = *value}));
        send(done || value ? v24::kXon : v24::kXonError);
    } else if (module_.wants_restart()) {
        module_.restart();
    }
}

std::optional<std::uint8_t> MidiV24End::transmit() {
    if (out_.empty()) return std::nullopt;
    const std::uint8_t byte = out_.front();
    out_.pop_front();
    if (out_.empty() && module_.wants_restart()) module_.restart();
    return byte;
}

}  // namespace nplc::sim
