// The claim: a step that looks at no more than two inputs and either a third one or the timer, has at most
// four branches, and sends no order twice in one branch, takes as few terms as any table that does the same,
// whatever its tricks. Every table of fewer terms is tried, from the last term back.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "support.h"

namespace nplc::seqc {
namespace {

constexpr int kOwnStep = 1;
constexpr unsigned kLeastCases = 8;  // A, B, and C or the timer at zero
constexpr unsigned kSeeds = 120;

/// What a case requires; a preset of 0: none. Register values are orders with a "=" in them.
struct Wanted {
    int next = kOwnStep;
    int outputs = 0;  // with the counter's two bits
    bool demands_outputs = false;
    int timer = 0;
    int counter = 0;
    std::vector<std::string> sends;
};

struct Move {
    unsigned value = 0;
    unsigned care = 0;
    std::string order;
    int timer = 0;
    int counter = 0;
    bool is_fast = true;
};

struct CaseState {
    bool next = false;
    bool outputs = false;
    bool timer = false;
    bool counter = false;
    std::uint8_t to_send = 0;
};
using State = std::array<CaseState, kLeastCases>;

std::uint64_t packed(const State& state) {
    std::uint64_t key = 0;
    for (const CaseState& c : state) {
        key = key * 64 + c.to_send * 16U + (c.next ? 8U : 0U) + (c.outputs ? 4U : 0U) + (c.timer ? 2U : 0U) +
              (c.counter ? 1U : 0U);
    }
    return key;
}

/// How many different values there are, of a few.
template <class T>
class Few {
  public:
    void insert(const T& value) {
        if (std::find(values_.begin(), values_.begin() + used_, value) == values_.begin() + used_)
            values_.at(static_cast<std::size_t>(used_++)) = value;
    }
    int size() const { return static_cast<int>(used_); }

  private:
    std::array<T, 2 * kLeastCases> values_{};
    std::ptrdiff_t used_ = 0;
};

class Exhaustive {
  public:
    Exhaustive(const std::array<Wanted, kLeastCases>& wanted, bool with_timer) : wanted_(wanted) {
        list_moves(with_timer);
    }

    bool exists_with(int terms) {
        State state;
        for (unsigned c = 0; c < kLeastCases; ++c)
            state[c].to_send = static_cast<std::uint8_t>(wanted_[c].sends.size());
        return search(state, terms);
    }

  private:
    void list_moves(bool with_timer) {
        std::set<std::pair<int, int>> presets = {{0, 0}};
        std::set<std::string> orders = {""};
        for (const Wanted& w : wanted_) {
            presets.insert({w.timer, 0});
            presets.insert({0, w.counter});
            orders.insert(w.sends.begin(), w.sends.end());
        }
        for (unsigned care = 0; care < kLeastCases; ++care) {
            for (unsigned value = 0; value < kLeastCases; ++value) {
                const bool runs = with_timer && (care & 4U) != 0 && (value & 4U) == 0;
                if ((value & ~care) != 0 || runs) continue;
                for (const std::string& order : orders) {
                    const bool is_fast = order.find('=') == std::string::npos;
                    for (auto [timer, counter] : presets) {
                        if (is_fast || (timer == 0 && counter == 0))
                            moves_.push_back({value, care, order, timer, counter, is_fast});
                    }
                }
            }
        }
    }

