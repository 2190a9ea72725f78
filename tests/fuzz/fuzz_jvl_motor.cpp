// Any bytes from the motor's line, at any time, among any orders: the driver stays bounded, delivers nothing
// but a stop while the link is not up, and settles once the line is steady.

#include <deque>

#include "fuzz.h"
#include "motor/jvl_motor.h"

using namespace nplc;

namespace {

bool belongs_to_the_link(std::uint8_t byte) {
    switch (byte & 0x7F) {
        case 0x60:
        case 0x6A:
        case 0x6B:
        case 0x73:
            return true;
        default:
            return byte == 0x7E;
    }
}

/// What a stop is while the link is lost: into FlexMAC, MODE_REG := 0 twice, back to FastMAC.
class BlindStop {
  public:
    /// It goes on with `byte`, or begins.
    bool take(std::uint8_t byte) {
        constexpr std::uint8_t kBytes[]{0x7F, 0x7F, 0xFF, 0xFF, 0x60, 0x60, 0x60, 0x02, 0xFD,
                                        0x00, 0xFF, 0x00, 0xFF, 0x60, 0x60, 0x60, 0x02, 0xFD,
                                        0x00, 0xFF, 0x00, 0xFF, 0x7E, 0x7E, 0x7E};
        // An order 1Fh may stand right before it: of three 7Fh the last two are its first.
        if (byte != kBytes[next_]) next_ = next_ == 2 ? 1 : 0;
        if (byte != kBytes[next_]) {
            next_ = 0;
            return false;
        }
        next_ = (next_ + 1) % sizeof kBytes;
        return true;
    }

  private:
    std::size_t next_ = 0;
};

struct Line final : ports::SerialPort {
    std::size_t write(std::span<const std::uint8_t> bytes) override {
        const std::size_t taken = bytes.size() < room ? bytes.size() : room;
        for (const std::uint8_t byte : bytes.first(taken)) {
            const bool stops = blind_stop.take(byte) && was_told_to_stop;
            require(motor::link_is_usable(driver->link()) || stops || belongs_to_the_link(byte));
        }
        return taken;
    }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::size_t count = 0;
        while (count < out.size() && !received.empty()) {
            out[count++] = received.front();
            received.pop_front();
        }
        return count;
    }
    bool transmitter_idle() override { return idle; }

    std::deque<ports::ReceivedByte> received;
    std::size_t room = 64;
    bool idle = true;
    bool was_told_to_stop = false;
    BlindStop blind_stop;
    const motor::Motor* driver = nullptr;
};

class Run {
  public:
    Run() {
        line_.driver = &driver_;
        for (const int echo : {0x00, 0x80, 0x00, 0x80, 0x00}) {
            for (int i = 0; i < 4; ++i) hear(static_cast<std::uint8_t>(echo), false);
        }
        require(driver_.link() == motor::Link::up);
    }

    void act(std::uint8_t what, std::uint8_t value) {
        switch (what % 8) {
            case 0:
            case 1:
            case 2:
            case 3:
                return hear(value, false);
            case 4:
                return hear(value, value % 16 == 0);
            case 5:
                line_.idle = value % 4 != 0;
                line_.room = value % 8;
                return poll(base::Microseconds(value * 100));
            case 6:
                if (driver_.has_room()) {
                    driver_.send({.is_register_write = value % 3 == 0,
                                  .command = static_cast<std::uint8_t>(value & 0x7F),
                                  .reg = static_cast<std::uint8_t>(value % 127 + 1),
                                  .longword = value % 2 != 0,
                                  .value = value * 0x01010101U});
                }
                return poll(base::Microseconds(100));
            default:
                if (value % 8 == 0) {
                    line_.was_told_to_stop = true;
                    driver_.stop();
                }
                if (value % 8 == 4) driver_.drop_access();
                if (value % 8 < 4 && value % 8 > 0) {
                    const bool taken = driver_.begin_access({.is_write = value % 8 == 3,
                                                             .reg = static_cast<std::uint8_t>(value | 1),
                                                             .longword = value % 8 == 2,
                                                             .value = value});
                    require(!taken || motor::link_is_usable(driver_.link()));
                }
                return poll(base::Microseconds(100));
        }
    }

    /// Nine orders and a stop, each three messages of 250 ms at the most.
    void settle(std::uint8_t steady) {
        line_.idle = true;
        line_.room = 64;
        for (int i = 0; i < 16'000 && !driver_.orders_complete(); ++i) hear(steady, false);
        require(driver_.orders_complete());
    }

  private:
    void hear(std::uint8_t byte, bool framing_error) {
        line_.received.push_back({byte, framing_error});
        poll(base::Microseconds(521));
    }

    void poll(base::Microseconds step) {
        now_ += step;
        driver_.poll(now_);
        require(driver_.link() == motor::Link::up || driver_.link() == motor::Link::starting || !ever_up_ ||
                driver_.error());
        if (driver_.link() == motor::Link::up) ever_up_ = true;
        require(!driver_.in_position() || driver_.link() == motor::Link::up);
    }

    Line line_;
    motor::JvlMotor driver_{line_, {}};
    base::Instant now_{};
    bool ever_up_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 4096) return 0;
    Run run;
    for (std::size_t i = 0; i + 1 < size; i += 2) run.act(data[i], data[i + 1]);
    run.settle(size == 0 ? std::uint8_t{0} : data[size - 1]);
    return 0;
}
