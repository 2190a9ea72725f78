#include "compiler/single_term.h"

#include <fmt/format.h>

#include "compiler/actions.h"

namespace nplc::seqc {
namespace {

using ast::Expression;
using ast::Statement;
using sequencer::Term;
using Kind = Expression::Kind;

class TermEncoder {
  public:
    TermEncoder(const ast::SymbolicTerm& written, Span span, Scope& scope)
        : written_(written), span_(span), scope_(scope) {}

    Term run(std::optional<std::uint8_t> inside) {
        term_.condition.step = step_number(inside);
        add_condition(written_.condition);
        for (const Statement& statement : written_.statements) add_statement(statement);
        add_outputs();
        if (send_ && send_->reg != nullptr) make_write();
        return term_;
    }

  private:
    std::uint8_t step_number(std::optional<std::uint8_t> inside) {
        if (written_.step.text.empty()) {
            if (!inside) {
                scope_.report().add("E094", span_, "this TERM belongs to no step",
                                    "write TERM Name: IF ..., or put it into its step");
            }
            return inside.value_or(0);
        }
        return scope_.step(written_.step).value_or(inside.value_or(0));
    }

    void no_product(const Expression& part, const char* message, const char* help) {
        scope_.report().add("E093", part.span, message, help);
    }

    void add_condition(const Expression& part) {
        switch (part.kind) {
            case Kind::all_of:
                for (const Expression& operand : part.operands) add_condition(operand);
                return;
            case Kind::constant:
                if (!part.value)
                    no_product(part, "a term that never holds cannot be written", "take the TERM out");
                return;
            case Kind::timer_q:
                term_.condition.needs_timer_zero = true;
                return;
            case Kind::counter_q:
                term_.condition.needs_counter_zero = true;
                return;
            case Kind::any_error:
                return no_product(part, "a single term always compares ERROR",
                                  "write two TERMs, one with ERROR and one without");
            case Kind::any_of:
            case Kind::odd_of:
                return no_product(part, "a single term can hold AND and NOT, but no OR or XOR",
                                  "write a TERM for each case");
            case Kind::negation:
                return add_negation(part);
            case Kind::rising:
            case Kind::falling:
                scope_.truth_of(part);  // already reported
                return;
            default:
                return add_literal(part, true);
        }
    }

    void add_negation(const Expression& part) {
        const Expression& inner = part.operands.front();
        if (inner.kind == Kind::timer_q || inner.kind == Kind::counter_q) {
            return no_product(part, "a single term can test that timer or counter are 0, not that they run",
                              "leave it out, and let a later TERM with TIMER.Q or COUNTER.Q decide");
        }
        if (inner.kind != Kind::name && inner.kind != Kind::in_pos && inner.kind != Kind::error) {
            return no_product(part, "in a single term NOT stands only before an input, INPOS or ERROR",
                              "write a TERM for each case");
        }
        add_literal(inner, false);
    }

    void add_literal(const Expression& part, bool wanted) {
        std::optional<std::size_t> bit;
        if (part.kind == Kind::name) {
            const auto tested = scope_.input(part.name);
            if (!tested) return;
            bit = tested->bit;
            wanted = wanted == tested->level;
        }
        if (part.kind == Kind::in_pos) bit = kInPosBit;
        if (part.kind == Kind::error) bit = kErrorBit;
        if (!bit) return;
        const auto mask = static_cast<std::uint8_t>(1U << *bit);
        if ((compared_ & mask) != 0 && ((term_.condition.input & mask) != 0) != wanted) {
            no_product(part, "this condition contradicts itself", "take the TERM out");
        }
        compared_ |= mask;
        if (wanted) term_.condition.input |= mask;
        term_.condition.care = compared_ & 0x7F;
    }

