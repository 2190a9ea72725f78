#include "editing/fixes.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/names.h"

namespace nplc::seqc::analysis {
namespace {

/// The text between two marks; empty if they are missing.
std::string between(std::string_view text, std::string_view before, std::string_view after) {
    const std::size_t begin = text.find(before);
    if (begin == text.npos) return "";
    const std::size_t from = begin + before.size();
    const std::size_t end = after.empty() ? text.size() : text.find(after, from);
    return end == text.npos ? "" : std::string(text.substr(from, end - from));
}

class Fixer {
  public:
    Fixer(const Program& program, const Diagnostic& diagnostic) : program_(program), d_(diagnostic) {}

    std::vector<Fix> find() {
        misspelt();
        punctuation();
        blocks();
        unknown_names();
        errors();
        statements();
        values();
        return std::move(fixes_);
    }

  private:
    bool is(std::string_view code) const { return d_.code == code; }
    bool says(std::string_view words) const { return d_.message.find(words) != d_.message.npos; }
    bool advises(std::string_view words) const { return d_.help.find(words) != d_.help.npos; }

    void add(std::string title, Span span, std::string text, bool preferred = true) {
        fixes_.push_back({std::move(title), {{span, std::move(text)}}, preferred});
    }
    void insert(std::string title, std::uint32_t offset, std::string text) {
        add(std::move(title), {offset, 0}, std::move(text));
    }

    void misspelt() {
        const std::string meant = between(d_.help, "did you mean '", "'");
        if (!meant.empty()) add(fmt::format("Write '{}'", meant), d_.span, meant);
    }

    void punctuation() {
        if (!is("E010")) return;
        if (says("expected ';' before")) insert("Insert ';'", d_.span.offset, ";");
        if (says("expected ':' after the step's name")) insert("Insert ':'", d_.span.offset, ":");
        if (advises("write := with a colon")) add("Write ':='", d_.span, ":=");
        if (says("expected THEN after the condition")) insert("Insert THEN", end_of_token_before(), " THEN");
        if (says("ELSE IF is the word ELSIF")) else_if();
        if (says("a motor's name is one word") || says("a name is one word"))
            add("Write it as one word", d_.span, one_word());
        if (advises("names stand without quotes")) {
            std::string plain(program_.text(d_.span));
            std::erase(plain, '\'');
            add("Take the quotes away", d_.span, plain);
        }
    }

    /// Also removes one of two consecutive END_IF.
    void else_if() {
        Fix fix{"Write ELSIF", {{d_.span, "ELSIF"}}, true};
        const Token* before = nullptr;
        for (const Token& token : program_.tokens()) {
            if (token.span.offset < d_.span.offset || token.text == ";") continue;
            const bool ends = token.kind == TokenKind::identifier && same_name(token.text, "END_IF");
            if (ends && before != nullptr) {
                fix.edits.push_back({{end_of(before->span), end_of(token.span) - end_of(before->span)}, ""});
                break;
            }
            before = ends ? &token : nullptr;
        }
        fixes_.push_back(std::move(fix));
    }

    std::string one_word() const {
        const std::string motor = between(d_.help, "write MOTOR ", ";");
        return motor.empty() ? between(d_.help, "write STEP ", ":") : motor;
    }

    std::uint32_t end_of_token_before() const {
        std::uint32_t end = 0;
        for (const Token& token : program_.tokens()) {
            if (token.span.offset >= d_.span.offset) break;
            if (token.kind != TokenKind::end) end = end_of(token.span);
        }
        return end;
    }

    std::string indentation_at(std::uint32_t offset) const {
        const std::string_view line = program_.lines().line(program_.lines().line_of(offset));
        return std::string(line.substr(0, std::min(line.find_first_not_of(" \t"), line.size())));
    }

