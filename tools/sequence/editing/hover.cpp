#include "editing/hover.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/model.h"
#include "editing/completion.h"
#include "editing/register_text.h"
#include "language/names.h"
#include "report/describe.h"
#include "report/table_report.h"
#include "report/table_text.h"
#include "sequencer/term.h"
#include "symbols/commands.h"
#include "table/terms.h"

namespace nplc::seqc::analysis {
namespace {

using sequencer::kTermBytes;

sequencer::TermView term_at(const Compilation& compiled, std::size_t index) {
    return std::span(compiled.table).subspan(index * kTermBytes).first<kTermBytes>();
}

std::string ways_text(const Compilation& compiled, std::uint8_t step) {
    const TableReport report = report_of(compiled.table, &compiled.symbols, {});
    std::string text;
    for (const TableReport::Transition& way : report.transitions) {
        if (way.from != step) continue;
        const std::string condition = condition_text(way.when, {}, &compiled.symbols);
        const double ms = milliseconds(way.line.until_done, report.settings.baud);
        text += fmt::format(
            "- {} `{}`{}{}\n",
            way.to == way.from ? "stays, when" : "to **" + step_name(way.to, &compiled.symbols) + "** when",
            condition, way.orders.empty() ? "" : fmt::format(": {}", fmt::join(way.orders, ", ")),
            ms > 0 ? fmt::format("; {:.1f} ms on the motor's line", ms) : "");
    }
    return text.empty() ? text : "\nWays out:\n" + text;
}

std::string step_text(const Program& program, std::string_view name) {
    const auto number = program.number_of_step(name);
    if (!number) return fmt::format("step `{}`", name);
    std::string text = fmt::format("**step {}**, number {}\n", name, *number);
    const Compilation& compiled = program.compiled();
    if (!compiled.ok) return text + "\nThe program has errors: there is no table to show.\n";
    std::string terms;
    std::size_t count = 0;
    constexpr std::size_t kShown = 24;
    for (std::size_t i = 0; i < compiled.origins.size(); ++i) {
        const sequencer::TermView bytes = term_at(compiled, i);
        if (sequencer::is_end(bytes) || sequencer::step_of(bytes) != *number) continue;
        if (++count <= kShown)
            terms += fmt::format("{:4}  {} {}\n", i, table::hex(bytes), describe(bytes, &compiled.symbols));
    }
    if (count > kShown) terms += fmt::format("... {} more\n", count - kShown);
    text += ways_text(compiled, *number);
    return text + fmt::format("\n{} term{}:\n```\n{}```\n", count, count == 1 ? "" : "s", terms);
}

std::string definition_text(const Program& program, const Definition& definition) {
    switch (definition.kind) {
        case Kind::step:
            return step_text(program, definition.name);
        case Kind::motor_variable: {
            const auto* reg = program.register_named(definition.name);
            std::string text = fmt::format("**{}** at {}\n\n", definition.name, definition.address);
            for (const Constant& constant : program.constants()) {
                if (holds(definition.whole, constant.span.offset))
                    text += fmt::format("`{}` is {}\n\n", program.text(constant.span),
                                        constant_text(program, constant));
            }
            return reg != nullptr ? text + register_text(program, *reg) : text;
        }
        case Kind::set_point: {
            std::string text = fmt::format("set-point `{}`\n\n", program.text(definition.whole));
            const auto* reg = program.register_named(definition.name);
            return reg != nullptr ? text + register_text(program, *reg) : text;
        }
        case Kind::input:
            return definition.is_inverted
                       ? fmt::format("input **{}** at NOT {}: on while the wire is off", definition.name,
                                     definition.address)
                       : fmt::format("input **{}** at {}", definition.name, definition.address);
        case Kind::output:
            return fmt::format("output **{}** at {}", definition.name, definition.address);
        default:
            return fmt::format("`{}`", program.text(definition.whole));
    }
}

std::string reference_text(const Program& program, const Reference& reference) {
    if (const Definition* definition = program.definition_of(reference))
        return definition_text(program, *definition);
    const std::string_view word = program.text(reference.span);
    if (const auto* reg = program.register_named(word);
        reg != nullptr &&
        (reference.role == ast::Role::register_name || reference.role == ast::Role::command))
        return register_text(program, *reg);
    if (reference.role == ast::Role::step && same_name(word, "POWER_UP"))
        return step_text(program, "POWER_UP");
    return documentation_of(upper(word));
}

std::size_t terms_between(const Compilation& compiled, std::uint32_t begin, std::uint32_t end) {
    return static_cast<std::size_t>(
        std::count_if(compiled.origins.begin(), compiled.origins.end(), [&](const TermOrigin& origin) {
            return origin.span.length > 0 && origin.span.offset >= begin && origin.span.offset < end;
        }));
}

std::string count_text(std::size_t terms) {
    return terms == 1 ? "1 term" : fmt::format("{} terms", terms);
}

void add_step_hints(const Program& program, const ast::Step& step, std::vector<Hint>& hints) {
    const Compilation& compiled = program.compiled();
    const auto number = program.number_of_step(step.name.text);
    std::size_t terms = 0;
    for (std::size_t i = 0; i < compiled.origins.size(); ++i) {
        const sequencer::TermView bytes = term_at(compiled, i);
        if (number && !sequencer::is_end(bytes) && sequencer::step_of(bytes) == *number) ++terms;
    }
    hints.push_back(
        {end_of(step.name.span), " " + count_text(terms), "of step " + std::to_string(number.value_or(0))});
    for (const ast::Choice& choice : step.choices) {
        for (std::size_t i = 0; choice.branches.size() > 1 && i < choice.branches.size(); ++i) {
            const ast::Branch& branch = choice.branches[i];
            const std::uint32_t last =
                branch.statements.empty() ? end_of(branch.span) : end_of(branch.statements.back().span);
            const std::size_t own = terms_between(compiled, branch.span.offset, last);
            const std::uint32_t at = branch.condition ? end_of(branch.condition->span) : end_of(branch.span);
            if (own > 0) hints.push_back({at, " " + count_text(own), "of this branch"});
        }
    }
}

}  // namespace

std::optional<Hover> hover_at(const Program& program, std::uint32_t offset) {
    if (program.in_comment(offset)) return std::nullopt;
    for (const Constant& constant : program.constants()) {
        if (!holds(constant.span, offset)) continue;
        std::string text = fmt::format("`{}` in {} is {}\n", program.text(constant.span), constant.reg->name,
                                       constant_text(program, constant));
        for (const Rounding& rounding : program.compiled().roundings) {
            if (rounding.span == constant.span) text += fmt::format("\n{}\n", rounding.text);
        }
        return Hover{constant.span, text + "\n" + register_text(program, *constant.reg)};
    }
    if (const Reference* reference = program.reference_at(offset)) {
        std::string text = reference_text(program, *reference);
        if (!text.empty()) return Hover{reference->span, std::move(text)};
    }
    const Token* token = program.token_at(offset);
    if (token == nullptr || token->kind != TokenKind::identifier) return std::nullopt;
    std::string text = documentation_of(upper(token->text));
    if (text.empty()) return std::nullopt;
    return Hover{token->span, std::move(text)};
}

std::vector<Hint> hints_in(const Program& program, Span range) {
    std::vector<Hint> hints;
    for (const Constant& constant : program.constants()) {
        const std::string raw = std::to_string(constant.raw);
        if (program.text(constant.span) != raw)
            hints.push_back({end_of(constant.span), " = " + raw, constant_text(program, constant)});
    }
    if (program.compiled().ok) {
        for (const ast::Step& step : program.tree().steps) add_step_hints(program, step, hints);
        const std::size_t used = static_cast<std::size_t>(std::count_if(
            program.compiled().symbols.steps.begin() + 1, program.compiled().symbols.steps.end(),
            [](const std::string& name) { return !name.empty(); }));
        if (!program.tree().name.text.empty())
            hints.push_back({end_of(program.tree().name.span),
                             fmt::format(" {} of {} steps, {}", used, kMostSteps,
                                         count_text(program.compiled().origins.size() - 1)),
                             "with those that the compiler makes"});
    }
    std::erase_if(hints, [&](const Hint& hint) { return !holds(range, hint.offset); });
    std::sort(hints.begin(), hints.end(), [](const Hint& a, const Hint& b) { return a.offset < b.offset; });
    return hints;
}

}  // namespace nplc::seqc::analysis
