#include <fmt/format.h>

#include <algorithm>

#include "parser.h"
#include "sim/scenario.h"

namespace nplc::sim {
namespace {

constexpr std::size_t kLongestLine = 1'000'000;

/// Statements of one line. Throws LineMistake.
class LineParser {
  public:
    LineParser(std::string_view text, int line, const Names& names, Scenario& scenario)
        : reader_(text),
          conditions_(reader_, names),
          actions_(reader_, conditions_),
          line_(line),
          scenario_(scenario) {}

    void parse() {
        if (reader_.at_end()) return;
        statement();
        if (!reader_.at_end()) reader_.fail("one statement in a line, actions separated by commas");
    }

  private:
    void statement() {
        if (reader_.take("at")) return at();
        if (reader_.take("every")) return every();
        if (reader_.take("when")) return when(false);
        if (reader_.take("once")) return when(true);
        if (reader_.take("expect")) return expect();
        if (reader_.is("always") || reader_.is("never")) return expect();
        if (reader_.take("end")) return end();
        scenario_.at.push_back({Time{0}, actions_.actions()});
    }

    void at() {
        const Time time = reader_.duration("a time, such as at 100 ms IN0 := 1");
        if (!reader_.take("expect")) {
            scenario_.at.push_back({time, actions_.actions()});
            return;
        }
        Expectation expectation = begin_expectation();
        expectation.condition = conditions_.condition();
        expectation.time = time;
        add(expectation);
    }

    void every() {
        EveryRule rule;
        rule.period = reader_.duration("a time, such as every 500 ms pulse IN0 50 ms");
        if (rule.period <= Time{0})
            throw LineMistake{"a period must be longer than 0; write such as every 500 ms"};
        rule.from = rule.period;
        if (reader_.take("from")) rule.from = reader_.duration("a time after from");
        if (reader_.take("until")) rule.until = reader_.duration("a time after until");
        rule.actions = actions_.actions();
        scenario_.every.push_back(std::move(rule));
    }

    void when(bool once) {
        WhenRule rule{.event = conditions_.event(), .once = once, .actions = {}, .line = line_};
        rule.actions = actions_.actions();
        scenario_.when.push_back(std::move(rule));
    }

    void end() {
        if (reader_.take("when")) {
            WhenRule rule{.event = conditions_.event(), .once = true, .actions = {}, .line = line_};
            Time after{0};
            if (reader_.take("after")) after = reader_.duration("a time after after");
            rule.actions.push_back({after, action::End{}});
            scenario_.when.push_back(std::move(rule));
            return;
        }
        reader_.want("at", "end at 10 s, or end when step = 3");
        if (scenario_.end) throw LineMistake{"the scenario has an end already; keep one of the two"};
        scenario_.end = reader_.duration("a time, such as end at 10 s");
    }

    // --- expectations -------------------------------------------------------------------------------------

    Expectation begin_expectation() {
        Expectation expectation;
        expectation.line = line_;
        return expectation;
    }

    void add(Expectation& expectation) {
        expectation.text = reader_.source_since(reader_.was_first("expect") ? 1 : 0);
        scenario_.expectations.push_back(expectation);
    }

    void expect() {
        Expectation expectation = begin_expectation();
        if (reader_.take("always")) {
            always(expectation, false);
        } else if (reader_.take("never")) {
            always(expectation, true);
        } else if (reader_.take("eventually")) {
            expectation.kind = Expectation::Kind::by;
            expectation.condition = conditions_.condition();
            if (reader_.take("by")) expectation.time = reader_.duration("a time after by");
        } else if (reader_.take("at")) {
            at_time(expectation);
            expectation.condition = conditions_.condition();
        } else {
            expect_event_or_condition(expectation);
        }
        add(expectation);
    }

    void always(Expectation& expectation, bool never) {
        expectation.kind = Expectation::Kind::always;
        expectation.condition = conditions_.condition();
        if (never) {
            expectation.condition = {.kind = Condition::Kind::negated,
                                     .value = {},
                                     .order = {},
                                     .parts = {std::move(expectation.condition)}};
        }
        if (reader_.take("from")) expectation.from = reader_.duration("a time after from");
        if (reader_.take("until")) expectation.time = reader_.duration("a time after until");
    }

