// What a drawing shows, and its parts; the places in whole drawings are checked by graph_test.py.
#include "report/graph/graph.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "case_file.h"
#include "report/graph/graph_columns.h"
#include "report/graph/graph_font.h"
#include "report/graph/graph_layout.h"
#include "report/graph/graph_model.h"
#include "report/graph/graph_svg.h"
#include "report/graph/graph_text.h"
#include "report/graph/graph_tracks.h"
#include "support.h"

namespace nplc::seqc {
namespace {

/// POWER_UP, two steps and a fault; Lost is never reached.
const char* const kSource =
    "PROGRAM Door MOTOR MAC140; VAR_INPUT Start AT IN0; Key AT IN1; END_VAR\n"
    "VAR_OUTPUT Lamp AT OUT0; Horn AT OUT1; END_VAR VAR_MOTOR Fast AT V1 := 1000; END_VAR\n"
    "ON ERROR NEXT := Fault; POWER_UP INIT(Fast); NEXT := Shut; END_POWER_UP\n"
    "STEP Shut: OUT Lamp; IF Start THEN VELOCITY(Fast); TIMER := T#500ms; NEXT := Open; END_IF END_STEP\n"
    "STEP Open: OUT Horn WHEN Key; IF TIMER.Q THEN NEXT := Shut; ELSIF NOT Start THEN EVERY_SCAN COUNT_DOWN; "
    "END_IF "
    "END_STEP\n"
    "STEP Fault: OWN ERROR; ENTRY STOP; IF ANY ERROR AND Key THEN RESET_ERROR; NEXT := Shut; END_IF "
    "END_STEP\n"
    "STEP Lost: OWN ERROR; IF Start THEN NEXT := Shut; END_IF END_STEP END_PROGRAM\n";

GraphModel model_of(const Compilation& compilation, std::string_view source) {
    return graph_model_of(compilation.table, &compilation.symbols, "file", {&compilation.written, source});
}

std::string text_of(const GraphModel::Way& way) {
    return way.condition + (way.actions.empty() ? "" : " / " + way.actions) + " -> " + std::to_string(way.to);
}

std::vector<std::string> texts_of(const GraphModel::Box& box) {
    std::vector<std::string> texts;
    for (const GraphModel::Way& way : box.ways) texts.push_back(text_of(way));
    return texts;
}

using Texts = std::vector<std::string>;

TEST(GraphModel, SaysWhatAPersonNeeds) {
    const Compilation door = test::compiled(kSource);
    const GraphModel model = model_of(door, kSource);
    EXPECT_EQ(model.title, "Door");
    EXPECT_EQ(model.motor, "MAC140");
    ASSERT_EQ(model.boxes.size(), 5U);
    EXPECT_EQ(model.boxes[0].entry, Texts{"Fast := 1000"});
    EXPECT_EQ(texts_of(model.boxes[0]), Texts{"always / INIT(Fast) -> 1"});
    EXPECT_EQ(model.boxes[1].outputs, Texts{"OUT Lamp"});
    EXPECT_EQ(texts_of(model.boxes[1]), Texts{"Start / VELOCITY(Fast); TIMER := T#500ms -> 2"});
    EXPECT_EQ(model.boxes[2].outputs, Texts{"OUT Horn WHEN Key"});
    EXPECT_EQ(texts_of(model.boxes[2]), (Texts{"TIMER.Q -> 1", "NOT Start / COUNT_DOWN -> 2"}));
    EXPECT_EQ(model.boxes[3].entry, Texts{"ENTRY STOP"});
    EXPECT_EQ(texts_of(model.boxes[3]), Texts{"ANY ERROR AND Key / RESET_ERROR -> 1"});
    EXPECT_TRUE(model.boxes[3].reachable);
    EXPECT_FALSE(model.boxes[4].reachable);
    ASSERT_EQ(model.notes.size(), 1U);  // POWER_UP, Shut and Open
    EXPECT_EQ(text_of(model.notes[0].way), "ERROR -> 3");
    EXPECT_EQ(model.notes[0].where, "in every other step but Lost");
}

/// Units, numbers, comments and line ends in a program; what comes from everywhere in two ways.
const char* const kLine =
    "PROGRAM Line MOTOR MAC140; SCALE 1 rev = 10 mm;\n"
    "VAR_INPUT Stop AT IN0; Go AT IN1; Home AT IN2; END_VAR\n"
    "VAR_MOTOR Home_Place AT P1 := 0 mm; Far AT P2 := 80 mm; Soft AT A1 := 20000 rpm/s; END_VAR\n"
    "GROUP Moving: Forth, Back, Rest;\n"
    "ON ERROR NEXT := Fault; ON Stop IN Moving NEXT := Fault;\n"
    "POWER_UP INIT(V1, Soft); NEXT := Forth; END_POWER_UP\n"
    "STEP Forth: ENTRY POSITION( Far ); IF INPOS and (* there *)\n  not Go THEN TIMER := 3 s; NEXT := Rest;\n"
    "  ELSE EVERY_SCAN V_SOLL := 300 rpm; END_IF END_STEP\n"
    "STEP Rest: IF TIMER.Q THEN NEXT := Back; END_IF END_STEP\n"
    "STEP Back: ENTRY POSITION(Home_Place); IF INPOS THEN NEXT := Forth; END_IF END_STEP\n"
    "STEP Fault: OWN ERROR; ENTRY STOP; IF ANY ERROR AND Home THEN RESET_ERROR; NEXT := POWER_UP; END_IF "
    "END_STEP END_PROGRAM\n";

TEST(GraphModel, ShowsAProgramAsItIsWritten) {
    const Compilation line = test::compiled(kLine);
    const GraphModel model = model_of(line, kLine);
    ASSERT_EQ(model.boxes.size(), 5U);
    EXPECT_EQ(model.boxes[0].entry, (Texts{"Home_Place := 0 mm", "Far := 80 mm", "Soft := 20000 rpm/s"}));
    EXPECT_EQ(model.boxes[1].entry, Texts{"ENTRY POSITION( Far )"});
    EXPECT_EQ(texts_of(model.boxes[1]),
              (Texts{"INPOS AND NOT Go / TIMER := 3 s -> 2", "ELSE / V_SOLL := 300 rpm -> 1"}));
    EXPECT_EQ(texts_of(model.boxes[2]), Texts{"TIMER.Q -> 3"});
    ASSERT_EQ(model.notes.size(), 2U);
    EXPECT_EQ(text_of(model.notes[1].way), "Stop -> 4");
    EXPECT_EQ(model.notes[1].where, "IN Moving");
}

// 80 mm are 8 revolutions of 4096 counts; 81 in A1 is 20117 rpm/s, and 20000 rpm/s, 80.5 steps, is rounded to
// it: the shorter one.
TEST(GraphModel, ATableHasTheNamesAndUnitsOfItsSymbols) {
    const Compilation line = test::compiled(kLine);
    const GraphModel model = graph_model_of(line.table, &line.symbols, "file");
    EXPECT_EQ(model.boxes[0].entry, (Texts{"Home_Place := 0 mm", "Far := 80 mm", "Soft := 20000 rpm/s"}));
    EXPECT_EQ(model.boxes[1].entry, Texts{"ENTRY POSITION(Far)"});
    // The content of the note is left out; the only way into a step shows the actions of its ENTRY.
    EXPECT_EQ(texts_of(model.boxes[2]), Texts{"TIMER.Q / POSITION(Home_Place) -> 3"});
    ASSERT_EQ(model.notes.size(), 2U);
    EXPECT_EQ(text_of(model.notes[1].way), "Stop -> 4");
    EXPECT_EQ(model.notes[1].where, "in every other step");
}

TEST(GraphModel, SetPointsHaveTheirRangesAndTheStepsThatTakeThem) {
    const Compilation program = test::compiled(
        "PROGRAM P MOTOR MAC140; SET_POINT Speed AT V1 := 1000 rpm RANGE 500 .. 2500 rpm STEP 100 rpm; "
        "ON ERROR NEXT := Fault; STEP Idle: TAKES SET_POINTS; IF IN0 THEN INIT(Speed); NEXT := Work; END_IF "
        "END_STEP "
        "STEP Work: IF IN1 THEN NEXT := Idle; END_IF END_STEP "
        "STEP Fault: OWN ERROR; IF ANY ERROR AND IN2 THEN RESET_ERROR; NEXT := POWER_UP; END_IF END_STEP "
        "END_PROGRAM");
    const GraphModel model = graph_model_of(program.table, &program.symbols, "p.seq");
    EXPECT_EQ(
        model.set_points,
        (std::vector<std::string>{"Set-point Speed: 1000 rpm, 500 rpm to 2500 rpm in steps of 100 rpm"}));
    for (const GraphModel::Box& box : model.boxes) {
        const bool takes =
            std::find(box.outputs.begin(), box.outputs.end(), "TAKES SET_POINTS") != box.outputs.end();
        EXPECT_EQ(takes, box.name == "Idle") << box.name;
    }
}

TEST(GraphModel, ABareTableNamesStepsByRanges) {
    const Compilation line = test::compiled(kLine);
    const GraphModel model = graph_model_of(line.table, nullptr, "file");
    ASSERT_EQ(model.notes.size(), 2U);
    EXPECT_EQ(text_of(model.notes[1].way), "IN0 -> 4");
    EXPECT_EQ(texts_of(model.boxes[1])[0], "NOT IN1 AND INPOS / TIMER := T#3s -> 2");
}

/// The terms of a table exclude each other; what is drawn is read from the top, as the source was.
TEST(GraphModel, ATableDoesNotRepeatEarlierConditionsInTheNegative) {
    const Compilation two = test::compiled(
        "PROGRAM P MOTOR MAC140; ON IN5 IN A, B NEXT := C; STEP A: OWN ERROR; IF IN1 THEN NEXT := B; ELSIF "
        "IN2 THEN NEXT := C; ELSIF IN3 AND IN4 THEN NEXT := D; END_IF END_STEP "
        "STEP B: OWN ERROR; IF IN1 THEN NEXT := A; END_IF END_STEP STEP C: OWN ERROR; END_STEP "
        "STEP D: OWN ERROR; IF IN0 THEN NEXT := A; END_IF END_STEP END_PROGRAM");
    const GraphModel model = graph_model_of(two.table, &two.symbols, "");
    for (const GraphModel::Box& box : model.boxes) {
        for (const GraphModel::Way& way : box.ways)
            EXPECT_EQ(way.condition.find("NOT "), std::string::npos) << box.name << ": " << way.condition;
    }
    EXPECT_EQ(texts_of(model.boxes[1]), (Texts{"IN5 -> 3", "IN1 -> 2", "IN2 -> 3", "IN3 AND IN4 -> 4"}));
    EXPECT_EQ(texts_of(model.boxes[2]), (Texts{"IN5 -> 3", "IN1 -> 1"}));
}

TEST(GraphModel, AHelperStepStandsOnTheWay) {
    const char* const source =
        "PROGRAM P MOTOR MAC140; STEP Work: OWN ERROR; ENTRY TIMER := T#9ms; IF TIMER.Q THEN NEXT := Late; "
        "ELSIF IN0 "
        "THEN HOME; NEXT := Done; END_IF END_STEP STEP Late: OWN ERROR; END_STEP STEP Done: OWN ERROR; "
        "END_STEP "
        "END_PROGRAM";
    const Compilation work = test::compiled(source);
    const GraphModel model = model_of(work, source);
    ASSERT_EQ(model.boxes.size(), 5U);
    EXPECT_EQ(texts_of(model.boxes[1]), (Texts{"TIMER.Q -> 2", "IN0 / HOME -> 3"}));
    EXPECT_EQ(model.boxes[1].ways[1].by, std::uint8_t{4});
    EXPECT_EQ(model.boxes[4].made_as, "helper step");
    EXPECT_TRUE(model.boxes[4].is_of_compiler);
    EXPECT_EQ(texts_of(model.boxes[4]).front(), "always / HOME -> 3");
}

TEST(GraphModel, ATimeLimitStandsBehindItsCondition) {
    const char* const source =
        "PROGRAM P MOTOR MAC140; STEP Wait: OWN ERROR; IF IN0 AND NOT IN1 WITHIN (* so long *)\n T#3s THEN "
        "NEXT "
        ":= Done; ELSE NEXT := Late; END_IF END_STEP STEP Done: OWN ERROR; END_STEP STEP Late: OWN ERROR; "
        "END_STEP END_PROGRAM";
    const Compilation wait = test::compiled(source);
    const GraphModel model = model_of(wait, source);
    ASSERT_EQ(model.boxes.size(), 4U);
    EXPECT_EQ(texts_of(model.boxes[1]), (Texts{"IN0 AND NOT IN1 WITHIN T#3s -> 2", "ELSE -> 3"}));
}

/// The clamp is latched, so that Release divides: with and without Start in a copy of Wait.
TEST(GraphModel, WaysOfOneConditionAreTold) {
    const std::string source = test::text_of_file(std::filesystem::path(SEQC_EXAMPLES) / "glue_station.seq");
    const Compilation glue = test::compiled(source);
    for (const GraphModel::Box& box : model_of(glue, source).boxes) {
        std::set<std::string> conditions;
        for (const GraphModel::Way& way : box.ways)
            EXPECT_TRUE(conditions.insert(way.condition).second) << box.name << ": " << way.condition;
    }
}

/// A SEQUENCE's parameters are no names of the program.
TEST(GraphModel, StepsOfASequenceNameWhatTheyWereCalledWith) {
    const std::string source = test::text_of_file(std::filesystem::path(SEQC_EXAMPLES) / "dough_divider.seq");
    const Compilation divider = test::compiled(source);
    const GraphModel model = model_of(divider, source);
    EXPECT_EQ(texts_of(model.boxes[3]), Texts{"always -> 9"});  // Lift: CALL Knife_To(Up)
    EXPECT_EQ(texts_of(model.boxes[8]), (Texts{"Down WITHIN T#600ms -> 3", "ELSE -> 7"}));
    EXPECT_EQ(texts_of(model.boxes[9]), (Texts{"Up WITHIN T#600ms -> 4", "ELSE -> 7"}));
    EXPECT_FALSE(model.boxes[8].is_of_compiler);
    const std::string second =
        test::text_of_file(std::filesystem::path(SEQC_EXAMPLES) / "screwdriver_station.seq");
    const Compilation station = test::compiled(second);
    const GraphModel model_of_it = model_of(station, second);
    EXPECT_EQ(model_of_it.boxes[5].entry.front(), "ENTRY POSITION(Hole_1)");
    EXPECT_EQ(model_of_it.boxes[8].entry.front(), "ENTRY POSITION(Hole_2)");
}

const GraphModel::Box& box_named(const GraphModel& model, std::string_view name) {
    for (const GraphModel::Box& box : model.boxes) {
        if (box.name == name) return box;
    }
    ADD_FAILURE() << "no box " << name;
    return model.boxes.front();
}

/// Idle waits for two edges, Alarm blinks and counts its WITHIN, Down is reached with the clamp on and off.
const char* const kCopies =
    "PROGRAM P MOTOR MAC140; VAR_INPUT Start AT IN0; Ack AT IN1; Low AT IN2; END_VAR\n"
    "VAR_OUTPUT Clamp AT OUT0; Lamp AT OUT1; Horn AT OUT2; Ready AT OUT3; END_VAR\n"
    "ON ERROR NEXT := Alarm; POWER_UP NEXT := Idle; END_POWER_UP\n"
    "STEP Idle: OUT Ready; IF R_TRIG(Start) THEN SET Clamp; NEXT := Down; ELSIF F_TRIG(Ack) THEN NEXT := "
    "Down; END_IF END_STEP\n"
    "STEP Down: IF Low FOR 2 s THEN RESET Clamp; NEXT := Idle; ELSIF Start THEN EVERY_SCAN COUNT_DOWN; "
    "END_IF "
    "END_STEP\n"
    "STEP Alarm: OWN ERROR; ENTRY RESET Clamp; OUT Lamp, Horn BLINKING T#500ms;\n"
    "IF ANY ERROR AND Ack WITHIN T#2s THEN RESET_ERROR; NEXT := Idle; ELSE NEXT := POWER_UP; END_IF "
    "END_STEP END_PROGRAM\n";

TEST(GraphModel, AStepAndItsCopiesAreOneBox) {
    const Compilation program = test::compiled(kCopies);
    const GraphModel model = model_of(program, kCopies);
    ASSERT_EQ(model.boxes.size(), 4U);
    std::set<std::uint8_t> steps;
    for (const GraphModel::Box& box : model.boxes) {
        for (const std::uint8_t step : box.steps) EXPECT_TRUE(steps.insert(step).second) << int{step};
        EXPECT_FALSE(box.is_of_compiler);
        EXPECT_TRUE(box.reachable) << box.name;
        EXPECT_EQ(box.steps.front(), box.step);
    }
    std::size_t named = 0;
    for (const std::string& name : program.symbols.steps) named += name.empty() ? 0U : 1U;
    EXPECT_EQ(steps.size(), named) << "each step of the table is in one box";
    const GraphModel::Box& idle = box_named(model, "Idle");
    EXPECT_GE(idle.steps.size(), 4U);
    EXPECT_EQ(idle.outputs, (Texts{"OUT Ready"}));
    EXPECT_EQ(texts_of(idle), (Texts{"R_TRIG(Start) / SET Clamp -> 2", "F_TRIG(Ack) -> 2"}));
    const GraphModel::Box& down = box_named(model, "Down");
    EXPECT_EQ(down.outputs, (Texts{"Clamp as before"}));
    EXPECT_EQ(texts_of(down), (Texts{"Low FOR 2 s / RESET Clamp -> 1", "Start / COUNT_DOWN -> 2"}));
    const GraphModel::Box& alarm = box_named(model, "Alarm");
    EXPECT_EQ(alarm.outputs, (Texts{"OUT Lamp, Horn BLINKING T#500ms"}));
    EXPECT_EQ(alarm.entry, (Texts{"ENTRY RESET Clamp"}));
    EXPECT_EQ(texts_of(alarm), (Texts{"ANY ERROR AND Ack WITHIN T#2s / RESET_ERROR -> 1", "ELSE -> 0"}));
}

TEST(GraphModel, ATableWithoutItsProgramHasABoxForEachStep) {
    const Compilation program = test::compiled(kCopies);
    const GraphModel model = graph_model_of(program.table, &program.symbols, "");
    for (const GraphModel::Box& box : model.boxes) EXPECT_EQ(box.steps, GraphModel::Steps{box.step});
    EXPECT_GT(model.boxes.size(), 8U);
}

/// A later CALL is another place of the program, with copies of its own.
TEST(GraphModel, ALaterCallHasBoxesOfItsOwn) {
    const char* const source =
        "PROGRAM P MOTOR MAC140; SEQUENCE Press_Anew(VAR_INPUT Button) STEP Wait: OWN ERROR; IF "
        "R_TRIG(Button) "
        "THEN RETURN; END_IF END_STEP END_SEQUENCE\n"
        "STEP One: OWN ERROR; CALL Press_Anew(IN0); NEXT := Two; END_STEP\n"
        "STEP Two: OWN ERROR; CALL Press_Anew(IN1); NEXT := One; END_STEP END_PROGRAM\n";
    const Compilation program = test::compiled(source);
    std::size_t waits = 0;
    for (const GraphModel::Box& box : model_of(program, source).boxes) {
        if (box.steps.size() < 2) continue;
        ++waits;
        ASSERT_EQ(box.ways.size(), 1U);
        EXPECT_NE(box.ways[0].condition.find("R_TRIG"), std::string::npos);
    }
    EXPECT_EQ(waits, 2U);
}

TEST(GraphModel, NumbersOfStepsAreToldInRanges) {
    EXPECT_EQ(numbers_text({4}), "step 4");
    EXPECT_EQ(numbers_text({4, 9, 10, 11, 13}), "steps 4, 9 to 11, 13");
}

TEST(GraphModel, AnOnConditionOfTwoStepsIsANote) {
    const char* const source =
        "PROGRAM P MOTOR MAC140; ON IN0 IN A, B NEXT := C; STEP A: OWN ERROR; IF IN1 THEN NEXT := B; END_IF "
        "END_STEP "
        "STEP B: OWN ERROR; IF IN1 THEN NEXT := A; END_IF END_STEP STEP C: OWN ERROR; END_STEP END_PROGRAM";
    const Compilation two = test::compiled(source);
    const GraphModel model = model_of(two, source);
    ASSERT_EQ(model.notes.size(), 1U);
    EXPECT_EQ(text_of(model.notes[0].way), "IN0 -> 3");
    EXPECT_EQ(model.notes[0].where, "IN A, B");
}

TEST(GraphModel, FewWaysOnErrorStandInTheBoxes) {
    const Compilation two = test::compiled(
        "PROGRAM P POWER_UP NEXT := A; END_POWER_UP ON ERROR NEXT := B; STEP A: END_STEP STEP B: OWN ERROR; "
        "END_STEP "
        "END_PROGRAM");
    const GraphModel model = graph_model_of(two.table, &two.symbols, "");
    EXPECT_TRUE(model.notes.empty());
    EXPECT_EQ(texts_of(model.boxes[1]), Texts{"ERROR -> 2"});
    EXPECT_TRUE(model.boxes[1].ways[0].on_error);
}

std::vector<std::string> ids_of(const CardColumns& columns) {
    std::vector<std::string> ids;
    for (const auto& column : columns) {
        for (const Card& card : column) ids.push_back(card.box.id);
    }
    return ids;
}

GraphModel::Way way_to(std::uint8_t step) {
    return {.condition = "Go", .to = step};
}

// 0 -> 2 -> 3 -> 1 by the ways; 4 is where the note leads, and comes last with the note before it.
TEST(GraphColumns, AreReadAlongTheWaysAndNotesStandAboveTheirSteps) {
    GraphModel model;
    for (std::uint8_t step = 0; step < 5; ++step) model.boxes.push_back({.step = step, .name = "A"});
    model.boxes[0].ways = {way_to(4), way_to(2)};
    model.boxes[2].ways = {way_to(3)};
    model.boxes[3].ways = {way_to(1)};
    model.notes.push_back({{.condition = "Stop", .to = 4}, "in every other step"});
    EXPECT_EQ(reading_order(model), (std::vector<std::size_t>{0, 2, 3, 1, 4}));
    const CardColumns one = columns_of(model, 1, 40);
    EXPECT_EQ(one.size(), 1U);
    EXPECT_EQ(ids_of(one), (Texts{"s0", "s2", "s3", "s1", "n4", "s4"}));
    const CardColumns three = columns_of(model, 3, 40);
    EXPECT_EQ(three.size(), 3U);
    EXPECT_EQ(ids_of(three), ids_of(one));
}

TEST(GraphTracks, WhatMeetsStandsSideBySideAndWhatDoesNotSharesAPlace) {
    Tracks tracks;
    tracks.add(1, 7, 0, 100, Tracks::Side::left);
    tracks.add(1, 8, 50, 90, Tracks::Side::left);
    tracks.add(1, 9, 150, 200, Tracks::Side::left);
    tracks.assign(3);
    EXPECT_NE(tracks.x(1, 7), tracks.x(1, 8));
    EXPECT_EQ(tracks.x(1, 8), tracks.x(1, 9));
    EXPECT_EQ(tracks.width(0), 0);
    EXPECT_GT(tracks.width(1), tracks.x(1, 7));
}

TEST(GraphFont, IsAsWideAsTheWidestUsualFont) {
    EXPECT_DOUBLE_EQ(text_width("iii", 10), 3 * 6.02);  // a monospaced one
    EXPECT_DOUBLE_EQ(text_width("WWW", 10), 3 * 9.89);  // a sans serif one
    EXPECT_GT(text_width("WWW", 10, true), text_width("WWW", 10));
}

TEST(GraphLayout, HelperStepsAreMarkedAndLinesKnowTheirWays) {
    const Compilation door = test::compiled(kSource);
    const Picture picture = picture_of(model_of(door, kSource));
    ASSERT_EQ(picture.boxes.size(), 6U);
    EXPECT_EQ(picture.boxes[0].id, "s0");
    EXPECT_EQ(picture.lines.size(), 6U);  // POWER_UP, Shut, Open, Fault, Lost and the note
    for (const Picture::Line& line : picture.lines) EXPECT_GE(line.points.size(), 2U) << line.from;
    EXPECT_EQ(picture.scale, 1);
}

// The CRC-32 is zlib's over C0 00 00 01 80 01 00 00, C1 01 01 00 65 00 00 00, 3F 00 00 00 00 00 00 00.
TEST(Graph, IsTheTextWrittenByHand) {
    const Compilation small = test::compiled(
        "PROGRAM Tiny MOTOR MAC50; VAR_OUTPUT Lamp AT OUT0; END_VAR POWER_UP NEXT := Lit; END_POWER_UP\n"
        "STEP Lit: OWN ERROR; OUT Lamp; IF IN0 THEN STOP; NEXT := POWER_UP; END_IF END_STEP END_PROGRAM");
    const std::string expected =
        R"(digraph "Tiny" {
  graph [size="7.3,10.7", margin=0.2, nodesep=0.3, ranksep=0.3, labelloc=b, fontname="Helvetica", fontsize=9, label=<2 steps, 3 terms, CRC-32 FF6E6CDD>];
  node [fontname="Helvetica", fontsize=11, shape=box, style=filled, fillcolor="#ffffff", color="#333333", margin="0.06,0.04"];
  edge [color="#333333", arrowsize=0.7];
  subgraph cluster_table {
    graph [peripheries=0, fontsize=16, labelloc=t, label=<<B>Tiny</B><BR/><FONT POINT-SIZE="10">Motor: MAC50</FONT><BR/><FONT POINT-SIZE="10">OUT0 = Lamp</FONT>>];
    s0 [label=<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="2"><TR><TD COLSPAN="2"><FONT COLOR="#777777">0</FONT>  <B>POWER_UP</B></TD></TR><HR/><TR><TD ALIGN="LEFT">always<BR ALIGN="LEFT"/></TD><TD ALIGN="RIGHT" VALIGN="TOP"><FONT COLOR="#555555">  → 1 Lit</FONT></TD></TR></TABLE>>, peripheries=2];
    s1 [label=<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="2"><TR><TD COLSPAN="2"><FONT COLOR="#777777">1</FONT>  <B>Lit</B></TD></TR><HR/><TR><TD ALIGN="LEFT" COLSPAN="2">OUT Lamp</TD></TR><HR/><TR><TD ALIGN="LEFT">IN0<BR ALIGN="LEFT"/><FONT COLOR="#1f4e79">/ STOP</FONT><BR ALIGN="LEFT"/></TD><TD ALIGN="RIGHT" VALIGN="TOP"><FONT COLOR="#555555">  → 0 POWER_UP</FONT></TD></TR></TABLE>>];
    { rank=min; s0; }
    s0 -> s1;
    s1 -> s0 [color="#999999"];
  }
}
)";
    EXPECT_EQ(graph_of(small.table, &small.symbols, ""), expected);
}

