#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "seqc/decompile.h"
#include "seqc/symbol_file.h"
#include "sequencer/term.h"
#include "set_points/values.h"
#include "support.h"

namespace nplc::seqc {
namespace {

using set_points::SetPoint;
using set_points::ValueKind;

std::string machine(const std::string& declarations, const std::string& steps, const char* motor = "MAC140") {
    return std::string("PROGRAM P\nMOTOR ") + motor + ";\nSCALE 1 rev = 5 mm;\n" + declarations +
           "ON ERROR NEXT := Fault;\n" + steps +
           "STEP Fault: OWN ERROR; IF ANY ERROR AND IN2 THEN RESET_ERROR; NEXT := POWER_UP; END_IF END_STEP\n"
           "END_PROGRAM\n";
}

Compilation good(const std::string& source) {
    Compilation compilation = compile(source);
    EXPECT_TRUE(compilation.ok) << render_all(compilation, source, "P.seq");
    return compilation;
}

Decompilation decompiled(const Compilation& compilation) {
    DecompileOptions options;
    options.symbols = &compilation.symbols;
    return decompile(compilation.table, options);
}

sequencer::Term term_of(const Compilation& compilation, std::size_t index) {
    return sequencer::decode(std::span(compilation.table).subspan(std::size_t{8} * index).first<8>());
}

const SetPoint& point(const Compilation& compilation, const char* name) {
    return *set_points::find(compilation.symbols.set_points, name);
}

const std::string kSaw = machine(
    "SET_POINT Length AT P2 := 80 mm RANGE 10 .. 200 mm STEP 0.1 mm;\n"
    "SET_POINT Dwell := 500 ms RANGE 100 ms .. 5 s;\nSET_POINT Parts := 12 RANGE 1..999;\n",
    "STEP S: TAKES SET_POINTS; IF IN0 THEN COUNTER := Parts; INIT(V1); NEXT := M; END_IF END_STEP\n"
    "STEP M: ENTRY POSITION(Length); IF INPOS THEN TIMER := Dwell; NEXT := W; END_IF END_STEP\n"
    "STEP W: IF TIMER.Q THEN NEXT := S; END_IF END_STEP\n");

// 80 mm are 16 revolutions of 4096 counts: 65536; 10 mm 8192, 200 mm 163840.
TEST(SetPoints, LieWhereTheRecordSays) {
    const Compilation compilation = good(kSaw);
    const SetPoint& length = point(compilation, "length");
    EXPECT_EQ(length.kind, ValueKind::motor_register);
    EXPECT_EQ(length.reg, 51);
    EXPECT_EQ(length.initial, 65536);
    EXPECT_EQ(length.lowest, 8192);
    EXPECT_EQ(length.highest, 163840);
    EXPECT_TRUE(length.at_power_up && length.longword);
    ASSERT_EQ(length.places.size(), 2U);  // POWER_UP with and without ERROR
    for (const std::uint16_t place : length.places) {
        const sequencer::Term term = term_of(compilation, place);
        EXPECT_EQ(term.condition.step, 0);
        EXPECT_TRUE(term.is_flex && term.flex.reg == 51 && term.flex.high_word == 1 &&
                    term.flex.low_word == 0);
    }
    ASSERT_EQ(point(compilation, "Dwell").places.size(), 1U);
    EXPECT_EQ(term_of(compilation, point(compilation, "Dwell").places[0]).fast.preset, 500);
    ASSERT_EQ(point(compilation, "Parts").places.size(), 1U);
    EXPECT_TRUE(term_of(compilation, point(compilation, "Parts").places[0]).fast.presets_counter);
    EXPECT_EQ(compilation.symbols.set_points.takes, 3U);  // POWER_UP and S, which is step 1
}

/// The same program with the defaults as constants has the same bytes where nothing could be shared.
TEST(SetPoints, TheTableHasTheDefaults) {
    std::string constants = kSaw;
    const auto replace = [&](const std::string& what, const std::string& by) {
        const std::size_t at = constants.find(what);
        ASSERT_NE(at, std::string::npos);
        constants.replace(at, what.size(), by);
    };
    replace("SET_POINT Length AT P2 := 80 mm RANGE 10 .. 200 mm STEP 0.1 mm;",
            "VAR_MOTOR Length AT P2 := 80 mm; END_VAR");
    replace("SET_POINT Dwell := 500 ms RANGE 100 ms .. 5 s;", "");
    replace("SET_POINT Parts := 12 RANGE 1..999;", "");
    replace("TAKES SET_POINTS;", "");
    replace(":= Parts", ":= 12");
    replace(":= Dwell", ":= T#500ms");
    EXPECT_EQ(good(kSaw).table, good(constants).table);
}

/// Two branches that differ only in whose value they preset would be one with constants.
TEST(SetPoints, TermsOfDifferentOnesAreNeverShared) {
    const char* steps =
        "STEP S: IF IN0 THEN TIMER := A; NEXT := T; ELSIF IN1 THEN TIMER := B; NEXT := T; "
        "ELSIF IN3 THEN TIMER := T#500ms; NEXT := T; END_IF END_STEP\n"
        "STEP T: IF TIMER.Q THEN NEXT := S; END_IF END_STEP\n";
    const Compilation compilation = good(machine(
        "SET_POINT A := 500 ms RANGE 1 ms .. 1 s;\nSET_POINT B := 500 ms RANGE 1 ms .. 1 s;\n", steps));
    const auto places_a = point(compilation, "A").places;
    const auto places_b = point(compilation, "B").places;
    ASSERT_FALSE(places_a.empty() || places_b.empty());
    std::size_t presets = 0;
    for (std::size_t i = 0; i + 1 < compilation.table.size() / 8; ++i) {
        const sequencer::Term term = term_of(compilation, i);
        presets += !term.is_flex && term.fast.preset == 500 ? 1 : 0;
    }
    for (const std::uint16_t place : places_a)
        EXPECT_EQ(std::count(places_b.begin(), places_b.end(), place), 0);
    EXPECT_GT(presets, places_a.size() + places_b.size());  // the constant's own
}

TEST(SetPoints, ComeBackFromTheSymbolFileAndTheRecord) {
    const Compilation compilation = good(kSaw);
    const SymbolReading read = read_symbols(write_symbols(compilation, kSaw, "P.seq"), compilation.table);
    EXPECT_EQ(read.error, "");
    EXPECT_EQ(read.file.symbols.set_points, compilation.symbols.set_points);
    const auto bytes = set_points::encode(compilation.symbols.set_points);
    const auto decoded = set_points::decode(bytes, compilation.table);
    ASSERT_TRUE(decoded);
    ASSERT_EQ(decoded->values.size(), 3U);
    EXPECT_EQ(decoded->values[0].name, "Length");
    EXPECT_EQ(decoded->values[0].places, point(compilation, "Length").places);
    EXPECT_EQ(set_points::range_text(decoded->values[0]), "10 mm to 200 mm in steps of 0.1 mm");
    EXPECT_EQ(decoded->takes, 3U);
}

/// Any byte of a record that is changed leaves one that is refused, or one within its table.
TEST(SetPoints, ARecordOfAnotherTableIsRefused) {
    const Compilation compilation = good(kSaw);
    const auto bytes = set_points::encode(compilation.symbols.set_points);
    std::vector<std::uint8_t> other = compilation.table;
    other[std::size_t{8} * point(compilation, "Dwell").places[0] + 6] ^= 1;
    EXPECT_FALSE(set_points::decode(bytes, other));
    for (std::size_t length = 0; length < bytes.size(); ++length)
        EXPECT_FALSE(set_points::decode(std::span(bytes).first(length), compilation.table));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            std::vector<std::uint8_t> damaged = bytes;
            damaged[i] ^= static_cast<std::uint8_t>(1 << bit);
            const auto read = set_points::decode(damaged, compilation.table);
            if (!read) continue;
            for (const SetPoint& one : read->values) {
                EXPECT_TRUE(one.lowest <= one.initial && one.initial <= one.highest);
                for (const std::uint16_t place : one.places)
                    EXPECT_LT(std::size_t{8} * place, compilation.table.size());
            }
        }
    }
}