    void at_time(Expectation& expectation) {
        if (!reader_.take("end"))
            expectation.time = reader_.duration("a time or end, such as expect at 3 s step = 0");
    }

    void expect_event_or_condition(Expectation& expectation) {
        Event event = conditions_.event();
        if (event.edge != Event::Edge::true_now) {
            expectation.event = std::move(event);
            count(expectation);
            return;
        }
        expectation.condition = std::move(event.condition);
        if (reader_.take("at")) {
            at_time(expectation);
        } else if (reader_.take("by")) {
            expectation.kind = Expectation::Kind::by;
            expectation.time = reader_.duration("a time after by");
        } else if (reader_.take("within")) {
            expectation.kind = Expectation::Kind::within;
            after_event(expectation);
        } else if (reader_.starts_duration()) {
            expectation.kind = Expectation::Kind::after;
            after_event(expectation);
        }
    }

    void after_event(Expectation& expectation) {
        expectation.span = reader_.duration("a time, such as within 200 ms after IN0 rises");
        reader_.want("after", "after and what happens, such as within 200 ms after IN0 rises");
        expectation.event = conditions_.event();
    }

    void count(Expectation& expectation) {
        expectation.kind = Expectation::Kind::count;
        if (reader_.take("at")) {
            const bool least = reader_.take("least");
            if (!least) reader_.want("most", "at least 3 times, or at most 3 times");
            const std::uint64_t times = number_of_times();
            (least ? expectation.least : expectation.most) = times;
            if (!least) expectation.least = 0;
        } else if (reader_.peek().kind == Token::Kind::number) {
            expectation.least = expectation.most = number_of_times();
        }
        if (reader_.take("by")) expectation.time = reader_.duration("a time after by");
    }

    std::uint64_t number_of_times() {
        const double number = reader_.number("a number of times");
        if (number < 0 || number != static_cast<double>(static_cast<std::uint32_t>(number))) {
            throw LineMistake{"a number of times is a whole number, such as 3 times"};
        }
        if (!reader_.take("times")) reader_.want("time", "times, such as 3 times");
        return static_cast<std::uint64_t>(number);
    }

    Reader reader_;
    ConditionParser conditions_;
    ActionParser actions_;
    int line_;
    Scenario& scenario_;
};

void check_expectation_times(ParsedScenario& parsed) {
    const Scenario& scenario = parsed.scenario;
    if (!scenario.end) return;
    for (const Expectation& expectation : scenario.expectations) {
        if (!expectation.time || *expectation.time <= *scenario.end) continue;
        parsed.mistakes.push_back(
            {expectation.line, fmt::format("this looks at {}, but the scenario ends at {}; move one "
                                           "of the two",
                                           in_words(*expectation.time), in_words(*scenario.end))});
    }
}

bool has_end(const Actions& actions) {
    return std::any_of(actions.begin(), actions.end(),
                       [](const Action& action) { return std::holds_alternative<action::End>(action.what); });
}

template <class Rules>
bool any_ends(const Rules& rules) {
    return std::any_of(rules.begin(), rules.end(), [](const auto& rule) { return has_end(rule.actions); });
}

}  // namespace

bool Scenario::can_end() const {
    return end || any_ends(at) || any_ends(every) || any_ends(when);
}

ParsedScenario parse_scenario(std::string_view text, const std::string& file, const Names& names) {
    ParsedScenario parsed;
    parsed.scenario.file = file;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    int number = 0;
    while (!text.empty()) {
        const auto length = std::min(text.find('\n'), text.size());
        ++number;
        try {
            if (length > kLongestLine) {
                throw LineMistake{
                    fmt::format("the line is longer than {} characters; write several", kLongestLine)};
            }
            LineParser(text.substr(0, length), number, names, parsed.scenario).parse();
        } catch (const LineMistake& mistake) {
            parsed.mistakes.push_back({number, mistake.message});
        }
        text.remove_prefix(std::min(length + 1, text.size()));
    }
    check_expectation_times(parsed);
    return parsed;
}

}  // namespace nplc::sim
