#include "host/process.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "host/paths.h"

namespace nplc::host {
namespace {

TEST(Process, GivesInputAndTakesOutput) {
    const std::string all("bytes \r\n\x1A\x00\xFF end", 14);
    const Ran ran = run_program("cat", {}, all);
    EXPECT_EQ(ran.problem, "");
    EXPECT_TRUE(ran.done);
    EXPECT_EQ(ran.output, all);
    EXPECT_EQ(ran.errors, "");
}

TEST(Process, MoreThanAnyPipeHolds) {
    const std::string much(1'000'000, 'x');
    EXPECT_EQ(run_program("cat", {}, much).output, much);
}

TEST(Process, ArgumentsStayWhole) {
    const Ran ran = run_program("printf", {"%s|", "a b", "", "\"c\\", "$HOME;ls"}, "");
    EXPECT_EQ(ran.output, "a b||\"c\\|$HOME;ls|");
}

TEST(Process, FailuresAreTold) {
    const Ran failed = run_program("ls", {"/nowhere at all"}, "");
    EXPECT_EQ(failed.problem, "");
    EXPECT_FALSE(failed.done);
    EXPECT_GT(failed.status, 0);
    EXPECT_NE(failed.errors.find("nowhere at all"), std::string::npos);
    const Ran missing = run_program("no_such_program_here", {}, "");
    EXPECT_TRUE(missing.missing);
    EXPECT_FALSE(missing.done);
    EXPECT_NE(missing.problem, "");
}

TEST(Process, KnowsItsFolder) {
    EXPECT_TRUE(std::filesystem::exists(path_of(own_folder()) / "test_host"));
}

TEST(Process, NumbersItself) {
    EXPECT_NE(own_process(), 0U);
    EXPECT_EQ(own_process(), own_process());
}

}  // namespace
}  // namespace nplc::host