/// A constant that is equal to a default: the bytes do not tell which is which.
TEST(SetPoints, ThatCannotBeWrittenAgainAreNamedWithTheirRanges) {
    const Compilation compilation =
        good(machine("SET_POINT Dwell := 500 ms RANGE 100 ms .. 5 s STEP 100 ms;\n",
                     "STEP S: TAKES SET_POINTS; IF IN0 THEN TIMER := Dwell; NEXT := W; END_IF END_STEP\n"
                     "STEP W: IF TIMER.Q THEN TIMER := T#500ms; NEXT := V; END_IF END_STEP\n"
                     "STEP V: IF TIMER.Q THEN NEXT := S; END_IF END_STEP\n"));
    const Decompilation back = decompiled(compilation);
    EXPECT_EQ(back.lost_set_points, std::vector<std::string>{"Dwell"});
    EXPECT_NE(back.text.find("//     SET_POINT Dwell := "), std::string::npos) << back.text;
    EXPECT_EQ(good(back.text).table, compilation.table);
}

TEST(SetPoints, ComeBackFromTheTableWithItsSymbols) {
    const Compilation compilation = good(kSaw);
    const Decompilation back = decompiled(compilation);
    const Compilation again = good(back.text);
    EXPECT_EQ(again.table, compilation.table);
    EXPECT_EQ(again.symbols.set_points, compilation.symbols.set_points);
    EXPECT_NE(back.text.find("TIMER := Dwell"), std::string::npos);
    EXPECT_NE(back.text.find("TAKES SET_POINTS;"), std::string::npos);
}

