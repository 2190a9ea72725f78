// A virtual motor under whatever lines, registers and terminals can do to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "protocol/flexmac.h"
#include "protocol/mactalk.h"
#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

constexpr int kRuns = NPLC_MOTOR_RUNS;
constexpr int kActions = 120;

/// From any state the profile is at rest after 65,535 samples of STOP at A_SOLL = 1 (1/16 counts/sample^2,
/// the highest velocity being 65,535 / 16), and the shaft behind it, or coasting out of AT, soon after.
constexpr int kPassiveWithin = 65'535 + 8'000;

using Random = std::mt19937_64;

struct Ranges {
    int first, last;
};
/// Coefficients and calibration: the manual warns that wrong ones destroy the regulation (001 §3.2.106).
constexpr std::array<Ranges, 4> kSmallCoefficients{{{13, 13}, {81, 84}, {89, 111}, {124, 151}}};
constexpr std::array<Ranges, 4> kBigCoefficients{{{13, 13}, {81, 84}, {121, 157}, {172, 201}}};

bool is_coefficient(registers::Model model, int reg) {
    for (const auto& [first, last] : is_mac800(model) ? kBigCoefficients : kSmallCoefficients) {
        if (reg >= first && reg <= last) return true;
    }
    return false;
}

class Tormentor {
  public:
    Tormentor(registers::Model model, std::uint64_t seed, bool coefficients_too)
        : random_(seed), coefficients_too_(coefficients_too), motor_(model) {}

    void run() {
        for (int action = 0; action < kActions; ++action) {
            act();
            for (auto n = below(40); n > 0; --n) sample();
        }
    }

    /// A request of INIT, a calm world: how many samples until the motor is passive; kPassiveWithin: it is
    /// not.
    int until_passive() {
        calm();
        motor_.go_to_init();
        for (int i = 0; i < kPassiveWithin; ++i) {
            if (motor_.is_mode(MotorMode::init)) return i;
            sample();
        }
        return kPassiveWithin;
    }
    /// The same of the profile: FNC_OUT and the torque that AT asks for are 0.
    int until_profile_rests() {
        motor_.go_to_init();
        for (int i = 0; i < kPassiveWithin; ++i) {
            sample();
            if (fnc_out() == 0 && !motor_.is_mode(MotorMode::brake)) return i;
        }
        return kPassiveWithin;
    }
    bool stays_passive() {
        for (int i = 0; i < 50; ++i) {
            sample();
            if (!motor_.is_mode(MotorMode::init) || motor_.torque() != 0) return false;
        }
        return true;
    }
    MacMotor& motor() { return motor_; }

  private:
    std::uint64_t below(std::uint64_t n) { return random_() % n; }
    std::int32_t fnc_out() const { return motor_.read(is_mac800(motor_.model()) ? 166 : 117); }

    void sample() {
        motor_.sample();
        now_ += std::chrono::microseconds(2000);
        ASSERT_LT(motor_.mode(), 25);
        ASSERT_LE(std::abs(motor_.torque()), 1023);
    }

    /// Nothing pulls, the supply is there.
    void calm() {
        motor_.plant().load().torque = 0;
        motor_.supply().set_source(is_mac800(motor_.model()) ? 325 : 48);
        motor_.supply().settle();
        motor_.surroundings() = {};
    }

