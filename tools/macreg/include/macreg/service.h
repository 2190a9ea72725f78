#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "macreg/motor.h"

/// SAFE_MODE, flash and reset (001 §2.2, §4.4.16, §5.1).
namespace nplc::macreg {

/// The motor is not in a state to do it, or did not do it.
class NotDone : public mactalk_client::EndedWith<mactalk_client::kRefused> {
    using EndedWith::EndedWith;
};

/// What has been done to the motor so far, to report after an early end.
struct Trail {
    enum class Order : std::uint8_t { none, sent, done };

    std::string ran_in{};       ///< the mode in which it was commanded to stop; empty: it was passive
    bool stopped = false;       ///< the stop has been confirmed
    std::string turns{};        ///< "V_IST 200 rpm" if it was still turning when the wait ended
    bool in_safe_mode = false;  ///< it could not be brought out of it again
    Order order = Order::none;  ///< to write flash, to reset, to read parameters

    /// "the motor ran in P_MODE and was stopped: ...", of one that ran.
    std::string stop_words() const;
};

/// Stops a running motor, and waits until it is passive, for 10 s at the most. `goes_on` false:
/// mactalk_client::Interrupted.
void stop_motor(Motor& motor, const std::function<bool()>& goes_on, Trail& trail);

/// Holds the motor in SAFE_MODE. The destructor restores the mode found before: passive, or SAFE_MODE if it
/// had been in it.
class SafeMode {
  public:
    /// The motor must be passive; with `stop` a running one is stopped first, and stays passive. `goes_on`
    /// false: mactalk_client::Interrupted. Records in `trail` what it does.
    SafeMode(Motor& motor, bool stop, std::function<bool()> goes_on, Trail& trail);
    ~SafeMode();
    SafeMode(const SafeMode&) = delete;
    SafeMode& operator=(const SafeMode&) = delete;

    /// The motor has left it by itself, as after a reset.
    void left() { left_ = true; }
    /// Stays in SAFE_MODE.
    void keep() { left_ = true; }

  private:
    Motor& motor_;
    Trail& trail_;
    bool was_safe_ = false;
    bool left_ = false;
};

/// To be called in SAFE_MODE; afterwards the motor is no longer in it.
class Service {
  public:
    Service(Motor& motor, std::function<bool()> goes_on) : motor_(motor), goes_on_(std::move(goes_on)) {}
    /// A moving motor is stopped only if `stop` is given.
    void allow_stop() { stop_ = true; }

    void enter_safe();
    void exit_safe();
    /// Saves the motor's memory to its flash, after which it resets. Returns the names of parameters that
    /// differ from before; none if all are equal.
    std::vector<std::string> save();
    /// MODE_REG 256 (into flash, with a reset) or 257 (not into flash).
    void defaults(bool into_flash);
    /// MODE_REG 258: the flash's parameters.
    void reload();
    /// 57h. Unsaved values are lost.
    void reset();
    /// The mode in which the motor is now.
    std::int64_t mode() { return motor_.read(registers::MODE_REG); }

    const Trail& trail() const { return trail_; }
    /// The last call, if it ended early: the state of flash, memory and mode, and what to check.
    std::string left_behind() const;

  private:
    enum class Task : std::uint8_t { safe_mode, save, defaults, unsaved_defaults, reload, reset };

    void begin(Task task);
    void order_reset(const std::function<void()>& order, const char* what);
    void order_parameters(std::int64_t code, const char* what);
    bool wait_until_out_of_safe();
    void look() const;

    Motor& motor_;
    std::function<bool()> goes_on_;
    bool stop_ = false;
    Task task_ = Task::safe_mode;
    Trail trail_;
};

/// MODE_REG's name, for a user.
std::string mode_text(registers::Model model, std::int64_t mode);

}  // namespace nplc::macreg
