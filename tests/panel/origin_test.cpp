#include "origin.h"

#include <gtest/gtest.h>

#include "panel/web_server.h"

namespace nplc::panel {
namespace {

TEST(Origin, ThisMachineByItsOwnNames) {
    for (const char* host : {"127.0.0.1:80", "127.9.8.7", "localhost", "LOCALHOST:8080", "[::1]:80", "[::1]"})
        EXPECT_TRUE(is_our_host(host, {})) << host;
    for (const char* host : {"", "attacker.example", "127.0.0.1.attacker.example:80",
                             "localhost.attacker.example", "127.attacker.example", "10.0.0.1"})
        EXPECT_FALSE(is_our_host(host, {})) << host;
    EXPECT_TRUE(is_our_host("Cell4.plant.example:443", {"cell4.plant.example"}));
    EXPECT_FALSE(is_our_host("cell5.plant.example", {"cell4.plant.example"}));
}

TEST(Origin, APageOfItsOwnOnly) {
    EXPECT_TRUE(is_same_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
    EXPECT_TRUE(is_same_origin("https://cell4.example", "cell4.example"));
    for (const char* origin : {"", "null", "http://127.0.0.1:8081", "http://localhost:8080",
                               "http://127.0.0.1:8080.attacker.example", "file://"})
        EXPECT_FALSE(is_same_origin(origin, "127.0.0.1:8080")) << origin;
}

TEST(Origin, LoopbackAddresses) {
    EXPECT_TRUE(is_loopback("127.0.0.1"));
    EXPECT_TRUE(is_loopback("::1"));
    for (const char* address : {"0.0.0.0", "::", "192.168.1.2", "127.0.0", "12.7.0.1", ""})
        EXPECT_FALSE(is_loopback(address)) << address;
}

}  // namespace
}  // namespace nplc::panel
