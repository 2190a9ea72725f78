#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "case_file.h"
#include "language/lexer.h"
#include "language/reserved_words.h"
#include "seqc/format.h"
#include "support.h"

/// The tokens of known programs in layouts made up at random.
namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;

struct Program {
    std::string name;
    std::string text;  ///< as the formatter leaves it
    std::vector<Token> tokens;
    std::vector<Token> comments;
};

std::vector<Program> programs() {
    std::vector<Program> result;
    for (const test::Case& one : test::read_cases(SEQC_FORMAT))
        result.push_back({one.name, one.expected, {}, {}});
    std::set<fs::path> examples;
    for (const auto& entry : fs::directory_iterator(SEQC_EXAMPLES)) {
        if (entry.path().extension() == ".seq") examples.insert(entry.path());
    }
    for (const fs::path& path : examples)
        result.push_back({path.filename().string(), test::text_of_file(path), {}, {}});
    for (Program& program : result) {
        Report report;
        program.tokens = tokens_of(program.text, report, &program.comments);
        program.tokens.pop_back();
    }
    return result;
}

/// All but blanks, in small letters; comments as they are but for blanks at line ends. Independent of the
/// lexer.
std::string squeezed(const std::string& text) {
    std::string result;
    for (std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; at < text.size();) {
        const bool line = text.compare(at, 2, "//") == 0;
        const bool block = text.compare(at, 2, "(*") == 0;
        if (line || block) {
            const std::size_t end = line ? text.find('\n', at) : text.find("*)", at + 2) + 2;
            std::string comment = text.substr(at, std::min(end, text.size()) - at);
            comment.erase(std::remove(comment.begin(), comment.end(), '\r'), comment.end());
            while (line && (comment.back() == ' ' || comment.back() == '\t')) comment.pop_back();
            result += '[' + comment + ']';
            at = std::min(end, text.size());
            continue;
        }
        if (std::isspace(static_cast<unsigned char>(text[at])) == 0)
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(text[at])));
        ++at;
    }
    return result;
}

bool is_word(const Token& token) {
    return token.kind != TokenKind::symbol;
}

std::string random_case(std::string text, test::Random& random) {
    for (char& c : text) {
        const auto letter = static_cast<unsigned char>(c);
        c = static_cast<char>(random() % 2 == 0 ? std::toupper(letter) : std::tolower(letter));
    }
    return text;
}

std::string random_blanks(test::Random& random) {
    const char* const blanks[] = {" ", "  ", "\t", " \t ", "       ", "\f", "\v "};
    return blanks[random() % std::size(blanks)];
}

std::string random_comment(test::Random& random) {
    const char* const comments[] = {
        "// IF a; (* b",
        "// *) \xC2\xB5  \t",
        "//",
        "//no blank",
        "(* inside *)",
        "(**)",
        "(* two\n      lines *)",
        "(* END_IF // ; *)",
        "(*\r\n\tthree\r\n lines  \r\n*)",
        "(* a long one: lorem ipsum dolor sit amet, consectetur adipisici elit *)"};
    const std::string comment = comments[random() % std::size(comments)];
    return ' ' + comment + (comment.starts_with("//") ? "\n" : "");
}

/// Between any two tokens: blanks, line ends and comments, few or many.
std::string random_gap(bool needed, unsigned density, test::Random& random) {
    std::string gap;
    while (random() % 100 < density) {
        switch (random() % 6) {
            case 0:
                gap += "\n";
                break;
            case 1:
                gap += "\r\n";
                break;
            case 2:
                gap += random_comment(random);
                break;
            default:
                gap += random_blanks(random);
        }
    }
    return gap.empty() && needed ? " " : gap;
}

std::string scrambled(const Program& program, test::Random& random) {
    const unsigned density = random() % 90;
    std::string text = random_gap(false, density, random);
    for (std::size_t i = 0; i < program.tokens.size(); ++i) {
        const bool needed = i > 0 && is_word(program.tokens[i]) && is_word(program.tokens[i - 1]);
        // The compiler accepts no unit with a comment inside.
        const bool in_unit = program.tokens[i].text == "/" || (i > 0 && program.tokens[i - 1].text == "/");
        text += in_unit ? random_blanks(random) : random_gap(needed, density, random);
        text += random_case(std::string(program.tokens[i].text), random);
    }
    return text + random_gap(false, density, random);
}

