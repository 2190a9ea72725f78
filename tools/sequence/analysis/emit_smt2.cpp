#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <set>
#include <utility>
#include <vector>

#include "analysis/emit.h"
#include "emit_smt2_fields.h"
#include "table/step.h"

namespace nplc::verify {
namespace {

using smt2::bit;
using smt2::bits;
using smt2::condition_clause;
using smt2::Field;
using smt2::Fields;
using smt2::formula_clause;

/// The motion after a scan's orders, for each motion before it.
Motions motions_after(const table::Outcome& outcome) {
    Motions motions;
    for (std::size_t before = 0; before < kMotions; ++before)
        motions[before] = motion_after(static_cast<Motion>(before), {}, outcome.orders);
    return motions;
}

/// The steps that have terms, or that some term names.
std::vector<table::Step> steps_of(std::span<const std::uint8_t> table, const Question& question) {
    std::set<std::uint8_t> numbers = {0};
    for (const auto& [term, order] : question.terms) {
        numbers.insert(term.condition.step);
        if (!term.is_flex && term.fast.next_step != sequencer::kNoSwitch) numbers.insert(term.fast.next_step);
    }
    const std::vector<sequencer::TermView> terms = table::terms_of(table);
    std::vector<table::Step> steps;
    for (const std::uint8_t number : numbers) steps.push_back(table::step_of(number, terms));
    return steps;
}

class Clauses {
  public:
    Clauses(std::span<const std::uint8_t> table, Question question)
        : question_(std::move(question)),
          steps_(steps_of(table, question_)),
          fields_(question_),
          told_(question_.named | (question_.used & assumed_bits())),
          facts_(facts()) {}

    const Fields& fields() const { return fields_; }
    bool times_moves() const { return fields_.times_moves; }

    std::string text() const {
        std::string result = declared() + ticks();
        result += fmt::format("(rule (Begin {}))\n", fields_.at_power_up());
        result += scans();
        result += fmt::format("(rule (=> (Move {0} i {1}) (After i {1})))\n; any time passes\n",
                              fields_.here(), fields_.there());
        result += fmt::format("(rule (=> (After i {0}) (Begin {0})))\n", fields_.here());
        result += time("Begin", "");
        for (unsigned value = 0; value <= question_.greatest_counter; ++value) {
            const std::string from = bits(value, fields_.counter.width);
            result += fmt::format("(rule (Zero {} {}))\n(rule (Down {} {}))\n", from, bit(value == 0), from,
                                  bits(value == 0 ? 0 : value - 1, fields_.counter.width));
        }
        return result + turns() + facts_;
    }

    /// The relations of a state and of the stored facts that do not change while time passes.
    std::string time(const std::string& relation, const std::string& remembered) const {
        const std::string from = fields_.here() + remembered;
        if (!times_moves()) {
            return fmt::format("(rule (=> ({0} {1}) ({0} {2})))\n", relation, with_timer(from, "#b1"),
                               with_timer(from, "#b0"));
        }
        return fmt::format("(rule (=> (and ({0} {1}) (Tick {2} {3})) ({0} {3}{4})))\n", relation, from,
                           fields_.here(), fields_.there(), remembered);
    }
    /// A state with another word for the timer.
    std::string with_timer(std::string state, const char* word) const {
        state.replace(state.find(" r") + 1, 1, word);
        return state;
    }

  private:
    unsigned assumed_bits() const {
        unsigned bits = question_.tells_motion ? 0xC0U : 0U;
        for (const Assumption& assumption : question_.assumptions) bits |= image_bits_of(assumption.never);
        return bits;
    }

