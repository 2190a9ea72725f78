// What is kept of orders, and the window in which they are carried out.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

#include "deployment/settings.h"
#include "disk.h"
#include "record.h"

namespace nplc::deployment {
namespace {

Record record() {
    return {.state = orders::State::trial,
            .counter = 12,
            .order = "nanoplc-order 1\nkind table\n",
            .text = "why",
            .since = 5,
            .has_former = true,
            .former_sha256 = "aa",
            .former_name = "one",
            .runs_sha256 = "bb",
            .runs_name = "two",
            .runs_since = 4};
}

TEST(DeploymentRecord, ComesBackAsItWasWritten) {
    EXPECT_EQ(read_record(write_record(record())), record());
    EXPECT_EQ(read_record(write_record({})), Record{});
}

TEST(DeploymentRecord, NoBitOfItMayBeAnother) {
    const std::string text = write_record(record());
    for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
        std::string wrong = text;
        wrong[bit / 8] = static_cast<char>(static_cast<unsigned char>(wrong[bit / 8]) ^ 1U << bit % 8);
        EXPECT_FALSE(read_record(wrong)) << bit;
    }
    for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_FALSE(read_record(std::string_view(text).substr(0, length))) << length;
}

/// At an hour and minute of 2026-01-15, by the local time.
std::uint64_t at(int hour, int minute) {
    std::tm local{};
    local.tm_year = 126;
    local.tm_mday = 15;
    local.tm_hour = hour;
    local.tm_min = minute;
    local.tm_isdst = -1;
    return static_cast<std::uint64_t>(std::mktime(&local)) * 1000;
}

TEST(DeploymentWindow, IsAPartOfTheDay) {
    const auto night = read_window("02:00-04:30");
    ASSERT_TRUE(night);
    EXPECT_EQ(night->text(), "02:00-04:30");
    EXPECT_FALSE(night->contains(at(1, 59)));
    EXPECT_TRUE(night->contains(at(2, 0)));
    EXPECT_TRUE(night->contains(at(4, 29)));
    EXPECT_FALSE(night->contains(at(4, 30)));
    const auto midnight = read_window("23:30-00:15");
    ASSERT_TRUE(midnight);
    EXPECT_TRUE(midnight->contains(at(23, 30)));
    EXPECT_TRUE(midnight->contains(at(0, 14)));
    EXPECT_FALSE(midnight->contains(at(0, 15)));
    EXPECT_FALSE(midnight->contains(at(12, 0)));
    for (const char* text : {"", "02:00", "2:00-4:00", "02:00-02:00", "24:00-02:00", "02:60-04:00",
                             "02:00-04:0x", "-2:00-04:00"})
        EXPECT_FALSE(read_window(text)) << text;
}

TEST(DeploymentDisk, SaysWhyItCannotWrite) {
    Disk disk;
    disk.write({{"/proc/nplc/orders", {1}}});
    std::optional<std::string> ended;
    while (!ended) ended = disk.take_end();
    EXPECT_TRUE(ended->starts_with("/proc/nplc/orders: cannot be written: ")) << *ended;
    EXPECT_FALSE(disk.is_busy());
}

}  // namespace
}  // namespace nplc::deployment
