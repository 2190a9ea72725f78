#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <set>

#include "manual_term.h"
#include "verify/emit.h"

namespace nplc::verify {
namespace {

using Kind = Condition::Kind;

std::string bits(unsigned value, unsigned width) {
    return fmt::format("#b{:0{}b}", value, width);
}

std::string clause(const Condition& condition, unsigned counter_bits);

std::string joined_clause(const char* sign, const Condition& condition, unsigned counter_bits) {
    std::string text = clause(condition.operands[0], counter_bits);
    for (std::size_t i = 1; i < condition.operands.size(); ++i)
        text = fmt::format("({} {} {})", sign, text, clause(condition.operands[i], counter_bits));
    return text;
}

/// Over i, s, o, r, c: image, step, outputs, whether the timer runs, counter after a scan.
std::string clause(const Condition& condition, unsigned counter_bits) {
    const unsigned number = condition.number;
    switch (condition.kind) {
        case Kind::constant:
            return number != 0 ? "true" : "false";
        case Kind::image:
            return fmt::format("(= ((_ extract {0} {0}) i) #b1)", number);
        case Kind::output:
            return fmt::format("(= ((_ extract {0} {0}) o) #b1)", number);
        case Kind::timer_q:
            return "(= r #b0)";
        case Kind::counter_q:
            return fmt::format("(= c {})", bits(0, counter_bits));
        case Kind::step:
            return fmt::format("(= s {})", bits(number, 6));
        case Kind::negation:
            return fmt::format("(not {})", clause(condition.operands[0], counter_bits));
        case Kind::all_of:
            return joined_clause("and", condition, counter_bits);
        case Kind::any_of:
            return joined_clause("or", condition, counter_bits);
        case Kind::odd_of:
            return joined_clause("xor", condition, counter_bits);
        case Kind::moving:  // no matter of the table alone
            break;
    }
    return {};
}

/// The temporary command registers (001 §6.1.9) after all terms were executed in one case.
struct Registers {
    unsigned next_step = 0;
    bool wrote = false;
    unsigned output_byte = 0;
    unsigned timer_preset = 0;
    unsigned counter_preset = 0;
};

Registers executed(const std::vector<ManualTerm>& terms, unsigned step, bool runs, bool counter_zero,
                   unsigned image) {
    Registers registers;
    registers.next_step = step;
    for (const ManualTerm& term : terms) {
        if (term.state != step || ((image ^ term.input) & term.compared) != 0) continue;
        if ((term.timer_must_be_zero && runs) || (term.counter_must_be_zero && !counter_zero)) continue;
        if (term.is_flexmac) continue;
        registers.wrote = true;
        registers.output_byte = term.output_byte;
        if (term.names_next) registers.next_step = term.next_state;
        if (term.word != 0)
            (term.word_is_counter ? registers.counter_preset : registers.timer_preset) = term.word;
    }
    return registers;
}

class Clauses {
  public:
    Clauses(std::span<const std::uint8_t> table, const std::vector<Property>& properties)
        : terms_(manual_terms(table)) {
        for (const ManualTerm& term : terms_) {
            cared_ |= term.compared;
            if (!term.is_flexmac && term.word_is_counter)
                greatest_ = std::max<unsigned>(greatest_, term.word);
        }
        for (const Property& property : properties)
            named_ |= unsigned{image_bits_of(property.condition)} | image_bits_of(property.then);
        counter_bits_ = std::max(1U, static_cast<unsigned>(std::bit_width(greatest_)));
    }

    std::string text() const {
        const std::string c = fmt::format("(_ BitVec {})", counter_bits_);
        const std::string place = fmt::format("(_ BitVec 6) (_ BitVec 4) (_ BitVec 1) {}", c);
        std::string result = fmt::format(
            R"((set-option :fp.engine datalog)
(declare-var i (_ BitVec 8))
(declare-var s (_ BitVec 6)) (declare-var o (_ BitVec 4)) (declare-var r (_ BitVec 1)) (declare-var c {0})
(declare-var t (_ BitVec 6)) (declare-var p (_ BitVec 4)) (declare-var q (_ BitVec 1)) (declare-var d {0})
(declare-var z (_ BitVec 1)) (declare-var v {0})
; step, timer runs, counter is 0, image -> step, timer runs, outputs written, outputs, counter: 00 kept, 01 set, 10 counted
; down; its value
(declare-rel Scan ((_ BitVec 6) (_ BitVec 1) (_ BitVec 1) (_ BitVec 8) (_ BitVec 6) (_ BitVec 1) (_ BitVec 1) (_ BitVec 4)
  (_ BitVec 2) {0}))
(declare-rel Zero ({0} (_ BitVec 1)))
(declare-rel Down ({0} {0}))
; a scan begins here; one leads from here to there; one ended here
(declare-rel Begin ({1}))
(declare-rel Move ({1} (_ BitVec 8) {1}))
(declare-rel After ((_ BitVec 8) {1}))
)",
            c, place);
        result += fmt::format("(rule (Begin {} #b0000 #b0 {}))\n", bits(0, 6), bits(0, counter_bits_));
        for (const char* outputs : {"#b0 p", "#b1 p"}) {
            const char* then = outputs[2] == '0' ? "o" : "p";
            const auto rule = [&](const char* counter, const char* with, const char* value) {
                result += fmt::format(
                    "(rule (=> (and (Begin s o r c) (Zero c z) (Scan s r z i t q {} {} v){}) "
                    "(Move s o r c i t {} q {})))\n",
                    outputs, counter, with, then, value);
            };
            rule("#b00", "", "c");
            rule("#b01", "", "v");
            rule("#b10", " (Down c d)", "d");
        }
        result +=
            "(rule (=> (Move s o r c i t p q d) (After i t p q d)))\n"
            "; any time passes\n"
            "(rule (=> (After i s o r c) (Begin s o r c)))\n"
            "(rule (=> (After i s o #b1 c) (Begin s o #b0 c)))\n";
        for (unsigned value = 0; value <= greatest_; ++value) {
            const std::string from = bits(value, counter_bits_);
            result +=
                fmt::format("(rule (Zero {} {}))\n(rule (Down {} {}))\n", from, value == 0 ? "#b1" : "#b0",
                            from, bits(value == 0 ? 0 : value - 1, counter_bits_));
        }
        return result + facts();
    }

