#include "midi_bench.h"

namespace nplc::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Temperature and supply as GET_MEASURES reports them.
std::uint32_t temperature(MidiBench& bench) {
    return bench.ask(midi::GET_MEASURES) >> 24;
}
std::uint32_t supply(MidiBench& bench) {
    return bench.ask(midi::GET_MEASURES) >> 16 & 0xFF;
}

// 000 §VI 27h: 2.5 m - 215, 2.45 m - 140; m / 4.8, 0.4 m, 0.8 m.
TEST(MidiWorld, ReadingsByModel) {
    struct Reading {
        midi::Model model;
        std::uint32_t at_35_degrees;
        std::int32_t millivolts;
        std::uint32_t volts;
    };
    for (const auto& [model, degrees, millivolts, volts] :
         {Reading{midi::Model::mac23, 100, 24'000, 115}, Reading{midi::Model::mac34_1, 71, 48'000, 120},
          Reading{midi::Model::mac34_2, 71, 120'000, 150}}) {
        MidiBench bench(model);
        bench->set_temperature(35'000);
        bench->set_supply(millivolts);
        EXPECT_EQ(temperature(bench), degrees);
        EXPECT_EQ(supply(bench), volts);
        EXPECT_EQ(bench.ask(midi::GET_STATUS), 0U);
        EXPECT_TRUE(bench->leds().supply_good);
    }
}

// 003 §IV, §VII 01h: 85 and 21 V on MAC34-1, 170 and 42 V on MAC34-2; kept in bit 7 of the last byte.
TEST(MidiWorld, SupplyWarnings) {
    for (const auto& [model, high, low] : {std::tuple{midi::Model::mac34_1, 85'000, 21'000},
                                           std::tuple{midi::Model::mac34_2, 170'000, 42'000}}) {
        MidiBench bench(model);
        bench->set_supply(low + 1);
        EXPECT_EQ(bench.ask(midi::GET_STATUS), 0U);
        bench->set_supply(low);
        EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kUnderVoltage);
        bench->set_supply(high - 1);
        EXPECT_EQ(bench.ask(midi::GET_STATUS), 0U);
        bench->set_supply(high);
        EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kOverVoltage | midi::kOverVoltageKept);
        bench->set_supply(60'000);
        EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kOverVoltageKept);
        EXPECT_FALSE(bench->fault());
        bench.restart();
        EXPECT_EQ(bench.ask(midi::GET_STATUS), 0U);
        MidiBench older(model, {.release = 0x0703});  // before 7.4
        older->set_supply(high);
        EXPECT_EQ(older.ask(midi::GET_STATUS), midi::kOverVoltage);
    }
}

struct Trip {
    void (*cause)(MidiModule&, bool);
    std::uint32_t bit;
};

const Trip kTrips[] = {
    {[](MidiModule& m, bool on) { m.set_temperature(on ? 95'001 : 95'000); }, midi::kThermalTrip},
    {[](MidiModule& m, bool on) { m.connect_encoder(!on); }, midi::kEncoderTrip},
    {[](MidiModule& m, bool on) { m.set_supply(on ? 18'999 : 48'000); }, midi::kSupplyTrip},
    {[](MidiModule& m, bool on) { m.set_supply(on ? 100'001 : 48'000); },
     midi::kAmplifierTrip},  // 125 % of 80 V
};

// 003 §IV, §VII 01h: power off, motion refused, until 00h or power-off after the cause is gone.
TEST(MidiWorld, TripsHoldUntilTheyAreAcknowledged) {
    for (const Trip& trip : kTrips) {
        MidiBench bench;
        ASSERT_TRUE(bench.order(midi::GO_TO, 100'000));
        bench.pass(milliseconds{300});
        trip.cause(*bench, true);
        EXPECT_EQ(bench.ask(midi::GET_STATUS) & midi::kTrips, trip.bit);
        EXPECT_FALSE(bench->moving());
        EXPECT_FALSE(bench->powered());
        EXPECT_TRUE(bench->fault());
        EXPECT_TRUE(bench->leds().fault);
        trip.cause(*bench, false);
        EXPECT_EQ(bench.ask(midi::GET_STATUS) & midi::kTrips, trip.bit);
        for (const auto number : {midi::GO_TO, midi::GO_TO_ZERO, midi::POWER_ON, midi::SYNC})
            EXPECT_FALSE(bench.order(number)) << int{number};
        EXPECT_FALSE(bench.order(midi::RUN, 0, 480));
        EXPECT_FALSE(bench.order(midi::SEGMENT, 10, 480));
        EXPECT_FALSE(bench.order(midi::PAUSE, 10, 480));
        EXPECT_TRUE(bench.order(midi::EMERGENCY_STOP));
        EXPECT_TRUE(bench.order(midi::RAMP, 5));  // a parameter
        bench.restart();
        EXPECT_FALSE(bench->fault());
        EXPECT_TRUE(bench.order(midi::GO_TO, 100'000));
        // Acknowledged while the cause is there, it trips again.
        trip.cause(*bench, true);
        bench.restart();
        EXPECT_EQ(bench.ask(midi::GET_STATUS) & midi::kTrips, trip.bit);
    }
}

TEST(MidiWorld, AMac23HasOneBitForMost) {
    MidiBench bench(midi::Model::mac23);
    bench->set_temperature(95'001);
    EXPECT_EQ(bench.ask(midi::GET_STATUS) & midi::kTrips, midi::kThermalTrip23);
    bench->set_temperature(20'000);
    bench.restart();
    bench->overload_amplifier();
    EXPECT_EQ(bench.ask(midi::GET_STATUS) & midi::kTrips, midi::kThermalTrip23);
}

// 003 §II.1: above 115 % braking is cut; §VII 01h: the warning stays. 80 V x 115 % = 92 V.
TEST(MidiWorld, BrakingIsCutAboveTheLimit) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::RUN, 0, 480));
    bench.pass(seconds{1});
    bench->set_supply(92'001);
    EXPECT_TRUE(bench->leds().ballast);
    const std::int32_t at = bench->position();
    EXPECT_TRUE(bench.order(midi::EMERGENCY_STOP));
    bench.pass(milliseconds{60});
    EXPECT_EQ(bench->position(), at + 1'000);  // 480 ticks each
    EXPECT_TRUE(bench->moving());
    bench->set_supply(92'000);
    bench.pass(milliseconds{1});
    EXPECT_FALSE(bench->moving());
    EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kOverVoltage | midi::kOverVoltageKept);
}

// Braking itself lifts the supply from 80 to 93 V: it is cut and taken up again, and what is too far is made
// up.
TEST(MidiWorld, ABrakingAxisLiftsTheSupply) {
    MidiBench bench;
    bench->set_supply(80'000);
    bench->set_regeneration(13'000);
    ASSERT_TRUE(bench.order(midi::GO_TO, 10'000));
    std::int32_t farthest = 0;
    for (int i = 0; i < 60'000 && bench->moving(); ++i) {
        bench.pass(milliseconds{1});
        farthest = std::max(farthest, bench->position());
    }
    EXPECT_GT(farthest, 10'000);
    EXPECT_EQ(bench->position(), 10'000);
    EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kOverVoltageKept);
    bench->set_regeneration(21'000);  // 101 V: over 125 %
    ASSERT_TRUE(bench.order(midi::GO_TO, 0));
    bench.pass(seconds{2});
    EXPECT_EQ(bench.ask(midi::GET_STATUS) & midi::kTrips, midi::kAmplifierTrip);
}

// 003 §IV: it resets the module and nothing is heard; R: the release is a start.
TEST(MidiWorld, TheSecurityInputHoldsItInReset) {
    MidiBench bench;
    ASSERT_TRUE(bench->take_boot());
    ASSERT_TRUE(bench.order(midi::GO_TO, 10'000));
    bench.pass(milliseconds{300});
    bench->set_input(Input::security, true);
    EXPECT_FALSE(bench->moving());
    EXPECT_FALSE(bench->powered());
    bench.pass(seconds{5});
    EXPECT_TRUE(bench->deaf());
    bench->set_input(Input::security, false);
    EXPECT_TRUE(bench->deaf());
    EXPECT_FALSE(bench->take_boot());
    bench.pass(seconds{2});
    EXPECT_FALSE(bench->deaf());
    EXPECT_TRUE(bench->take_boot());
    EXPECT_FALSE(bench->take_boot());
}

// 000 §VI 00h, 01h: two seconds.
TEST(MidiMemory, ParametersAndPositionSurvivePowerOff) {
    MidiBench bench;
    const std::pair<midi::Command, std::int32_t> kept[] = {
        {midi::STOP_TORQUE, 0}, {midi::END_STOPS, 9}, {midi::UPPER_STOP, 50'000}, {midi::LOWER_STOP, -50'000},
        {midi::TORQUE, 0x33},   {midi::SPEED, 1'000}, {midi::UNSTALL, 7},         {midi::RAMP, 9},
        {midi::TOLERANCE, 4},   {midi::REFERENCE, 1}};
    for (const auto& [number, value] : kept) ASSERT_TRUE(bench.order(number, value)) << int{number};
    ASSERT_TRUE(bench.order(midi::GO_TO, 12'345));
    bench.run_out();
    bench->power_off();
    EXPECT_TRUE(bench->deaf());
    bench.pass(seconds{60});
    bench->power_on();
    EXPECT_TRUE(bench->deaf());
    bench.pass(seconds{2});
    EXPECT_FALSE(bench->deaf());
    EXPECT_EQ(bench.ask(midi::GET_POSITION), 12'345U);
    EXPECT_EQ(bench.ask(midi::GET_UPPER_STOP), 50'000U);
    EXPECT_EQ(bench.ask(midi::GET_SETTINGS), 0x09330904U);
    EXPECT_EQ(bench.ask(midi::GET_SPEEDS), 0x070003E8U);
    // The reference input is not allowed after a start (000 §VI 07h).
    bench->set_input(Input::reference, true);
    ASSERT_TRUE(bench.order(midi::RUN, 0, 480));
    bench.pass(milliseconds{500});
    bench->set_input(Input::reference, false);
    EXPECT_GT(bench->position(), 12'345);
    // In mid-move too the place is kept.
    const std::int32_t at = bench->position();
    bench->power_off();
    bench->power_on();
    EXPECT_EQ(bench->position(), at);
}

TEST(MidiMemory, FactorySettings) {
    for (const bool can : {false, true}) {
        MidiBench bench(midi::Model::mac34_1, {.can = can, .address = 5});
        ASSERT_TRUE(bench.order(midi::TOLERANCE, 4));
        ASSERT_TRUE(bench.order(midi::FACTORY));
        EXPECT_TRUE(bench->wants_restart());
        EXPECT_EQ(bench->memory().address, 5);
        bench.restart();
        EXPECT_EQ(bench->memory().address, can ? 1 : 0);
        EXPECT_EQ(bench->memory().tolerance, 0);
        EXPECT_EQ(bench->baud(), 38'400U);
    }
}

TEST(MidiMemory, TheEepromIsReadOverV24) {
    MidiBench bench(midi::Model::mac34_1, {.address = 5});
    EXPECT_EQ(bench.ask(midi::GET_EEPROM, 0) >> 16, 0x0503U);
    EXPECT_EQ(bench.ask(midi::GET_EEPROM, 0xFE), 0xFFFF0503U);
    MidiBench on_can(midi::Model::mac34_1, {.can = true, .address = 5});
    EXPECT_FALSE(on_can->answer(midi::GET_EEPROM, 0));
    EXPECT_FALSE(on_can->execute(midi::ADDRESS, 0, 1));
    EXPECT_FALSE(on_can->execute(midi::BAUD, 0, 1));
}

// 003 §IV: 50 marks a revolution.
TEST(MidiWorld, TopZero) {
    MidiBench bench;
    int marks = 0;
    for (int i = 0; i < 10'000; ++i) {
        if (bench->leds().top_zero) ++marks;
        bench->turn_shaft(1);
    }
    EXPECT_EQ(marks, 50);
}

}  // namespace
}  // namespace nplc::sim