    std::int32_t value() {
        constexpr std::array<std::int32_t, 12> kEdges{
            0, 1, -1, 1023, 2047, 32767, 32768, 65'535, -32768, 0x7FFFFFFF, -0x7FFFFFFF, INT32_MIN};
        switch (below(4)) {
            case 0:
                return kEdges[below(kEdges.size())];
            case 1:
                return static_cast<std::int32_t>(below(4000)) - 2000;
            case 2:
                return static_cast<std::int32_t>(below(200'000)) - 100'000;
            default:
                return static_cast<std::int32_t>(static_cast<std::uint32_t>(random_()));
        }
    }

    void write_register() {
        const auto reg = static_cast<std::uint8_t>(1 + below(255));
        const bool longword = is_mac800(motor_.model()) || below(2) == 0;
        const int last = reg + (longword && !is_mac800(motor_.model()) ? 1 : 0);
        if (!coefficients_too_ &&
            (is_coefficient(motor_.model(), reg) || is_coefficient(motor_.model(), last))) {
            return;
        }
        motor_.write(reg, value(), longword);
    }

    /// Bytes of no meaning, or a FastMAC command, with pauses between them.
    void speak_over_the_link() {
        for (auto n = 1 + below(6); n > 0; --n) {
            now_ += std::chrono::microseconds(below(3) == 0 ? 2000 : 520);
            motor_.receive(static_cast<std::uint8_t>(random_()), below(20) == 0, now_);
            (void)motor_.transmit(now_);
        }
    }
    void switch_to_flexmac_and_speak() {
        for (int i = 0; i < 3; ++i) {
            now_ += std::chrono::microseconds(520);
            motor_.receive(below(2) == 0 ? 0x7F : 0xFF, false, now_);
        }
        const auto header = static_cast<std::uint8_t>(0x60 | below(16) | (below(2) << 7));
        for (int i = 0; i < 3; ++i) {
            now_ += std::chrono::microseconds(520);
            motor_.receive(header, false, now_);
        }
        for (auto n = below(5); n > 0; --n) {
            const auto byte = static_cast<std::uint8_t>(random_());
            for (const auto sent : {byte, static_cast<std::uint8_t>(~byte)}) {
                now_ += std::chrono::microseconds(520);
                motor_.receive(sent, false, now_);
            }
        }
    }
    void speak_mactalk() {
        using protocol::mactalk::Kind;
        constexpr std::array kKinds{Kind::read,      Kind::read_block, Kind::write,       Kind::read_samples,
                                    Kind::safe_mode, Kind::init_mode,  Kind::write_flash, Kind::reset};
        const Kind kind = kKinds[below(kKinds.size())];
        const auto reg = static_cast<std::uint8_t>(1 + below(255));
        if (kind == Kind::write && !coefficients_too_ &&
            (is_coefficient(motor_.model(), reg) || is_coefficient(motor_.model(), reg + 1))) {
            return;
        }
        const auto message = protocol::mactalk::encode({.kind = kind,
                                                        .address = 255,
                                                        .reg = reg,
                                                        .length = static_cast<std::uint8_t>(2 + 2 * below(2)),
                                                        .value = static_cast<std::uint32_t>(value())});
        for (const std::uint8_t byte : message.view()) motor_.receive_mactalk(byte, false);
        while (motor_.transmit_mactalk()) {
        }
    }
    void change_the_world() {
        switch (below(10)) {
            case 0:
                return motor_.terminals().set_analogue(static_cast<std::int32_t>(below(24'000)) - 12'000);
            case 1:
                return motor_.terminals().set_pulse_rate(static_cast<std::int32_t>(below(200'000)) - 100'000);
            case 2:
                motor_.plant().load().torque = static_cast<std::int32_t>(below(400)) - 200;
                return;
            case 3:
                motor_.plant().load().high_stop = MechanicalStop{motor_.plant().counts() + 5000};
                return;
            case 4:
                motor_.plant().load().high_stop.reset();
                return;
            case 5:
                return motor_.power_cycle();
            case 6:
                motor_.supply().set_source(static_cast<double>(below(600)));
                return motor_.supply().settle();
            case 7:
                motor_.surroundings().celsius = static_cast<std::int32_t>(below(120));
                motor_.surroundings().encoder_broken = below(4) == 0;
                return;
            case 8:
                return calm();
            default:
                return motor_.terminals().connect({.counts = 0, .on_above = below(2) == 0});
        }
    }
    void act() {
        switch (below(8)) {
            case 0:
            case 1:
                return write_register();
            case 2:
                return motor_.write(2, static_cast<std::int32_t>(below(27)));  // MODE_REG
            case 3:
                return speak_over_the_link();
            case 4:
                return coefficients_too_ ? switch_to_flexmac_and_speak() : speak_mactalk();
            case 5:
                return speak_mactalk();
            case 6:
                return change_the_world();
            default:
                motor_.write(35, 0);  // what an error holds up, goes on
                return motor_.write(2, static_cast<std::int32_t>(below(25)));
        }
    }

    Random random_;
    bool coefficients_too_;
    MacMotor motor_;
    base::Instant now_{};
};

class RandomMotor : public ::testing::TestWithParam<registers::Model> {};

TEST_P(RandomMotor, IsAlwaysPassiveAfterARequestOfInit) {
    int longest = 0;
    std::array<int, 25> asked{};  // from which modes
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Tormentor tormentor(GetParam(), seed, false);
        tormentor.run();
        if (HasFatalFailure()) return;
        ++asked[tormentor.motor().mode()];
        const int samples = tormentor.until_passive();
        ASSERT_LT(samples, kPassiveWithin)
            << "mode " << tormentor.motor().mode() << ", V_IST " << tormentor.motor().v_ist();
        ASSERT_TRUE(tormentor.stays_passive());
        longest = std::max(longest, samples);
    }
    const auto modes = std::count_if(asked.begin(), asked.end(), [](int times) { return times > 0; });
    std::printf("%d runs of %d actions, seeds 1 to %d, from %d modes: passive after %d samples at the most\n",
                kRuns, kActions, kRuns, static_cast<int>(modes), longest);
}

// With every register written, coefficients too: no shaft can be promised, but no crash, no undefined mode,
// and a profile that comes to rest.
TEST_P(RandomMotor, SurvivesEveryRegister) {
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Tormentor tormentor(GetParam(), 1'000'000 + seed, true);
        tormentor.run();
        if (HasFatalFailure()) return;
        ASSERT_LT(tormentor.until_profile_rests(), kPassiveWithin) << "mode " << tormentor.motor().mode();
    }
    std::printf("%d runs of %d actions, seeds 1000001 to %d\n", kRuns, kActions, 1'000'000 + kRuns);
}

INSTANTIATE_TEST_SUITE_P(Models, RandomMotor,
                         ::testing::Values(registers::Model::mac140, registers::Model::mac800));

}  // namespace
}  // namespace nplc::sim
