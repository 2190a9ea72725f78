#include "language/item_mistakes.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "language/names.h"
#include "language/statement_mistakes.h"

namespace nplc::seqc {
namespace {

/// OUT Lamp BLINKING 1 s IN Moving; outside of steps
bool refuse_blinking_group(TokenStream& in) {
    if (!is_one_of(in.token(), {"OUT"})) return false;
    std::size_t ahead = 1;
    while (in.token(ahead).kind != TokenKind::end && !in.is_symbol_at(ahead, ";") &&
           !same_name(in.token(ahead).text, "BLINKING"))
        ++ahead;
    if (!same_name(in.token(ahead).text, "BLINKING")) return false;
    const Span place = in.token(ahead).span;
    while (in.token(ahead).kind != TokenKind::end && !in.is_symbol_at(ahead, ";") &&
           !same_name(in.token(ahead).text, "IN"))
        ++ahead;
    if (!same_name(in.token(ahead).text, "IN")) return false;
    in.report().add("E010", place, "an OUT for many steps cannot blink",
                    "write OUT Lamp BLINKING T#500ms; in each of the steps");
    while (!in.at_symbol(";") && !in.at_end()) in.skip();
    in.take_symbol(";");
    return true;
}

}  // namespace

void mend_split_words(TokenStream& in) {
    constexpr std::pair<std::string_view, std::string_view> kEnds[] = {{"IF", "END_IF"},
                                                                       {"STEP", "END_STEP"},
                                                                       {"VAR", "END_VAR"},
                                                                       {"PROGRAM", "END_PROGRAM"},
                                                                       {"POWER_UP", "END_POWER_UP"}};
    const std::vector<Token>& tokens = in.tokens();
    for (std::size_t i = 0; i + 1 < tokens.size() && !in.report().full(); ++i) {
        if (!is_one_of(tokens[i], {"END"})) continue;
        for (const auto& [second, joined] : kEnds) {
            if (!is_one_of(tokens[i + 1], {second}) ||
                has_line_end(in, tokens[i].span.offset, tokens[i + 1].span.offset))
                continue;
            in.join(i, joined);
            in.report().add("E010", tokens[i].span, fmt::format("{} is one word", joined),
                            fmt::format("write {}", joined));
            break;
        }
    }
}

void refuse_twice(TokenStream& in, Span span, std::string_view what, Span first) {
    in.report()
        .add("E020", span, fmt::format("{} stands twice", what),
             what == "POWER_UP" ? "put all of it into one" : "keep one of the two")
        .notes.push_back({first, "the first one is here"});
}

bool refuse_foreign_item(TokenStream& in, ast::Program& program) {
    const Token first = in.token();
    if (refuse_blinking_group(in)) return true;
    if (!refuse_foreign_word(in)) return false;
    program.steps_missing = true;
    program.names_missing = true;
    if (same_name(first.text, "INITIAL_STEP")) {
        in.replace("STEP");
    } else if (in.token().text.data() == first.text.data()) {
        in.skip();
        recover_item(in);
    }
    return true;
}

void recover_item(TokenStream& in) {
    const auto inside = [&] {
        return in.at("IF") || in.at("ELSIF") || in.at("ELSE") || in.at("END_IF") || in.at("END_STEP") ||
               in.at("END_VAR") || in.at("END_POWER_UP");
    };
    while ((!in.at_boundary() || inside()) && !in.at("ON") && !in.at("TERM") && !in.at_end()) in.skip();
}

void miss_names(ast::Program& program) {
    program.steps_missing = program.names_missing = program.motor_missing = program.scale_missing = true;
}

}  // namespace nplc::seqc
