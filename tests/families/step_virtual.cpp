#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "sim/virtual_drive.h"

namespace nplc::sim {
namespace {

constexpr std::uint32_t kBaud = 9'600;

/// A STEP1 that goes 4 counts a millisecond.
class StepVirtual final : public VirtualDrive {
  public:
    explicit StepVirtual(const VirtualDriveOptions& options) : line_(kBaud, options.seed) {}

    motor::DriverPorts ports() override { return {.serial = &line_.port()}; }
    void complete(motor::DriverSettings& settings) const override { settings.baud = kBaud; }
    std::string in_words() const override { return "STEP1"; }
    std::string note(const motor::AnyDriver&) const override { return {}; }
    const VirtualSerialLine* line() const override { return &line_; }
    Time sample_period() const override { return std::chrono::milliseconds{1}; }
    void sample() override {
        if (is_on_) place_ += std::clamp<std::int32_t>(target_ - place_, -4, 4);
    }
    void fill(Snapshot& snapshot) const override {
        snapshot.p_ist = place_;
        snapshot.v_ist = std::clamp<std::int32_t>(target_ - place_, -4, 4);
        snapshot.shaft = place_;
        snapshot.torque = 0;
    }
    void cut(bool cut) override { cut ? line_.cut() : line_.restore(); }
    bool is_cut() const override { return line_.is_cut(); }
    void spoil(const action::SpoilLine&) override {}
    void reseed(std::uint64_t seed) override { line_.reseed(seed); }
    void power(bool on) override { is_on_ = on; }

    bool service(Time now) override {
        while (const auto byte = line_.to_motor().take(now)) {
            if (is_on_) receive(static_cast<char>(byte->value));
        }
        if (!answer_.empty() && line_.from_motor().free(now)) {
            line_.from_motor().start(static_cast<std::uint8_t>(answer_.front()), now);
            answer_.pop_front();
        }
        return line_.service(now);
    }
    Time next_event(Time) const override {
        Time next = Time::max();
        for (const auto& arrival : {line_.to_motor().next_arrival(), line_.from_motor().next_arrival()})
            next = std::min(next, arrival.value_or(Time::max()));
        if (line_.has_waiting()) next = std::min(next, line_.to_motor().busy_until());
        if (!answer_.empty()) next = std::min(next, line_.from_motor().busy_until());
        return next;
    }

  private:
    void receive(char character) {
        if (character != '\n') {
            request_ += character;
            return;
        }
        if (request_.starts_with("G")) target_ = std::stoi(request_.substr(1));
        if (request_ == "S") target_ = place_;
        if (request_ == "?") {
            const std::string text = fmt::format("{} {}\n", target_ == place_ ? 0 : 1, place_);
            answer_.insert(answer_.end(), text.begin(), text.end());
        }
        request_.clear();
    }

    VirtualSerialLine line_;
    std::string request_;
    std::deque<char> answer_;
    std::int32_t place_ = 0;
    std::int32_t target_ = 0;
    bool is_on_ = true;
};

}  // namespace

std::unique_ptr<VirtualDrive> make_step_drive(const VirtualDriveOptions& options, const LineFaults&) {
    return std::make_unique<StepVirtual>(options);
}

}  // namespace nplc::sim