    void add_statement(const Statement& statement) {
        if (scope_.is_set_point(statement.value)) {
            scope_.report().add("E094", statement.value.span, "a TERM cannot take a set-point",
                                "write it as a branch: IF ... THEN ... END_IF");
            return;
        }
        ActionBuilder builder(scope_);
        const Action action = builder.build({statement});
        if (const auto marked = builder.marked()) {
            scope_.report().add("E064", *marked, "EVERY_SCAN does not go with TERM",
                                "leave it out: a TERM acts in every scan in which it holds");
        }
        sequencer::FastStatement& fast = term_.fast;
        if (action.next && once(next_, statement, "NEXT is set")) fast.next_step = *action.next;
        if (statement.kind == Statement::Kind::call || statement.kind == Statement::Kind::go_back) {
            scope_.report().add("E067", statement.span, "a TERM calls no SEQUENCE", "write a branch instead");
        }
        if (action.switches()) {
            scope_.report().add("E075", statement.span,
                                "a TERM does not set and reset outputs: it writes all four",
                                "write OUT with all that are on, or a branch instead of the TERM");
        }
        for (const Send& send : action.sends) add_send(send);
        if (action.timer) add_preset(statement, false, *action.timer);
        if (action.counter) add_preset(statement, true, *action.counter);
        fast.clears_counter = fast.clears_counter || action.clears_counter;
        fast.counts_down = fast.counts_down || action.counts_down;
        if (other_ == nullptr && (action.next || action.presets() || action.counts())) other_ = &statement;
    }

    bool once(const Statement*& first, const Statement& statement, const char* what) {
        if (first == nullptr) {
            first = &statement;
            return true;
        }
        scope_.report()
            .add("E061", statement.span, fmt::format("{} twice in the same TERM", what), "keep one")
            .notes.push_back({first->span, "the other one is here"});
        return false;
    }

    void add_send(const Send& send) {
        if (send_) {
            scope_.report()
                .add("E094", send.span, "a single term sends one command or writes one register",
                     "write a TERM with the same condition for each")
                .notes.push_back({send_->span, "it sends this"});
            return;
        }
        send_ = send;
        if (send.reg != nullptr) return;
        term_.fast.sends = true;
        term_.fast.command = send.command;
    }

    void add_preset(const Statement& statement, bool counter, std::uint16_t value) {
        if (preset_ != nullptr && counter != term_.fast.presets_counter) {
            scope_.report()
                .add("E094", statement.span, "a single term presets the timer or the counter, not both",
                     "write a TERM with the same condition for each")
                .notes.push_back({preset_->span, "the other preset is here"});
            return;
        }
        if (!once(preset_, statement, counter ? "the counter is set" : "the timer is set")) return;
        term_.fast.presets_counter = counter;
        term_.fast.preset = value;
    }

    void add_outputs() {
        for (const ast::Name& name : written_.outputs) {
            if (const auto bit = scope_.output(name))
                term_.fast.outputs |= static_cast<std::uint8_t>(1U << *bit);
        }
    }

    void make_write() {
        if (other_ != nullptr || !written_.outputs.empty()) {
            const Span span = other_ != nullptr ? other_->span : written_.outputs.front().span;
            scope_.report()
                .add("E094", span, "a term that writes a register can hold nothing else",
                     "write a TERM with the same condition for each")
                .notes.push_back({send_->span, "it writes a register"});
        }
        term_.is_flex = true;
        term_.flex = write_of(*send_);
    }

    const ast::SymbolicTerm& written_;
    Span span_;
    Scope& scope_;
    Term term_;
    std::uint8_t compared_ = 0;  ///< bits of the image, ERROR included if it was written
    std::optional<Send> send_;
    const Statement* next_ = nullptr;
    const Statement* preset_ = nullptr;
    const Statement* other_ = nullptr;  ///< the first statement that cannot be combined with a register write
};

}  // namespace

sequencer::TermBytes encode_term(const ast::SymbolicTerm& written, Span span,
                                 std::optional<std::uint8_t> inside, Scope& scope) {
    return sequencer::encode(TermEncoder(written, span, scope).run(inside));
}

}  // namespace nplc::seqc