    std::string declared() const {
        std::string vars;
        for (const Field& field : fields_.all()) {
            vars += fmt::format("(declare-var {0} (_ BitVec {2})) (declare-var {1} (_ BitVec {2}))\n",
                                field.here, field.there, field.width);
        }
        return fmt::format(
            R"((set-option :fp.engine datalog)
(declare-var i (_ BitVec 8)) (declare-var z (_ BitVec 1)) (declare-var y (_ BitVec 1))
{0}(declare-var u (_ BitVec {1})) (declare-var x (_ BitVec {2}))
(declare-var k (_ BitVec 1)) (declare-var l (_ BitVec 1)) (declare-var g (_ BitVec {4})) (declare-var e (_ BitVec 1))
; step, timer runs, counter is 0, image -> step, timer preset, its value, outputs written, outputs, counter: 00 kept, 01 set,
; 10 counted down; its value, which orders to the motion
(declare-rel Scan ((_ BitVec 6) (_ BitVec 1) (_ BitVec 1) (_ BitVec 8) (_ BitVec 6) (_ BitVec 1) (_ BitVec {2}) (_ BitVec 1)
  (_ BitVec 4) (_ BitVec 2) (_ BitVec {1}) (_ BitVec {4})))
(declare-rel Zero ((_ BitVec {1}) (_ BitVec 1)))
(declare-rel Down ((_ BitVec {1}) (_ BitVec {1})))
(declare-rel Runs ((_ BitVec {2}) (_ BitVec 1)))
; motion, INPOS seen, ERROR seen, which orders -> motion, whether a move whose time is known goes on
; motion: 0 INIT, 1 to a place, 2 runs, 3 to a place for an unknown time, 4 in its place, 5 there with V_SOLL 0, 6 on its way with
; V_SOLL 0, 7 in velocity mode with V_SOLL 0, 8 homing, 9 homing for an unknown time, 10 in a torque or test mode
(declare-rel Turn ((_ BitVec 4) (_ BitVec 1) (_ BitVec 1) (_ BitVec {4}) (_ BitVec 4) (_ BitVec 1)))
; a scan begins here; one leads from here to there; one ended here
(declare-rel Begin ({3}))
(declare-rel Move ({3} (_ BitVec 8) {3}))
(declare-rel After ((_ BitVec 8) {3}))
)",
            vars, fields_.counter.width, fields_.timer.width, fields_.sorts(), orders_width());
    }

    /// A rule for each way to take over the outputs, the counter and the timer.
    std::string scans() const {
        struct Choice {
            const char* word;     ///< of the scan's fact
            const char* needs;    ///< what else must hold
            const char* becomes;  ///< the place of the value in the state after the scan
        };
        static constexpr Choice kOutputs[] = {{"#b0 p", "", "o"}, {"#b1 p", "", "p"}};
        static constexpr Choice kCounter[] = {
            {"#b00 u", "", "c"}, {"#b01 u", "", "u"}, {"#b10 u", " (Down c d)", "d"}};
        static constexpr Choice kTimer[] = {{"#b0 x", "", "r"}, {"#b1 x", "", "x"}};
        std::string text;
        for (const Choice& o : kOutputs) {
            for (const Choice& c : kCounter) {
                for (const Choice& r : kTimer) {
                    const std::string scan =
                        fmt::format("(Begin {}) (Runs r y) (Zero c z) (Scan s y z i t {} {} {} g){}{}",
                                    fields_.here(), r.word, o.word, c.word, c.needs, left_out());
                    const std::string end = fmt::format("t {} {} {}", o.becomes, r.becomes, c.becomes);
                    text += moves(scan, end);
                }
            }
        }
        return text;
    }

    std::string moves(const std::string& scan, const std::string& end) const {
        const auto rule = [&](const std::string& more, const std::string& motion) {
            return fmt::format("(rule (=> (and {}{}) (Move {} i {}{})))\n", scan, more, fields_.here(), end,
                               motion);
        };
        if (!fields_.tells_motion) return rule("", "");
        const std::string turn = " (Turn m ((_ extract 6 6) i) ((_ extract 7 7) i) g n e)";
        if (!times_moves()) return rule(turn, " n");
        const std::string in_time = fmt::format(
            " (or (not {}) (not (= v {})) (= ((_ extract 6 6) i) #b1) (= ((_ extract 7 7) i) #b1))", timed(),
            bits(question_.move_ms + 1, fields_.moved.width));
        const std::string none = bits(0, fields_.moved.width);
        return rule(turn + in_time + " (= e #b1)", " n v") +
               rule(turn + in_time + " (= e #b0)", " n " + none);
    }

    std::string left_out() const {
        std::string text;
        for (const Assumption& assumption : question_.assumptions) {
            if (assumption.move_ms == 0)
                text += fmt::format(" (not {})", condition_clause(assumption.never, fields_, false));
        }
        return text;
    }

    unsigned orders_width() const {
        return std::max(1U, static_cast<unsigned>(std::bit_width(orders_.size() - 1)));
    }

    /// The motion at a scan's beginning is one whose time may be known.
    static std::string timed() { return "(or (= m #b0001) (= m #b1000))"; }

    /// ERROR is part of the facts only where moves are timed.
    std::string turns() const {
        std::string text;
        if (!fields_.tells_motion) return text;
        for (std::size_t order = 0; order < orders_.size(); ++order) {
            const bool begins = is_timed(orders_[order][0]);
            for (unsigned all = 0; all < kMotions * 4; ++all) {
                const unsigned before = all >> 2U;
                const bool in_pos = (all & 1U) != 0;
                const bool error = (all & 2U) != 0;
                const Seen saw{.in_pos = in_pos, .disturbs = error && times_moves()};
                const Motion seen = motion_after(static_cast<Motion>(before), saw, {});
                const Motion then = orders_[order][static_cast<std::size_t>(seen)];
                text += fmt::format("(rule (Turn {} {} {} {} {} {}))\n", bits(before, 4), bit(in_pos),
                                    bit(error), bits(static_cast<unsigned>(order), orders_width()),
                                    bits(static_cast<unsigned>(then), 4), bit(is_timed(then) && !begins));
            }
        }
        return text;
    }

