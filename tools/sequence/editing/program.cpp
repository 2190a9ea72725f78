#include "editing/program.h"

#include <algorithm>

#include "compiler/sequences.h"
#include "language/lexer.h"
#include "language/names.h"
#include "language/parser.h"

namespace nplc::seqc::analysis {
namespace {

using ast::Role;

/// An include file without a program is parsed separately.
ast::Program parsed(const Sources& sources, Report& report, bool& is_part) {
    Parser parser(sources, report);
    is_part = is_part || parser.at_part();
    return parser.at_part() ? parser.parse_part() : parser.parse();
}

bool fits(Kind kind, Role role, bool in_property) {
    switch (role) {
        case Role::program:
            return kind == Kind::program;
        case Role::step:
            return kind == Kind::step;
        case Role::step_or_group:
            return kind == Kind::step || kind == Kind::group || kind == Kind::sequence;
        case Role::group:
            return kind == Kind::group;
        case Role::input:
            return kind == Kind::input;
        case Role::output:
            return kind == Kind::output;
        case Role::tested:
            return kind == Kind::input || (in_property && kind == Kind::output);
        case Role::motor_variable:
        case Role::command:
        case Role::register_name:
            return kind == Kind::motor_variable || kind == Kind::set_point;
        case Role::constant:
            return kind == Kind::constant || kind == Kind::set_point;
        case Role::property:
            return kind == Kind::property;
        case Role::sequence:
            return kind == Kind::sequence;
        case Role::argument:
            return kind == Kind::input || kind == Kind::output || kind == Kind::motor_variable ||
                   kind == Kind::constant || kind == Kind::step || kind == Kind::set_point;
        default:
            return false;
    }
}

}  // namespace

Program::Program(std::string source) : Program(Sources({{}, std::move(source)})) {}

Program::Program(Sources sources)
    : sources_(std::move(sources)),
      is_part_(&sources_.program() != &sources_.files().front()),
      lines_(sources_.text_of(sources_.files().front())) {
    if (sources_.text().size() > kLongestSource) return;
    tokens_ = tokens_of(source(), noise_, &comments_);
    tree_ = parsed(sources_, noise_, is_part_);
    grammar_ = Report(noise_).take();
    expand_sequences(tree_, noise_);
    scope_.emplace(tree_, sources_.text(), noise_, named_);
    define();
    resolve();
    work_out_constants();
}

const Compilation& Program::compiled() const {
    if (!compiled_) compiled_ = compile(sources_);
    return *compiled_;
}

std::optional<LengthUnit> Program::length_unit() const {
    const auto& scale = symbols().scale;
    if (!scale) return std::nullopt;
    return LengthUnit{scale->unit, scale->length / scale->revolutions};
}

/// From a name to the semicolon that ends its declaration.
Span Program::declaration_of(Span name) const {
    auto token = std::lower_bound(tokens_.begin(), tokens_.end(), name.offset,
                                  [](const Token& t, std::uint32_t at) { return t.span.offset < at; });
    std::uint32_t end = end_of(name);
    for (; token != tokens_.end() && token->kind != TokenKind::end; ++token) {
        if (token->span.offset >= end && same_name(token->text, "END_VAR")) break;
        end = end_of(token->span);
        if (token->text == ";") break;
    }
    return {name.offset, end - name.offset};
}

/// The innermost block around a name.
Span Program::block_of(Span name, std::string_view end_word) const {
    Span best = name;
    for (const ast::Block& block : tree_.blocks) {
        if (block.end_word != end_word || !holds(block.span, name.offset)) continue;
        if (best == name || block.span.length < best.length) best = block.span;
    }
    return best;
}

void Program::define() {
    for (const ast::Use& use : tree_.uses) {
        if (!use.declares) continue;
        const std::string_view name = text(use.span);
        switch (use.role) {
            case Role::program:
                definitions_.push_back(
                    {Kind::program, name, use.span, block_of(use.span, "END_PROGRAM"), {}});
                break;
            case Role::step:
                definitions_.push_back({Kind::step, name, use.span, block_of(use.span, "END_STEP"), {}});
                break;
            case Role::group:
                definitions_.push_back({Kind::group, name, use.span, declaration_of(use.span), {}});
                break;
            case Role::constant:
                definitions_.push_back({Kind::constant, name, use.span, declaration_of(use.span), {}});
                break;
            case Role::sequence:
                definitions_.push_back(
                    {Kind::sequence, name, use.span, block_of(use.span, "END_SEQUENCE"), {}});
                break;
            case Role::parameter:
                definitions_.push_back(
                    {Kind::parameter, name, use.span, block_of(use.span, "END_SEQUENCE"), {}});
                break;
            case Role::property:
                definitions_.push_back({Kind::property, name, use.span, declaration_of(use.span), {}});
                break;
            default: {
                const Kind kind = use.role == Role::input       ? Kind::input
                                  : use.role == Role::output    ? Kind::output
                                  : use.role == Role::set_point ? Kind::set_point
                                                                : Kind::motor_variable;
                definitions_.push_back({kind, name, use.span, declaration_of(use.span), {}});
            }
        }
    }
    const auto note_address = [this](const auto& declared) {
        for (Definition& definition : definitions_) {
            if (definition.name_span == declared.name.span) definition.address = declared.address.text;
        }
    };
    for (const ast::Variable& input : tree_.inputs) {
        for (Definition& definition : definitions_) {
            if (definition.name_span == input.name.span) definition.is_inverted = input.inverted.length != 0;
        }
    }
    for (const auto* variables : {&tree_.inputs, &tree_.outputs, &tree_.motor_variables})
        std::for_each(variables->begin(), variables->end(), note_address);
    std::for_each(tree_.set_points.begin(), tree_.set_points.end(), note_address);
}

std::size_t Program::target_of(const ast::Use& use) const {
    const bool property = use.role == Role::tested && in_property(use.span.offset);
    const auto [begin, end] = by_name_.equal_range(upper(text(use.span)));
    std::size_t first = Reference::kNone;
    for (auto named = begin; named != end; ++named) {
        const Definition& definition = definitions_[named->second];
        const bool itself = use.declares && definition.name_span == use.span;
        if (itself) return named->second;
        const bool is_parameter =
            definition.kind == Kind::parameter && holds(definition.whole, use.span.offset);
        if (is_parameter && !use.declares) return named->second;
        if (!use.declares && fits(definition.kind, use.role, property))
            first = std::min(first, named->second);
    }
    return first;
}

void Program::resolve() {
    for (std::size_t i = 0; i < definitions_.size(); ++i) by_name_.emplace(upper(definitions_[i].name), i);
    for (const ast::Use& use : tree_.uses)
        references_.push_back({use.span, use.role, target_of(use), use.declares});
    std::stable_sort(references_.begin(), references_.end(),
                     [](const Reference& a, const Reference& b) { return a.span.offset < b.span.offset; });
}

void Program::work_out(const ast::Value& value, const registers::Register* reg) {
    if (reg == nullptr || value.span.length == 0) return;
    const auto bits = scope_->value(value, *reg, reg->name);
    if (!bits) return;
    constants_.push_back(
        {value.span, reg, *bits, static_cast<std::int64_t>(number_of_bits(*bits, reg->format))});
}

void Program::work_out(const std::vector<ast::Statement>& statements) {
    for (const ast::Statement& statement : statements) {
        if (statement.kind == ast::Statement::Kind::assign)
            work_out(statement.value, scope_->find_register(statement.name.text));
    }
}

void Program::work_out_constants() {
    for (const ast::Variable& variable : tree_.motor_variables) {
        if (variable.value) work_out(*variable.value, scope_->find_register(variable.address.text));
    }
    const auto work_out_step = [&](const ast::Step& step) {
        work_out(step.entry);
        for (const ast::Choice& choice : step.choices) {
            for (const ast::Branch& branch : choice.branches) work_out(branch.statements);
        }
    };
    for (const ast::Step& step : tree_.steps) work_out_step(step);
    if (tree_.power_up) work_out_step(*tree_.power_up);
    std::sort(constants_.begin(), constants_.end(),
              [](const Constant& a, const Constant& b) { return a.span.offset < b.span.offset; });
}

const Reference* Program::reference_at(std::uint32_t offset) const {
    for (const Reference& reference : references_) {
        if (holds(reference.span, offset)) return &reference;
    }
    return nullptr;
}

const Token* Program::token_at(std::uint32_t offset) const {
    const Token* touched = nullptr;
    for (const Token& token : tokens_) {
        if (token.span.offset > offset) break;
        if (token.kind != TokenKind::end && holds(token.span, offset)) touched = &token;
    }
    return touched;
}

const Definition* Program::definition_of(const Reference& reference) const {
    return reference.definition == Reference::kNone ? nullptr : &definitions_[reference.definition];
}

const Definition* Program::find(Kind kind, std::string_view name) const {
    for (const Definition& definition : definitions_) {
        if (definition.kind == kind && same_name(definition.name, name)) return &definition;
    }
    return nullptr;
}

const registers::Register* Program::register_named(std::string_view name) const {
    return scope_ ? scope_->find_register(name) : nullptr;
}

const ast::Step* Program::step_at(std::uint32_t offset) const {
    for (const ast::Step& step : tree_.steps) {
        if (holds(block_of(step.name.span, "END_STEP"), offset)) return &step;
    }
    if (tree_.power_up && holds(block_of(tree_.power_up->name.span, "END_POWER_UP"), offset))
        return &*tree_.power_up;
    return nullptr;
}

std::optional<std::uint8_t> Program::number_of_step(std::string_view name) const {
    if (same_name(name, "POWER_UP")) return 0;
    if (!scope_) return std::nullopt;
    for (std::size_t i = 0; i < scope_->steps().size(); ++i) {
        if (same_name(scope_->steps()[i]->name.text, name)) return scope_->number_of(i);
    }
    return std::nullopt;
}

bool Program::in_property(std::uint32_t offset) const {
    return std::any_of(tree_.claims.begin(), tree_.claims.end(),
                       [&](const ast::Claim& claim) { return holds(claim.span, offset); });
}

bool Program::in_comment(std::uint32_t offset) const {
    return std::any_of(comments_.begin(), comments_.end(), [&](const Token& comment) {
        const bool to_line_end = comment.text.starts_with("//");
        return offset > comment.span.offset &&
               (to_line_end ? offset <= end_of(comment.span) : offset < end_of(comment.span));
    });
}

}  // namespace nplc::seqc::analysis
