#include <algorithm>
#include <span>

#include "format/layout.h"

namespace nplc::seqc::layout {
namespace {

constexpr std::size_t kWidestAligned = 40;

bool may_break_before(const std::vector<Item*>& code, std::size_t i) {
    const Item& item = *code[i];
    return code[i - 1]->is_symbol(",") || item.is_keyword("AND") || item.is_keyword("OR") ||
           item.is_keyword("XOR") || item.is_keyword("WHEN");
}

bool may_wrap(const Line& line) {
    return code_width(line) > kWidest &&
           std::none_of(line.code.begin(), line.code.end(), [](const Item* item) {
               return item->is_keyword("TERM") || item->text.find('\n') != item->text.npos;
           });
}

/// Index after the last word of the line that begins at `first`. If no break fits the width, the line is as
/// short as possible.
std::size_t end_of_line(const std::vector<Item*>& code, std::size_t first, std::size_t indent) {
    std::size_t end = 0;
    std::size_t before = indent + width(code[first]->text);
    for (std::size_t i = first + 1; i < code.size(); ++i) {
        if (may_break_before(code, i)) end = i;
        before += code[i]->blanks + width(code[i]->text);
        if (before > kWidest && end > 0) return end;
    }
    return code.size();
}

void wrap_onto(std::vector<Line>& lines, Line line) {
    const std::vector<Item*> code = std::move(line.code);
    const std::vector<const Item*> comments = std::move(line.comments);
    line.comments.clear();
    std::size_t end = 0;
    for (std::size_t first = 0; end < code.size(); first = end) {
        end = end_of_line(code, first, line.indent);
        line.code.assign(code.begin() + static_cast<std::ptrdiff_t>(first),
                         code.begin() + static_cast<std::ptrdiff_t>(end));
        if (end == code.size()) line.comments = comments;
        lines.push_back(line);
        if (!line.continues) line.indent += 2 * kIndent;
        line.continues = true;
        line.blank_before = false;
    }
}

bool belongs_to_line_before(const Line& line) {
    return line.continues || line.continues_comment;
}

bool closes_block(const Line& line) {
    return line.role == Role::closer && line.indent == 0 && !line.is_own_comment;
}

bool opens_block(const Line& line) {
    return line.role == Role::opener && line.indent == 0;
}

/// Handles a statement's last line, the comment lines after it, and the first line of the next statement.
void keep_apart(std::span<Line> gap) {
    if (!closes_block(gap.front()) && !opens_block(gap.back())) return;
    const auto between = gap.subspan(1);
    if (std::none_of(between.begin(), between.end(), [](const Line& line) { return line.blank_before; }))
        between.front().blank_before = true;
}

struct Declaration {
    Item* at = nullptr;
    Item* type_or_value = nullptr;
    std::size_t name_width = 0;
    std::size_t address_width = 0;
};

/// Lines with comments among the words are not aligned.
bool is_aligned(std::span<const Line> rest) {
    const Line& line = rest.front();
    const bool is_whole = rest.size() < 2 || !rest[1].continues || rest[1].continues_comment;
    return line.role == Role::declaration && !belongs_to_line_before(line) && is_whole &&
           std::none_of(line.code.begin(), line.code.end(),
                        [](const Item* item) { return item->is_comment(); });
}

Declaration declaration_of(const Line& line) {
    Declaration result;
    std::size_t sum = 0;
    for (Item* item : line.code) {
        const bool is_first = item == line.code.front();
        if (item->is_keyword("AT") && result.at == nullptr) {
            result.at = item;
            result.name_width = sum;
            sum = 0;
        } else if (item->is_symbol(":") || item->is_symbol(":=")) {
            result.type_or_value = item;
            result.address_width = sum;
            break;
        } else {
            sum += (is_first ? 0U : item->blanks) + width(item->text);
        }
    }
    return result;
}

std::size_t widest(const std::vector<Declaration>& block, std::size_t Declaration::*column) {
    std::size_t most = 0;
    for (const Declaration& declaration : block) {
        if (declaration.*column <= kWidestAligned) most = std::max(most, declaration.*column);
    }
    return most;
}

void pad(Item* item, std::size_t own, std::size_t most) {
    if (item != nullptr && own < most) item->blanks = static_cast<std::uint8_t>(1 + most - own);
}

void align_block(std::vector<Declaration>& block) {
    const std::size_t names = widest(block, &Declaration::name_width);
    const std::size_t addresses = widest(block, &Declaration::address_width);
    for (Declaration& declaration : block) {
        pad(declaration.at, declaration.name_width, names);
        pad(declaration.type_or_value, declaration.address_width, addresses);
    }
    block.clear();
}

}  // namespace

void wrap(std::vector<Line>& lines) {
    std::vector<Line> result;
    result.reserve(lines.size());
    for (Line& line : lines) {
        if (may_wrap(line)) {
            wrap_onto(result, std::move(line));
        } else {
            result.push_back(std::move(line));
        }
    }
    lines = std::move(result);
}

void space_out(std::vector<Line>& lines) {
    std::size_t statement = lines.size();  // last line of the last statement
    for (std::size_t i = 0; i < lines.size(); ++i) {
        Line& line = lines[i];
        const bool at_edge = i == 0 || lines[i - 1].role == Role::opener ||
                             lines[i - 1].role == Role::middle || line.role == Role::closer ||
                             line.role == Role::middle;
        if (at_edge || belongs_to_line_before(line)) line.blank_before = false;
        if (line.is_own_comment) continue;
        if (statement < i && !belongs_to_line_before(line))
            keep_apart(std::span(lines).subspan(statement, i - statement + 1));
        statement = i;
    }
}

void align_declarations(std::vector<Line>& lines) {
    std::vector<Declaration> block;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].role == Role::opener || lines[i].role == Role::closer) align_block(block);
        if (is_aligned(std::span(lines).subspan(i))) block.push_back(declaration_of(lines[i]));
    }
    align_block(block);
}

}  // namespace nplc::seqc::layout
