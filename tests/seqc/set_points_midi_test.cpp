// What compiles for a MIDI drive without a word holds for every pair of values of the declared ranges: the
// functions that the driver translates with (registers/midi_motor.h) refuse none.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <random>

#include "registers/midi_motor.h"
#include "seqc/seqc.h"
#include "support.h"

namespace nplc::seqc {
namespace {

namespace midi = registers::midi;

constexpr int kMidiPrograms = 400;
constexpr int kPairs = 60;

struct Range {
    int low;
    int value;
    int high;
};

std::string program(const Range& rpm, const Range& rpm_per_s, const char* motor) {
    const auto declared = [](const char* name, const char* reg, const Range& range, const char* unit) {
        return std::string("SET_POINT ") + name + " AT " + reg + " := " + std::to_string(range.value) + ' ' +
               unit + " RANGE " + std::to_string(range.low) + " .. " + std::to_string(range.high) + ' ' +
               unit + ";\n";
    };
    return std::string("PROGRAM P\nMOTOR ") + motor + ";\nVAR_MOTOR Place AT P1 := 5 rev; END_VAR\n" +
           declared("Fast", "V1", rpm, "rpm") + declared("Soft", "A1", rpm_per_s, "rpm/s") +
           "ON ERROR NEXT := Fault;\n"
           "STEP S: TAKES SET_POINTS; IF IN0 THEN INIT(Fast, Soft); NEXT := M; END_IF END_STEP\n"
           "STEP M: ENTRY POSITION(Place); IF INPOS THEN NEXT := S; END_IF END_STEP\n"
           "STEP Fault: OWN ERROR; IF ANY ERROR AND IN2 THEN RESET_ERROR; NEXT := POWER_UP; END_IF END_STEP\n"
           "END_PROGRAM\n";
}

struct Draw {
    explicit Draw(unsigned seed) : random(seed) {}
    int of(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }
    Range range(int low, int high) {
        std::array<int, 3> ends{of(low, high), of(low, high), of(low, high)};
        std::sort(ends.begin(), ends.end());
        return {ends[0], ends[1], ends[2]};
    }
    std::mt19937 random;
};

bool is_clean(const Compilation& compilation) {
    return compilation.ok && test::codes(compilation).find("W016") == std::string::npos;
}

void expect_every_pair(const Compilation& compilation, midi::Model model, Draw& draw,
                       const std::string& source) {
    const auto& points = compilation.symbols.set_points.values;
    ASSERT_EQ(points.size(), 2U);
    for (int i = 0; i < kPairs; ++i) {
        // Every third one as slow as the range has them.
        const int slow = std::clamp(draw.of(-3, 3), points[0].lowest, points[0].highest);
        const int v = i % 3 == 0 ? slow : draw.of(points[0].lowest, points[0].highest);
        const int a = draw.of(points[1].lowest, points[1].highest);
        const auto wrong = [&](midi::Limitation found) {
            return found != midi::Limitation::none
                       ? std::string(midi::text_of(found)) + " with " + std::to_string(v) + " and " +
                             std::to_string(a) + "\n" + source
                       : std::string();
        };
        EXPECT_EQ(wrong(midi::limitation_of_profile(model, static_cast<std::int16_t>(v),
                                                    static_cast<std::uint16_t>(a))),
                  "");
        EXPECT_EQ(wrong(midi::limitation_of_write(model, 65, false, static_cast<std::uint16_t>(v))), "");
        EXPECT_EQ(wrong(midi::limitation_of_write(model, 73, false, static_cast<std::uint16_t>(a))), "");
    }
}

void try_programs(const char* motor, midi::Model model, int fastest) {
    constexpr unsigned kSeed = 23;
    Draw draw(kSeed);
    int clean = 0;
    int refused = 0;
    for (int i = 0; i < kMidiPrograms && !testing::Test::HasFailure(); ++i) {
        const int widest = draw.of(1, fastest);
        const std::string source =
            program(draw.range(i % 4 == 0 ? -widest : 1, widest), draw.range(100, 60'000), motor);
        const Compilation compilation = compile(source);
        if (!is_clean(compilation)) {
            ++refused;
            continue;
        }
        ++clean;
        expect_every_pair(compilation, model, draw, source);
    }
    std::cout << motor << ", seed " << kSeed << ": " << clean << " programs with " << kPairs
              << " pairs each, " << refused << " refused\n";
    EXPECT_GT(clean, 20);
    EXPECT_GT(refused, 20);
}

TEST(MidiSetPoints, EveryPairOfACleanProgramIsWithinTheDrivesReach) {
    try_programs("MAC23", midi::Model::mac23, 3000);
    try_programs("MAC34", midi::Model::mac34_1, 4000);
}

/// With the default and both ends of each range.
bool any_constant_is_refused(const Range& rpm, const Range& rpm_per_s, const char* motor) {
    for (const int v : {rpm.low, rpm.value, rpm.high}) {
        for (const int a : {rpm_per_s.low, rpm_per_s.value, rpm_per_s.high}) {
            const std::string source =
                std::string("PROGRAM P\nMOTOR ") + motor +
                ";\nVAR_MOTOR Place AT P1 := 5 rev; Fast AT V1 := " + std::to_string(v) +
                " rpm; Soft AT A1 := " + std::to_string(a) +
                " rpm/s; END_VAR\nON ERROR NEXT := Fault;\n"
                "STEP S: IF IN0 THEN INIT(Fast, Soft); NEXT := M; END_IF END_STEP\n"
                "STEP M: ENTRY POSITION(Place); IF INPOS THEN NEXT := S; END_IF END_STEP\n"
                "STEP Fault: OWN ERROR; IF ANY ERROR AND IN2 THEN RESET_ERROR; NEXT := POWER_UP; END_IF "
                "END_STEP\nEND_PROGRAM\n";
            if (!compile(source).ok) return true;
        }
    }
    return false;
}

TEST(MidiSetPoints, AValueThatTheDriveCannotDoIsTheErrorThatAConstantGives) {
    Draw draw(7);
    int refused = 0;
    for (int i = 0; i < kMidiPrograms; ++i) {
        const Range v = draw.range(1, 2500);
        const Range a = draw.range(200, 40'000);
        const Compilation compilation = compile(program(v, a, "MAC34"));
        EXPECT_EQ(compilation.ok, !any_constant_is_refused(v, a, "MAC34")) << program(v, a, "MAC34");
        EXPECT_EQ(test::codes(compilation).find("W016"), std::string::npos) << program(v, a, "MAC34");
        refused += compilation.ok ? 0 : 1;
    }
    EXPECT_GT(refused, 20);
    EXPECT_LT(refused, kMidiPrograms - 20);
}

/// A speed that is not 0 and too slow for a period lies between ends that are fast enough.
TEST(MidiSetPoints, ARangeAboutNoSpeedIsRefused) {
    const Range soft{20'000, 20'000, 30'000};
    EXPECT_TRUE(is_clean(compile(program({100, 100, 500}, soft, "MAC34"))));
    const Compilation about_zero = compile(program({-500, 100, 500}, soft, "MAC34"));
    EXPECT_FALSE(about_zero.ok);
    EXPECT_NE(test::codes(about_zero).find("E044"), std::string::npos);
    EXPECT_TRUE(compile(program({-500, 100, 500}, soft, "MAC140")).ok);
}

}  // namespace
}  // namespace nplc::seqc
