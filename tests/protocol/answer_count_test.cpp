#include "protocol/answer_count.h"

#include <gtest/gtest.h>

namespace nplc::protocol {
namespace {

/// 'q' a request, 'a' an answer, 'o' another master's request.
bool several(const char* course) {
    AnswerCount count;
    for (const char* one = course; *one != 0; ++one) {
        if (*one == 'q') count.asked();
        if (*one == 'a') count.answered();
        if (*one == 'o') count.asked_by_other();
    }
    return count.several();
}

TEST(AnswerCount, TwoAnswersToEachOfThreeRequests) {
    EXPECT_FALSE(several("qaaqaa"));
    EXPECT_TRUE(several("qaaqaaqaa"));
    EXPECT_TRUE(several("qaqaaaqaqaaaqaqaaaqaqaaa")) << "the second one's come after the next request";
    EXPECT_TRUE(several("qaqaaqaaqaa"));
}

TEST(AnswerCount, OneThatAnswersLate) {
    EXPECT_FALSE(several("qaqaqaqa"));
    EXPECT_FALSE(several("qqqaaaqaqa"));
    EXPECT_FALSE(several("qqaqaqaqaqaa"));
    EXPECT_FALSE(several("qqqqqqqqqqqqaaaaaaaaaaaaqaqa")) << "held up, then all at once";
}

TEST(AnswerCount, WhatIsRepeatedNowAndThen) {
    EXPECT_FALSE(several("qaaqaqaqaaqaqaqaaqaqaqaa"));
}

TEST(AnswerCount, AnotherMasterIsAnsweredToo) {
    EXPECT_FALSE(several("oaqaoaqoaaoaqaoaqoaa"));
    EXPECT_TRUE(several("oaaqaaoaaqaaoaaqaa"));
}

TEST(AnswerCount, UntilOnlyOneAnswers) {
    EXPECT_TRUE(several("qaaqaaqaaqaaqaaqa"));
    EXPECT_FALSE(several("qaaqaaqaaqaaqaaqaqa"));
}

}  // namespace
}  // namespace nplc::protocol