    unsigned counter_bits() const { return counter_bits_; }

  private:
    std::string facts() const {
        std::set<unsigned> steps;
        for (const ManualTerm& term : terms_) {
            steps.insert(term.state);
            if (!term.is_flexmac && term.names_next) steps.insert(term.next_state);
        }
        steps.insert(0);
        std::set<std::string> facts;
        for (const unsigned step : steps) {
            for (unsigned image = 0; image < 256; ++image) {
                if ((image & ~(cared_ | named_)) != 0) continue;
                for (unsigned zeros = 0; zeros < 4; ++zeros)
                    facts.insert(fact(step, (zeros & 1U) != 0, (zeros & 2U) != 0, image));
            }
        }
        std::string text;
        for (const std::string& fact : facts) text += fact;
        return text;
    }

    std::string fact(unsigned step, bool runs, bool counter_zero, unsigned image) const {
        const Registers done = executed(terms_, step, runs, counter_zero, image);
        unsigned operation = 0;
        unsigned value = 0;
        if ((done.output_byte & 0x40U) != 0) {
            operation = 1;
        } else if (done.counter_preset != 0) {
            operation = 1;
            value = done.counter_preset;
        } else if ((done.output_byte & 0x80U) != 0) {
            operation = 2;
        }
        return fmt::format("(rule (Scan {} {} {} {} {} {} {} {} {} {}))\n", bits(step, 6),
                           bits(runs ? 1 : 0, 1), bits(counter_zero ? 1 : 0, 1), bits(image & named_, 8),
                           bits(done.next_step, 6), bits(runs || done.timer_preset != 0 ? 1 : 0, 1),
                           bits(done.wrote ? 1 : 0, 1), bits(done.output_byte & 0x0FU, 4), bits(operation, 2),
                           bits(value, counter_bits_));
    }

    std::vector<ManualTerm> terms_;
    unsigned cared_ = 0;
    unsigned named_ = 0;
    unsigned greatest_ = 0;
    unsigned counter_bits_ = 1;
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

/// What breaks the property, or what is to be reached; empty for what is not known here.
std::string bad_clause(const Property& property, unsigned counter_bits) {
    std::string c = clause(property.condition, counter_bits);
    switch (property.form) {
        case Form::never:
        case Form::reachable:
        case Form::always_possible:
            return c;
        case Form::always:
            return fmt::format("(not {})", c);
        case Form::whenever:
            return fmt::format("(and {} (not {}))", c, clause(property.then, counter_bits));
        default:
            return {};
    }
}

std::string query_of(const Property& property, const std::string& bad, unsigned counter_bits) {
    const std::string& name = property.name;
    std::string text = fmt::format("\n; {}\n(declare-rel Bad_{} ())\n", property.text, name);
    if (property.form == Form::always_possible) {
        const std::string place =
            fmt::format("(_ BitVec 6) (_ BitVec 4) (_ BitVec 1) (_ BitVec {})", counter_bits);
        text += fmt::format(
            R"((declare-rel Hit_{0} ((_ BitVec 8) {2}))
(declare-rel Can_{0} ({2}))
(rule (=> (and (After i s o r c) {1}) (Hit_{0} i s o r c)))
(rule (=> (and (Move s o r c i t p q d) (Hit_{0} i t p q d)) (Can_{0} s o r c)))
(rule (=> (and (Move s o r c i t p q d) (Can_{0} t p q d)) (Can_{0} s o r c)))
(rule (=> (and (Can_{0} s o #b0 c) (Begin s o #b1 c)) (Can_{0} s o #b1 c)))
(rule (=> (and (After i s o r c) (not (Hit_{0} i s o r c)) (not (Can_{0} s o r c))) Bad_{0}))
)",
            name, bad, place);
    } else {
        text += fmt::format("(rule (=> (and (After i s o r c) {}) Bad_{}))\n", bad, name);
    }
    return text + fmt::format("(echo \"{0}\")\n(query Bad_{0})\n", name);
}

}  // namespace

Emission smt2_of(std::span<const std::uint8_t> table, const std::vector<Property>& properties) {
    const Clauses clauses(table, properties);
    Emission emission{kClausesHeader + clauses.text(), {}};
    for (const Property& property : properties) {
        const std::string bad = bad_clause(property, clauses.counter_bits());
        if (bad.empty()) {
            emission.left_out.push_back(property.name);
        } else {
            emission.text += query_of(property, bad, clauses.counter_bits());
        }
    }
    return emission;
}

}  // namespace nplc::verify
