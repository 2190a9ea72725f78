#pragma once

#include <atomic>

#include "hal_mcu/i2c_bus.h"

namespace nplc::hal_mcu::stellaris {

/// I2C0 on PB2 (clock) and PB3 (data) at 357 kHz; its interrupt moves the bytes.
class I2cMaster final : public I2cBus {
  public:
    void begin_bus();

    void begin(const Transfer& transfer) override;
    State state() override { return state_; }
    void abandon() override;
    void on_interrupt();

  private:
    void go_on();
    void send_next();
    void receive_first();
    std::size_t to_send() const { return transfer_.address.size() + transfer_.out.size() + transfer_.blanks; }

    Transfer transfer_{};
    std::size_t sent_ = 0;
    std::size_t asked_ = 0;  ///< bytes of transfer_.in that have been requested from the chip
    std::atomic<State> state_{State::idle};
};

}  // namespace nplc::hal_mcu::stellaris
