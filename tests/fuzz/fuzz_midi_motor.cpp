// Any bytes from a MIDI module's V24 line; what must hold stands in midi_driver_run.h.

#include "midi_driver_run.h"
#include "motor/midi_v24_link.h"

using namespace nplc;

namespace {

namespace v24 = protocol::midi_v24;

class Line final : public ports::SerialPort {
  public:
    static constexpr base::Microseconds kGap{261};  // a byte at 38400 baud

    std::size_t write(std::span<const std::uint8_t> bytes) override {
        const std::size_t count = bytes.size() < room_ ? bytes.size() : room_;
        for (const std::uint8_t byte : bytes.first(count)) take(byte);
        return count;
    }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::size_t count = 0;
        while (count < out.size() && arrivals.take(out[count])) ++count;
        return count;
    }
    bool transmitter_idle() override { return true; }

    motor::MidiLink& link() { return link_; }

    void answer(std::uint32_t value) {
        say({0x06, 0x13});
        if (v24::is_query(last_.index))
            say(v24::encode_reply({.address = 0, .digit = v24::digit_of(last_.index), .data = value}));
        say({0x1A});
    }

    void act(std::uint8_t what, std::uint8_t value) {
        if (what == 0) arrivals.say({value, false});
        if (what == 1) arrivals.say({value, value % 16 == 0});
        if (what == 2) say({0x06, 0x13, static_cast<std::uint8_t>(value % 4 == 0 ? 0x17 : 0x1A)});
        if (what == 3) room_ = value % 3 == 0 ? value % 8U : kRoom;
    }

    void clear() { room_ = kRoom; }

    const motor::Motor* driver = nullptr;
    fuzz::Arrivals<ports::ReceivedByte> arrivals;

  private:
    static constexpr std::size_t kRoom = 64;

    void take(std::uint8_t byte) {
        const auto event = requests_.receive(byte);
        if (event.kind != v24::RequestDecoder::Event::Kind::request) return;
        last_ = event.request;
        // Commands begin only while the link delivers; one that was begun may have ended the link meanwhile.
        const bool stops = last_.index == registers::midi::EMERGENCY_STOP;
        if (room_ >= kRoom)
            require(v24::is_query(last_.index) || stops || motor::link_is_usable(driver->link()));
    }

    void say(const auto& bytes) {
        for (const std::uint8_t byte : bytes) arrivals.say({byte, false});
    }
    void say(std::initializer_list<std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) arrivals.say({byte, false});
    }

    std::size_t room_ = kRoom;
    v24::RequestDecoder requests_;
    v24::Request last_;
    motor::MidiV24Link link_{*this, {}};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::run_midi_driver<Line>(data, size);
    return 0;
}
