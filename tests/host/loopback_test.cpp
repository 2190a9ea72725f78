#include "host/loopback.h"

#include <gtest/gtest.h>

namespace nplc::host {
namespace {

TEST(Loopback, AddressesOfThisMachine) {
    const auto usual = loopback_address("127.0.0.1:5000");
    ASSERT_TRUE(usual.has_value());
    EXPECT_EQ(usual->ip, 0x7F000001U);
    EXPECT_EQ(usual->port, 5000);
    EXPECT_EQ(loopback_address("localhost:0")->ip, 0x7F000001U);
    EXPECT_EQ(loopback_address("127.255.2.30:65535")->ip, 0x7FFF021EU);
    EXPECT_EQ(loopback_address("127.255.2.30:65535")->port, 65535);
}

TEST(Loopback, NothingElse) {
    for (const char* other : {"",
                              ":",
                              "127.0.0.1",
                              "127.0.0.1:",
                              ":80",
                              "127.0.0.1:65536",
                              "127.0.0.1:-1",
                              "127.0.0.1:+1",
                              "127.0.0.1:80x",
                              "127.0.0.1: 80",
                              "127.0.0:80",
                              "127.0.0.0.1:80",
                              "127.0.0.256:80",
                              "127.0..1:80",
                              "127.0.0.01:80",
                              "0177.0.0.1:80",
                              "0x7f.0.0.1:80",
                              "2130706433:80",
                              "128.0.0.1:80",
                              "0.0.0.0:80",
                              "192.0.2.1:80",
                              "::1:80",
                              "example.org:80",
                              "localhost.:80",
                              "LOCALHOST:80"})
        EXPECT_FALSE(loopback_address(other).has_value()) << other;
}

}  // namespace
}  // namespace nplc::host