    void blocks() {
        const bool open =
            is("E012") || (!d_.notes.empty() && d_.notes.back().message.ends_with("is still open"));
        if (!open) return;
        for (const Note& note : d_.notes) {
            const std::string block = between(note.message, "this ", " is still open");
            if (block.empty()) continue;
            insert("Insert END_" + block, end_of_token_before(),
                   fmt::format("\n{}END_{}", indentation_at(note.span.offset), block));
        }
    }

    /// Position before END_PROGRAM, or the end of the file.
    std::uint32_t end_of_program() const {
        for (const Token& token : program_.tokens()) {
            if (token.kind == TokenKind::identifier && same_name(token.text, "END_PROGRAM"))
                return program_.lines().start_of(program_.lines().line_of(token.span.offset));
        }
        return program_.size();
    }

    std::string new_step(std::string_view name) const {
        return fmt::format("\nSTEP {}:\n{}END_STEP\n", name,
                           program_.tree().on_error ? "" : "    OWN ERROR;\n");
    }

    void unknown_names() {
        if (!is("E021")) return;
        const std::string step = between(d_.message, "there is no step '", "'");
        if (!step.empty()) {
            add(fmt::format("Add STEP {}", step), {end_of_program(), 0}, new_step(step), fixes_.empty());
            return;
        }
        const std::string declaration = between(d_.help, "under VAR_", "");
        const std::size_t colon = declaration.find(": ");
        if (colon == declaration.npos) return;
        const std::string block = "VAR_" + declaration.substr(0, colon);
        const std::string line = declaration.substr(colon + 2);
        add(fmt::format("Declare it: {}", line), {place_in(block), 0},
            has_block(block) ? fmt::format("    {}\n", line)
                             : fmt::format("{}\n    {}\nEND_VAR\n", block, line),
            false);
    }

    bool has_block(std::string_view opening) const { return opening_of(opening) != nullptr; }
    const Token* opening_of(std::string_view word) const {
        for (const Token& token : program_.tokens()) {
            if (token.kind == TokenKind::identifier && same_name(token.text, word)) return &token;
        }
        return nullptr;
    }
    /// The line after the block's first word, or after the program header.
    std::uint32_t place_in(std::string_view block) const {
        const Token* opening = opening_of(block);
        return opening != nullptr ? next_line(opening->span.offset) : after_head();
    }
    std::uint32_t next_line(std::uint32_t offset) const {
        const std::uint32_t line = program_.lines().line_of(offset) + 1;
        return line < program_.lines().count() ? program_.lines().start_of(line) : program_.size();
    }
    std::uint32_t after_head() const {
        std::uint32_t after = next_line(program_.tree().name.span.offset);
        if (program_.tree().motor) after = std::max(after, next_line(program_.tree().motor->span.offset));
        if (program_.tree().scale) after = std::max(after, next_line(program_.tree().scale->span.offset));
        return after;
    }

    void errors() {
        if (is("E031"))
            insert("Name the motor: MOTOR MAC140;", next_line(program_.tree().name.span.offset),
                   "MOTOR MAC140;\n");
        if (is("E080") && !program_.tree().on_error) {
            const bool has_fault = program_.find(Kind::step, "Fault") != nullptr;
            Fix fix{
                "Add ON ERROR NEXT := Fault;", {{{before_steps(), 0}, "ON ERROR NEXT := Fault;\n\n"}}, false};
            if (!has_fault)
                fix.edits.push_back(
                    {{end_of_program(), 0}, "\nSTEP Fault:\n    OWN ERROR;\n    ENTRY STOP;\nEND_STEP\n"});
            fixes_.push_back(std::move(fix));
        }
        if (is("E080") || is("E081") || is("E082")) own_error();
    }

    std::uint32_t before_steps() const {
        for (const Token& token : program_.tokens()) {
            if (token.kind == TokenKind::identifier &&
                (same_name(token.text, "STEP") || same_name(token.text, "POWER_UP")))
                return program_.lines().start_of(program_.lines().line_of(token.span.offset));
        }
        return after_head();
    }

