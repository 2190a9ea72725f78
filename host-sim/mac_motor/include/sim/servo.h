#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/inner_loop.h"
#include "sim/mode_table.h"
#include "sim/motor_inputs.h"
#include "sim/motor_memory.h"
#include "sim/plant.h"
#include "sim/regulator.h"

namespace nplc::sim {

/// Observer of the registers after each sample of the inner loop.
class InnerWatcher {
  public:
    virtual void inner_sample() = 0;

  protected:
    ~InnerWatcher() = default;
};

/// The stages below the profile: regulators, windings, supply and shaft. A sample of the outer loop is
/// `advance`, then the mode determines its Drive, then `carry_out`.
class Servo {
  public:
    enum class Depth : std::uint8_t {
        current_loop,  ///< every sample of the inner loop
        outer_loop,    ///< torque as requested, within the supply's limit; no current registers
    };
    struct Result {
        std::int32_t torque = 0;      ///< VF_OUT
        std::int32_t correction = 0;  ///< wanted minus actual FNC_OUT (001 §4.2.1)
    };
    static constexpr int kTestSamples = 11;  ///< of the inner loop that a Drive `voltage` lasts (001 §4.4.9)

    Servo(registers::Model model, Depth depth, const Load& load);

    /// One outer sample with the last request. Returns the encoder counts of that sample (V_IST). `watcher`,
    /// if any, is called in every inner sample after currents are measured and voltages set.
    [[gnu::flatten]] std::int32_t advance(MotorMemory& memory, const Terminals& terminals,
                                          InnerWatcher* watcher = nullptr);
    /// The request for the next sample. Writes VF_OUT, FF_OUT, VB_OUT. The speed regulator is reset unless
    /// the Drive is `velocity`.
    [[gnu::flatten]] Result carry_out(const Drive& drive, MotorMemory& memory);

    /// An outer sample without supply: the shaft coasts. Returns its counts.
    std::int32_t coast();

    /// As after power-up: windings shorted, IA_OFFSET ... determined. The shaft does not move.
    void power_up(MotorMemory& memory);
    /// Profile and shaft have the same position and run at `velocity`, 1/16 counts/sample, in the next
    /// sample.
    void restart(std::int32_t velocity) { regulator_.restart(velocity); }

    std::int32_t torque() const { return torque_; }  ///< VF_OUT
    const Drive& drive() const { return drive_; }
    /// Lag of the shaft behind the profile, without corrections, 1/16 counts.
    std::int64_t lag_16() const { return regulator_.lag_16(); }
    /// Encoder counts since construction, as read in the last sample.
    std::int64_t counts() const { return last_counts_; }
    /// A phase current was at the end of its measuring range in the last sample (001 §3.2.35, IX_ERR).
    bool current_at_the_end() const { return inner_.regulator().at_the_end(); }
    /// Samples of the inner loop since a Drive `voltage` began, kTestSamples at the most.
    int test_samples() const { return test_samples_; }

    /// The speed regulator's filters can drive the motor.
    bool filters_answer() const { return regulator_.answers(); }
    /// A broken encoder counts nothing: V_IST is 0, whatever the shaft does. R: commutation has its own
    /// sensor.
    void break_encoder(bool broken) { encoder_broken_ = broken; }

    Plant& plant() { return plant_; }
    const Plant& plant() const { return plant_; }
    /// The supply voltage can be changed at any time; the registers follow.
    Supply& supply() { return supply_; }
    const Supply& supply() const { return supply_; }

  private:
    [[gnu::noinline]] void use_settings(const MotorMemory& memory);
    [[gnu::flatten, gnu::noinline]] void run_inner(MotorMemory& memory, const Terminals& terminals,
                                                   InnerWatcher* watcher);
    [[gnu::cold]] void show_inner_sample(MotorMemory& memory, InnerWatcher& watcher) const;
    [[gnu::noinline]] void set_voltages(const MotorMemory& memory, const Terminals& terminals,
                                        std::int32_t acting);
    Regulator::Input regulator_input(const Drive& drive) const;
    std::int32_t unregulated_torque(const Drive& drive, const MotorMemory& memory);
    void run_outer(const MotorMemory& memory, const Terminals& terminals);
    std::int32_t asked(std::int32_t samples_ago) const {
        return asked_[(asked_next_ + asked_.size() - 1 - static_cast<std::size_t>(samples_ago)) %
                      asked_.size()];
    }
    double acting_torque() const;
    std::int32_t analogue_torque(const MotorMemory& memory, const Terminals& terminals) const;
    void follow_offsets(MotorMemory& memory) const;
    void show_currents(MotorMemory& memory) const;
    void warm(double squares, double regenerated);
    void show_supply(MotorMemory& memory) const;
    void take_sums(const MotorMemory& memory);
    void show_sums(MotorMemory& memory);

    const MotorConstants& constants_;
    Depth depth_;
    Plant plant_;
    Supply supply_;
    Regulator regulator_;
    InnerLoop inner_;
    QuickLoop quick_;        // outer_loop only
    double heat_of_square_;  // final I2T per sum of squared currents
    double dumped_of_watt_;  // final UIT per watt in the dump
    double copper_share_;    // I2T's step towards its final value, per sample
    double dump_share_;      // and UIT's
    Drive drive_;
    std::int32_t man_i_nom_ = 0;
    std::int32_t man_alpha_ = 0;
    std::int32_t umeas_ = 0;
    int test_samples_ = 0;
    std::int32_t torque_ = 0;
    std::array<std::int32_t, Load::kLatest / kInnerSamples + 2> asked_{};  // torque_ of the last samples
    std::size_t asked_next_ = 0;
    std::int32_t late_ = 0;  // delay of torque_ in inner samples
    double i2t_ = 0;
    double uit_ = 0;
    std::int32_t i2t_shown_ = 0;
    std::int32_t uit_shown_ = 0;
    std::int64_t last_counts_ = 0;
    std::int32_t v_ist_ = 0;
    double kvout_ = 0;  // KVOUT
    bool encoder_broken_ = false;
};

}  // namespace nplc::sim
