#include "report/decompile/writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/decompile/vocabulary.h"
#include "set_points/values.h"
#include "symbols/motors.h"

namespace nplc::seqc {
namespace {

using Kind = Passage::Kind;
using sequencer::TermBytes;

constexpr TermBytes kPlainEnd = {sequencer::kEndOfTable};

std::string commented(const Line& line) {
    return line.comment.empty() ? line.text : fmt::format("{}  // {}", line.text, line.comment);
}

Action without(Action action, const Action& tail) {
    action.sends.resize(action.sends.size() - tail.sends.size());
    if (tail.timer) action.timer.reset();
    if (tail.counter) action.counter.reset();
    if (tail.clears_counter) action.clears_counter = false;
    if (tail.counts_down) action.counts_down = false;
    return action;
}

/// Whether the automatic step numbers are those of the table.
bool numbers_itself(const Layout& layout) {
    std::uint8_t next = 1;
    return std::all_of(layout.steps.begin(), layout.steps.end(),
                       [&](const Part& part) { return part.number == 0 || part.number == next++; });
}

class Writer {
  public:
    Writer(const Layout& layout, const Draft& draft, const WriterContext& context)
        : layout_(layout), draft_(draft), context_(context), numbered_(!numbers_itself(layout)) {}

    WrittenProgram run(const std::string& head) {
        result_.text = head;
        line(0, "PROGRAM " + names().program);
        if (needs_motor()) line(0, fmt::format("MOTOR {};", motor_name(names())));
        if (const auto& scale = names().scale)
            line(0, fmt::format("SCALE {} rev = {} {};", scale->revolutions, scale->length, scale->unit));
        end_passage(Kind::rest);
        write_signals();
        write_values();
        write_set_points();
        if (draft_.around.fault) {
            line(0, "");
            line(0, "ON ERROR " + next_text(*draft_.around.fault->next, context_));
            end_passage(Kind::on_error);
        }
        if (draft_.power_up) write_power_up();
        for (std::size_t i = draft_.power_up ? 1 : 0; i < layout_.steps.size(); ++i) write_step(i);
        write_outside();
        line(0, "END_PROGRAM");
        end_passage(Kind::rest);
        return std::move(result_);
    }

  private:
    const Symbols& names() const { return context_.naming.symbols; }

    void line(std::size_t indent, const std::string& text) {
        if (!text.empty()) result_.text.append(4 * indent, ' ');
        result_.text += text + "\n";
    }

    void end_passage(Kind kind, std::uint8_t step = 0) {
        result_.passages.push_back({kind, step, result_.text.size()});
    }

    template <class Test>
    bool any_term(const Test& test) const {
        const auto in = [&](const Terms& terms) { return std::any_of(terms.begin(), terms.end(), test); };
        return in(layout_.outside) || std::any_of(layout_.steps.begin(), layout_.steps.end(),
                                                  [&](const Part& part) { return in(part.terms); });
    }

    bool needs_motor() const {
        return any_term([&](const TermBytes& term) { return sequencer::has_order(term); });
    }

    void write_signals() {
        const auto cares = [&](std::size_t bit) {
            return any_term([&](const TermBytes& term) {
                return ((sequencer::decode(term).condition.care >> bit) & 1) != 0;
            });
        };
        const auto writes = [&](std::size_t bit) {
            return any_term([&](const TermBytes& bytes) {
                const sequencer::Term term = sequencer::decode(bytes);
                return !term.is_flex && ((term.fast.outputs >> bit) & 1) != 0;
            });
        };
        write_block("VAR_INPUT", names().inputs, context_.naming.declared_inputs, "IN", cares,
                    names().inverted_inputs);
        write_block("VAR_OUTPUT", names().outputs, context_.naming.declared_outputs, "OUT", writes);
        end_passage(Kind::names);
    }