    void own_error() {
        const ast::Step* step = program_.step_at(d_.span.offset);
        if (step == nullptr || step->own_error) return;
        const auto colon = std::find_if(
            program_.tokens().begin(), program_.tokens().end(),
            [&](const Token& t) { return t.span.offset >= end_of(step->name.span) && t.text == ":"; });
        if (colon == program_.tokens().end()) return;
        const std::uint32_t at = end_of(colon->span);
        const bool same_line = program_.lines().line_of(at) == program_.lines().line_of(end_of(d_.span)) &&
                               !program_.lines().line(program_.lines().line_of(at)).ends_with(':');
        add(fmt::format("Write OWN ERROR; in step {}", step->name.text), {at, 0},
            same_line ? " OWN ERROR;" : "\n    OWN ERROR;");
    }

    void statements() {
        if (is("E060") && advises("EVERY_SCAN")) {
            if (advises("ENTRY")) insert("Insert ENTRY", d_.span.offset, "ENTRY ");
            add("Insert EVERY_SCAN", {d_.span.offset, 0}, "EVERY_SCAN ", false);
        }
        if (is("E064") && says("EVERY_SCAN does not go with"))
            add("Leave EVERY_SCAN out", {d_.span.offset, d_.span.length + 1}, "");
        if (is("E050") && says("takes nothing in parentheses"))
            add("Leave the parentheses out", d_.span, between(d_.help, "write ", ";"));
        if (is("E014") && advises("write TIMER.Q or COUNTER.Q")) {
            const bool timer = upper(program_.text(d_.span)).starts_with("TIMER");
            const std::string test = timer ? "TIMER.Q" : "COUNTER.Q";
            add("Write " + test, d_.span, test);
        }
        if (is("W021") && advises("write ANY ERROR AND in front")) {
            const std::string condition(program_.text(d_.span));
            const bool joined = upper(condition).find(" OR ") != condition.npos;
            add("Write ANY ERROR AND in front", d_.span,
                joined ? fmt::format("ANY ERROR AND ({})", condition) : "ANY ERROR AND " + condition);
        }
        if (is("E096")) {
            const std::string name = between(d_.help, "write NEXT := ", ";");
            if (!name.empty()) add("Write " + name, d_.span, name);
        }
    }

    void values() {
        if (is("W007") && advises("write T#1ms")) add("Write T#1ms", d_.span, "T#1ms");
        if (is("W002") && advises("if that will do")) {
            const std::string time = between(d_.help, "write ", " if");
            add("Write " + time, d_.span, time);
        }
        if (is("E003") && says("decimal point"))
            add("Write " + between(d_.help, "write ", ""), d_.span, between(d_.help, "write ", ""));
        if (is("E043") && advises("if these are milliseconds")) {
            const std::string number(program_.text(d_.span));
            const bool plain =
                std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
            if (plain) add(fmt::format("Write T#{}ms", number), d_.span, fmt::format("T#{}ms", number));
        }
    }

    const Program& program_;
    const Diagnostic& d_;
    std::vector<Fix> fixes_;
};

}  // namespace

std::vector<Fix> fixes_for(const Program& program, const Diagnostic& diagnostic) {
    return Fixer(program, diagnostic).find();
}

std::vector<Fix> allow_in(const Program& program, Span step_name, std::string_view code) {
    const auto colon = std::find_if(program.tokens().begin(), program.tokens().end(), [&](const Token& t) {
        return t.span.offset >= end_of(step_name) && t.text == ":";
    });
    if (step_name.length == 0 || colon == program.tokens().end()) return {};
    return {{fmt::format("Allow {} in this step", code),
             {{{end_of(colon->span), 0}, fmt::format("\n    ALLOW {} BECAUSE 'say why';", code)}},
             false}};
}

}  // namespace nplc::seqc::analysis
