#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

constexpr int kSamples = 3000;

/// A life at random from `seed`: modes, moves, loads, coefficients, supply.
class Life {
  public:
    Life(registers::Model model, Servo::Depth depth, unsigned seed)
        : random_(seed), motor_(model, {.order_limit = 1, .depth = depth}) {}

    void sample() {
        if (between(0, 40) == 0) change();
        motor_.sample();
    }
    const MacMotor& motor() const { return motor_; }

  private:
    int between(int low, int high) {
        return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
    }
    void set(int reg, std::int32_t value) { motor_.write(static_cast<std::uint8_t>(reg), value); }
    void change() {
        switch (between(0, 7)) {
            case 0:
                return set(MODE_REG, between(0, 24));
            case 1:
                return set(V_SOLL, between(-5000, 5000));
            case 2:
                return set(A_SOLL, between(1, 600));
            case 3:
                return set(T_SOLL, between(100, 1023));
            case 4:
                motor_.plant().load().inertia_256 = between(256, 2000);
                return;
            case 5:
                return set(is_mac800(motor_.model()) ? 127 : 93, between(50, 1500));  // KVFX of the newest
            case 6:
                return motor_.supply().set_source(between(20, 60) * (is_mac800(motor_.model()) ? 7 : 1));
            default:
                set(MODE_REG, 2);
                return set(P_SOLL, between(-30'000, 30'000));
        }
    }

    std::mt19937 random_;
    MacMotor motor_;
};

class AlternateMotors : public testing::TestWithParam<Servo::Depth> {};

// Motors are independent: two of each family stepped in turn behave as each does alone.
TEST_P(AlternateMotors, EqualMotorsAlone) {
    const auto life = [&](std::size_t n) {
        const auto model = n % 2 == 0 ? registers::Model::mac140 : registers::Model::mac800;
        return std::make_unique<Life>(model, GetParam(), static_cast<unsigned>(n) + 1);
    };
    std::vector<std::unique_ptr<Life>> together;
    for (std::size_t n = 0; n < 4; ++n) together.push_back(life(n));
    std::vector<std::vector<std::array<std::int32_t, 3>>> seen(together.size());
    for (int i = 0; i < kSamples; ++i) {
        for (std::size_t n = 0; n < together.size(); ++n) {
            together[n]->sample();
            const MacMotor& motor = together[n]->motor();
            seen[n].push_back({motor.p_ist(), motor.v_ist(), motor.torque()});
        }
    }
    for (std::size_t n = 0; n < together.size(); ++n) {
        SCOPED_TRACE("seed " + std::to_string(n + 1));
        const auto alone = life(n);
        for (const auto& [p_ist, v_ist, torque] : seen[n]) {
            alone->sample();
            ASSERT_EQ(alone->motor().p_ist(), p_ist);
            ASSERT_EQ(alone->motor().v_ist(), v_ist);
            ASSERT_EQ(alone->motor().torque(), torque);
        }
        for (int reg = 1; reg < 210; ++reg) {
            ASSERT_EQ(alone->motor().read(static_cast<std::uint8_t>(reg)),
                      together[n]->motor().read(static_cast<std::uint8_t>(reg)))
                << reg;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(BothDepths, AlternateMotors,
                         testing::Values(Servo::Depth::current_loop, Servo::Depth::outer_loop));

}  // namespace
}  // namespace nplc::sim
