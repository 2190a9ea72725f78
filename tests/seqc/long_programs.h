#pragma once

#include <functional>
#include <string>
#include <vector>

namespace nplc::seqc::test {

/// Writes something many times.
struct Many {
    int count;

    std::string operator()(const std::function<std::string(int)>& part) const {
        std::string text;
        for (int i = 0; i < count; ++i) text += part(i);
        return text;
    }
    std::string operator()(const std::string& part) const {
        return (*this)([&](int) { return part; });
    }
};

inline std::string in_step(const std::string& body) {
    return "PROGRAM P MOTOR MAC140;\nSTEP S: OWN ERROR; " + body + " END_STEP END_PROGRAM\n";
}

inline std::string at_top(const std::string& body) {
    return "PROGRAM P MOTOR MAC140;\n" + body + " STEP S: OWN ERROR; END_STEP END_PROGRAM\n";
}

inline std::string text_of(int i) {
    return std::to_string(i);
}

struct Long {
    std::string what;
    std::string source;
    std::string codes = {};  ///< first of them; "" for whatever comes
};

/// Each `count` parts long of something.
inline std::vector<Long> long_programs(int count) {
    const Many many{count};
    const std::string bytes = "TERM 16#C0, 16#01, 16#01, 16#02, 16#41, 16#01, 16#F4, 16#01;";
    return {
        {"TERM lines", "PROGRAM P " + many(bytes + "\n") + "END_PROGRAM", "W010"},
        {"TERMs on one line", "PROGRAM P " + many(bytes) + "END_PROGRAM", "W010"},
        {"TERMs in symbols", in_step(many("TERM IF IN0 THEN OUT OUT0; NEXT := S; END_IF;\n")), "E086"},
        {"ELSIF", in_step("IF IN0 THEN NEXT := S; " + many("ELSIF IN1 THEN NEXT := S;\n") + "END_IF"),
         "W001"},
        {"ELSIF that differ",
         in_step("IF IN0 THEN NEXT := S; " + many([](int i) {
                     return "ELSIF IN1 THEN EVERY_SCAN V_SOLL := " + text_of(i % 99) + ";\n";
                 }) +
                 "END_IF"),
         "W001"},
        {"IFs alike", in_step(many("IF IN1 THEN NEXT := S; END_IF\n"))},
        {"IFs that differ", in_step(many([](int i) {
             return "IF IN1 THEN EVERY_SCAN V_SOLL := " + text_of(i % 9000) + "; END_IF\n";
         })),
         "E070"},
        {"steps", at_top(many([](int i) { return "STEP T" + text_of(i) + ": OWN ERROR; END_STEP\n"; })),
         "E083"},
        {"steps with numbers", at_top(many([](int i) {
             return "STEP T" + text_of(i) + " AT " + text_of(i % 62) + ": END_STEP\n";
         })),
         "E095"},
        {"unknown steps",
         in_step(many([](int i) { return "IF IN0 THEN NEXT := Q" + text_of(i) + "; END_IF\n"; })), "E021"},
        {"unknown commands",
         in_step("IF IN0 THEN " + many([](int i) { return "Foo" + text_of(i) + "; "; }) +
                 "NEXT := S; END_IF"),
         "E021"},
        {"faulty variables",
         at_top("VAR_INPUT " + many([](int i) { return "A" + text_of(i) + " AT Q; "; }) +
                "END_VAR STEP T: OUT W WHEN IN0" + many([](int i) { return " OR A" + text_of(i); }) +
                "; END_STEP"),
         "E022"},
        {"commands", in_step("IF IN0 THEN " + many("EVERY_SCAN STOP; ") + "END_IF"), "E086"},
        {"commands of POWER_UP", at_top("POWER_UP " + many("V_SOLL := 1; ") + "NEXT := S; END_POWER_UP"),
         "E086"},
        {"ENTRY",
         at_top("ON ERROR NEXT := F; STEP F: OWN ERROR; " + many("ENTRY V_SOLL := 1; ") +
                "END_STEP STEP G: END_STEP STEP H: END_STEP"),
         "E086"},
        {"commands of many branches",
         in_step("IF IN0 THEN " + many("V_SOLL := 1; ").substr(0, 900 * 13) + "NEXT := S; ELSIF IN1 THEN " +
                 many("V_SOLL := 2; ").substr(0, 900 * 13) + "NEXT := S; END_IF"),
         "E060"},
        {"conditions", in_step("IF IN0" + many(" OR IN1 AND NOT IN2") + " THEN NEXT := S; END_IF")},
        {"parentheses", in_step("IF " + many("(")), "E013"},
        {"NOT", in_step("IF " + many("NOT ") + "IN0 THEN NEXT := S; END_IF"), "E013"},
        {"outputs", in_step(many("OUT OUT0 WHEN IN0 AND TIMER.Q;\n"))},
        {"a list of outputs", in_step("OUT OUT0" + many(", OUT0") + ";")},
        {"semicolons", in_step(many(";;;;;;;;;;"))},
        {"comments", at_top(many("(* a *) // b\n"))},
        {"comments in a condition",
         in_step("IF IN0" + many(" (* a *) OR IN1 // b\n") + " THEN NEXT := S; END_IF")},
        {"a name", at_top("STEP " + many("Name") + ": END_STEP"), "E080"},
        {"a number", in_step("EVERY_SCAN V_SOLL := " + many("9") + ";"), "E003"},
        {"a unit", in_step("EVERY_SCAN V_SOLL := 1 rev" + many("/s") + ";"), "E043"},
        {"groups", at_top(many([](int i) { return "GROUP G" + text_of(i) + ": S;\n"; })), "W034"},
        {"groups of groups", at_top("GROUP G0: S;\n" + many([](int i) {
                                        return "GROUP G" + text_of(i + 1) + ": G" + text_of(i) + ", G" +
                                               text_of(i) + ";\n";
                                    }) +
                                    "OUT OUT0 IN G" + text_of(count) + ";\n")},
        {"unknown steps of groups",
         at_top(many([](int i) { return "GROUP G" + text_of(i) + ": Q" + text_of(i) + ";\n"; })), "E021"},
        {"outputs of groups", at_top(many([](int i) {
             return "GROUP G" + text_of(i) + ": S;\nOUT OUT0 IN G" + text_of(i) + ";\n";
         }))},
        {"sequences", at_top(many([](int i) {
             return "SEQUENCE Q" + text_of(i) +
                    "() STEP A: OWN ERROR; IF IN0 THEN RETURN; END_IF END_STEP END_SEQUENCE\n";
         })),
         "W005"},
        {"unknown sequences",
         at_top("SEQUENCE Q() STEP A: OWN ERROR; IF IN0 THEN RETURN; END_IF END_STEP END_SEQUENCE STEP T: "
                "OWN ERROR; " +
                many([](int i) { return "IF IN0 THEN CALL W" + text_of(i) + "(); NEXT := S; END_IF\n"; }) +
                "END_STEP")},
        {"calls that differ",
         at_top("SEQUENCE Q(CONST W) STEP A: OWN ERROR; IF IN0 THEN TIMER := W; RETURN; END_IF END_STEP "
                "END_SEQUENCE STEP T: OWN ERROR; IF IN1 THEN NEXT := S; " +
                many([](int i) { return "ELSIF IN2 THEN CALL Q(" + text_of(i + 1) + " ms); NEXT := S;\n"; }) +
                "END_IF END_STEP"),
         "E083"},
        {"unknown constants",
         "PROGRAM P MOTOR MAC140;\n" + many([](int i) { return "CONST C" + text_of(i) + " := 1;\n"; }) +
             "STEP S: OWN ERROR; IF IN0 THEN " +
             many([](int i) { return "V_SOLL := W" + text_of(i) + ";\n"; }) + "END_IF END_STEP END_PROGRAM",
         "E021"},
        {"a word of foreign letters", many("\u00e9\u00e9\u00e9\u00e9"), "E001"},
        {"no words", "PROGRAM P " + many("\xFF "), "E001"},
        {"words", "PROGRAM P " + many("word "), "E010"},
    };
}

}  // namespace nplc::seqc::test