TEST(Graph, NamesCannotBreakOut) {
    Symbols symbols;
    symbols.program = "P\"; x [label=\"\\";
    symbols.steps[0] = "<b>&\xFF\x01";
    symbols.inputs = {"Tür", "b", "c", "d", "e", "f"};
    symbols.outputs = {"a", "b", "c", "d"};
    const std::vector<std::uint8_t> table{0xC0, 1, 1, 1, 0x80, 0, 0, 0, 0x3F, 0, 0, 0, 0, 0, 0, 0};
    const std::string text = graph_of(table, &symbols, "");
    EXPECT_TRUE(text.starts_with("digraph \"P\\\"; x [label=\\\"\\\\\" {")) << text;
    EXPECT_NE(text.find("<B>&lt;b&gt;&amp;\xEF\xBF\xBD\xEF\xBF\xBD</B>"), std::string::npos) << text;
    EXPECT_NE(text.find(">Tür<"), std::string::npos) << text;
    const std::string svg = svg_of(picture_of(graph_model_of(table, &symbols, "")), symbols.program);
    EXPECT_NE(svg.find(">&lt;b&gt;&amp;\xEF\xBF\xBD\xEF\xBF\xBD</text>"), std::string::npos) << svg;
    EXPECT_NE(svg.find("<title>P&quot;; x [label=&quot;\\</title>"), std::string::npos) << svg;
}