    template <std::size_t N, class Used>
    void write_block(const char* word, const std::array<std::string, N>& signals,
                     const std::array<bool, N>& declared, const char* address, const Used& used,
                     unsigned inverted = 0) {
        std::vector<std::string> lines;
        for (std::size_t i = 0; i < N; ++i) {
            if (declared[i] && used(i))
                lines.push_back(fmt::format("{} AT {}{}{} : BOOL;", signals[i],
                                            (inverted >> i & 1) != 0 ? "NOT " : "", address, i));
        }
        write_variables(word, lines);
    }

    void write_variables(const char* word, const std::vector<std::string>& lines) {
        if (lines.empty()) return;
        line(0, "");
        line(0, word);
        for (const std::string& text : lines) line(1, text);
        line(0, "END_VAR");
    }

    void write_values() {
        std::vector<std::string> lines;
        auto unsaid = context_.naming.registers;
        const std::size_t values = draft_.power_up ? draft_.power_up->values : 0;
        for (std::size_t i = 0; i < values; ++i) {
            const Send& send = draft_.power_up->action.sends[i];
            unsaid.erase(send.reg->number);
            if (context_.naming.set_point_of(send.reg->number) != nullptr) continue;
            const ValueText value = value_text(*send.reg, send.value, names(), context_.naming.exact_places);
            lines.push_back(
                commented({fmt::format("{} := {};", declared(*send.reg), value.text), value.comment}));
        }
        for (const auto& [number, name] : unsaid)
            lines.push_back(declared(*registers::find(context_.motor, number)) + ";");
        if (!draft_.power_up && lines.empty()) return;
        write_variables("VAR_MOTOR", lines);
        end_passage(Kind::values);
    }

    void write_set_points() {
        if (context_.naming.set_points.empty()) return;
        line(0, "");
        for (const set_points::SetPoint& point : context_.naming.set_points)
            line(0, declaration_of(point, context_));
        end_passage(Kind::values);
    }

    /// "Place AT P2"
    std::string declared(const registers::Register& reg) const {
        const std::string address = register_address(reg, context_);
        const auto given = context_.naming.registers.find(reg.number);
        const std::string name = address.starts_with("REG(") ? fmt::format("R{}", reg.number) : address;
        return fmt::format(
            "{} AT {}",
            given != context_.naming.registers.end() ? given->second : context_.naming.value_name(name),
            address);
    }

    /// The part of an action that a branch states itself, without ENTRY of the step it enters.
    Action said(const Action& action, std::uint8_t from) const {
        const bool enters = action.next && *action.next != from;
        return enters ? without(action, draft_.entries[*action.next]) : action;
    }

    void write_power_up() {
        Action action = said(draft_.power_up->action, 0);
        action.sends.erase(action.sends.begin(),
                           action.sends.begin() + static_cast<std::ptrdiff_t>(draft_.power_up->values));
        line(0, "");
        line(0, "POWER_UP");
        for (const Line& statement : statements_of(action, context_)) line(1, commented(statement));
        line(1, next_text(*action.next, context_));
        line(0, "END_POWER_UP");
        end_passage(Kind::power_up);
    }

    void write_step(std::size_t index) {
        const Part& part = layout_.steps[index];
        const std::optional<Shape>& shape = draft_.shapes[index];
        const bool numbered = numbered_ || part.number == 0;
        line(0, "");
        line(0, fmt::format("STEP {}{}:{}", names().steps[part.number],
                            numbered ? fmt::format(" AT {}", part.number) : "",
                            part.terms.empty() ? "  // the table only names it" : ""));
        write_outputs(part, shape);
        if (!shape || shape->plan.own_error) line(1, "OWN ERROR;");
        const bool takes =
            !context_.naming.set_points.empty() && ((names().set_points.takes >> part.number) & 1U) != 0;
        if (takes) line(1, "TAKES SET_POINTS;");
        end_passage(Kind::step, part.number);
        for (const Line& statement : statements_of(draft_.entries[part.number], context_))
            line(1, "ENTRY " + commented(statement));
        end_passage(Kind::entry, part.number);
        if (shape) write_branches(shape->plan);
        for (std::size_t i = shape ? shape->terms : 0; i < part.terms.size(); ++i)
            line(1, commented(term_line(part.terms[i], true, context_)));
        line(0, "END_STEP");
        end_passage(Kind::step, part.number);
    }

