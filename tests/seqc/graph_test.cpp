// The drawing as text for Graphviz; what Graphviz makes of it is checked by graph_test.py.
#include "views/graph.h"

#include <gtest/gtest.h>

#include "support.h"
#include "views/graph_model.h"

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

TEST(GraphModel, SaysWhatAPersonNeeds) {
    const Compilation door = test::compiled(kSource);
    const GraphModel model = graph_model_of(door.table, &door.symbols, "file");
    EXPECT_EQ(model.title, "Door");
    EXPECT_EQ(model.motor, "MAC140");
    ASSERT_EQ(model.boxes.size(), 5U);
    EXPECT_EQ(model.boxes[0].entry, "V1 := 1000");
    EXPECT_EQ(model.boxes[1].outputs, std::vector<std::string>{"OUT Lamp"});
    EXPECT_EQ(model.boxes[2].outputs, std::vector<std::string>{"OUT Horn WHEN Key"});
    ASSERT_EQ(model.boxes[2].every_scan.size(), 1U);
    EXPECT_EQ(model.boxes[2].every_scan[0].condition, "NOT Start AND NOT TIMER.Q");
    EXPECT_EQ(model.boxes[2].every_scan[0].actions, "COUNT_DOWN");
    EXPECT_EQ(model.boxes[3].entry, "ENTRY STOP");
    EXPECT_TRUE(model.boxes[3].reachable);
    EXPECT_FALSE(model.boxes[4].reachable);
    ASSERT_EQ(model.notes.size(), 1U);  // POWER_UP, Shut and Open
    EXPECT_EQ(model.notes[0].where, "in every other step but Lost");
    EXPECT_EQ(model.notes[0].actions, "");
    ASSERT_EQ(model.arrows.size(), 5U);
    EXPECT_EQ(model.arrows[0].ways[0].actions, "INIT(V1)");
    EXPECT_EQ(model.arrows[1].ways[0].condition, "Start");
    EXPECT_EQ(model.arrows[1].ways[0].actions, "VELOCITY(V1); TIMER := T#500ms");
    EXPECT_EQ(model.arrows[3].ways[0].condition, "ANY ERROR AND Key");
}

TEST(GraphModel, FewWaysOnErrorAreArrows) {
    const Compilation two = test::compiled(
        "PROGRAM P POWER_UP NEXT := A; END_POWER_UP ON ERROR NEXT := B; STEP A: END_STEP STEP B: OWN ERROR; "
        "END_STEP "
        "END_PROGRAM");
    const GraphModel model = graph_model_of(two.table, &two.symbols, "");
    EXPECT_TRUE(model.notes.empty());
    ASSERT_EQ(model.arrows.size(), 3U);
    EXPECT_TRUE(model.arrows[1].on_error);
}

// The CRC-32 is zlib's over C0 00 00 01 80 01 00 00, C1 01 01 00 65 00 00 00, 3F 00 00 00 00 00 00 00.
TEST(Graph, IsTheTextWrittenByHand) {
    const Compilation small = test::compiled(
        "PROGRAM Tiny MOTOR MAC50; VAR_OUTPUT Lamp AT OUT0; END_VAR POWER_UP NEXT := Lit; END_POWER_UP\n"
        "STEP Lit: OWN ERROR; OUT Lamp; IF IN0 THEN STOP; NEXT := POWER_UP; END_IF END_STEP END_PROGRAM");
    const std::string expected =
        R"(digraph "Tiny" {
  graph [size="7.3,10.7", margin=0.2, nodesep=0.4, ranksep=0.4, labelloc=b, fontname="Helvetica", fontsize=9, label=<2 steps, 3 terms, CRC-32 FF6E6CDD>];
  node [fontname="Helvetica", fontsize=11, shape=box, style=filled, fillcolor="#ffffff", color="#333333", margin="0.08,0.04"];
  edge [fontname="Helvetica", fontsize=10, color="#333333", arrowsize=0.7];
  subgraph cluster_table {
    graph [peripheries=0, fontsize=16, labelloc=t, label=<<B>Tiny</B>  MAC50>];
    { rank=min; s0; }
    s0 [label=<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="1"><TR><TD><FONT COLOR="#777777">0</FONT>  <B>POWER_UP</B></TD></TR></TABLE>>, peripheries=2];
    s1 [label=<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="1"><TR><TD><FONT COLOR="#777777">1</FONT>  <B>Lit</B></TD></TR><HR/><TR><TD ALIGN="LEFT">OUT Lamp</TD></TR></TABLE>>];
    s0 -> s1 [label=<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="1"><TR><TD ALIGN="LEFT">always</TD></TR></TABLE>>];
    s1 -> s0 [label=<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="1"><TR><TD ALIGN="LEFT">IN0</TD></TR><TR><TD ALIGN="LEFT"><FONT COLOR="#1f4e79">/ STOP</FONT></TD></TR></TABLE>>];
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
}

TEST(Graph, TooManySwitchesGoWithoutLabels) {
    std::vector<std::uint8_t> table;
    for (std::uint8_t from = 0; from < 20; ++from) {  // 20 x 19 arrows
        for (std::uint8_t to = 0; to < 20; ++to) {
            if (to != from)
                table.insert(table.end(),
                             {static_cast<std::uint8_t>(0xC0 | from), to, 0x3F, to, 0x80, 0, 0, 0});
        }
    }
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    const std::string text = graph_of(table, nullptr, "t");
    EXPECT_NE(text.find("too many switches"), std::string::npos);
    EXPECT_NE(text.find("s3 -> s17 [label=\"\""), std::string::npos);
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
