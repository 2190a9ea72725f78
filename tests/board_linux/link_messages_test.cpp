// The journal's messages on a link that is lost again and again.
#include "link_messages.h"

#include <gtest/gtest.h>

namespace nplc::boards {
namespace {

using namespace std::chrono_literals;

/// A link that is cut and mended once a second.
struct Flapping {
    void flap(unsigned times) {
        for (unsigned i = 0; i < times; ++i) {
            messages.lost(now);
            whole += messages.writes_whole() ? 1U : 0U;
            now += 500ms;
            messages.back();
            whole += messages.writes_whole() ? 1U : 0U;
            now += 500ms;
            look();
        }
    }
    void rest(base::Microseconds time) {
        for (const auto end = now + time; now < end; now += 1s) look();
    }
    void look() {
        if (now < messages.next()) return;
        if (const auto text = messages.count(now)) counts.push_back(*text);
    }

    LinkMessages messages;
    base::Instant now{100s};
    unsigned whole = 0;
    std::vector<std::string> counts;
};

TEST(LinkMessages, TheFirstAreWholeAndThenAMinuteHasOne) {
    Flapping link;
    link.flap(3 * 60);
    EXPECT_EQ(link.whole, 6U) << "three losses, and that the motor answers again";
    ASSERT_EQ(link.counts.size(), 3U);
    for (const std::string& count : link.counts)
        EXPECT_EQ(
            count,
            "the link to the motor was lost 60 times in the last minute; the motor answers now; each loss is "
            "counted and not told until there are fewer");
}

TEST(LinkMessages, WhenItIsQuietAgainThatIsSaidAndTheNextLossIsWhole) {
    Flapping link;
    link.flap(60);
    link.rest(61s);
    ASSERT_EQ(link.counts.size(), 2U);
    EXPECT_EQ(link.counts[1],
              "the link to the motor was lost 0 times in the last minute; the motor answers now");
    EXPECT_EQ(link.messages.next(), base::kNever);
    link.whole = 0;
    link.flap(1);
    EXPECT_EQ(link.whole, 2U);
}

TEST(LinkMessages, ALossThatStaysIsSaid) {
    Flapping link;
    link.flap(10);
    link.messages.lost(link.now);
    link.rest(51s);
    ASSERT_EQ(link.counts.size(), 1U);
    EXPECT_NE(link.counts[0].find("lost 11 times in the last minute; the motor does not answer now"),
              std::string::npos)
        << link.counts[0];
}

TEST(LinkMessages, LossesNowAndThenAreAllTold) {
    Flapping link;
    for (int i = 0; i < 30; ++i) {
        link.flap(1);
        link.rest(30s);
    }
    EXPECT_EQ(link.whole, 60U);
    EXPECT_TRUE(link.counts.empty());
}

}  // namespace
}  // namespace nplc::boards