    void write_outputs(const Part& part, const std::optional<Shape>& shape) {
        const std::uint8_t outputs = draft_.around.outputs[part.number];
        if (draft_.says_outputs.test(part.number) && outputs != 0)
            line(1, outputs_text(outputs, context_.naming));
        if (!shape) return;
        Truth leaves = shape->plan.own_error ? Truth() : truth_of_bit(kErrorBit);
        for (const Rule& rule : shape->plan.rules) {
            if (rule.action.next && *rule.action.next != part.number) leaves |= rule.when;
        }
        for (const ConditionalOutput& output : shape->plan.conditional) {
            if (output.outputs == outputs) continue;  // a step with the number 0 writes its own in any case
            std::string text = outputs_text(output.outputs, context_.naming);
            text.pop_back();
            const Formula when = formula_of(output.when, output.when | leaves, context_.naming.bits);
            line(1, fmt::format("{} WHEN {};", text, when.text));
        }
    }

    void write_branches(const StepPlan& plan) {
        const std::vector<Link> chain = chain_of(plan.rules, context_.naming.bits);
        if (chain.size() == 1 && chain.front().condition.is_true)
            return write_statements(*chain.front().action, plan.number, 1);
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const bool last = i + 1 == chain.size();
            const Formula& condition = chain[i].condition;
            line(1, condition.is_true && last
                        ? "ELSE"
                        : fmt::format("{} {} THEN", i == 0 ? "IF" : "ELSIF",
                                      condition.is_true ? "NOT ERROR" : condition.text));
            write_statements(*chain[i].action, plan.number, 2);
        }
        if (!chain.empty()) line(1, "END_IF");
    }

    void write_statements(const Action& action, std::uint8_t step, std::size_t indent) {
        const bool leaves = action.next && *action.next != step;
        for (const Line& statement : statements_of(said(action, step), context_))
            line(indent, (leaves ? "" : "EVERY_SCAN ") + commented(statement));
        if (action.next) line(indent, next_text(*action.next, context_));
    }

    void write_outside() {
        line(0, "");
        end_passage(Kind::rest);
        if (!layout_.outside.empty()) line(0, "// behind the terms of all steps above");
        for (const TermBytes& term : layout_.outside) line(0, commented(term_line(term, false, context_)));
        if (layout_.end != kPlainEnd || (layout_.steps.empty() && layout_.outside.empty()))
            line(0, commented(term_line(layout_.end, false, context_)));
    }

    const Layout& layout_;
    const Draft& draft_;
    const WriterContext& context_;
    bool numbered_;
    WrittenProgram result_;
};

}  // namespace

std::string declaration_of(const set_points::SetPoint& point, const WriterContext& context) {
    const registers::Register* reg = point.at_power_up ? registers::find(context.motor, point.reg) : nullptr;
    std::string text = fmt::format("SET_POINT {}", point.name);
    if (reg != nullptr) text += " AT " + register_address(*reg, context);
    const std::string unit = point.unit.empty() ? "" : " " + point.unit;
    // The grid of the STEP begins at the lower end as written.
    const std::string low = point.grid_from  ? fmt::format("{}{}", *point.grid_from, unit)
                            : point.step > 0 ? set_points::text_of(point, point.lowest)
                                             : set_points::short_text_of(point, point.lowest);
    text += fmt::format(" := {} RANGE {} .. {}", set_points::short_text_of(point, point.initial), low,
                        set_points::short_text_of(point, point.highest));
    if (point.step > 0) text += fmt::format(" STEP {}{}", point.step, unit);
    return text + ";";
}

WrittenProgram write_program(const Layout& layout, const Draft& draft, const WriterContext& context,
                             const std::string& head) {
    return Writer(layout, draft, context).run(head);
}

}  // namespace nplc::seqc
