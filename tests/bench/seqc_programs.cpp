#include "seqc_programs.h"

#include <array>
#include <vector>

namespace nplc::bench {
namespace {

constexpr unsigned kFill = 10;  // register values in POWER_UP that bring the table to its size

std::string name(unsigned step) {
    return "S" + std::to_string(step % (kFullSteps - 1));
}

std::string header() {
    return "PROGRAM Full\nMOTOR MAC140;\nSCALE 1 rev = 5 mm;\n"
           "VAR_INPUT A AT IN0 : BOOL; B AT IN1 : BOOL; C AT IN2 : BOOL; D AT IN3 : BOOL; E AT IN4 : BOOL; "
           "F AT IN5 : BOOL; END_VAR\n"
           "VAR_OUTPUT W AT OUT0 : BOOL; X AT OUT1 : BOOL; Y AT OUT2 : BOOL; Z AT OUT3 : BOOL; END_VAR\n"
           "VAR_MOTOR Home AT P1 := 0 mm; Place AT P2 := 60 mm; Fast AT V1 := 1500 rpm; Slow AT V2 := 200 "
           "rpm; "
           "Soft AT A1 := 20000 rpm/s; Weak AT T1 := 50 %peak; END_VAR\n"
           "ON ERROR NEXT := Fault;\n";
}

/// The ways of a step to go on: `a`, `b`, `c` are steps.
std::string body(unsigned kind, unsigned number) {
    const std::string a = name(number + 1);
    const std::string b = name(number + 2);
    const std::string c = name(number + 7);
    const std::string time = std::to_string(100 + number);
    switch (kind) {
        case 0:  // a move: guard, arrival, too late
            return "IF A OR B THEN STOP; NEXT := Fault;\nELSIF INPOS THEN TIMER := T#" + time +
                   "ms; NEXT := " + a + ";\nELSIF TIMER.Q THEN NEXT := " + b + "; END_IF\n";
        case 1:  // a selector of three bits
            return "IF A AND B AND C THEN NEXT := " + a + ";\nELSIF A AND B THEN NEXT := " + b +
                   ";\nELSIF B AND C THEN NEXT := " + c + ";\nELSIF A AND C THEN CLEAR_IN_POS; NEXT := " + a +
                   ";\nELSIF A THEN TIMER := T#" + time + "ms; NEXT := " + b + "; END_IF\n";
        case 2:  // lamps, and two out of three guards
            return "OUT Z WHEN D OR E; OUT Y WHEN F;\nIF A AND B OR A AND C OR B AND C THEN STOP; "
                   "CLEAR_IN_POS; NEXT := " +
                   a + ";\nELSIF D AND NOT E THEN NEXT := " + b + "; END_IF\n";
        case 3:  // counting
            return "IF A AND NOT B THEN COUNT_DOWN; NEXT := " + a +
                   ";\nELSIF C XOR D THEN COUNTER := " + time + "; NEXT := " + b +
                   ";\nELSIF COUNTER.Q THEN NEXT := " + c + "; END_IF\n";
        case 4:  // two-hand start with a time limit
            return "IF A AND B AND NOT C THEN VELOCITY(Fast, Soft); NEXT := " + a +
                   ";\nELSIF NOT A AND NOT B THEN NEXT := " + b + ";\nELSIF TIMER.Q THEN NEXT := " + c +
                   "; END_IF\n";
        case 5:  // an XOR of three with a command
            return "IF A XOR B XOR C THEN USE_SET(2); NEXT := " + a +
                   ";\nELSIF E AND INPOS THEN INPOSWIN := 20; USE_SET(1); NEXT := " + b + "; END_IF\n";
        default:  // everything has an ELSE
            return "IF A AND B AND C AND D THEN RESET_ERROR; TIMER := T#" + time +
                   "ms; COUNTER := 3; NEXT := " + a +
                   ";\nELSIF E OR F AND INPOS THEN V_SOLL := 100; NEXT := " + b +
                   ";\nELSE CLEAR_P_IST; NEXT := " + c + "; END_IF\n";
    }
}

std::string entry(unsigned number) {
    static const std::array<const char*, 5> kEntries = {
        "ENTRY POSITION(Place);\n", "", "ENTRY INIT(Slow, Soft, Weak);\n",
        "ENTRY CLEAR_IN_POS;\nENTRY USE_SET(1);\nENTRY POSITION(Home);\n", "ENTRY CLEAR_P_IST;\n"};
    return kEntries[number % kEntries.size()];
}

std::string outputs(unsigned number) {
    static const std::array<const char*, 4> kOutputs = {"OUT W;\n", "OUT X;\n", "OUT W, X;\n", ""};
    return kOutputs[number * 7 / 3 % kOutputs.size()];
}

std::string fault() {
    return "STEP Fault:\nOWN ERROR;\nIF ANY ERROR AND F THEN RESET_ERROR; NEXT := POWER_UP; "
           "END_IF\nEND_STEP\n";
}

std::string machine_header(unsigned units) {
    std::string moving;
    for (unsigned unit = 0; unit < units; ++unit) {
        const std::string n = std::to_string(unit);
        moving += (unit == 0 ? "Move" : ", Move") + n + ", Back" + n;
    }
    return "PROGRAM Machine\nMOTOR MAC140;\nSCALE 1 rev = 5 mm;\n"
           "CONST Pitch := 120 mm / 2;\nCONST Limit := T#3s;\nCONST Settled := T#200ms;\n"
           "VAR_INPUT Start AT IN0 : BOOL; Guard AT IN1 : BOOL; Ack AT IN2 : BOOL; Shut AT IN3 : BOOL; "
           "END_VAR\n"
           "VAR_OUTPUT Lamp AT OUT0 : BOOL; Clamp AT OUT1 : BOOL; Valve AT OUT2 : BOOL; Alarm AT OUT3 : "
           "BOOL; "
           "END_VAR\n"
           "VAR_MOTOR Home AT P1 := 0 mm; Place AT P2 := Pitch; Fast AT V1 := 1500 rpm; "
           "Soft AT A1 := 20000 rpm/s; END_VAR\n"
           "ON ERROR NEXT := Fault;\nGROUP Moving: " +
           moving +
           ";\nON Guard IN Moving NEXT := Fault;\nOUT Alarm IN Fault;\n"
           "SEQUENCE Close(VAR_OUTPUT Jaw, VAR_INPUT Closed, CONST Time)\nSTEP Closing:\nENTRY SET Jaw;\n"
           "IF Closed WITHIN Time THEN RETURN; ELSE NEXT := Fault; END_IF\nEND_STEP\nEND_SEQUENCE\n"
           "POWER_UP\nINIT(Fast, Soft);\nNEXT := Wait;\nEND_POWER_UP\n"
           "STEP Wait:\nIF Start AND NOT Guard THEN NEXT := Move0; END_IF\nEND_STEP\n";
}

std::string machine_unit(unsigned unit, const std::string& next) {
    const std::string n = std::to_string(unit), time = std::to_string(10 + unit);
    return "STEP Move" + n + ":\nENTRY POSITION(Place);\nIF INPOS WITHIN Limit + T#" + time +
           "ms THEN NEXT := Press" + n + "; ELSE NEXT := Fault; END_IF\nEND_STEP\nSTEP Press" + n +
           ":\nOUT Lamp;\nENTRY SET Clamp;\nIF R_TRIG(Start) THEN NEXT := Hold" + n +
           "; END_IF\nEND_STEP\nSTEP Hold" + n +
           ":\nIF Shut AND NOT Start FOR Settled THEN CALL Close(Valve, Shut, 2 * T#" + time +
           "ms); NEXT := Back" + n + "; END_IF\nEND_STEP\nSTEP Back" + n +
           ":\nENTRY POSITION(Home);\nOUT Lamp BLINKING T#500ms;\n"
           "IF INPOS THEN RESET Clamp, Valve; NEXT := " +
           next + ";\nELSIF F_TRIG(Ack) THEN NEXT := Fault; END_IF\nEND_STEP\n";
}

}  // namespace

std::string machine_program(unsigned units, unsigned rests) {
    const auto rest = [&](unsigned n) { return n < rests ? "Rest" + std::to_string(n) : "Wait"; };
    std::string text = machine_header(units);
    for (unsigned unit = 0; unit < units; ++unit)
        text += machine_unit(unit, unit + 1 < units ? "Move" + std::to_string(unit + 1) : rest(0));
    for (unsigned n = 0; n < rests; ++n) {
        text += "STEP " + rest(n) + ":\nIF Shut WITHIN Limit THEN NEXT := " + rest(n + 1) +
                "; ELSE NEXT := Fault; END_IF\nEND_STEP\n";
    }
    return text +
           "STEP Fault:\nOWN ERROR;\nALLOW W037 BECAUSE 'Ack is a key';\nENTRY RESET Clamp, Valve;\nENTRY "
           "STOP;\n"
           "IF ANY ERROR AND Ack AND NOT Guard THEN RESET_ERROR; NEXT := POWER_UP; END_IF\nEND_STEP\n"
           "END_PROGRAM\n";
}

std::string full_program() {
    std::string text = header() + "POWER_UP\n";
    for (unsigned i = 0; i < kFill; ++i) text += "INPOSWIN := " + std::to_string(1 + i) + ";\n";
    text += "INIT(Fast, Soft);\nNEXT := S0;\nEND_POWER_UP\n";
    for (unsigned number = 0; number + 1 < kFullSteps; ++number) {
        text += "STEP " + name(number) + ":\n" + outputs(number) + entry(number) +
                body(number * 5 / 3 % 7, number) + "END_STEP\n";
    }
    return text + fault() + "END_PROGRAM\n";
}

std::string worst_program() {
    static const std::array<const char*, 6> kConditions = {
        "A AND B XOR C AND D XOR E AND F",
        "A XOR B XOR C AND D AND (TIMER.Q OR E)",
        "(A OR B) AND (C OR D) AND (E OR F) XOR INPOS AND COUNTER.Q",
        "A AND B OR C AND D OR E AND F XOR A AND INPOS",
        "A XOR B XOR C XOR D",
        "A AND B AND C XOR D AND E AND F XOR INPOS",
    };
    std::string text = header();
    for (unsigned number = 0; number + 1 < kFullSteps; ++number) {
        text += "STEP " + name(number) + ":\nOUT W;\n";
        if (number < 40)
            text += "IF " + std::string(kConditions[number % kConditions.size()]) +
                    " THEN NEXT := " + name(number + 1) +
                    ";\nELSIF A AND NOT C OR D AND NOT F THEN NEXT := Fault; END_IF\n";
        else
            text += "IF A THEN NEXT := " + name(number + 1) + "; END_IF\n";
        text += "END_STEP\n";
    }
    return text + fault() + "END_PROGRAM\n";
}

}  // namespace nplc::bench
