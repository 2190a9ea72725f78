// Orders in courses and drawings: names and units as the program has them.
#include <gtest/gtest.h>

#include "report/table_text.h"
#include "sequencer/state.h"
#include "support.h"

namespace nplc::seqc {
namespace {

Symbols symbols_of(const std::string& scale, const std::string& registers, const std::string& orders = "",
                   const std::string& motor = "MAC140") {
    const std::string source = "PROGRAM P MOTOR " + motor + "; " + scale + " VAR_MOTOR " + registers +
                               " END_VAR POWER_UP " + orders +
                               " NEXT := S; END_POWER_UP STEP S: OWN ERROR; END_STEP END_PROGRAM";
    const Compilation compiled = compile(source);
    EXPECT_TRUE(compiled.ok) << test::shown(compiled, source);
    return compiled.symbols;
}

sequencer::MotorOrder write_of(std::uint8_t reg, std::uint32_t value, bool longword = false) {
    sequencer::MotorOrder order;
    order.is_register_write = true;
    order.reg = reg;
    order.value = value;
    order.longword = longword;
    return order;
}

std::string words(const Symbols& symbols, std::uint8_t reg, std::uint32_t value, bool longword = false) {
    return named_order_text(write_of(reg, value, longword), &symbols);
}

constexpr std::uint8_t kP1 = registers::P1;
constexpr std::uint8_t kP2 = registers::P1 + 2;
constexpr std::uint8_t kV1 = registers::V1;

// 125 mm/s with 5 mm a turn are 1500 rpm, 3146 in V1.
TEST(OrderWords, AreInTheUnitOfTheProgram) {
    const Symbols symbols = symbols_of("SCALE 1 rev = 5 mm;", "Far AT P1 := 80 mm; Fast AT V1 := 125 mm/s;");
    EXPECT_EQ(words(symbols, kV1, 3146), "Fast := 125 mm/s");
    EXPECT_EQ(words(symbols, kP1, 65'536, true), "Far := 80 mm");
    const Symbols turns = symbols_of("SCALE 1 rev = 5 mm;", "Far AT P1 := 16 rev; Fast AT V1 := 1500 rpm;");
    EXPECT_EQ(words(turns, kP1, 65'536, true), "Far := 16 rev");
    EXPECT_EQ(words(turns, kV1, 3146), "Fast := 1500 rpm");
}

TEST(OrderWords, PlainNumbersAreCounts) {
    const Symbols plain =
        symbols_of("", "Far AT P1 := 5000; Near AT P2 := -7 counts; Window AT INPOSWIN := 20;");
    EXPECT_EQ(words(plain, kP1, 5000, true), "Far := 5000 counts");
    EXPECT_EQ(words(plain, kP2, 0xFFFF'FFF9U, true), "Near := -7 counts");
    EXPECT_EQ(words(plain, registers::INPOSWIN, 20), "Window := 20 counts");
    const Symbols scaled = symbols_of("SCALE 1 rev = 5 mm;", "Far AT P1 := 20 counts; Other AT P2 := 16#20;");
    EXPECT_EQ(words(scaled, kP1, 20, true), "Far := 20 counts");
    EXPECT_EQ(words(scaled, kP2, 32, true), "Other := 32 counts");
}

TEST(OrderWords, RegistersWithoutUnitStayNumbersAndModesHaveNames) {
    const Symbols symbols =
        symbols_of("", "Ratio AT GEARF1 := 3; Time AT INPOSCNT := 5;", "MODE_REG := INIT_MODE;");
    EXPECT_EQ(words(symbols, registers::GEARF1, 3), "Ratio := 3");
    EXPECT_EQ(words(symbols, registers::INPOSCNT, 5), "Time := 5 samples");
    EXPECT_EQ(words(symbols, registers::MODE_REG, 3), "MODE_REG := GP_MODE");
}

TEST(OrderWords, ASetPointHasItsOwnUnit) {
    const std::string source =
        "PROGRAM P MOTOR MAC140; SCALE 1 rev = 5 mm; SET_POINT Pace AT V1 := 600 rpm RANGE 60 .. 2000 rpm;\n"
        "STEP S: OWN ERROR; IF IN0 THEN INIT(Pace); NEXT := T; END_IF END_STEP STEP T: OWN ERROR; END_STEP "
        "END_PROGRAM";
    const Compilation compiled = compile(source);
    ASSERT_TRUE(compiled.ok) << test::shown(compiled, source);
    EXPECT_EQ(words(compiled.symbols, kV1, 1258), "Pace := 600 rpm");
}

}  // namespace
}  // namespace nplc::seqc
