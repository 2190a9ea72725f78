#include <fmt/format.h>

#include "parser.h"

namespace nplc::sim {
namespace {

using Kind = Expectation::Kind;

}  // namespace

Expectation ExpectationParser::expectation(std::optional<Time> at) {
    Expectation result;
    reader_.take("expect");
    const std::size_t begin = at ? 0 : reader_.mark();
    if (at) {
        moment_begin_ = reader_.time_begin();
        result.time = at;
        held_condition(result);
    } else if (reader_.take("always")) {
        always(result, false);
    } else if (reader_.take("never")) {
        always(result, true);
    } else if (reader_.take("eventually")) {
        result.kind = Kind::by;
        held_condition(result);
        if (reader_.take("by")) result.time = moment("a time after by");
    } else if (reader_.take("at")) {
        at_time(result);
        held_condition(result);
    } else {
        event_or_condition(result);
    }
    result.text = reader_.source_since(begin);
    return result;
}

Time ExpectationParser::moment(std::string_view what_to_write) {
    const Time time = reader_.duration(what_to_write);
    moment_begin_ = reader_.time_begin();
    return time;
}

/// Lamp falls within 200 ms after IN0 rises
void ExpectationParser::refuse_awaited_change(const Event& event) const {
    if (!reader_.is("within") && !(reader_.starts_duration() && !starts_count())) return;
    const std::string_view state = std::string_view(event.text).substr(0, event.text.find_last_of(' ') + 1);
    const bool is_known = event.edge == Event::Edge::rises || event.edge == Event::Edge::falls;
    reader_.refuse_next(fmt::format(
        "a change is counted, and a state is awaited; write expect {}within 200 ms after and what happens",
        !is_known                          ? "Lamp "
        : event.edge == Event::Edge::falls ? fmt::format("not {}", state)
                                           : std::string(state)));
}

void ExpectationParser::held_condition(Expectation& result) {
    result.condition = conditions_.condition();
    result.hold = reader_.lasting();
}

void ExpectationParser::always(Expectation& result, bool never) {
    result.condition = conditions_.condition();
    if (never) {
        result.condition = {.kind = Condition::Kind::negated,
                            .value = {},
                            .order = {},
                            .parts = {std::move(result.condition)}};
    }
    all_the_time(result);
}

void ExpectationParser::all_the_time(Expectation& result) {
    result.kind = Kind::always;
    take_window(result);
}

void ExpectationParser::take_window(Expectation& result) {
    const Window window = reader_.window();
    moment_begin_ = reader_.time_begin();
    result.from = window.from;
    result.time = window.until;
}

void ExpectationParser::at_time(Expectation& result) {
    if (!reader_.take("end")) result.time = moment("a time or end, such as expect at 3 s step = 0");
}

void ExpectationParser::event_or_condition(Expectation& result) {
    Event event = conditions_.event();
    if (event.edge != Event::Edge::true_now || starts_count()) {
        refuse_awaited_change(event);
        result.event = std::move(event);
        return count(result);
    }
    result.condition = std::move(event.condition);
    result.hold = event.span;
    if (reader_.take("at")) {
        at_time(result);
    } else if (reader_.take("by")) {
        result.kind = Kind::by;
        result.time = moment("a time after by");
    } else if (reader_.take("within")) {
        result.kind = Kind::within;
        after_event(result);
    } else if (reader_.starts_duration()) {
        result.kind = Kind::after;
        after_event(result);
    } else if (result.hold != Time{0} && reader_.take("after")) {
        result.kind = Kind::during;
        result.span = result.hold;
        result.hold = Time{0};
        of_event(result);
    } else if (reader_.is("from") || reader_.is("until")) {
        if (result.hold != Time{0})
            reader_.refuse_next("this has for and from or until; write one of them, or by and a time");
        all_the_time(result);
    }
}

void ExpectationParser::after_event(Expectation& result) {
    result.span = reader_.duration("a time, such as within 200 ms after IN0 rises");
    reader_.want("after", "after and what happens, such as within 200 ms after IN0 rises");
    of_event(result);
}

void ExpectationParser::of_event(Expectation& result) {
    result.event = conditions_.event();
    take_window(result);
}

bool ExpectationParser::starts_count() const {
    if (reader_.is("at")) return reader_.is("least", 1) || reader_.is("most", 1);
    return reader_.starts_times();
}

void ExpectationParser::count(Expectation& result) {
    result.kind = Kind::count;
    if (reader_.take("at")) {
        const bool least = reader_.take("least");
        if (!least) reader_.want("most", "at least 3 times, or at most 3 times");
        const std::uint64_t times = reader_.times();
        (least ? result.least : result.most) = times;
        if (!least) result.least = 0;
    } else if (reader_.peek().kind == Token::Kind::number) {
        result.least = result.most = reader_.times();
    }
    if (reader_.take("by")) {
        result.time = moment("a time after by");
    } else {
        take_window(result);
    }
}

}  // namespace nplc::sim
