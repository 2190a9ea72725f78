// The full screen without a terminal: keys in, what is shown and what is asked of the line out.
#include "macreg/ui_model.h"

#include <gtest/gtest.h>

#include "macreg/layout.h"

namespace nplc::macreg {
namespace {

using Kind = Request::Kind;

struct UiTest : testing::Test {
    Request key(Key key) { return model.press({key}); }
    /// What the last of the keys asked for.
    Request type(const std::string& text) {
        Request request;
        for (const char c : text) request = model.press({Key::character, c});
        return request;
    }
    Request enter(const std::string& text) {
        type(text);
        return key(Key::enter);
    }
    void select(const std::string& name) {
        type("/");
        enter(name);
        ASSERT_EQ(model.list().selected().name, name);
    }
    void store(std::uint8_t number, std::int64_t raw) {
        Snapshot values;
        values.set(number, raw, {});
        model.store(values);
    }

    UiModel model{registers::Model::mac140};
};

TEST_F(UiTest, ArrowsSelectAndStopAtTheEnds) {
    EXPECT_EQ(model.list().selected().name, "PROG_VERSION");
    key(Key::up);
    EXPECT_EQ(model.list().selected_row(), 0U);
    key(Key::down);
    EXPECT_EQ(model.list().selected().name, "MODE_REG");
    model.set_page(10);
    key(Key::page_down);
    EXPECT_EQ(model.list().selected_row(), 11U);
    key(Key::last);
    EXPECT_EQ(model.list().selected_row(), model.list().rows().size() - 1);
    key(Key::page_down);
    EXPECT_EQ(model.list().selected_row(), model.list().rows().size() - 1);
    EXPECT_EQ(model.list().visible().size(), 10U);
    EXPECT_EQ(model.list().visible().back(), &model.list().selected());
    key(Key::first);
    EXPECT_EQ(model.list().visible().front(), &model.list().selected());
}

TEST_F(UiTest, CtrlUClearsWhatStandsInThePrompt) {
    type("s");
    EXPECT_NE(model.prompt().text, "");
    key(Key::erase);
    EXPECT_EQ(model.prompt().text, "");
    EXPECT_EQ(enter("V_IST").text, "V_IST");
}

TEST_F(UiTest, TestModesWantAYes) {
    select("MODE_REG");
    type("w");
    EXPECT_NE(model.prompt().label.find("0 to 24"), std::string::npos) << model.prompt().label;
    EXPECT_EQ(enter("TESTA_MODE").kind, Kind::none);
    EXPECT_EQ(model.prompt().kind, Prompt::Kind::confirm);
    EXPECT_EQ(enter("yes").kind, Kind::write);
}

TEST_F(UiTest, SearchFindsNamesNumbersAndTitles) {
    type("/");
    type("v_i");
    EXPECT_EQ(model.list().selected().name, "V_IST") << "as it is typed";
    key(Key::escape);
    EXPECT_EQ(model.list().selected().name, "PROG_VERSION") << "where it was";
    type("/");
    enter("gear");
    EXPECT_EQ(model.list().selected().name, "GEARF1");
    type("n");
    EXPECT_EQ(model.list().selected().name, "GEARF2");
    type("/");
    enter("nothing like it");
    EXPECT_TRUE(model.is_bad());
    EXPECT_EQ(model.list().selected().name, "GEARF2");
    type("/");
    enter("actual");  // P_IST's title; no name has it
    EXPECT_EQ(model.prompt().kind, Prompt::Kind::none);
}

TEST_F(UiTest, ReadAndQuit) {
    const Request read = type("r");
    EXPECT_EQ(read.kind, Kind::read);
    EXPECT_EQ(read.reg, &model.list().selected());
    EXPECT_EQ(type("R").kind, Kind::read_all);
    EXPECT_EQ(type("q").kind, Kind::quit);
}

TEST_F(UiTest, WritesInUnits) {
    select("V_SOLL");
    type("w");
    EXPECT_EQ(model.prompt().kind, Prompt::Kind::write);
    const Request request = enter("100 rpm");
    EXPECT_EQ(request.kind, Kind::write);
    EXPECT_EQ(request.reg->name, "V_SOLL");
    EXPECT_EQ(request.raw, 210);  // 001 §3.2.5: 2.0972 a rpm
}

TEST_F(UiTest, AWrongValueIsSaidAndMayBeMended) {
    select("T_SOLL");
    type("w");
    EXPECT_EQ(enter("1024").kind, Kind::none);
    EXPECT_TRUE(model.is_bad());
    EXPECT_EQ(model.prompt().text, "1024");
    key(Key::backspace);
    EXPECT_EQ(key(Key::enter).raw, 102);
    type("w");
    key(Key::escape);
    EXPECT_EQ(model.prompt().kind, Prompt::Kind::none);
}

TEST_F(UiTest, DangerousOnesWantAYes) {
    select("AMPLITUDE");
    type("w");
    EXPECT_EQ(enter("0.5").kind, Kind::none);
    EXPECT_EQ(model.prompt().kind, Prompt::Kind::confirm);
    EXPECT_EQ(enter("y").kind, Kind::none) << "the whole word";
    EXPECT_NE(model.note().find("nothing was written"), std::string::npos);
    type("w");
    enter("0.5");
    const Request request = enter("yes");
    EXPECT_EQ(request.kind, Kind::write);
    EXPECT_EQ(request.raw, 128);  // Fixed8
    type("w");
    enter("0.5");
    key(Key::escape);
    EXPECT_NE(enter("yes").kind, Kind::write) << "what was refused is forgotten";
}

TEST_F(UiTest, ABitIsWrittenAndTheOthersStay) {
    select("CNTRL_BITS");
    key(Key::tab);
    EXPECT_EQ(model.panel(), Panel::bits);
    key(Key::down);
    EXPECT_EQ(model.list().fields()[model.list().selected_field()].name, "PULSEDIR");
    type("w");
    EXPECT_TRUE(model.is_bad()) << "not read yet";
    store(36, 0x0203);
    type("w");
    enter("2");
    EXPECT_TRUE(model.is_bad()) << "one bit";
    key(Key::backspace);
    Request request = enter("1");
    if (request.kind == Kind::none) request = enter("yes");
    EXPECT_EQ(request.raw, 0x0207);
}

TEST_F(UiTest, TabGoesRound) {
    for (const Panel panel : {Panel::bits, Panel::samples, Panel::line, Panel::parameters}) {
        key(Key::tab);
        EXPECT_EQ(model.panel(), panel);
    }
    key(Key::back_tab);
    EXPECT_EQ(model.panel(), Panel::line);
}

TEST_F(UiTest, TheStateIsModeAndErrors) {
    EXPECT_EQ(model.state_words(), "reading");
    store(2, 2);
    store(35, 0x10);
    EXPECT_EQ(model.state_words(), "P_MODE, no error");
    EXPECT_FALSE(model.list().has_error());
    store(35, 0x12);
    EXPECT_EQ(model.state_words(), "P_MODE FLW_ERR");
    model.set_trouble("NO ANSWER");
    EXPECT_EQ(model.state_words(), "NO ANSWER");
    model.set_trouble("");
    EXPECT_EQ(model.note(), "the motor answers again");
}

TEST_F(UiTest, RecordsWhatIsNamedAndRemembersIt) {
    type("s");
    EXPECT_EQ(model.prompt().text, "P_IST,V_IST slow");
    for (int i = 0; i < 4; ++i) key(Key::backspace);
    const Request request = enter("fast");
    EXPECT_EQ(request.kind, Kind::record);
    EXPECT_EQ(request.text, "P_IST,V_IST fast");
    type("s");
    EXPECT_EQ(model.prompt().text, "P_IST,V_IST fast");
    key(Key::escape);
    Recording recording;
    recording.time_s = {0, 1};
    recording.columns = {{"P_IST", "counts", {1, 2}}, {"V_IST", "rpm", {3, 4}}};
    model.set_recording(recording);
    key(Key::right);
    EXPECT_EQ(model.samples().curve(), 1U);
    key(Key::right);
    EXPECT_EQ(model.samples().curve(), 1U);
    type("c");
    EXPECT_TRUE(model.samples().recording().columns.empty());
}

TEST_F(UiTest, WhatWasLostWithTheLineStaysOnTheScreen) {
    model.set_trouble("NO ANSWER, asking again");
    model.set_trouble("");
    EXPECT_EQ(model.note(), "the motor answers again");
    model.set_trouble("NO ANSWER, asking again");
    model.tell("V_SOLL may have been written or not", true);
    model.set_trouble("");
    EXPECT_EQ(model.note(), "V_SOLL may have been written or not");
}

// On a motor that stands, and after a typed yes.
TEST_F(UiTest, WhatActsOnTheWholeMotorAsks) {
    const auto set_mode = [&](std::int64_t mode) {
        Snapshot state;
        state.set(registers::MODE_REG, mode, {});
        model.store(state);
    };
    EXPECT_EQ(type("F").kind, Kind::none);
    EXPECT_TRUE(model.is_bad()) << "no mode is known";
    set_mode(1);
    type("X");
    EXPECT_NE(model.note().find("stop it first"), std::string::npos) << model.note();
    set_mode(0);
    for (const auto& [letter, kind] :
         {std::pair{"F", Kind::save}, {"X", Kind::reset}, {"P", Kind::enter_safe}}) {
        type(letter);
        type("no");
        EXPECT_EQ(key(Key::enter).kind, Kind::none);
        EXPECT_EQ(model.note(), "not confirmed, nothing was done");
        type(letter);
        type("yes");
        EXPECT_EQ(key(Key::enter).kind, kind);
    }
    set_mode(15);
    type("P");
    type("yes");
    EXPECT_EQ(key(Key::enter).kind, Kind::exit_safe);
}

TEST_F(UiTest, SamplesGoOnAsNumbers) {
    Recording recording;
    recording.time_s = {0, 1, 2};
    recording.columns = {{.name = "P_IST", .unit = "counts", .values = {5, 6, 7}}};
    model.set_recording(recording);
    key(Key::tab);
    key(Key::tab);
    ASSERT_EQ(model.panel(), Panel::samples);
    type("v");
    EXPECT_TRUE(model.samples().shows_numbers());
    key(Key::down);
    EXPECT_EQ(model.samples().sample(), 1U);
    key(Key::last);
    EXPECT_EQ(model.samples().sample(), 2U);
    type("v");
    EXPECT_FALSE(model.samples().shows_numbers());
}

TEST_F(UiTest, HelpGoesWithAnyKey) {
    type("?");
    EXPECT_TRUE(model.shows_help());
    key(Key::none);  // time passes
    EXPECT_TRUE(model.shows_help());
    EXPECT_EQ(type("q").kind, Kind::none);
    EXPECT_FALSE(model.shows_help());
}

TEST(Wrapped, BreaksAtBlanksAndSaysWhereItEnds) {
    const std::string text = "MODE_REG: 256 acts in SAFE_MODE only";
    EXPECT_EQ(wrapped(text, 40, 3), (std::vector<std::string>{text}));
    EXPECT_EQ(wrapped(text, 15, 4), (std::vector<std::string>{"MODE_REG: 256", "acts in", "SAFE_MODE only"}));
    EXPECT_EQ(wrapped(text, 15, 2), (std::vector<std::string>{"MODE_REG: 256", "acts in..."}));
    EXPECT_EQ(wrapped("abcdefgh", 5, 3), (std::vector<std::string>{"abcde", "fgh"}));
    EXPECT_TRUE(wrapped("", 5, 3).empty());
}

TEST(TextCurve, StarsGoFromLowToHigh) {
    const std::vector<double> values{0, 1, 2, 3};
    EXPECT_EQ(text_curve(values, 4, 4, 0, 3, false),
              (std::vector<std::string>{"   *", "  **", " ** ", "**  "}));
}

// Unicode's braille patterns: dots 1, 2, 3, 7 are the left column from above, 4, 5, 6, 8 the right one.
TEST(TextCurve, BrailleDots) {
    const std::vector<double> flat{0, 0};
    EXPECT_EQ(text_curve(flat, 1, 1, 0, 3, true), (std::vector<std::string>{"\u28C0"}));  // dots 7 and 8
    EXPECT_EQ(text_curve(std::vector<double>{3, 3}, 1, 1, 0, 3, true), (std::vector<std::string>{"\u2809"}));
    EXPECT_TRUE(text_curve(flat, 0, 3, 0, 1, true).empty());
    EXPECT_EQ(text_curve({}, 2, 1, 0, 1, true), (std::vector<std::string>{"  "}));
}

}  // namespace
}  // namespace nplc::macreg