// 819.2 counts a mm. 40/7 mm are 4681 counts: 5.714 mm are 4680.9, 5.71 mm 4677.6. 80/7 mm are 9362: 11.428
// mm are 9361.8, 11.43 mm 9363.5. The STEP itself is in no byte of the table, and comes back as it was.
TEST(SetPoints, ComeBackWithTheFewestDigits) {
    const Compilation compilation =
        good(machine("SET_POINT Pitch AT P2 := 40 mm / 7 RANGE 1 .. 200 mm;\n"
                     "SET_POINT Slot AT P3 := 80 mm / 7 RANGE 40 mm / 7 .. 400 mm / 7 STEP 40 mm / 7;\n",
                     "STEP S: TAKES SET_POINTS; IF IN0 THEN INIT(V1); NEXT := M; END_IF END_STEP\n"
                     "STEP M: ENTRY POSITION(Pitch); IF INPOS AND IN1 THEN NEXT := W; END_IF END_STEP\n"
                     "STEP W: ENTRY POSITION(Slot); IF INPOS AND NOT IN1 THEN NEXT := S; END_IF END_STEP\n"));
    const Decompilation back = decompiled(compilation);
    EXPECT_NE(back.text.find("Pitch AT P2 := 5.714 mm RANGE 1 mm .. 200 mm;"), std::string::npos)
        << back.text;
    EXPECT_NE(back.text.find("Slot AT P3 := 11.428 mm RANGE "), std::string::npos) << back.text;
    const Compilation again = good(back.text);
    EXPECT_EQ(again.table, compilation.table);
    EXPECT_EQ(again.symbols.set_points, compilation.symbols.set_points);
}

/// A ramp that the drive reaches with the defaults and not at the ends of the ranges.
TEST(SetPoints, MidiRampsHoldOverTheWholeRange) {
    const char* steps =
        "STEP S: IF IN0 THEN INIT(V1, A1); NEXT := M; END_IF END_STEP\n"
        "STEP M: ENTRY POSITION(P1); IF INPOS THEN NEXT := S; END_IF END_STEP\n";
    const auto with = [&](const char* range) {
        return test::codes(
            compile(machine(std::string("VAR_MOTOR Place AT P1 := 5 rev; Soft AT A1 := 2000 rpm/s; "
                                        "END_VAR\nSET_POINT Fast AT V1 := 500 rpm RANGE ") +
                                range + ";\n",
                            steps, "MAC34")));
    };
    EXPECT_EQ(with("400 .. 600 rpm"), with("450 .. 550 rpm"));
    EXPECT_NE(with("400 .. 600 rpm"), with("400 .. 5000 rpm"));
}

TEST(SetPointValues, AreReadInTheirUnit) {
    const Compilation compilation = good(kSaw);
    const SetPoint& length = point(compilation, "Length");
    EXPECT_EQ(set_points::read_value(length, "80").value, 65536);
    EXPECT_EQ(set_points::read_value(length, "12.3 mm").value, 10076);  // 10076.16
    EXPECT_EQ(set_points::read_value(length, " 200mm ").error, "");
    EXPECT_EQ(set_points::read_value(length, "200.1 mm").error,
              "200.1 mm is out of range; Length takes 10 mm to 200 mm in steps of 0.1 mm");
    EXPECT_EQ(set_points::read_value(length, "80 rpm").error,
              "'rpm' is no unit of Length; Length takes 10 mm to 200 mm in steps of 0.1 mm");
    EXPECT_EQ(set_points::read_value(length, "80.05 mm").error,
              "80.05 mm is between two steps, 80 or 80.1; Length takes 10 mm to 200 mm in steps of 0.1 mm");
    EXPECT_EQ(set_points::read_value(point(compilation, "Parts"), "2.5").error,
              "2.5 is no whole number; Parts takes 1 to 999");
    EXPECT_NE(set_points::read_value(length, "eighty").error, "");
    EXPECT_NE(set_points::read_value(length, "nan").error, "");
    EXPECT_NE(set_points::read_value(length, "").error, "");
    EXPECT_EQ(set_points::read_value(point(compilation, "Dwell"), "1.5 s").value, 1500);
    EXPECT_EQ(set_points::text_of(length, 10076), "12.3 mm");
}

