// A stop for a motor from which nothing is heard, on the virtual motor in each state that it can be in.
#include "motor/jvl_blind_stop.h"

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

constexpr int kUseFastMac = 0x1E;
constexpr int kUseFlexMac = 0x1F;

struct LinkState {
    bool flexmac;
    bool safe;
    bool toggle;
};

/// Safe communication by 0Bh (001 §5.2.1.4), then NOPs, then 1Fh as the state wants them.
void bring_into(MotorBench& b, const LinkState& state) {
    const int copies = state.safe ? 2 : 1;
    if (state.safe) b.send({0xEB});
    const auto command = [&](int number) {
        const int byte = 0x60 | number | (b.motor.link().toggle() ? 0 : 0x80);
        for (int i = 0; i < copies; ++i) b.send({byte});
    };
    const bool switches = b.motor.link().toggle() != (state.toggle != state.flexmac);
    if (switches) command(0);
    if (state.flexmac) command(kUseFlexMac);
    ASSERT_EQ(b.motor.link().safe_communication(), state.safe);
    ASSERT_EQ(b.motor.link().flexmac(), state.flexmac);
    ASSERT_EQ(b.motor.link().toggle(), state.toggle);
}

void send_blind_stop(MotorBench& b, bool longword) {
    motor::BlindStop stop;
    for (;;) {
        b.pause(3);
        const auto part = stop.take_part(longword, {});
        if (part.size == 0) return;
        for (const std::uint8_t byte : part.view()) b.send({byte});
    }
}

class BlindStopOn : public testing::TestWithParam<registers::Model> {
  protected:
    static bool is_harmless(const Order& order) {
        if (order.flexmac) return order.reg == MODE_REG && order.message.value == 0;
        const int number = order.command & 0x1F;
        return (order.command & 0x60) == 0x60 && (number == kUseFastMac || number == kUseFlexMac);
    }
};

TEST_P(BlindStopOn, EndsInModeZeroAndChangesNothingElse) {
    for (int bits = 0; bits < 8; ++bits) {
        const LinkState state{(bits & 4) != 0, (bits & 2) != 0, (bits & 1) != 0};
        SCOPED_TRACE(testing::Message() << "FlexMAC " << state.flexmac << ", safe " << state.safe
                                        << ", toggle " << state.toggle);
        MotorBench b(GetParam());
        b.set(MODE_REG, 1);
        bring_into(b, state);
        const std::size_t before = b.motor.orders().size();
        send_blind_stop(b, GetParam() == registers::Model::mac800);
        EXPECT_EQ(b.reg(MODE_REG), 0);
        EXPECT_FALSE(b.motor.link().flexmac()) << "back where the driver looks for it";
        const auto& orders = b.motor.orders();
        ASSERT_GT(orders.size(), before);
        for (std::size_t i = before; i < orders.size(); ++i)
            EXPECT_TRUE(is_harmless(orders[i])) << "order " << i << ", command " << int{orders[i].command}
                                                << ", register " << int{orders[i].reg};
    }
}

INSTANTIATE_TEST_SUITE_P(Motors, BlindStopOn,
                         testing::Values(registers::Model::mac140, registers::Model::mac800),
                         [](const auto& model) {
                             return model.param == registers::Model::mac140 ? "Mac140" : "Mac800";
                         });

TEST(BlindStop, IsRepeatedEvery50msForASecondThenEvery500ms) {
    motor::BlindStop stop;
    const base::Instant begun{base::Milliseconds(1000)};
    EXPECT_FALSE(stop.is_due(begun)) << "the link was not lost yet";
    stop.allow(begun);
    base::Instant now = begun;
    for (int i = 0; i < 23; ++i) {
        ASSERT_TRUE(stop.is_due(now));
        while (stop.take_part(false, now).size != 0) EXPECT_TRUE(stop.is_under_way());
        const base::Microseconds pause = stop.due() - now;
        EXPECT_EQ(pause, i < 20 ? base::Milliseconds(50) : base::Milliseconds(500)) << i;
        EXPECT_FALSE(stop.is_due(stop.due() - base::Microseconds(1)));
        now = stop.due();
    }
    stop.begin_anew();
    while (stop.take_part(false, now).size != 0) {
    }
    EXPECT_EQ(stop.due() - now, base::Milliseconds(50)) << "another stop was asked for";
}

}  // namespace
}  // namespace nplc::sim
