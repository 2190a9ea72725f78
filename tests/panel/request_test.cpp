#include "request.h"

#include <gtest/gtest.h>

#include "registers/gateway.h"

namespace nplc::panel {
namespace {

constexpr base::Instant kNow{base::Milliseconds{5}};
constexpr auto kModel = registers::Model::mac140;

Asked asked(const char* text) {
    return command_of(Request::read(text), kModel, kNow);
}

TEST(PanelRequest, CommandsByName) {
    const Asked run = asked(R"({"id":1,"do":"command","name":"run"})");
    ASSERT_TRUE(run.command.has_value());
    EXPECT_EQ(run.command->reg, registers::gateway::COMMAND);
    EXPECT_EQ(run.command->value, 1U);
    EXPECT_EQ(run.command->origin, kNow);
    EXPECT_FALSE(run.command->is_stop());
    EXPECT_TRUE(asked(R"({"id":1,"do":"command","name":"stop"})").command->is_stop());
    const Asked given_up = asked(R"({"id":1,"do":"command","name":"give_up_stop"})");
    ASSERT_TRUE(given_up.command.has_value());
    EXPECT_TRUE(given_up.command->operates());
    EXPECT_FALSE(given_up.command->is_stop()) << "it needs the seat";
    EXPECT_FALSE(asked(R"({"id":1,"do":"command","name":"upload_begin"})").command.has_value());
    EXPECT_FALSE(asked(R"({"id":1,"do":"command","name":"RUN"})").command.has_value());
    EXPECT_FALSE(asked(R"({"id":1,"do":"command"})").command.has_value());
}

/// Not a write of 0 to ERR_STAT, which has settings too, and which a MIDI drive does not have.
TEST(PanelRequest, ResetErrorIsTheModels) {
    const Asked reset = asked(R"({"id":1,"do":"command","name":"reset_error"})");
    ASSERT_TRUE(reset.command.has_value());
    EXPECT_EQ(reset.command->kind, faces::Command::Kind::reset_error);
    EXPECT_EQ(reset.command->origin, kNow);
    EXPECT_TRUE(reset.command->operates());
}

TEST(PanelRequest, RegistersByNameAndNumber) {
    const Asked force = asked(R"({"id":1,"do":"write","register":"FORCE_IN","value":257})");
    ASSERT_TRUE(force.command.has_value());
    EXPECT_EQ(force.command->reg, 49);
    EXPECT_EQ(force.command->value, 257U);
    EXPECT_EQ(asked(R"({"id":1,"do":"write","register":52,"value":4294967295})").command->value, 0xFFFFFFFFU);
    for (const char* wrong : {R"({"id":1,"do":"write","register":"COMMAND","value":1})",
                              R"({"id":1,"do":"write","register":61,"value":1})",
                              R"({"id":1,"do":"write","register":"NOBODY","value":1})",
                              R"({"id":1,"do":"write","register":-1,"value":1})",
                              R"({"id":1,"do":"write","register":"FORCE_IN","value":4294967296})",
                              R"({"id":1,"do":"write","register":"FORCE_IN","value":1.5})",
                              R"({"id":1,"do":"write","register":"FORCE_IN"})"})
        EXPECT_FALSE(asked(wrong).command.has_value()) << wrong;
}

TEST(PanelRequest, TheMotorsRegisters) {
    const Asked read = asked(R"({"id":1,"do":"motor_read","register":"P_IST"})");
    ASSERT_TRUE(read.command.has_value());
    EXPECT_EQ(read.command->reg, 10);
    EXPECT_TRUE(read.command->longword);
    const Asked write = asked(R"({"id":1,"do":"motor_write","register":"V_SOLL","value":-5})");
    ASSERT_TRUE(write.command.has_value());
    EXPECT_FALSE(write.command->longword);
    EXPECT_FALSE(
        asked(R"({"id":1,"do":"motor_write","register":"V_SOLL","value":40000})").command.has_value());
    EXPECT_FALSE(asked(R"({"id":1,"do":"motor_read","register":"P_IS"})").command.has_value());
}

TEST(PanelRequest, WhatIsNoRequestSaysWhy) {
    for (const char* text :
         {"", "{", "null", "[]", "7", "\"text\"", "{}", R"({"do":"seat"})", R"({"id":"1","do":"seat"})",
          R"({"id":-1,"do":"seat"})", R"({"id":1e300,"do":"seat"})", R"({"id":1})", R"({"id":1,"do":7})"})
        EXPECT_FALSE(Request::read(text).error.empty()) << text;
    EXPECT_FALSE(Request::read(std::string(60'000, '[')).error.empty());
    EXPECT_FALSE(Request::read(R"({"id":0,"do":"seat","x":)" + std::string(30'000, '[') +
                               std::string(30'000, ']') + "}")
                     .error.empty());
    EXPECT_TRUE(Request::read(R"({"id":0,"do":"seat"})").error.empty());
}

}  // namespace
}  // namespace nplc::panel
