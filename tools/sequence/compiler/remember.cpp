#include "compiler/remember.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/actions.h"

namespace nplc::seqc {
namespace {

using ExpressionKind = ast::Expression::Kind;

constexpr const char* kOneTimer = "put one of the two into a step of its own";
constexpr const char* kBlinkTogether =
    "let all of them blink alike: OUT Lamp, Horn BLINKING T#500ms; or put one into a step of its own";
constexpr const char* kHeld =
    "FOR starts the timer again whenever its condition becomes true, so nothing else can use it: put one of "
    "the "
    "two "
    "into a step of its own; WITHIN and BLINKING go together";

template <class Visit>
void for_each_part(const ast::Expression& expression, const Visit& visit) {
    visit(expression);
    for (const ast::Expression& operand : expression.operands) for_each_part(operand, visit);
}

template <class Visit>
void for_each_branch(const ast::Step& step, const Visit& visit) {
    for (const ast::Choice& choice : step.choices) {
        for (const ast::Branch& branch : choice.branches) visit(branch);
    }
}

class Remembering {
  public:
    Remembering(const ast::Step& step, Scope& scope) : step_(step), scope_(scope) {}

    Memory run() {
        for_each_branch(step_, [&](const ast::Branch& branch) {
            if (branch.condition) add_edges(*branch.condition);
        });
        refuse_many_edges();
        scope_.see_edges(&memory_.edges, 0);
        for_each_branch(step_, [&](const ast::Branch& branch) {
            if (branch.timing) add_timing(branch);
        });
        for (const ast::Blinking& blinking : step_.blinking) add_blinking(blinking);
        if (memory_.timer_span) refuse_other_uses();
        return memory_;
    }

  private:
    void add_edges(const ast::Expression& condition) {
        for_each_part(condition, [&](const ast::Expression& part) {
            if (part.kind != ExpressionKind::rising && part.kind != ExpressionKind::falling) return;
            const auto tested = scope_.input(part.name);
            if (!tested) return;
            const bool rising = (part.kind == ExpressionKind::rising) == tested->level;
            const bool is_known = std::any_of(
                memory_.edges.begin(), memory_.edges.end(),
                [&](const Edge& edge) { return edge.bit == tested->bit && edge.rising == rising; });
            if (!is_known) memory_.edges.push_back({tested->bit, rising, part.span});
        });
    }

    void refuse_many_edges() {
        constexpr std::size_t kMost = 4;
        if (memory_.edges.size() <= kMost) return;
        scope_.report().add(
            "E074", memory_.edges[kMost].span,
            fmt::format("a step can have at most {} edges: each doubles the number of steps", kMost),
            "wait for some of them in a step of their own");
        memory_.edges.resize(kMost);
    }

    void add_timing(const ast::Branch& branch) {
        use_timer(branch.timing->span, branch.timing->is_limit ? kOneTimer : kHeld);
        const auto time = timer_value(branch.timing->time, scope_,
                                      branch.timing->is_limit ? TimeFor::limit : TimeFor::lasting);
        if (!time) return;
        if (branch.timing->is_limit) {
            memory_.limit = *time;
            return;
        }
        for_each_part(*branch.condition, [&](const ast::Expression& part) {
            if (part.kind != ExpressionKind::rising && part.kind != ExpressionKind::falling) return;
            scope_.report().add("E066", part.span, "an edge lasts one scan, so it never holds FOR a time",
                                "write the input itself in front of FOR");
        });
        memory_.held = scope_.branch_truth(*branch.condition);
        memory_.held_for = *time;
    }

    /// WITHIN counts the half periods of one BLINKING.
    void add_blinking(const ast::Blinking& blinking) {
        const bool beside_limit = memory_.limit != 0 && memory_.blink_for == 0;
        if (!beside_limit) use_timer(blinking.span, help_of_blinking());
        for (const ast::Name& name : blinking.outputs) {
            if (const auto bit = scope_.output(name))
                memory_.blinking |= static_cast<std::uint8_t>(1U << *bit);
        }
        memory_.blink_for = timer_value(blinking.time, scope_, TimeFor::blinking).value_or(1);
    }

    const char* help_of_blinking() const {
        return memory_.blink_for != 0 ? kBlinkTogether : memory_.is_held() ? kHeld : kOneTimer;
    }

    void use_timer(Span span, const char* help = kOneTimer) {
        if (memory_.timer_span) {
            refuse(span, help);
        } else {
            memory_.timer_span = span;
        }
    }

    void refuse(Span span, const char* help = kOneTimer) {
        scope_.report()
            .add("E073", span, "there is one timer, and this step uses it already", help)
            .notes.push_back({*memory_.timer_span, "the other use is here"});
    }

