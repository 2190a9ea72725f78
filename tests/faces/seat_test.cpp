#include "seat/seat.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "seat/secret.h"

namespace nplc::faces {
namespace {

using Verdict = Seat::Verdict;

constexpr base::Instant kStart{base::Milliseconds(5'000)};
const Sitter kPerson{1, Side::person, "nanoctl"};
const Sitter kOther{2, Side::person, "panel"};
const Sitter kPlc{3, Side::plant, "Modbus"};

TEST(Seat, BelongsToTheFirstWhoOperates) {
    Seat seat;
    EXPECT_EQ(seat.holder(), nullptr);
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::granted);
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::granted);
    EXPECT_EQ(seat.take(kPlc, kStart), Verdict::taken);
    EXPECT_EQ(seat.holder()->name, "nanoctl");
}

TEST(Seat, IsFreeWhenItsClientLeaves) {
    Seat seat;
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::granted);
    seat.leave(kOther.number);
    EXPECT_EQ(seat.take(kOther, kStart), Verdict::taken);
    seat.leave(kPerson.number);
    EXPECT_EQ(seat.take(kOther, kStart), Verdict::granted);
}

/// 10 s of silence unless set otherwise; a command restarts the time.
TEST(Seat, IsFreeAfterSilence) {
    Seat seat;
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::granted);
    const base::Instant later = kStart + base::Milliseconds(9'000);
    EXPECT_EQ(seat.take(kPerson, later), Verdict::granted);
    EXPECT_EQ(seat.ends(), later + base::Milliseconds(10'000));
    EXPECT_EQ(seat.take(kPlc, later + base::Milliseconds(9'999)), Verdict::taken);
    EXPECT_EQ(seat.take(kPlc, later + base::Milliseconds(10'000)), Verdict::granted);
}

Sitter of_user(std::uint64_t number, const char* user) {
    return {
        .number = number, .name = user, .way = registers::gateway::OperatorWay::unix_socket, .user = user};
}

TEST(Seat, IsOfAllClientsOfAUserUntilTheLastOfThemThatOperatedLeaves) {
    Seat seat;
    EXPECT_EQ(seat.take(of_user(1, "uid 1000"), kStart), Verdict::granted);
    EXPECT_EQ(seat.take(of_user(2, "uid 1000"), kStart), Verdict::granted);
    EXPECT_EQ(seat.take(of_user(3, "uid 1001"), kStart), Verdict::taken);
    seat.leave(1);
    EXPECT_EQ(seat.take(of_user(3, "uid 1001"), kStart), Verdict::taken);
    seat.leave(2);
    EXPECT_EQ(seat.take(of_user(3, "uid 1001"), kStart), Verdict::granted);
    EXPECT_TRUE(seat.is_holder(of_user(4, "uid 1001")));
}

TEST(Seat, IsTakenOverAndBothAreTold) {
    Seat seat;
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::granted);
    EXPECT_EQ(seat.take_over(kOther, kStart), Verdict::granted);
    const auto news = seat.take_news();
    ASSERT_TRUE(news);
    EXPECT_EQ(news->from.name, "nanoctl");
    EXPECT_EQ(news->by.name, "panel");
    EXPECT_FALSE(seat.take_news());
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::taken_over);
    EXPECT_EQ(detail_of(Verdict::taken_over), 3);
    EXPECT_EQ(seat.take(kPlc, kStart), Verdict::taken);
    seat.leave(kPerson.number);
    EXPECT_EQ(seat.holder()->name, "panel") << "who lost it does not free it";
    EXPECT_EQ(seat.take_over(kOther, kStart), Verdict::granted) << "it has it already";
    EXPECT_FALSE(seat.take_news());
    seat.set_control(Control::remote);
    EXPECT_EQ(seat.take_over(kPerson, kStart), Verdict::remote);
}

TEST(Seat, IsGivenBackByWhoHasIt) {
    Seat seat;
    EXPECT_EQ(seat.take(of_user(1, "uid 1000"), kStart), Verdict::granted);
    EXPECT_FALSE(seat.give_back(of_user(2, "uid 1001")));
    EXPECT_TRUE(seat.give_back(of_user(3, "uid 1000")));
    EXPECT_EQ(seat.holder(), nullptr);
}

TEST(Seat, GoesByTheSideThatMayOperate) {
    Seat seat;
    seat.set_control(Control::local);
    EXPECT_EQ(seat.take(kPlc, kStart), Verdict::local);
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::granted);
    seat.set_control(Control::remote);
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::remote);
    EXPECT_EQ(seat.holder(), nullptr);
    EXPECT_EQ(seat.take(kPlc, kStart), Verdict::granted);
    seat.set_control(Control::any);
    EXPECT_EQ(seat.take(kPerson, kStart), Verdict::taken);
    EXPECT_EQ(detail_of(Verdict::taken), 0);
    EXPECT_EQ(detail_of(Verdict::local), 1);
    EXPECT_EQ(detail_of(Verdict::remote), 2);
}

TEST(Secret, IsTheSameAsAWhole) {
    EXPECT_TRUE(same_secret("abc", "abc"));
    for (const char* given : {"", "ab", "abd", "abcabc", "ABC"})
        EXPECT_FALSE(same_secret(given, "abc")) << given;
    EXPECT_FALSE(same_secret("", "")) << "where none is configured nobody has it";
    EXPECT_FALSE(same_secret("abc", ""));
}

TEST(Secret, IsAFilesFirstLineOf12CharactersAndMore) {
    const std::string path = testing::TempDir() + "secret_test";
    const auto read = [&](const std::string& text) {
        std::ofstream(path, std::ios::binary) << text;
        return read_secret(path, 16);
    };
    EXPECT_EQ(read("0123456789ab").text, "0123456789ab");
    EXPECT_EQ(read("0123456789ab\r\nmore").text, "0123456789ab");
    for (const char* text : {"", "0123456789a\nb", "0123456789abcdefg"})
        EXPECT_EQ(read(text).error, path + ": its first line must be a secret of 12 to 16 characters")
            << text;
    std::filesystem::remove(path);
    EXPECT_EQ(read_secret(path, 16).error, path + ": No such file or directory");
}

TEST(Seat, HasNumbersForEveryClient) {
    const std::uint64_t one = Seat::new_number();
    EXPECT_NE(one, 0U);
    EXPECT_NE(Seat::new_number(), one);
}

}  // namespace
}  // namespace nplc::faces
