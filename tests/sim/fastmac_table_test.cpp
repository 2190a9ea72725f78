// 001 §5.2.1.4, command mode: each of the 32 commands changes what its line describes and nothing else.
#include <map>
#include <string>
#include <vector>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

constexpr int P7 = P1 + 2 * 6, P8 = P1 + 2 * 7;
constexpr std::int32_t kInPos = 1 << 4, kRelPSoll = 1 << 9, kRelPFnc = 1 << 10;

using Registers = std::map<int, std::int32_t>;

/// What a command leaves in the registers that it writes; all others stay.
struct Line {
    int number;
    Registers after;
};

// Before: INIT, IN_POS, every error that can be reset and both RELPOS bits set, P_SOLL 1, P_IST 1000, P_FNC
// 160, V_SOLL 1600, T_SOLL 1023, FLWERR 30, P1..P8 = 100, 200 ... 800, HOME_MODE 0.
constexpr std::int32_t kErrors = 0x188F | kRelPFnc;  // bits 0-3, 7, 11, 12
constexpr std::int32_t kBefore = kErrors | kInPos | kRelPSoll;

std::vector<Line> table() {
    const std::int32_t out_of_position = kBefore & ~kInPos;
    std::vector<Line> lines{
        {0x00, {}},                                              // NOP
        {0x01, {{ERR_STAT, kInPos | kRelPSoll | kRelPFnc}}},     // reset error
        {0x02, {{P_SOLL, 0}, {ERR_STAT, out_of_position}}},      // P_SOLL = 0, IN_POS = 0
        {0x03, {{P_IST, 0}}},                                    // P_IST = 0
        {0x04, {{P_FNC, 0}, {ERR_STAT, out_of_position}}},       // P_FNC = 0, IN_POS = 0
        {0x05, {{V_SOLL, 0}}},                                   // V_SOLL = 0
        {0x06, {{T_SOLL, 0}}},                                   // T_SOLL = 0
        {0x07, {{ERR_STAT, out_of_position}}},                   // IN_POS = 0
        {0x08, {{P_FNC, (30 - 700) * 16}}},                      // (FLWERR - P7) * 16
        {0x09, {{P_FNC, (30 - 800) * 16}}},                      // (FLWERR - P8) * 16
        {0x0A, {}},                                              // rapid communication
        {0x0B, {}},                                              // safe communication
        {0x10, {}},                                              // home search: HOME_MODE names none
        {0x11, {{P_SOLL, 1000 + 700 - 30}}},                     // P_IST + P7 - FLWERR
        {0x12, {{P_SOLL, 1000 + 800 - 30}}},                     // P_IST + P8 - FLWERR
        {0x13, {}},                                              // transmit slowly
        {0x14, {{ERR_STAT, kBefore & ~kRelPSoll & ~kRelPFnc}}},  // absolute
        {0x15, {{ERR_STAT, kBefore & ~kRelPFnc}}},               // relative by P_SOLL
        {0x16, {{ERR_STAT, kBefore & ~kRelPSoll}}},              // relative by P_FNC
    };
    for (int set = 0; set < 4;
         ++set) {  // P_FNC - 16 x Pn (both RELPOS bits: R), Vn, An, Tn, Ln, Zn, IN_POS = 0
        lines.push_back({0x0C + set,
                         {{P_FNC, 160 - 1600 * (set + 1)},
                          {V_SOLL, 400 * (set + 1)},
                          {A_SOLL, 40 << set},
                          {T_SOLL, 501 + set},
                          {KVOUT, 301 + set},
                          {INPOSWIN, 21 + set},
                          {ERR_STAT, out_of_position}}});
    }
    for (int nop = 0x17; nop <= 0x1F; ++nop) lines.push_back({nop, {}});  // NOPs, MYADDR, FASTMAC, FLEXMAC
    return lines;
}

MotorBench before() {
    MotorBench b;
    for (int n = 0; n < 8; ++n) b.set(P1 + 2 * n, 100 * (n + 1));
    for (int n = 0; n < 4; ++n) {
        b.set(T1 + n, 501 + n);
        b.set(L1 + n, 301 + n);
        b.set(Z1 + n, 21 + n);
    }
    b.set(P_SOLL, 1);
    b.set(P_IST, 1000);
    b.set(P_FNC, 160);
    b.set(FLWERR, 30);
    b.set(ERR_STAT, kBefore);
    return b;
}

Registers words(const MotorBench& b) {
    Registers all;
    for (int reg = 1; reg < 256; ++reg) all[reg] = b.reg(reg);
    return all;
}

TEST(FastMacTable, EachCommandDoesWhatItsLineSays) {
    ASSERT_EQ(table().size(), 32U);
    for (const Line& line : table()) {
        SCOPED_TRACE("command " + std::to_string(line.number));
        MotorBench b = before();
        Registers expected = words(b);
        b.command(static_cast<std::uint8_t>(0x60 | line.number));
        for (const auto& [reg, value] : line.after) expected[reg] = value;
        const bool p_fnc = line.after.contains(P_FNC);
        const Registers after = words(b);
        for (const auto& [reg, value] : expected) {
            if (p_fnc && reg == P_FNC + 1) continue;  // P_FNC's high word
            EXPECT_EQ(after.at(reg), value) << "register " << reg;
        }
    }
}

}  // namespace
}  // namespace nplc::sim
