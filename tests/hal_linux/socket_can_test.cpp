#include "hal_linux/socket_can.h"

#include <gtest/gtest.h>

namespace nplc::hal_linux {
namespace {

// Frames, filters and errors are tried in tests/vm, on a kernel that has CAN.

TEST(SocketCan, SaysWhatIsWrong) {
    const std::string missing = "; `ip -o link | grep link/can` lists those for CAN";
    for (const char* name : {"nocan0", "", "a_name_much_too_long_for_an_interface"}) {
        const auto opened = SocketCan::open({.interface = name});
        EXPECT_EQ(opened.can, nullptr);
        EXPECT_EQ(opened.error, "there is no interface '" + std::string(name) + "'" + missing);
    }
    EXPECT_EQ(SocketCan::open({.interface = "lo"}).error,
              "lo is not an interface for CAN; `ip -o link | grep link/can` lists those");
}

TEST(CanFrame, KnowsWhatTheBusCanCarry) {
    using base::is_valid;
    EXPECT_TRUE(is_valid({.id = 0x7FF, .length = 8}));
    EXPECT_FALSE(is_valid({.id = 0x800}));
    EXPECT_TRUE(is_valid({.id = 0x1FFF'FFFF, .extended = true}));
    EXPECT_FALSE(is_valid({.id = 0x2000'0000, .extended = true}));
    EXPECT_FALSE(is_valid({.id = 1, .length = 9}));
}

}  // namespace
}  // namespace nplc::hal_linux
