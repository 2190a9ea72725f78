#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "parser.h"
#include "sim/scenario.h"
#include "text/edit_distance.h"

namespace nplc::sim {
namespace {

constexpr std::size_t kLongestLine = 1'000'000;
constexpr std::size_t kMostMistakes = 1000;  // a file with more is probably not a scenario

/// Statements of one line. Throws LineMistake.
class LineParser {
  public:
    /// `moments`: where in its line each expectation names its moment.
    LineParser(std::string_view text, int line, const Names& names, Scenario& scenario,
               std::vector<std::size_t>& moments)
        : reader_(text, names),
          conditions_(reader_, names),
          actions_(reader_, conditions_, scenario.recipes),
          line_(line),
          scenario_(scenario),
          moments_(moments) {}

    void parse() {
        if (reader_.at_end()) return;
        statement();
        if (!reader_.at_end()) reader_.fail("one statement in a line, actions separated by commas");
    }

  private:
    void statement() {
        if (reader_.is(":=", 1)) return at_beginning();
        if (reader_.is("follows", 1)) return follows();
        if (reader_.is("appears", 1)) return comes(true);
        if (reader_.is("disappears", 1)) return comes(false);
        if (reader_.take("at")) return at();
        if (reader_.take("every")) return every();
        if (reader_.take("when")) return when(false);
        if (reader_.take("once")) return when(true);
        if (reader_.is("expect") || reader_.is("always") || reader_.is("never")) return expect();
        if (reader_.take("end")) return end();
        if (reader_.is("motor") && reader_.is("plant", 1)) return plant();
        if (reader_.is("motor") && reader_.is(":=", 2)) {
            reader_.next();
            scenario_.registers.push_back(actions_.stored_register());
            return;
        }
        at_beginning();
    }

    void at_beginning() { scenario_.at.push_back({Time{0}, actions_.actions(), line_}); }

    /// motor plant "axis.toml"
    void plant() {
        reader_.next();
        reader_.next();
        const std::string why = why_without(DrivePart::plant, conditions_.names());
        if (!why.empty()) reader_.refuse(why);
        if (scenario_.plant) reader_.refuse("the scenario has a plant already; keep one of the two");
        if (reader_.peek().kind != Token::Kind::text || reader_.peek().text.empty())
            reader_.fail("the file in quotes, such as motor plant \"axis.toml\"");
        scenario_.plant = NamedPlant{std::string(reader_.next().text), line_};
    }

    void at() {
        const Time time = reader_.duration("a time, such as at 100 ms IN0 := 1");
        if (!reader_.is("expect")) {
            scenario_.at.push_back({time, actions_.actions(), line_});
            return;
        }
        expect(time);
    }

    void every() {
        EveryRule rule = period("every 500 ms pulse IN0 50 ms");
        rule.actions = actions_.actions();
        check_spans(rule);
        scenario_.every.push_back(std::move(rule));
    }

    /// Refuses an action that lasts as long as the period, since it would never be reversed.
    void check_spans(const EveryRule& rule) const {
        for (std::size_t i = 1; i < rule.actions.size(); ++i) {
            const Time span = rule.actions[i].after - rule.actions[i - 1].after;
            if (!rule.actions[i].takes_back || span < rule.period) continue;
            reader_.refuse_at(0,
                              fmt::format("it lasts {} and comes again every {}; make it shorter than that",
                                          in_words(span), in_words(rule.period)));
        }
    }

    EveryRule period(std::string_view example) {
        EveryRule rule;
        rule.line = line_;
        rule.period = reader_.duration(fmt::format("a time, such as {}", example));
        if (rule.period <= Time{0})
            reader_.refuse_time(fmt::format("a period must be longer than 0; write such as {}", example));
        const Window window = reader_.window(rule.period);
        rule.from = window.from;
        rule.until = window.until;
        return rule;
    }

    void when(bool once) {
        WhenRule rule = begin_when(once);
        rule.actions = actions_.actions();
        scenario_.when.push_back(std::move(rule));
    }

    WhenRule begin_when(bool once) {
        WhenRule rule;
        rule.event = conditions_.event();
        rule.once = once;
        if (once && reader_.starts_times()) rule.times = times();
        rule.line = line_;
        const Window window = reader_.window();
        rule.from = window.from;
        rule.until = window.until;
        return rule;
    }

    std::uint64_t times() {
        const std::uint64_t times = reader_.times();
        if (times == 0) reader_.refuse("an event is awaited once or more often, such as 2 times");
        return times;
    }