    /// A millisecond, where time is counted.
    std::string ticks() const {
        std::string text;
        const unsigned greatest = times_moves() ? question_.greatest_timer : 1;
        for (unsigned value = 0; value <= greatest; ++value) {
            const std::string from = bits(value, fields_.timer.width);
            text += fmt::format("(rule (Runs {} {}))\n", from, bit(value != 0));
            if (!times_moves()) continue;
            text += fmt::format("(rule (Less {} {}))\n", from,
                                bits(value == 0 ? 0 : value - 1, fields_.timer.width));
        }
        if (!times_moves()) return text;
        const unsigned late = question_.move_ms + 1;
        for (unsigned value = 0; value <= late; ++value) {
            text += fmt::format("(rule (More {} {}))\n", bits(value, fields_.moved.width),
                                bits(std::min(value + 1, late), fields_.moved.width));
        }
        return fmt::format(
                   "(declare-rel Less ((_ BitVec {0}) (_ BitVec {0})))\n"
                   "(declare-rel More ((_ BitVec {1}) (_ BitVec {1})))\n(declare-rel Tick ({2} {2}))\n"
                   "(rule (=> (and (Begin {3}) (Less r q) (More v w) {4}) (Tick {3} s o q c m w)))\n"
                   "(rule (=> (and (Begin {3}) (Less r q) (not {4})) (Tick {3} s o q c m v)))\n",
                   fields_.timer.width, fields_.moved.width, fields_.sorts(), fields_.here(), timed()) +
               text;
    }

    /// The facts of all scans; also collects the orders that they name.
    std::string facts() {
        const std::vector<Case> cases = cases_of_steps();
        for (const Case& one : cases) {
            const Motions motions = motions_after(*one.outcome);
            if (std::find(orders_.begin(), orders_.end(), motions) == orders_.end())
                orders_.push_back(motions);
        }
        std::set<std::string> facts;
        for (const Case& one : cases) facts.insert(fact(one));
        std::string text;
        for (const std::string& each : facts) text += each;
        return text;
    }

    struct Case {
        const table::Outcome* outcome = nullptr;
        unsigned step = 0;
        bool runs = false;
        bool counter_zero = false;
        unsigned image = 0;
    };

    std::vector<Case> cases_of_steps() const {
        std::vector<Case> cases;
        for (const table::Step& step : steps_) {
            for (unsigned image = 0; image < 256; ++image) {
                if ((image & ~question_.used) != 0) continue;
                for (unsigned zeros = 0; zeros < 4; ++zeros) {
                    const bool runs = (zeros & 1U) != 0;
                    const unsigned key = image | (runs ? 0U : 0x100U) | (zeros & 2U) << 8U;
                    cases.push_back({&step.in(key), step.number, runs, (zeros & 2U) != 0, image});
                }
            }
        }
        return cases;
    }

    std::string fact(const Case& one) const {
        const table::Outcome& done = *one.outcome;
        const bool counts = done.counter == table::CounterChange::count_down;
        const unsigned operation = done.sets_counter() ? 1U : counts ? 2U : 0U;
        const bool presets = done.timer != 0;
        const unsigned left = times_moves() ? done.timer : (presets ? 1U : 0U);
        const auto found = std::find(orders_.begin(), orders_.end(), motions_after(done)) - orders_.begin();
        const unsigned orders = fields_.tells_motion ? static_cast<unsigned>(found) : 0;
        return fmt::format("(rule (Scan {} {} {} {} {} {} {} {} {} {} {} {}))\n", bits(one.step, 6),
                           bit(one.runs), bit(one.counter_zero), bits(one.image & told_, 8),
                           bits(done.next, 6), bit(presets), bits(left, fields_.timer.width),
                           bit(done.outputs.has_value()), bits(done.outputs.value_or(0), 4),
                           bits(operation, 2), bits(done.counter_preset, fields_.counter.width),
                           bits(orders, orders_width()));
    }

    Question question_;
    std::vector<table::Step> steps_;  ///< those that have terms or can be entered
    Fields fields_;
    unsigned told_;                ///< bits of HW_INP by which a scan's facts are distinguished
    std::vector<Motions> orders_;  ///< what the orders of a scan do to the motion, each once
    std::string facts_;
};

constexpr const char* kClausesHeader =
    R"(; A NanoPLC sequence table (001 6.1) and its properties, as `seqc verify --assume any` asks them: inputs, INPOS and
; ERROR are free in each scan, and any time from 0 on passes between two scans, so that a running timer may or may not
; have ended. A condition is judged after each finished scan.
;
;   z3 F.smt2
;
; prints each property's name, and "sat" if some scan is as its query says: that breaks the property, or proves
; IS REACHABLE. The next scan may come after any time, so WHENEVER is broken as soon as a scan leaves its deadline open.
)";