TEST(FormatGenerated, AnyLayoutKeepsWordsAndCommentsAndFormattingAgainChangesNothing) {
    const std::vector<Program> known = programs();
    ASSERT_GE(known.size(), 11U);
    for (unsigned seed = 0; seed < 2'500; ++seed) {
        test::Random random(seed);
        const Program& program = known[seed % known.size()];
        const std::string source = scrambled(program, random);
        const Formatted result = format_program(source);
        ASSERT_TRUE(result.ok) << "seed " << seed << ' ' << result.fault << '\n' << source;
        ASSERT_EQ(squeezed(result.text), squeezed(source)) << "seed " << seed;
        ASSERT_EQ(format_program(result.text).text, result.text) << "seed " << seed << '\n' << source;
    }
}

TEST(FormatGenerated, TheBytesAreTheSameBeforeAndAfter) {
    int compiled = 0;
    for (const Program& program : programs()) {
        const std::vector<std::uint8_t> table = compile(program.text).table;
        if (table.empty()) continue;
        ++compiled;
        for (unsigned seed = 0; seed < 20; ++seed) {
            test::Random random(seed);
            const std::string source = scrambled(program, random);
            ASSERT_EQ(compile(source).table, table) << program.name << " seed " << seed;
            ASSERT_EQ(compile(format_program(source).text).table, table) << program.name << " seed " << seed;
        }
    }
    EXPECT_GE(compiled, 3);
}

/// White space without a meaning: how far lines are indented, the length of a gap, blanks at line ends, the
/// kind of line ends, how many blank lines stand in a row.
std::string other_white_space(const Program& program, test::Random& random) {
    std::vector<Token> items = program.tokens;
    items.insert(items.end(), program.comments.begin(), program.comments.end());
    std::sort(items.begin(), items.end(),
              [](const Token& a, const Token& b) { return a.span.offset < b.span.offset; });
    const std::string line_end = random() % 2 == 0 ? "\n" : "\r\n";
    std::string text;
    std::size_t end = 0;
    for (const Token& item : items) {
        const std::string gap = program.text.substr(end, item.span.offset - end);
        const auto breaks = std::count(gap.begin(), gap.end(), '\n');
        const bool in_line = breaks == 0 && !text.empty();
        if (breaks > 0 && random() % 4 == 0) text += random_blanks(random);
        for (long i = 0; i < breaks; ++i) text += line_end;
        if (breaks > 1 && random() % 2 == 0) text += line_end + line_end;
        if (in_line && item.kind == TokenKind::comment) {
            text += std::string(24 + random() % 5, ' ');  // further right than any line begins
        } else if (in_line ? !gap.empty() || random() % 3 == 0 : random() % 2 == 0) {
            text += random_blanks(random);
        }
        const bool keyword = item.kind == TokenKind::identifier && is_reserved(item.text);
        text += keyword ? random_case(std::string(item.text), random) : std::string(item.text);
        end = item.span.offset + item.span.length;
    }
    return text + (random() % 2 == 0 ? "" : line_end + line_end + "\t");
}

/// A comment before ELSIF and one that goes on below another have a meaning by their columns.
bool has_telling_columns(const Program& program) {
    return program.name == "comments" || program.name == "trailing_comments";
}

TEST(FormatGenerated, WhiteSpaceThatSaysNothingIsNotLookedAt) {
    const std::vector<Program> known = programs();
    for (unsigned seed = 0; seed < 1'500; ++seed) {
        test::Random random(seed);
        const Program& program = known[seed % known.size()];
        if (has_telling_columns(program)) continue;
        const std::string source = other_white_space(program, random);
        ASSERT_EQ(format_program(source).text, program.text) << program.name << " seed " << seed << '\n'
                                                             << source;
    }
}

}  // namespace
}  // namespace nplc::seqc
