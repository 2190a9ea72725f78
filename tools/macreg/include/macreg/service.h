#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "macreg/motor.h"

/// SAFE_MODE, flash and reset (001 §2.2, §4.4.16, §5.1).
namespace nplc::macreg {

/// The motor is not in a state to do it, or did not do it.
class NotDone : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Holds the motor in SAFE_MODE. At the end of its life the motor is as it was found: passive, or in
/// SAFE_MODE if it had been in it.
class SafeMode {
  public:
    /// The motor must be passive; with `stop` one that runs is stopped first, and stays passive. `goes_on`
    /// false: mactalk_client::Interrupted.
    SafeMode(Motor& motor, bool stop, std::function<bool()> goes_on);
    ~SafeMode();
    SafeMode(const SafeMode&) = delete;
    SafeMode& operator=(const SafeMode&) = delete;

    /// The motor has left it by itself, as after a reset.
    void left() { left_ = true; }
    /// Stays in SAFE_MODE.
    void keep() { left_ = true; }

  private:
    Motor& motor_;
    bool was_safe_ = false;
    bool left_ = false;
};

/// In SAFE_MODE, after which the motor is not in it any more.
class Service {
  public:
    Service(Motor& motor, std::function<bool()> goes_on) : motor_(motor), goes_on_(std::move(goes_on)) {}
    /// A motor that moves may not be stopped unless said.
    void allow_stop() { stop_ = true; }

    void enter_safe();
    void exit_safe();
    /// What the motor has in memory goes into its flash, then it resets. Names of parameters that the motor
    /// has other than before; none if all is well.
    std::vector<std::string> save();
    /// MODE_REG 256 (into flash, with a reset) or 257 (not into flash).
    void defaults(bool into_flash);
    /// MODE_REG 258: the flash's parameters.
    void reload();
    /// 57h. What was not saved is gone.
    void reset();
    /// The mode in which the motor is now.
    std::int64_t mode() { return motor_.read(registers::MODE_REG); }

  private:
    void order_reset(const std::function<void()>& order, const char* what);
    void order_parameters(std::int64_t code, const char* what);
    bool wait_until_out_of_safe();
    void look() const;

    Motor& motor_;
    std::function<bool()> goes_on_;
    bool stop_ = false;
};

/// MODE_REG's name, for a person.
std::string mode_text(registers::Model model, std::int64_t mode);

}  // namespace nplc::macreg