TEST(DotText, BreaksLinesBetweenConditionsOnly) {
    EXPECT_EQ(wrapped("Start AND NOT Guard OR INPOS", 12),
              (std::vector<std::string>{"Start", "AND NOT Guard", "OR INPOS"}));
    EXPECT_EQ(wrapped("V1 := 3146; A1 := 81; STOP", 23),
              (std::vector<std::string>{"V1 := 3146; A1 := 81;", "STOP"}));
    EXPECT_EQ(wrapped("a, b", 99), std::vector<std::string>{"a, b"});
    EXPECT_EQ(wrapped("Guard OR NOT INPOS AND TIMER.Q", 26),
              (std::vector<std::string>{"Guard", "OR NOT INPOS AND TIMER.Q"}));
    EXPECT_TRUE(wrapped("", 10).empty());
}

// U+0041, U+00FC, U+20AC and U+1F600 are whole; an overlong A, half a surrogate, a cut character and FFh are
// not.
TEST(DotText, KeepsUtf8AndReplacesTheRest) {
    EXPECT_EQ(markup("Aü€😀"), "Aü€😀");
    const std::string bad = "\xEF\xBF\xBD";
    EXPECT_EQ(markup("\xC1\x81"), bad + bad);
    EXPECT_EQ(markup("\xED\xA0\x80"), bad + bad + bad);
    EXPECT_EQ(markup("\xE2\x82"), bad + bad);
    EXPECT_EQ(markup("\xFF\t\x7F"), bad + bad + bad);
    EXPECT_EQ(quoted("a\"\\\nb"), "\"a\\\"\\\\" + bad + "b\"");
}

}  // namespace
}  // namespace nplc::seqc
