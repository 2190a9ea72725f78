#include "hal_mcu/stellaris/i2c_master.h"

#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/stellaris/pins.h"
#include "hal_mcu/stellaris/system_clock.h"
#include "registers.h"

namespace nplc::hal_mcu::stellaris {
namespace {

constexpr unsigned kInterrupt = 8;
constexpr std::uint32_t kClockPin = 1U << 2;
constexpr std::uint32_t kDataPin = 1U << 3;
constexpr std::uint32_t kFast = 400'000;

I2cRegisters& i2c() {
    return block<I2cRegisters>(0x4002'0000U);
}

void half_bit() {
    for (unsigned turn = 0; turn < kHertz / 1'000'000 * 2; ++turn) asm volatile("nop");
}

/// After a reset during a read the memory holds the data line until it is clocked to the end of its byte.
void free_bus() {
    auto& gpio = block<GpioRegisters>(kPortB);
    gpio.AFSEL = gpio.AFSEL & ~(kClockPin | kDataPin);
    gpio.ODR = gpio.ODR | kClockPin | kDataPin;
    gpio.DATA[kClockPin | kDataPin] = kClockPin | kDataPin;
    gpio.DIR = (gpio.DIR & ~kDataPin) | kClockPin;
    gpio.DEN = gpio.DEN | kClockPin | kDataPin;
    for (int clock = 0; clock < 9; ++clock) {
        gpio.DATA[kClockPin] = 0;
        half_bit();
        gpio.DATA[kClockPin] = kClockPin;
        half_bit();
    }
    connect_to_peripheral(kPortB, kClockPin | kDataPin);
}

}  // namespace

/// A bit takes 20 system clocks times the period (data sheet); rounded up, so that it is never too fast.
void I2cMaster::begin_bus() {
    free_bus();
    i2c().MCR = kMcrMaster;
    i2c().MTPR = (kHertz + 20 * kFast - 1) / (20 * kFast) - 1;
    i2c().MICR = 1;
    i2c().MIMR = 1;
    cortex_m::enable_interrupt(kInterrupt);
}

void I2cMaster::begin(const Transfer& transfer) {
    transfer_ = transfer;
    sent_ = asked_ = 0;
    state_ = State::busy;
    i2c().MSA = static_cast<std::uint32_t>(transfer_.device) << 1;
    send_next();
}

void I2cMaster::on_interrupt() {
    i2c().MICR = 1;
    if (state_ == State::busy) go_on();
}

void I2cMaster::go_on() {
    const std::uint32_t status = i2c().MCS;
    if ((status & kMcsError) != 0) {
        if ((status & kMcsLost) == 0) i2c().MCS = kMcsStop;
        state_ = State::refused;
        return;
    }
    if (sent_ < to_send()) return send_next();
    if (asked_ == 0 && !transfer_.in.empty()) return receive_first();
    if (asked_ != 0) transfer_.in[asked_ - 1] = static_cast<std::uint8_t>(i2c().MDR);
    if (asked_ == transfer_.in.size()) {
        state_ = State::idle;
        return;
    }
    ++asked_;
    i2c().MCS = kMcsRun | (asked_ == transfer_.in.size() ? kMcsStop : kMcsAcknowledge);
}

void I2cMaster::send_next() {
    const std::size_t in_address = transfer_.address.size();
    std::uint8_t byte = 0xFF;
    if (sent_ < in_address) {
        byte = transfer_.address[sent_];
    } else if (sent_ - in_address < transfer_.out.size()) {
        byte = transfer_.out[sent_ - in_address];
    }
    const std::uint32_t start = sent_ == 0 ? kMcsStart : 0;
    ++sent_;
    i2c().MDR = byte;
    i2c().MCS = kMcsRun | start | (sent_ == to_send() ? kMcsStop : 0U);
}

void I2cMaster::receive_first() {
    asked_ = 1;
    i2c().MSA = static_cast<std::uint32_t>(transfer_.device) << 1 | 1U;
    i2c().MCS = kMcsRun | kMcsStart | (transfer_.in.size() == 1 ? kMcsStop : kMcsAcknowledge);
}

void I2cMaster::abandon() {
    i2c().MCR = 0;
    state_ = State::idle;
    begin_bus();
}

}  // namespace nplc::hal_mcu::stellaris
