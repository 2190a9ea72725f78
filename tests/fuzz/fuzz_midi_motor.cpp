// Any bytes from a MIDI module's line, at any time, among any orders: the driver stays bounded, gives no
// motion command while the link does not deliver, shows ERROR from a loss until "reset error", and settles
// once the line is silent.

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <string_view>

#include "motor/midi_motor.h"
#include "motor/midi_v24_link.h"

using namespace nplc;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

struct Line final : ports::SerialPort {
    std::size_t write(std::span<const std::uint8_t> bytes) override {
        const std::size_t count = bytes.size() < room ? bytes.size() : room;
        for (const std::uint8_t byte : bytes.first(count)) take(byte);
        return count;
    }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::size_t count = 0;
        while (count < out.size() && !received.empty()) {
            out[count++] = received.front();
            received.pop_front();
        }
        return count;
    }
    bool transmitter_idle() override { return true; }

    void take(std::uint8_t byte) {
        const auto event = requests.receive(byte);
        if (event.kind != protocol::midi_v24::RequestDecoder::Event::Kind::request) return;
        last = event.request;
        // Commands begin only while the link delivers; one that was begun may have ended the link meanwhile.
        if (room >= 64) require(protocol::midi_v24::is_query(last.index) || motor::delivers(driver->link()));
    }

    std::deque<ports::ReceivedByte> received;
    std::size_t room = 64;
    protocol::midi_v24::RequestDecoder requests;
    protocol::midi_v24::Request last;
    const motor::Motor* driver = nullptr;
};

class Run {
  public:
    /// Of a module with a speed of its own or with none (period 0).
    explicit Run(bool has_speed) {
        line_.driver = &driver_;
        for (int i = 0; i < 40 && driver_.link() != motor::Link::up; ++i) {
            poll(base::Microseconds(1'000));
            answer(has_speed ? 0x80000320 : 0x80000000);
        }
        require(driver_.link() == motor::Link::up);
    }

    void act(std::uint8_t what, std::uint8_t value) {
        switch (what % 10) {
            case 0:
                return hear(value, false);
            case 1:
                return hear(value, value % 16 == 0);
            case 2:
                return poll(base::Microseconds(value * 200));
            case 3:
                return answer(value * 0x01010101U);
            case 4:
                return answer(value % 2 != 0 ? 0x0000'0800U : 0U);
            case 5:
                for (const int c : {0x06, 0x13, value % 4 == 0 ? 0x17 : 0x1A})
                    hear(static_cast<std::uint8_t>(c), false);
                return;
            case 6:
                line_.room = value % 3 == 0 ? value % 8U : 64;
                return poll(base::Microseconds(261));
            case 7:
            case 8:
                return order(value);
            default:
                return other(value);
        }
    }

    /// Silence ends everything: the link is lost, or nothing was under way.
    void settle() {
        line_.room = 64;
        const base::Instant end = now_ + base::Milliseconds(5'000);
        for (int i = 0; now_ < end; ++i) {
            require(i < 2'000);  // deadlines lead on
            const base::Instant due = std::min(driver_.next_poll(now_), end);
            poll(due > now_ ? due - now_ : base::Microseconds(1));
        }
        require(driver_.settled());
        require(driver_.link() == motor::Link::down);
        require(driver_.error());
        require(driver_.next_poll(now_) > now_);
    }

  private:
    void order(std::uint8_t value) {
        if (driver_.has_room()) {
            constexpr std::uint8_t kRegisters[]{2, 2, 3, 5, 6, 7, 10, 33, 43, 49, 51, 65, 73, 77, 85, 120};
            driver_.send({.is_register_write = value % 3 == 0,
                          .command = static_cast<std::uint8_t>(value & 0x7F),
                          .reg = kRegisters[value % 16],
                          .longword = value % 5 == 0,
                          .value = value % 7U * (value % 4 == 0 ? 0x10001U : 77U)});
        }
        poll(base::Microseconds(100));
    }

    void other(std::uint8_t value) {
        if (value % 8 == 0) driver_.stop();
        if (value % 8 == 4) driver_.drop_access();
        if (value % 4 == 1) {
            // Where the shaft is and how fast it turns, besides any register.
            const int reg = value % 16 == 5 ? registers::P_IST + value / 16 % 3 : value / 2;
            const bool taken = driver_.begin_access({.is_write = value % 8 == 1,
                                                     .reg = static_cast<std::uint8_t>(reg),
                                                     .longword = value % 16 > 8,
                                                     .value = value});
            require(!taken || motor::delivers(driver_.link()));
        }
        poll(base::Microseconds(100));
    }

    /// As a module would.
    void answer(std::uint32_t value) {
        hear(0x06, false);
        hear(0x13, false);
        if (protocol::midi_v24::is_query(line_.last.index)) {
            const auto bytes = protocol::midi_v24::encode_reply(
                {.address = 0, .digit = protocol::midi_v24::digit_of(line_.last.index), .data = value});
            for (const std::uint8_t byte : bytes) hear(byte, false);
        }
        hear(0x1A, false);
    }

    void hear(std::uint8_t byte, bool framing_error) {
        line_.received.push_back({byte, framing_error});
        poll(base::Microseconds(261));
    }

    void poll(base::Microseconds step) {
        now_ += step;
        driver_.poll(now_);
        require(!driver_.in_position() || (driver_.link() == motor::Link::up && !driver_.error()));
        require(driver_.link() != motor::Link::unacknowledged || driver_.error());
        require(driver_.link() != motor::Link::down || !ever_up_ || driver_.error());
        require((driver_.fault() == motor::MidiFault::none) == !driver_.error());
        if (driver_.link() == motor::Link::up) ever_up_ = true;
    }

    Line line_;
    motor::MidiV24Link link_{line_, {}};
    motor::MidiMotor driver_{link_, {}};
    base::Instant now_{};
    bool ever_up_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 4096) return 0;
    Run run(size % 2 != 0);
    for (std::size_t i = 0; i + 1 < size; i += 2) run.act(data[i], data[i + 1]);
    run.settle();
    return 0;
}
