// Any frames from a CAN bus, and any state of it; what must hold stands in midi_driver_run.h.

#include "midi_driver_run.h"
#include "motor/midi_can_link.h"

using namespace nplc;

namespace {

namespace can = protocol::midi_can;

class Bus final : public ports::CanPort {
  public:
    static constexpr base::Microseconds kGap{1'000};

    bool write(const ports::CanFrame& frame) override {
        if (!takes_ || state_ == ports::CanState::down || state_ == ports::CanState::bus_off) return false;
        require(!frame.extended && !frame.remote && frame.length == 8);
        last_ = can::decode_request(frame);
        require(last_.address == kAddress);
        const bool asks = last_.kind == can::Request::Kind::query;
        require(asks || last_.kind == can::Request::Kind::command);
        const bool stops = last_.index == can::kIndices + registers::midi::EMERGENCY_STOP;
        require(asks || stops || motor::link_is_usable(driver->link()));
        return true;
    }
    bool read(ports::CanFrame& frame) override { return arrivals.take(frame); }
    bool filter(std::span<const ports::CanFilter>) override { return true; }
    ports::CanState state() override { return state_; }
    ports::CanFaults faults() override { return {}; }
    bool restart() override {
        require(state_ == ports::CanState::bus_off);
        if (restarts_) state_ = ports::CanState::active;
        return restarts_;
    }

    motor::MidiLink& link() { return link_; }

    void answer(std::uint32_t value) { say(answer_to_last(value)); }

    void act(std::uint8_t what, std::uint8_t value) {
        if (what == 0) say(damaged(value));
        if (what == 1) say({.kind = can::Answer::Kind::refused, .address = kAddress, .index = last_.index});
        if (what == 2) say({.kind = can::Answer::Kind::booted, .address = value % 2 != 0 ? kAddress : value});
        if (what != 3) return;
        state_ = static_cast<ports::CanState>(value % 5);
        takes_ = value % 3 != 0;
        restarts_ = value % 7 != 0;
    }

    void clear() { takes_ = true; }

    const motor::Motor* driver = nullptr;
    fuzz::Arrivals<ports::CanFrame> arrivals;

  private:
    static constexpr std::uint8_t kAddress = 5;

    can::Answer answer_to_last(std::uint32_t value) const {
        const bool asks = last_.kind == can::Request::Kind::query;
        return {.kind = asks ? can::Answer::Kind::value : can::Answer::Kind::accepted,
                .address = kAddress,
                .index = last_.index,
                .sub_index = last_.sub_index,
                .data = asks ? value : 0};
    }

    /// The right answer but for one thing.
    ports::CanFrame damaged(std::uint8_t value) const {
        ports::CanFrame frame = framed(answer_to_last(value));
        const std::uint8_t bit = static_cast<std::uint8_t>(1U << value % 8);
        if (value < 64) frame.data[value / 8] ^= bit;
        if (value >= 64 && value < 128) frame.id ^= bit;
        if (value >= 128 && value < 192) frame.length = value % 9;
        if (value >= 192) (value % 2 != 0 ? frame.extended : frame.remote) = true;
        return frame;
    }

    static ports::CanFrame framed(const can::Answer& answer) { return can::encode_answer(answer); }
    void say(const can::Answer& answer) { say(framed(answer)); }
    void say(const ports::CanFrame& frame) { arrivals.say(frame); }

    ports::CanState state_ = ports::CanState::active;
    bool takes_ = true;
    bool restarts_ = true;
    can::Request last_;
    motor::MidiCanLink link_{*this, {.address = kAddress}};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::run_midi_driver<Bus>(data, size);
    return 0;
}