    void end() {
        if (conditions_.names().motor_alone)
            reader_.refuse("this runs until it is stopped; leave the end out");
        if (reader_.take("when")) {
            WhenRule rule = begin_when(true);
            Time after{0};
            if (reader_.take("after")) after = reader_.duration("a time after after");
            rule.actions.push_back({after, action::End{}});
            scenario_.when.push_back(std::move(rule));
            return;
        }
        reader_.want("at", "end at 10 s, or end when step = 3");
        if (scenario_.end) reader_.refuse("the scenario has an end already; keep one of the two");
        scenario_.end = reader_.duration("a time, such as end at 10 s");
    }

    void expect(std::optional<Time> at = {}) {
        if (conditions_.names().motor_alone)
            reader_.refuse_next("expectations are not checked here; rehearse the scenario with nanoplc-sim");
        ExpectationParser parser(reader_, conditions_);
        scenario_.expectations.push_back(parser.expectation(at));
        scenario_.expectations.back().line = line_;
        moments_.push_back(parser.moment_begin());
    }

    void check_inputs() const {
        if (conditions_.names().motor_alone)
            reader_.refuse_next(
                "here is the motor alone, without a gateway's inputs; write what happens to the motor");
    }

    // --- the plant ----------------------------------------------------------------------------------------

    /// Clamped follows Clamp after 300 ms back after 100 ms
    void follows() {
        check_inputs();
        FollowRule rule;
        const Terminal input = conditions_.input("an input, such as IN2 follows OUT0 after 300 ms");
        rule.input = input.index;
        rule.inverted = input.inverted;
        rule.line = line_;
        reader_.next();
        rule.condition = conditions_.condition();
        if (rule.condition.kind == Condition::Kind::compare &&
            rule.condition.value.kind == Value::Kind::input && rule.condition.value.index == rule.input)
            reader_.refuse("an input that follows itself never changes; name what it follows, such as OUT0");
        if (reader_.take("after")) rule.after = reader_.duration("a time, such as after 300 ms");
        rule.back = rule.after;
        if (reader_.take("back")) {
            reader_.want("after", "back after and a time, such as back after 100 ms");
            rule.back = reader_.duration("a time, such as back after 100 ms");
        }
        const auto same = [&](const FollowRule& other) { return other.input == rule.input; };
        if (std::any_of(scenario_.follow.begin(), scenario_.follow.end(), same))
            reader_.refuse("this input follows something already; put both into one condition with and, or");
        scenario_.follow.push_back(std::move(rule));
    }

    /// Part appears every 2 s, Part appears for 100 ms 300 ms after Feed rises, Part appears at 2 s
    void comes(bool level) {
        check_inputs();
        const Terminal input = conditions_.input("an input, such as IN2 appears every 2 s");
        reader_.next();
        const Actions actions = levels(input.index, input.level(level), reader_.lasting());
        if (reader_.take("every")) {
            EveryRule rule = period("IN2 appears every 2 s");
            rule.actions = actions;
            check_spans(rule);
            scenario_.every.push_back(std::move(rule));
            return;
        }
        if (reader_.take("at")) {
            const Time time = reader_.duration("a time, such as IN2 appears at 2 s");
            scenario_.at.push_back({time, actions, line_});
            return;
        }
        Time delay{0};
        if (reader_.starts_duration()) delay = reader_.duration("a time");
        reader_.want("after", "every 2 s, at 2 s, or 300 ms after and what happens");
        WhenRule rule = begin_when(false);
        for (const Action& action : actions)
            rule.actions.push_back({delay + action.after, action.what, action.takes_back});
        scenario_.when.push_back(std::move(rule));
    }

    static Actions levels(unsigned input, bool level, Time span) {
        Actions actions{{Time{0}, action::SetInput{input, level}}};
        if (span != Time{0}) actions.push_back({span, action::SetInput{input, !level}, true});
        return actions;
    }

