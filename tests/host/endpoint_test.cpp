#include "host/endpoint.h"

#include <gtest/gtest.h>

namespace nplc::host {
namespace {

using Kind = Endpoint::Kind;

void expect(std::string_view text, Kind kind, std::string_view place) {
    const Endpoint endpoint(text);
    EXPECT_EQ(endpoint.kind, kind) << text;
    EXPECT_EQ(endpoint.place, place) << text;
    EXPECT_EQ(Endpoint::text(kind, place), text);
}

TEST(Endpoint, EachFormIsKnownByItsPrefix) {
    expect("pty:/tmp/f", Kind::pty, "/tmp/f");
    expect("unix:socket", Kind::unix_socket, "socket");
    expect("tcp:127.0.0.1:4001", Kind::tcp, "127.0.0.1:4001");
    expect("can:can0", Kind::can, "can0");
    expect("pty:", Kind::pty, "");
}

TEST(Endpoint, AnythingElseIsADevice) {
    for (const char* text : {"", "/dev/ttyUSB0", "COM3", "COM3:", "ptyx:/tmp", "/tmp/tcp:1", "http://x"})
        expect(text, Kind::device, text);
}

TEST(Endpoint, SocketsAndWhatAProgramServes) {
    EXPECT_TRUE(Endpoint("unix:a").is_socket() && Endpoint("tcp:a").is_socket());
    EXPECT_FALSE(Endpoint("pty:a").is_socket());
    EXPECT_TRUE(Endpoint("pty:a").is_served() && Endpoint("unix:a").is_served());
    EXPECT_FALSE(Endpoint("can:a").is_served() || Endpoint("/dev/ttyS0").is_served());
}

}  // namespace
}  // namespace nplc::host