    void refuse_other_uses() {
        for (const ast::Statement& statement : step_.entry) {
            if (statement.kind == ast::Statement::Kind::timer) refuse(statement.span);
        }
        for_each_branch(step_, [&](const ast::Branch& branch) {
            const bool leaves = std::any_of(
                branch.statements.begin(), branch.statements.end(),
                [](const ast::Statement& statement) { return statement.kind == ast::Statement::Kind::next; });
            for (const ast::Statement& statement : branch.statements) {
                if (statement.kind == ast::Statement::Kind::timer && !leaves) refuse(statement.span);
            }
            if (branch.condition) refuse_test(*branch.condition);
        });
        for (const ast::ConditionalOutput& output : step_.conditional) refuse_test(output.condition);
    }

    void refuse_test(const ast::Expression& condition) {
        for_each_part(condition, [&](const ast::Expression& part) {
            if (part.kind == ExpressionKind::timer_q) refuse(part.span);
        });
    }

    const ast::Step& step_;
    Scope& scope_;
    Memory memory_;
};

class Latched {
  public:
    explicit Latched(Scope& scope) : scope_(scope) {}

    void add(const ast::Step& step) {
        for (const ast::Name& name : step.outputs) note(name, &Use::out);
        for (const ast::ConditionalOutput& output : step.conditional) {
            for (const ast::Name& name : output.outputs) note(name, &Use::out);
        }
        for (const ast::Blinking& output : step.blinking) {
            for (const ast::Name& name : output.outputs) {
                note(name, &Use::out);
                refuse_twice(name, step);
            }
        }
        add(step.entry);
        for_each_branch(step, [&](const ast::Branch& branch) { add(branch.statements); });
    }

    void report() {
        for (std::size_t bit = 0; bit < uses_.size(); ++bit) {
            const Use& use = uses_[bit];
            const std::optional<Span> latched = use.set ? use.set : use.reset;
            if (!latched) continue;
            const std::string& name = scope_.symbols().outputs[bit];
            if (use.out) {
                scope_.report()
                    .add("E065", *use.out,
                         fmt::format("'{}' is set and reset elsewhere, so OUT cannot name it", name),
                         fmt::format("write ENTRY SET {}; in the steps that switch it on and ENTRY RESET {}; "
                                     "in those that switch it off, or OUT in all",
                                     name, name))
                    .notes.push_back({*latched, use.set ? "it is set here" : "it is reset here"});
            } else if (!use.set || !use.reset) {
                scope_.report().add("W024", *latched,
                                    use.set
                                        ? fmt::format("'{}' is set and never reset: it stays on", name)
                                        : fmt::format("'{}' is reset and never set: it is never on", name),
                                    fmt::format("write {} {}; where it is to be switched {}",
                                                use.set ? "RESET" : "SET", name, use.set ? "off" : "on"));
            }
        }
    }

  private:
    struct Use {
        std::optional<Span> set;
        std::optional<Span> reset;
        std::optional<Span> out;
    };

    void refuse_twice(const ast::Name& blinking, const ast::Step& step) {
        const auto bit = scope_.output(blinking);
        const auto names_it = [&](const std::vector<ast::Name>& names) {
            return std::any_of(names.begin(), names.end(),
                               [&](const ast::Name& name) { return bit && scope_.output(name) == bit; });
        };
        const bool follows =
            std::any_of(step.conditional.begin(), step.conditional.end(),
                        [&](const ast::ConditionalOutput& output) { return names_it(output.outputs); });
        if (!follows && !names_it(step.outputs)) return;
        scope_.report().add("E065", blinking.span,
                            fmt::format("'{}' cannot blink: another OUT of the step names it", blinking.text),
                            "keep one of the two");
    }

    void note(const ast::Name& name, std::optional<Span> Use::*place) {
        const auto bit = scope_.output(name);
        if (bit && !(uses_.at(*bit).*place)) uses_.at(*bit).*place = name.span;
    }

    void add(const std::vector<ast::Statement>& statements) {
        for (const ast::Statement& statement : statements) {
            const bool sets = statement.kind == ast::Statement::Kind::set_outputs;
            if (!sets && statement.kind != ast::Statement::Kind::reset_outputs) continue;
            for (const ast::Name& name : statement.arguments) note(name, sets ? &Use::set : &Use::reset);
        }
    }

    Scope& scope_;
    std::array<Use, 4> uses_;
};

}  // namespace

Memory memory_of(const ast::Step& step, Scope& scope) {
    Memory memory = Remembering(step, scope).run();
    scope.see_edges(nullptr, 0);
    return memory;
}

void check_latched_outputs(const ast::Program& program, Scope& scope) {
    Latched latched(scope);
    for (const ast::Step& step : program.steps) latched.add(step);
    if (program.power_up) latched.add(*program.power_up);
    latched.report();
}

}  // namespace nplc::seqc