/// One SET_POINT on V1, which goes in steps of 0.477 rpm.
SetPoint speed(const std::string& range) {
    const Compilation compilation =
        good(machine("SET_POINT Speed AT V1 := " + range + ";\n",
                     "STEP S: IF IN0 THEN INIT(Speed); NEXT := T; END_IF END_STEP\n"
                     "STEP T: TAKES SET_POINTS; IF IN1 THEN NEXT := S; END_IF END_STEP\n"));
    const auto bytes = set_points::encode(compilation.symbols.set_points);
    const auto record = set_points::decode(bytes, compilation.table);
    EXPECT_TRUE(record && record->values == compilation.symbols.set_points.values);
    return point(compilation, "Speed");
}

/// 2.097152 steps are 1 rpm on a MAC140 (001 §3.2.5): 1000 rpm become 2097, 999.93 rpm.
TEST(SetPointValues, EachWrittenValueOfTheGridIsTakenAndShown) {
    for (const char* range :
         {"1000 rpm RANGE 1000 .. 2500 rpm STEP 100 rpm", "1000 rpm RANGE 1000 .. 2500 rpm STEP 100"}) {
        const SetPoint point = speed(range);
        EXPECT_EQ(set_points::range_text(point), "1000 rpm to 2500 rpm in steps of 100 rpm");
        for (int rpm = 1000; rpm <= 2500; rpm += 100) {
            const set_points::Reading read = set_points::read_value(point, std::to_string(rpm));
            EXPECT_EQ(read.error, "") << rpm;
            EXPECT_EQ(read.value, std::lround(rpm * 2.097152));
            EXPECT_EQ(set_points::text_of(point, read.value), std::to_string(rpm) + " rpm");
            EXPECT_EQ(set_points::shown_value(point, read.value), rpm);
            EXPECT_TRUE(set_points::is_on_grid(point, read.value));
            EXPECT_FALSE(set_points::is_on_grid(point, read.value + 1));
        }
        EXPECT_EQ(set_points::read_value(point, "1499.5").error,
                  "1499.5 is between two steps, 1400 or 1500; Speed takes 1000 rpm to 2500 rpm in steps of "
                  "100 rpm");
    }
}

/// 10.07 rpm become 21 steps, which are 10.01 rpm: the shortest number for them is 10.
TEST(SetPointValues, TheGridBeginsAtTheLowerEndAsWritten) {
    const SetPoint point = speed("60.07 rpm RANGE 10.07 .. 110.07 rpm STEP 0.25 rpm");
    for (int i = 0; i <= 400; ++i) {
        const double rpm = 10.07 + i * 0.25;
        const set_points::Reading read = set_points::read_value(point, fmt::format("{:.2f} rpm", rpm));
        EXPECT_EQ(read.error, "") << rpm;
        EXPECT_EQ(read.value, std::lround(rpm * 2.097152));
    }
    EXPECT_EQ(set_points::text_of(point, point.lowest), "10.07 rpm");
    EXPECT_EQ(set_points::text_of(point, point.initial), "60.07 rpm");
    EXPECT_EQ(set_points::text_of(point, point.highest), "110.07 rpm");
    EXPECT_EQ(set_points::decimals_of(point), 2U);
}

TEST(SetPointValues, AnEndBetweenTwoStepsIsNotOnTheGrid) {
    const SetPoint point = speed("1000 rpm RANGE 1000 .. 2550 rpm STEP 100 rpm");
    EXPECT_EQ(set_points::read_value(point, "2550").error,
              "2550 is behind the last step, 2500; Speed takes 1000 rpm to 2550 rpm in steps of 100 rpm");
    EXPECT_EQ(set_points::read_value(point, "2500").error, "");
}

TEST(SetPointValues, ThousandsAreShownWithoutAnExponent) {
    const SetPoint point = speed("2000 rpm RANGE 1000 .. 3000 rpm");
    EXPECT_EQ(set_points::range_text(point), "1000 rpm to 3000 rpm");
    EXPECT_EQ(set_points::text_of(point, point.initial), "2000 rpm");
}

/// What is printed is read as the same value.
TEST(SetPointValues, PrintedValuesComeBack) {
    SetPoint length = point(good(kSaw), "Length");
    length.step = 0;
    for (std::int32_t value = length.lowest; value <= length.highest; value += 37)
        EXPECT_EQ(set_points::read_value(length, set_points::text_of(length, value)).value, value);
}

}  // namespace
}  // namespace nplc::seqc