/// The states from which no sequence of scans leads to the condition.
std::string ways_text(const Property& property, const Clauses& clauses) {
    const Fields& fields = clauses.fields();
    const std::string here = fields.here();
    const std::string condition = condition_clause(property.condition, fields, false);
    const std::string asked =
        property.form == Form::after_possible ? " " + condition_clause(property.then, fields, false) : "";
    const std::string waits =
        clauses.times_moves()
            ? fmt::format("(and (Can_{0} {2}) (Tick {1} {2}))", property.name, here, fields.there())
            : fmt::format("(and (Can_{0} {1}) (Begin {2}))", property.name, clauses.with_timer(here, "#b0"),
                          clauses.with_timer(here, "#b1"));
    return fmt::format(
        R"((declare-rel Hit_{0} ((_ BitVec 8) {2}))
(declare-rel Can_{0} ({2}))
(rule (=> (and (After i {3}) {1}) (Hit_{0} i {3})))
(rule (=> (and (Move {3} i {4}) (Hit_{0} i {4})) (Can_{0} {3})))
(rule (=> (and (Move {3} i {4}) (Can_{0} {4})) (Can_{0} {3})))
(rule (=> {5} (Can_{0} {6})))
(rule (=> (and (After i {3}) (not (Hit_{0} i {3})) (not (Can_{0} {3})){7}) Bad_{0}))
)",
        property.name, condition, fields.sorts(), here, fields.there(), waits,
        clauses.times_moves() ? here : clauses.with_timer(here, "#b1"), asked);
}

/// The stored facts are updated along all scans.
std::string watch_text(const Property& property, const Watch& watch, const Clauses& clauses) {
    const Fields& fields = clauses.fields();
    const std::string& name = property.name;
    std::string text = fmt::format(
        "(declare-rel Watch_{0} ({1} (_ BitVec 1) (_ BitVec 1)))\n(rule (Watch_{0} {2} {3} {4}))\n", name,
        fields.sorts(), fields.at_power_up(), bit(watch.first_at_power_up), bit(watch.second_at_power_up));
    const std::string scan =
        fmt::format("(Watch_{} {} k l) (Move {} i {})", name, fields.here(), fields.here(), fields.there());
    const std::string first = formula_clause(watch.first, fields);
    const std::string second = formula_clause(watch.second, fields);
    for (const bool one : {false, true}) {
        for (const bool two : {false, true}) {
            text += fmt::format("(rule (=> (and {} {} {}) (Watch_{} {} {} {})))\n", scan,
                                one ? first : "(not " + first + ")", two ? second : "(not " + second + ")",
                                name, fields.there(), bit(one), bit(two));
        }
    }
    return text + clauses.time("Watch_" + name, " k l") +
           fmt::format("(rule (=> (and {} {}) Bad_{}))\n", scan, formula_clause(watch.bad, fields), name);
}

std::string query_of(const Property& property, const Clauses& clauses) {
    const std::string& name = property.name;
    const Fields& fields = clauses.fields();
    std::string text = fmt::format("\n; {}\n(declare-rel Bad_{} ())\n", property.text, name);
    if (asks_for_ways(property)) {
        text += ways_text(property, clauses);
    } else if (const Watch watch = watch_of(property); watch.remembers) {
        text += watch_text(property, watch, clauses);
    } else {
        text += fmt::format("(rule (=> (and (Move {} i {}) {}) Bad_{}))\n", fields.here(), fields.there(),
                            formula_clause(watch.bad, fields), name);
    }
    return text + fmt::format("(echo \"{0}\")\n(query Bad_{0})\n", name);
}

}  // namespace

Emission smt2_of(std::span<const std::uint8_t> table, const std::vector<Property>& properties,
                 const std::vector<Assumption>& assumptions) {
    const Clauses clauses(table, Question(table, properties, assumptions, false));
    Emission emission{kClausesHeader, {}};
    for (const Assumption& assumption : assumptions) emission.text += "; " + assumption.text + "\n";
    if (clauses.times_moves()) emission.text += "; Time is counted in milliseconds.\n";
    emission.text += clauses.text();
    for (const Property& property : properties) {
        if (property.form == Form::never_while) {
            emission.left_out.push_back(property.name);
        } else {
            emission.text += query_of(property, clauses);
        }
    }
    return emission;
}

}  // namespace nplc::verify
