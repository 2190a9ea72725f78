#include <random>

#include "midi_bench.h"

namespace nplc::sim {
namespace {

/// What a refused order must leave as it is.
struct Seen {
    MidiMemory memory;
    std::int32_t position;
    std::uint32_t status;
    bool moving;
    bool powered;
    int waiting;
    bool operator==(const Seen&) const = default;
};

Seen look(MidiBench& bench) {
    return {bench->memory(), bench->position(), bench->status(),
            bench->moving(), bench->powered(),  bench->waiting_segments()};
}

/// Half of the parameters are legal ones.
std::uint32_t parameters(std::mt19937& random, const midi::CommandRow& row) {
    const auto any = static_cast<std::uint32_t>(random());
    if (random() % 2 == 0) return any;
    const auto draw = [&random](const midi::Field& field) {
        if (field.bits == 0) return 0;
        const std::int64_t span = std::min<std::int64_t>(std::int64_t{field.max} - field.min, 20'000);
        return static_cast<std::int32_t>(
            std::max(field.min, -10'000) +
            static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(span + 1)));
    };
    return midi::pack(row, draw(row.fields[0]), draw(row.fields[1])).value_or(any);
}

void disturb(std::mt19937& random, MidiModule& module) {
    switch (random() % 12) {
        case 0:
            return module.set_input(static_cast<Input>(random() % 4), random() % 2 == 0);
        case 1:
            return module.set_supply(static_cast<std::int32_t>(random() % 110'000));
        case 2:
            return module.set_temperature(static_cast<std::int32_t>(random() % 100'000));
        case 3:
            return module.hold_shaft(random() % 2 == 0);
        case 4:
            return module.turn_shaft(static_cast<std::int32_t>(random() % 200) - 100);
        case 5:
            return random() % 2 == 0 ? module.power_off() : module.power_on();
        case 6:
            return module.restart();
        default:
            return module.set_supply(48'000);
    }
}

// Any orders in any world: what is refused changes nothing, what is forbidden while moving is refused,
// without power nothing begins to move, with a trip there is no power, and 18h stops everything unless
// braking is cut.
TEST(MidiRandom, TheRulesHoldWhateverHappens) {
    constexpr unsigned kSeed = 9;
    int accepted = 0;
    int refused = 0;
    for (unsigned seed = kSeed; seed < kSeed + 40; ++seed) {
        std::mt19937 random(seed);
        MidiBench bench(static_cast<midi::Model>(random() % 3));
        bool rests = true;
        for (int i = 0; i < 300; ++i) {
            if (random() % 3 == 0) disturb(random, *bench);
            const midi::CommandRow& row = midi::commands()[random() % midi::commands().size()];
            const std::uint32_t data = parameters(random, row);
            const Seen before = look(bench);
            const bool done = bench->execute(row.number, 0, data);
            (done ? accepted : refused) += 1;
            const auto where = ::testing::Message() << "seed " << seed << ", round " << i << ", " << row.name;
            if (!done) {
                ASSERT_EQ(look(bench), before) << where;
            } else {
                ASSERT_TRUE(row.while_moving || !before.moving) << where;
                ASSERT_TRUE(midi::is_legal(row, data)) << where;
            }
            ASSERT_TRUE((bench->status() & midi::kTrips) == 0 || !bench->powered()) << where;
            const std::int64_t at = bench->shaft();
            const bool still = !bench->powered() && rests;
            bench.pass(std::chrono::microseconds{random() % 20'000});
            ASSERT_TRUE(!still || bench->shaft() == at) << where;
            rests = bench->shaft() == at;
            ASSERT_LE(bench->torque(), 0x80) << where;
            ASSERT_TRUE(bench->powered() || !bench->moving()) << where;
        }
        bench->set_supply(36'000);
        bench.pass(std::chrono::seconds{1});
        bench.order(midi::EMERGENCY_STOP);
        const std::int32_t at = bench->position();
        bench.pass(std::chrono::seconds{1});
        ASSERT_EQ(bench->position(), at) << "seed " << seed;
    }
    EXPECT_GT(accepted, 1'000);
    EXPECT_GT(refused, 1'000);
}

}  // namespace
}  // namespace nplc::sim