    /// Puts `move` before all terms placed so far, with the outputs that its open cases want, and with their
    /// next step if all want the same one (deciding more never costs a term). False if it does something
    /// wrong, or nothing at all.
    bool apply(const Move& move, State& state) const {
        Few<int> nexts;
        Few<int> outputs;
        bool helps = !move.order.empty();
        for (unsigned c = 0; c < kLeastCases; ++c) {
            if ((c & move.care) != move.value) continue;
            const Wanted& wanted = wanted_[c];
            CaseState& now = state[c];
            if (!move.order.empty()) {
                if (now.to_send == 0 || wanted.sends[now.to_send - 1U] != move.order) return false;
                --now.to_send;
            }
            if (!now.next) nexts.insert(wanted.next);
            if (!now.outputs) outputs.insert(wanted.outputs);
            if (!preset(move.timer, wanted.timer, now.timer, helps)) return false;
            if (!preset(move.counter, wanted.counter, now.counter, helps)) return false;
        }
        if (!move.is_fast) return true;
        if (outputs.size() > 1) return false;
        for (unsigned c = 0; c < kLeastCases; ++c) {
            if ((c & move.care) != move.value) continue;
            helps = helps || !state[c].outputs || (nexts.size() == 1 && !state[c].next);
            state[c].outputs = true;
            state[c].next = state[c].next || nexts.size() == 1;
        }
        return helps;
    }

    static bool preset(int given, int wanted, bool& decided, bool& helps) {
        if (given == 0) return true;
        if (wanted == 0 || (!decided && given != wanted)) return false;
        helps = helps || !decided;
        decided = true;
        return true;
    }

    /// A register value takes a term of its own; the others can carry a command, a next step, outputs and one
    /// preset each.
    int missing(const State& state) const {
        Few<int> nexts;
        Few<int> outputs;
        Few<int> presets;
        Few<std::string_view> commands;
        Few<std::string_view> values;
        for (unsigned c = 0; c < kLeastCases; ++c) {
            const Wanted& wanted = wanted_[c];
            const CaseState& now = state[c];
            if (!now.next && wanted.next != kOwnStep) nexts.insert(wanted.next);
            if (!now.outputs && wanted.demands_outputs) outputs.insert(wanted.outputs);
            if (wanted.timer != 0 && !now.timer) presets.insert(wanted.timer);
            if (wanted.counter != 0 && !now.counter) presets.insert(-wanted.counter);
            for (std::size_t i = 0; i < now.to_send; ++i) {
                const std::string_view order = wanted.sends[i];
                (order.find('=') == order.npos ? commands : values).insert(order);
            }
        }
        return std::max({nexts.size(), outputs.size(), presets.size(), commands.size()}) + values.size();
    }

    bool search(const State& state, int terms) {
        const int least = missing(state);
        if (least == 0) return true;
        if (least > terms) return false;
        const auto [known, is_new] = failed_.try_emplace(packed(state), terms);
        if (!is_new && known->second >= terms) return false;
        known->second = terms;
        for (const Move& move : moves_) {
            State next = state;
            if (apply(move, next) && search(next, terms - 1)) return true;
        }
        return false;
    }

    std::array<Wanted, kLeastCases> wanted_;
    std::vector<Move> moves_;
    std::unordered_map<std::uint64_t, int> failed_;
};

/// A random step; its two lamps follow inputs in one of four programs.
struct RandomStep {
    std::string source;
    bool shows = false;
    bool with_timer = false;

