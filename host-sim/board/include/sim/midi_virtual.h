#pragma once

#include "sim/midi_drive.h"
#include "sim/virtual_drive.h"

namespace nplc::sim {

/// A virtual MIDI drive in a World.
class MidiVirtual final : public VirtualDrive {
  public:
    MidiVirtual(const MidiDriveOptions& options, const LineFaults& faults);

    MidiDrive& drive() { return drive_; }
    const MidiDrive& drive() const { return drive_; }

    motor::DriverPorts ports() override;
    void complete(motor::DriverSettings& settings) const override;
    std::string in_words() const override;
    std::string note(const motor::AnyDriver& driver) const override;
    const VirtualSerialLine* line() const override { return options_.can ? nullptr : &drive_.line(); }
    bool service(Time now) override { return drive_.service(now); }
    Time next_event(Time now) const override { return drive_.next_event(now); }
    Time sample_period() const override { return std::chrono::microseconds{1'920}; }
    void sample() override;
    void fill(Snapshot& snapshot) const override;
    void cut(bool cut) override { drive_.cut(cut); }
    bool is_cut() const override { return drive_.is_cut(); }
    bool is_blocked() const override { return drive_.module().shaft_is_blocked(); }
    void spoil(const action::SpoilLine& faults) override;
    void reseed(std::uint64_t seed) override { drive_.line().reseed(seed); }
    void power(bool on) override { drive_.power(on); }
    bool fail() override;
    void store(const StoredRegister& parameter) override;
    std::string without_effect(const Action& action) const override;
    std::string_view act(const action::OnMotor& what) override;

  private:
    MidiDriveOptions options_;
    MidiDrive drive_;
    std::int64_t shaft() const;

    std::int64_t before_ = 0;
    std::int32_t speed_ = 0;
};

}  // namespace nplc::sim