    Reader reader_;
    ConditionParser conditions_;
    ActionParser actions_;
    int line_;
    Scenario& scenario_;
    std::vector<std::size_t>& moments_;
};

/// `columns`: of the moment in each expectation.
void check_expectation_times(ParsedScenario& parsed, const std::vector<int>& columns) {
    const Scenario& scenario = parsed.scenario;
    if (!scenario.end) return;
    for (std::size_t i = 0; i < scenario.expectations.size(); ++i) {
        const Expectation& expectation = scenario.expectations[i];
        const Time latest = expectation.time.value_or(expectation.from);
        if (latest <= *scenario.end) continue;
        parsed.mistakes.push_back(
            {.line = expectation.line,
             .column = columns[i],
             .message = fmt::format("this looks at {}, but the scenario ends at {}; move one of the two",
                                    in_words(latest), in_words(*scenario.end))});
    }
}

/// Refuses actions after the end, which would never be executed. An action that is not reversed before the
/// end is allowed.
void check_action_times(ParsedScenario& parsed) {
    const Scenario& scenario = parsed.scenario;
    if (!scenario.end) return;
    const auto check = [&](Time time, int line) {
        if (time <= *scenario.end) return;
        parsed.mistakes.push_back(
            {.line = line,
             .column = 1,
             .message = fmt::format("this happens at {}, but the scenario ends at {}; move one of the two",
                                    in_words(time), in_words(*scenario.end))});
    };
    for (const AtRule& rule : scenario.at) {
        const auto beyond = std::find_if(rule.actions.begin(), rule.actions.end(), [&](const Action& action) {
            return !action.takes_back && rule.time + action.after > *scenario.end;
        });
        if (beyond != rule.actions.end()) check(rule.time + beyond->after, rule.line);
    }
    for (const EveryRule& rule : scenario.every) check(rule.from, rule.line);
    for (const WhenRule& rule : scenario.when) check(rule.from, rule.line);
}

/// From 1, in characters.
int column_of(std::string_view line, std::size_t byte) {
    const std::string_view before = line.substr(0, std::min(byte, line.size()));
    const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
    return 1 + static_cast<int>(std::count_if(before.begin(), before.end(), begins));
}

bool is_of_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string_view letters_at(std::string_view text, std::size_t at) {
    const std::string_view rest = text.substr(std::min(at, text.size()));
    return rest.substr(
        0, static_cast<std::size_t>(std::find_if_not(rest.begin(), rest.end(), is_of_word) - rest.begin()));
}

/// Replaces the list of words in a message by the most similar one.
std::string with_guess(std::string_view line, const LineMistake& mistake) {
    constexpr std::string_view kOffer = "; write ";
    constexpr std::size_t kShortest = 3;
    const std::string_view wrong = letters_at(line, mistake.at);
    const std::size_t offer = mistake.message.find(kOffer);
    if (wrong.size() < kShortest || offer == std::string::npos) return mistake.message;
    const std::string_view offered = std::string_view(mistake.message).substr(offer + kOffer.size());
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < offered.size(); at += std::max<std::size_t>(words.back().size(), 1))
        words.push_back(letters_at(offered, at));
    const std::string_view meant = spelling::nearest(wrong, words);
    const bool is_numbered = std::isdigit(static_cast<unsigned char>(wrong.back())) != 0;  // a signal
    if (meant.empty() || same_name(meant, wrong) || is_numbered) return mistake.message;
    return fmt::format("{}; did you mean {}?", mistake.message.substr(0, offer), meant);
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

std::string Mistake::place() const {
    return column == 0 ? fmt::format("{}", line) : fmt::format("{}:{}", line, column);
}

std::string in_words(const std::string& file, const std::vector<Mistake>& mistakes) {
    constexpr std::size_t kMostShown = 20;
    std::string text;
    for (std::size_t i = 0; i < std::min(mistakes.size(), kMostShown); ++i)
        text +=
            fmt::format("{}{}:{}: {}", i == 0 ? "" : "\n", file, mistakes[i].place(), mistakes[i].message);
    if (mistakes.size() > kMostShown)
        text += fmt::format("\n{}: {}{} more mistakes", file, mistakes.size() - kMostShown,
                            mistakes.size() == kMostMistakes ? " or" : "");
    return text;
}

ParsedScenario parse_scenario(std::string_view text, const std::string& file, const Names& names) {
    ParsedScenario parsed;
    parsed.scenario.file = file;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    std::vector<std::size_t> moments;
    std::vector<int> columns;
    int number = 0;
    while (!text.empty()) {
        const auto length = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, length);
        ++number;
        try {
            if (length > kLongestLine) {
                throw LineMistake{
                    fmt::format("the line is longer than {} characters; write several", kLongestLine)};
            }
            LineParser(line, number, names, parsed.scenario, moments).parse();
        } catch (const LineMistake& mistake) {
            parsed.mistakes.push_back({number, column_of(line, mistake.at), with_guess(line, mistake)});
            if (parsed.mistakes.size() == kMostMistakes) return parsed;
        }
        while (columns.size() < moments.size()) columns.push_back(column_of(line, moments[columns.size()]));
        text.remove_prefix(std::min(length + 1, text.size()));
    }
    check_expectation_times(parsed, columns);
    check_action_times(parsed);
    std::stable_sort(parsed.mistakes.begin(), parsed.mistakes.end(),
                     [](const Mistake& a, const Mistake& b) { return a.line < b.line; });
    return parsed;
}

ParsedActions parse_actions(std::string_view line, const Names& names) try {
    std::vector<std::string> recipes;
    Reader reader(line, names);
    ConditionParser conditions(reader, names);
    ParsedActions parsed{.actions = ActionParser(reader, conditions, recipes).actions()};
    if (!reader.at_end()) reader.fail("actions separated by commas");
    return parsed;
} catch (const LineMistake& mistake) {
    return {.mistake = mistake.message};
}

}  // namespace nplc::sim