    explicit RandomStep(unsigned seed) {
        test::Random random(seed);
        with_timer = random() % 3 == 0;
        const auto condition = [&] {
            static const std::vector<std::string> plain = {
                "A",       "B",           "NOT A",       "NOT B",         "A AND B",       "A OR B",
                "A XOR B", "NOT A AND B", "A AND NOT B", "NOT (A AND B)", "NOT (A XOR B)", "TRUE"};
            static const std::vector<std::string> timed = {"TIMER.Q", "NOT TIMER.Q", "A AND TIMER.Q",
                                                           "B AND TIMER.Q OR A"};
            static const std::vector<std::string> third = {"C",
                                                           "NOT C",
                                                           "A AND C",
                                                           "B OR C",
                                                           "A AND B OR A AND C OR B AND C",
                                                           "A XOR C",
                                                           "A XOR B XOR C",
                                                           "A AND NOT B OR B AND NOT C OR C AND NOT A",
                                                           "NOT (A AND B AND C)",
                                                           "A AND B OR NOT A AND C"};
            const std::vector<std::string>& other = with_timer ? timed : third;
            return random() % 2 == 0 ? other[random() % other.size()] : plain[random() % plain.size()];
        };
        const auto action = [&] {
            static const std::vector<std::string> orders = {"STOP; ", "CLEAR_IN_POS; ", "INPOSWIN := 20; "};
            static const std::vector<std::string> presets = {"TIMER := T#1s; ", "TIMER := T#2s; ",
                                                             "COUNTER := 7; ", "COUNT_DOWN; "};
            std::string text;
            const unsigned first = random() % 3;
            const unsigned sends = random() % 3;
            const unsigned step = 1 + random() % 2;
            for (unsigned i = 0; i < sends; ++i) text += orders[(first + i * step) % 3];
            if (random() % 4 == 0) text += presets[random() % presets.size()];
            if (random() % 8 == 0) text += "TIMER := T#1s; COUNTER := 7; ";
            static const std::vector<std::string> nexts = {"T", "U", "V", "T"};
            return text + "NEXT := " + nexts[random() % nexts.size()] + "; ";
        };
        const bool same_outputs = random() % 3 == 0;
        shows = random() % 4 == 0;
        std::string body = shows ? "OUT Y WHEN " + condition() + "; " : "";
        const unsigned branches = random() % 4;
        for (unsigned i = 0; i < branches; ++i)
            body += (i == 0 ? "IF " : "ELSIF ") + condition() + " THEN " + action();
        if (branches > 0 && random() % 4 == 0) body += "ELSE " + action();
        if (branches > 0) body += "END_IF ";
        const std::string lamps = same_outputs ? "OWN ERROR; OUT W;" : "OWN ERROR; OUT X;";
        source = test::program("STEP S: OWN ERROR; NO_HELPER; OUT W; " + body + "END_STEP STEP T: " + lamps +
                               " END_STEP STEP U: " + lamps + " END_STEP STEP V: OWN ERROR; END_STEP");
    }
};

std::array<Wanted, kLeastCases> wanted_of(const Compilation& result, const RandomStep& step) {
    std::array<Wanted, kLeastCases> wanted;
    for (unsigned c = 0; c < kLeastCases; ++c) {
        const unsigned number = step.with_timer ? (c & 3U) | (c & 4U) << 6U : c;
        const test::Scan scan = test::scan_case(result.table, kOwnStep, number);
        Wanted& w = wanted[c];
        w.next = scan.next.value_or(kOwnStep);
        w.outputs = scan.outputs.value_or(1) + (scan.clears ? 0x40 : 0) + (scan.counts ? 0x80 : 0);
        w.demands_outputs = w.next != kOwnStep || step.shows || scan.clears || scan.counts;
        w.timer = scan.timer.value_or(0);
        w.counter = scan.counter.value_or(0);
        w.sends = scan.sends;
    }
    return wanted;
}

int terms_without_error(const std::vector<std::uint8_t>& table) {
    int count = 0;
    for (std::size_t i = 0; i + 8 <= table.size(); i += 8)
        count += (table[i] & 0x3F) == kOwnStep && table[i + 1] < 0x80;
    return count;
}

TEST(Least, NoTableOfFewerTermsDoesTheSame) {
    int compiled = 0;
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
        SCOPED_TRACE(seed);
        const RandomStep step(seed);
        const Compilation result = compile(step.source);
        if (!result.ok) continue;  // E070 .. E072: no table does it
        ++compiled;
        const int terms = terms_without_error(result.table);
        if (terms == 0) continue;
        Exhaustive exhaustive(wanted_of(result, step), step.with_timer);
        EXPECT_FALSE(exhaustive.exists_with(terms - 1))
            << step.source << listing(result, step.source, "test.seq");
    }
    EXPECT_GT(compiled, static_cast<int>(kSeeds) / 2);
}

}  // namespace
}  // namespace nplc::seqc
