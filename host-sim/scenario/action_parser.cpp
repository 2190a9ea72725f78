#include "action_parser.h"

#include <fmt/format.h>

namespace nplc::sim {
namespace {

constexpr std::string_view kActions =
    "an action: IN0 := 1, pulse IN0 50 ms, toggle IN0, line ..., motor ..., gateway ..., seed, log or end";

}  // namespace

Actions ActionParser::actions() {
    Actions list;
    Time after{0};
    do {
        if (reader_.take("after")) after += reader_.duration("a time after after");
        action(list, after);
    } while (reader_.take(","));
    return list;
}

void ActionParser::action(Actions& list, Time after) {
    if (reader_.take("pulse")) return pulse(list, after);
    if (reader_.take("toggle"))
        return add(list, after, action::ToggleInput{conditions_.input("an input to toggle")});
    if (reader_.take("line")) return line(list, after);
    if (reader_.take("motor")) return motor(list, after);
    if (reader_.take("gateway")) return gateway(list, after);
    if (reader_.take("seed")) return seed(list, after);
    if (reader_.take("log")) return log(list, after);
    if (reader_.take("end")) return add(list, after, action::End{});
    set_input(list, after);
}

void ActionParser::set_input(Actions& list, Time after) {
    if (reader_.peek().kind == Token::Kind::word && !reader_.is(":=", 1)) check_known_word();
    const unsigned index = conditions_.input(kActions);
    reader_.want(":=", ":= and the level, such as IN0 := 1");
    add(list, after, action::SetInput{index, conditions_.level()});
}

/// A first word that is no signal most likely is a misspelt statement.
void ActionParser::check_known_word() {
    if (conditions_.knows(reader_.peek().text)) return;
    throw LineMistake{
        fmt::format("\"{}\" is not known here; write at, every, when, once, expect, always, never, end or {}",
                    reader_.peek().text, kActions)};
}

void ActionParser::pulse(Actions& list, Time after) {
    const unsigned index = conditions_.input("an input, such as pulse IN0 50 ms");
    reader_.take("for");
    const Time length = reader_.duration("how long, such as pulse IN0 50 ms");
    if (length <= Time{0}) throw LineMistake{"a pulse must be longer than 0; write such as pulse IN0 50 ms"};
    add(list, after, action::SetInput{index, true});
    add(list, after + length, action::SetInput{index, false});
}

void ActionParser::line(Actions& list, Time after) {
    if (reader_.take("cut")) return add(list, after, action::CutLine{true});
    if (reader_.take("restored")) return add(list, after, action::CutLine{false});
    action::SpoilLine spoil;
    line_direction(spoil);
    if (reader_.take("clean")) {
        spoil.drop = spoil.damage = spoil.framing = spoil.delay = 0;
        return add(list, after, spoil);
    }
    if (!fault(spoil)) {
        reader_.fail(
            "line cut, line restored, line clean, or drop, damage, framing, delay and a share, such as line "
            "drop 1 %");
    }
    while (fault(spoil)) {
    }
    add(list, after, spoil);
}

void ActionParser::line_direction(action::SpoilLine& spoil) {
    constexpr std::string_view kUse = "line to motor, or line from motor";
    if (reader_.take("to")) {
        reader_.want("motor", kUse);
        spoil.from_motor = false;
    } else if (reader_.take("from")) {
        reader_.want("motor", kUse);
        spoil.to_motor = false;
    }
}

bool ActionParser::fault(action::SpoilLine& spoil) {
    constexpr std::string_view kShare = "a share, such as 1 %";
    if (reader_.take("drop")) {
        spoil.drop = reader_.percent(kShare);
    } else if (reader_.take("damage")) {
        spoil.damage = reader_.percent(kShare);
    } else if (reader_.take("framing")) {
        spoil.framing = reader_.percent(kShare);
    } else if (reader_.take("delay")) {
        spoil.delay = reader_.percent(kShare);
        if (reader_.take("up")) {
            reader_.want("to", "up to and a time, such as delay 1 % up to 5 ms");
            spoil.longest_delay = reader_.duration("a time, such as delay 1 % up to 5 ms");
        }
    } else {
        return false;
    }
    return true;
}

void ActionParser::gateway(Actions& list, Time after) {
    if (reader_.take("stop")) return add(list, after, action::Gateway::stop);
    if (reader_.take("run")) return add(list, after, action::Gateway::run);
    reader_.want("restart", "gateway stop, gateway run, or gateway restart");
    add(list, after, action::Gateway::restart);
}

void ActionParser::seed(Actions& list, Time after) {
    const double number = reader_.number("a whole number, such as seed 7");
    if (number < 0 || number > UINT32_MAX ||
        number != static_cast<double>(static_cast<std::uint64_t>(number))) {
        throw LineMistake{"a seed is a whole number 0 to 4294967295"};
    }
    add(list, after, action::Seed{static_cast<std::uint64_t>(number)});
}

void ActionParser::log(Actions& list, Time after) {
    if (reader_.peek().kind != Token::Kind::text)
        reader_.fail("a text in quotes, such as log \"door opens\"");
    add(list, after, action::Log{std::string(reader_.next().text)});
}

}  // namespace nplc::sim
