#pragma once

#include "motor/motor.h"

namespace nplc::motor {

/// The one access that a driver handles at a time (Motor::begin_access), and the access counters.
class AccessSlot {
  public:
    AccessState state() const { return state_; }
    bool is_open() const { return motor::is_open(state_); }
    bool waits() const { return state_ == AccessState::waiting; }
    bool is_under_way() const { return state_ == AccessState::under_way; }
    const Access& access() const { return access_; }
    std::uint32_t value() const { return value_; }

    /// False while another access is open.
    bool begin(const Access& access) {
        if (is_open()) return false;
        access_ = access;
        state_ = AccessState::waiting;
        return true;
    }
    void start() { state_ = AccessState::under_way; }
    void finish(std::uint32_t value = 0) {
        value_ = value;
        state_ = AccessState::done;
        ++done_;
    }
    void fail() {
        state_ = AccessState::failed;
        ++failed_;
    }
    void fail_open() {
        if (is_open()) fail();
    }
    void fail_waiting() {
        if (waits()) fail();
    }
    void drop() {
        if (!is_under_way()) state_ = AccessState::none;
    }

    void count(Counters& counters) const {
        counters.accesses = done_;
        counters.access_fails = failed_;
    }

  private:
    AccessState state_ = AccessState::none;
    Access access_;
    std::uint32_t value_ = 0;
    std::uint32_t done_ = 0;
    std::uint32_t failed_ = 0;
};

}  // namespace nplc::motor
