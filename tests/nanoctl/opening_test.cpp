// How a stop waits for the program that serves its port, in virtual time.

#include <gtest/gtest.h>

#include "command_line/program.h"

namespace nplc::command_line {
namespace {

using Opened = host::ByteClient::Opened;

class Client final : public host::ByteClient {
  public:
    const std::string& name() const override { return name_; }
    bool write(std::span<const std::uint8_t> /*bytes*/) override { return true; }
    std::optional<std::size_t> read(std::span<std::uint8_t> /*out*/, base::Microseconds /*wait*/) override {
        return 0;
    }
    base::Instant now() const override { return {}; }

  private:
    std::string name_ = "unix:x";
};

struct Opening : testing::Test {
    /// `failing` until `comes_at`.
    Opened open(Opened failing) {
        return open_patiently(
            [&] {
                ++attempts;
                Opened opened;
                if (now >= comes_at)
                    opened.client = std::make_unique<Client>();
                else
                    opened = {nullptr, failing.error, failing.never, failing.full, failing.absent};
                return opened;
            },
            base::Instant{kLongestOpening},
            {.now = [&] { return now; },
             .sleep = [&](base::Microseconds time) { now += time; },
             .goes_on = [&] { return now < interrupted_at; },
             .tell = [&] { ++told; }});
    }

    base::Instant now{};
    base::Instant comes_at = base::kNever;
    base::Instant interrupted_at = base::kNever;
    int attempts = 0;
    int told = 0;
};

TEST_F(Opening, WaitsForAProgramThatIsBeingRestartedAndSaysSoOnce) {
    comes_at = base::Instant{base::Milliseconds{2'000}};
    EXPECT_NE(open({nullptr, "nobody", false, false, true}).client, nullptr);
    EXPECT_GE(now, comes_at);
    EXPECT_LE(now, comes_at + base::Milliseconds{100});
    EXPECT_EQ(told, 1);
}

TEST_F(Opening, WaitsForAFreePlaceWithoutAWord) {
    comes_at = base::Instant{base::Milliseconds{500}};
    EXPECT_NE(open({nullptr, "full", false, true}).client, nullptr);
    EXPECT_EQ(told, 0);
}

TEST_F(Opening, OfAProgramThatDoesNotComeEndsAfterTenSeconds) {
    EXPECT_EQ(open({nullptr, "nobody", false, false, true}).error, "nobody");
    EXPECT_GE(now, base::Instant{base::Milliseconds{10'000}});
    EXPECT_LE(now, base::Instant{base::Milliseconds{10'100}});
    EXPECT_EQ(told, 1);
}

TEST_F(Opening, EndsAtOnceWhenInterrupted) {
    interrupted_at = base::Instant{base::Milliseconds{300}};
    EXPECT_EQ(open({nullptr, "nobody", false, false, true}).client, nullptr);
    EXPECT_LE(now, interrupted_at + base::Milliseconds{100});
}

TEST_F(Opening, OfWhatCannotHealIsTriedOnce) {
    for (const bool never : {false, true}) {
        attempts = 0;
        EXPECT_EQ(open({nullptr, "no permission", never}).error, "no permission");
        EXPECT_EQ(attempts, 1);
        EXPECT_EQ(now, base::Instant{});
        EXPECT_EQ(told, 0);
    }
}

}  // namespace
}  // namespace nplc::command_line
