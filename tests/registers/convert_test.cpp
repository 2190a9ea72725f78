#include "registers/convert.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "exact.h"
#include "registers/scale.h"

namespace nplc::registers {
namespace {

constexpr Model kSmall = Model::mac140;
constexpr Model kLarge = Model::mac800;

Parsed read(Model model, std::string_view name, std::string_view text) {
    return parse(text, *find(model, name), model);
}

std::int64_t raw(Model model, std::string_view name, std::string_view text) {
    const Parsed parsed = read(model, name, text);
    EXPECT_EQ(parsed.error, TextError::none) << name << " := " << text;
    return parsed.raw;
}

std::string shown(Model model, std::string_view name, std::int64_t value) {
    return std::string(to_text(value, *find(model, name), model).view());
}

TEST(Parse, ManualsExamples) {
    EXPECT_EQ(raw(kSmall, "V_SOLL", "762.9 rpm"), 1600);     // 001 §3.2.5
    EXPECT_EQ(raw(kSmall, "V_SOLL", "12.715 rev/s"), 1600);  // the same
    EXPECT_EQ(raw(kSmall, "V_IST", "762.9 rpm"), 100);       // §3.2.12
    EXPECT_EQ(raw(kSmall, "A_SOLL", "39731 rpm/s"), 160);    // §3.2.6
    EXPECT_EQ(raw(kSmall, "A_SOLL", "662.2 rev/s2"), 160);   // the same
    EXPECT_EQ(raw(kSmall, "V_SOLL", "1000 rpm"), 2097);      // 002: 831h
    EXPECT_EQ(raw(kLarge, "V_SOLL", "100 rpm"), 277);        // 004, register 5
    EXPECT_EQ(raw(kLarge, "V_SOLL", "1000 rpm"), 2771);      // 004: AD3h
    EXPECT_EQ(raw(kLarge, "A_SOLL", "100000 rpm/s"), 360);   // 004, register 6
    EXPECT_EQ(raw(kSmall, "KVOUT", "3.9"), 998);             // §3.2.13: 3.9 x 256 = 998.4
    EXPECT_EQ(raw(kSmall, "T_SOLL", "100 %"), 1023);         // §3.2.7
    EXPECT_EQ(raw(kLarge, "T_SOLL", "300 %nominal"), 1023);  // 004, register 7
    EXPECT_EQ(raw(kSmall, "ANINP", "-10 V"), -1023);         // §3.2.122
    EXPECT_EQ(raw(kLarge, "ANINP", "10 V"), 2048);           // 004, register 170: 10 / 0.0048828 = 2048.01
    EXPECT_EQ(raw(kLarge, "U_BUS", "325 V"), 366);           // 004, register 198
    EXPECT_EQ(raw(kSmall, "AMPLITUDE", "0.83"), 212);        // 212.48
    EXPECT_EQ(raw(kSmall, "MAN_ALPHA", "90 eldeg"), 512);    // a quarter of 2048
    EXPECT_EQ(raw(kSmall, "U_SUPPLY", "48 V"), 894);         // 48 / 0.0537 = 893.85
    EXPECT_EQ(raw(kLarge, "DEGCMAX", "85 °C"), 696);         // 85 / 0.12207 = 696.32
}

TEST(Parse, Forms) {
    EXPECT_EQ(raw(kSmall, "P_SOLL", "12 rev"), 49'152);
    EXPECT_EQ(raw(kSmall, "P_SOLL", "-67000000"), -67'000'000);
    EXPECT_EQ(raw(kSmall, "P_SOLL", "+67_000_000"), 67'000'000);
    EXPECT_EQ(raw(kSmall, "T_SOLL", "25 %"), 256);  // 255.75
    EXPECT_EQ(raw(kSmall, "ANINP", "3.5 V"), 358);  // 358.05
    EXPECT_EQ(raw(kSmall, "CNTRL_BITS", "16#1F"), 31);
    EXPECT_EQ(raw(kSmall, "CNTRL_BITS", "2#1_0000_0000_0000_000"), 32'768);
    EXPECT_EQ(raw(kSmall, "CNTRL_BITS", "8#17"), 15);
    EXPECT_EQ(raw(kSmall, "V_SOLL", "16#FFFE"), -2);  // bits of an Integer
    EXPECT_EQ(raw(kLarge, "KVOUT", "16#00018000"), 98'304);
    EXPECT_EQ(raw(kLarge, "ERR_STAT", "2#11111111111111111111111111111110"), -2);
    EXPECT_EQ(raw(kSmall, "V_SOLL", "  1500rpm\t"), 3146);
    EXPECT_EQ(raw(kSmall, "V_SOLL", "0 rpm"), 0);
    EXPECT_EQ(raw(kSmall, "KVOUT", "-0.5"), -128);
    EXPECT_EQ(raw(kSmall, "KVOUT", "000000000000000000000001.500000000"), 384);
}

TEST(Parse, SaysWhatRoundingDid) {
    const Parsed rpm = read(kSmall, "V_SOLL", "1500 rpm");  // 3145.728
    EXPECT_EQ(rpm.raw, 3146);
    EXPECT_FALSE(rpm.exact);
    EXPECT_EQ(rpm.rounding, 272);
    const Parsed load = read(kSmall, "KVOUT", "3.9");  // 998.4
    EXPECT_EQ(load.rounding, -400);
    EXPECT_TRUE(read(kSmall, "KVOUT", "1.5").exact);
    EXPECT_EQ(read(kSmall, "KVOUT", "1.5").rounding, 0);
    const Parsed barely = read(kSmall, "KVOUT", "1.000000001");  // 256.000000256
    EXPECT_FALSE(barely.exact);
    EXPECT_EQ(barely.rounding, 0);
}

// 257.5 and -257.5 steps of 1/256.
TEST(Parse, HalvesGoAwayFromZero) {
    EXPECT_EQ(raw(kSmall, "KVOUT", "1.005859375"), 258);
    EXPECT_EQ(raw(kSmall, "KVOUT", "-1.005859375"), -258);
    EXPECT_EQ(read(kSmall, "KVOUT", "1.005859375").rounding, 500);
    EXPECT_EQ(read(kSmall, "KVOUT", "-1.005859375").rounding, -500);
}

TEST(Parse, Refuses) {
    using enum TextError;
    const struct {
        std::string_view name;
        std::string_view text;
        TextError error;
    } rows[] = {
        {"V_SOLL", "", not_a_number},
        {"V_SOLL", "  ", not_a_number},
        {"V_SOLL", "rpm", not_a_number},
        {"V_SOLL", "-", not_a_number},
        {"V_SOLL", "- 5", not_a_number},
        {"V_SOLL", "--5", not_a_number},
        {"V_SOLL", "1.", not_a_number},
        {"V_SOLL", ".5", not_a_number},
        {"V_SOLL", "1.2.3", not_a_number},
        {"V_SOLL", "1 2", not_a_number},
        {"V_SOLL", "1__2", not_a_number},
        {"V_SOLL", "1_", not_a_number},
        {"V_SOLL", "16#", not_a_number},
        {"V_SOLL", "16#G", not_a_number},
        {"V_SOLL", "-16#1", not_a_number},
        {"V_SOLL", "2#2", not_a_number},
        {"V_SOLL", "5#1", not_a_number},
        {"V_SOLL", "16#10 rpm", wrong_unit},
        {"V_SOLL", "1e3", wrong_unit},
        {"V_SOLL", "1,5 rpm", wrong_unit},
        {"V_SOLL", "1 rev", wrong_unit},
        {"MODE_REG", "1 rpm", wrong_unit},
        {"V_SOLL", "1000000000000000000", too_long},
        {"KVOUT", "1.0000000000", too_long},
        {"V_SOLL", "16#1234567890ABCDEF", too_long},
        {"V_SOLL", "32768", out_of_range},
        {"V_SOLL", "-32768", out_of_range},
        {"V_SOLL", "16#8000", out_of_range},
        {"V_SOLL", "16#10000", out_of_range},
        {"V_SOLL", "15625 rpm", out_of_range},  // 32768
        {"T_SOLL", "100.1 %", out_of_range},
        {"T_SOLL", "-1", out_of_range},
        {"P_SOLL", "67000001", out_of_range},
        {"P_SOLL", "999999999999999999 rev", out_of_range},
        {"A_SOLL", "1 rpm/s", too_small},
        {"KVOUT", "-0.001", too_small},
    };
    for (const auto& row : rows) {
        EXPECT_EQ(read(kSmall, row.name, row.text).error, row.error)
            << row.name << " := '" << row.text << "'";
    }
    EXPECT_EQ(read(kSmall, "V_SOLL", "40000").raw, 40'000);  // for the message
}

TEST(Write, ManualsExamples) {
    EXPECT_EQ(shown(kSmall, "V_SOLL", 1600), "762.94 rpm");
    EXPECT_EQ(shown(kSmall, "V_IST", 100), "762.9 rpm");
    EXPECT_EQ(shown(kSmall, "A_SOLL", 160),
              "39736 rpm/s");  // 39731 with 520.8 Hz; 520.8333^2 x 160/16 / 4096 x 60
    EXPECT_EQ(shown(kSmall, "P_SOLL", 49'152), "12 rev");
    EXPECT_EQ(shown(kSmall, "T_SOLL", 1023), "100 %peak");
    EXPECT_EQ(shown(kSmall, "KVOUT", 998), "3.8984");  // 3.8984375
    EXPECT_EQ(shown(kSmall, "ANINP", -1023), "-10 V");
    EXPECT_EQ(shown(kLarge, "U_BUS", 366), "325.3 V");  // 325.300068
    EXPECT_EQ(shown(kSmall, "ERR_STAT", 0x10), "16#0010");
    EXPECT_EQ(shown(kLarge, "ERR_STAT", 0x20010), "16#00020010");
    EXPECT_EQ(shown(kSmall, "MODE_REG", 2), "2");
    EXPECT_EQ(shown(kSmall, "KFF3", -1), "-0.0039");
    EXPECT_EQ(shown(kSmall, "P1", 0), "0 rev");
    EXPECT_EQ(to_text(1600, *find(kSmall, "V_SOLL"), kSmall, "rev/s").view(), "12.7157 rev/s");
    EXPECT_EQ(to_text(1600, *find(kSmall, "V_SOLL"), kSmall, "V").view(), "1600");
    EXPECT_EQ(to_text(0x80000000, *find(kLarge, "KFF5"), kLarge).view(), "128");
    EXPECT_EQ(shown(kLarge, "KFF5", -2'147'483'648LL), "-128");  // 3.1 of 004
    EXPECT_EQ(shown(kLarge, "KFF5", 2'147'483'647), "127.99999994");
    EXPECT_EQ(shown(kLarge, "KVOUT", 2'147'483'647), "32767.999985");
}

void returns(const Text& text, std::int64_t value, const Register& reg, Model model) {
    const Parsed parsed = parse(text.view(), reg, model);
    const bool legal = value >= reg.min && value <= reg.max;
    if (parsed.raw == value && parsed.error == (legal ? TextError::none : TextError::out_of_range)) return;
    ADD_FAILURE() << reg.name << ": " << value << " is written as " << text.view() << " and read as "
                  << parsed.raw;
}

/// In every unit of a register, the usual one and none included.
void round_trip(const Register& reg, Model model, std::int64_t value) {
    returns(to_text(value, reg, model), value, reg, model);
    for (const auto unit : units_of(reg.unit)) returns(to_text(value, reg, model, unit), value, reg, model);
    returns(to_text(value, reg, model, ""), value, reg, model);
}

/// True once for every format and unit of a model: registers that differ in neither convert alike.
class Kinds {
  public:
    bool is_new(const Register& reg) {
        bool& seen = seen_[static_cast<std::size_t>(reg.format)][static_cast<std::size_t>(reg.unit)];
        return !std::exchange(seen, true);
    }

  private:
    bool seen_[8][32] = {};
};

TEST(RoundTrip, EveryValueOf16Bits) {
    Kinds kinds;
    for (const Register& reg : map_of(kSmall)) {
        if (is_32_bit(reg.format) || !kinds.is_new(reg)) continue;
        for (std::uint32_t bits = 0; bits <= 0xFFFF && !testing::Test::HasFailure(); ++bits) {
            const std::int64_t value = value_of(reg.format, bits);
            ASSERT_EQ(bits_of(reg.format, value), bits);
            returns(to_text(value, reg, kSmall), value, reg, kSmall);
            if (bits % 13 == 0) round_trip(reg, kSmall, value);
        }
    }
}

TEST(RoundTrip, EndsOfEveryRegister) {
    for (const Model model : {kSmall, kLarge}) {
        for (const Register& reg : map_of(model)) {
            round_trip(reg, model, reg.min);
            round_trip(reg, model, reg.max);
            round_trip(reg, model, 0);
            for (const std::uint32_t bits :
                 {0x7FFF'FFFFU, 0x8000'0000U, 0xFFFF'FFFFU, 1U, 0x8000U, 0x7FFFU}) {
                round_trip(reg, model, value_of(reg.format, bits));
            }
        }
    }
}

TEST(RoundTrip, RandomValuesOf32Bits) {
    constexpr unsigned kSeed = 20'240;
    RecordProperty("seed", kSeed);
    std::mt19937 random(kSeed);
    for (const Model model : {kSmall, kLarge}) {
        Kinds kinds;
        for (const Register& reg : map_of(model)) {
            if (!is_32_bit(reg.format) || !kinds.is_new(reg)) continue;
            for (int i = 0; i < 5000 && !testing::Test::HasFailure(); ++i) {
                // all magnitudes alike
                const auto bits = static_cast<std::uint32_t>(static_cast<std::int32_t>(random()) >> (i % 32));
                round_trip(reg, model, value_of(reg.format, bits));
            }
        }
    }
}

__extension__ using Wide = __int128;

TEST(Exact, AgreesWithTheCompilersOwn128Bits) {
    constexpr unsigned kSeed = 7;
    std::mt19937_64 random(kSeed);
    for (int i = 0; i < 100'000; ++i) {
        const auto a = static_cast<std::int64_t>(random()) >> (i % 60);
        const auto b = static_cast<std::int64_t>(random() >> (2 + i % 50)) | 1;
        const auto c = static_cast<std::int64_t>(random() >> (3 + i % 47)) | 1;
        const Quotient q = divide_product(a, b, c);
        const Wide product = Wide{a} * b;
        const Wide half_up = (product < 0 ? -product : product) * 2 + c;
        const Wide expected = half_up / (Wide{c} * 2) * (product < 0 ? -1 : 1);
        ASSERT_EQ(q.fits, (product < 0 ? -product : product) / c < (Wide{1} << 62)) << "seed " << kSeed;
        if (!q.fits) continue;
        ASSERT_TRUE(expected == q.value) << a << " * " << b << " / " << c << ", seed " << kSeed;
        ASSERT_TRUE(product - expected * c == q.remainder) << a << " * " << b << " / " << c;
    }
    EXPECT_EQ(divide_product(7, 1, 1).value, 7);
    EXPECT_EQ(divide_product(-1, 1, 2).value, -1);
}

}  // namespace
}  // namespace nplc::registers
