#include "sim/midi_ends.h"

#include <algorithm>
#include <set>

namespace nplc::sim {
namespace {

/// Start, identifier, control, check sum, acknowledgement, end and interframe space.
constexpr std::int64_t kBitsAround = 47;

}  // namespace

namespace v24 = protocol::midi_v24;

/// R: address 00 answers to FFh; a damaged request is answered by the module whose address it then has.
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

namespace can = protocol::midi_can;

using Ask = can::Request::Kind;
using Say = can::Answer::Kind;

void MidiCanEnd::receive(const base::CanFrame& frame) {
    if (module_.deaf()) return;
    const can::Request request = can::decode_request(frame);
    switch (request.kind) {
        case Ask::none:
            return;
        case Ask::sync:
            module_.sync();
            return;
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

/// 003 §V.5. R: out of sequence it has no effect, and an address outside 1..127 is answered with error code
/// 1.
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
    // 003 §V.8: only address 1 answers a general message.
    if (general && own != 1) return;
    send({.kind = value  ? Say::value
                  : done ? Say::accepted
                         : Say::refused,
          .address = own,
          .index = request.index,
          .sub_index = request.sub_index,
          .data = value.value_or(0)});
}

std::optional<base::CanFrame> MidiCanEnd::transmit() {
    if (out_.empty() && module_.wants_restart()) module_.restart();
    if (out_.empty() && module_.take_boot()) send({.kind = Say::booted, .address = module_.memory().address});
    if (out_.empty()) return std::nullopt;
    const base::CanFrame frame = out_.front();
    out_.pop_front();
    return frame;
}

void CanBus::send(const Frame& frame, int sender) {
    waiting_.push_back({frame, sender});
}

void CanBus::start(Time now) {
    if (under_way_ || waiting_.empty()) return;
    auto best = waiting_.end();
    std::set<int> seen;
    for (auto at = waiting_.begin(); at != waiting_.end(); ++at) {
        if (!seen.insert(at->sender).second) continue;
        if (best == waiting_.end() || at->frame.id < best->frame.id) best = at;
    }
    under_way_ = *best;
    waiting_.erase(best);
    const std::int64_t bits = kBitsAround + 8 * std::int64_t{under_way_->frame.length};
    ends_ = std::max(ends_, now) + Time{bits * 1'000'000'000 / bit_rate_};
}

std::optional<CanBus::Heard> CanBus::take(Time now) {
    start(now);
    if (!under_way_ || ends_ > now) return std::nullopt;
    const auto heard = under_way_;
    under_way_.reset();
    start(now);
    return heard;
}

std::optional<Time> CanBus::next_event() const {
    if (!under_way_) return std::nullopt;
    return ends_;
}

}  // namespace nplc::sim
