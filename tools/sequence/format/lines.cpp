#include "format/layout.h"

namespace nplc::seqc::layout {
namespace {

using Kind = Item::Kind;

class Assembler {
  public:
    explicit Assembler(Document& document) : items_(document.items) {}

    std::vector<Line> run() {
        for (std::size_t i = 0; i < items_.size();) {
            if (!items_[i].is_comment()) {
                add_token(items_[i++]);
                continue;
            }
            std::size_t next = i;
            while (next < items_.size() && items_[next].is_comment()) ++next;
            add_comments(i, next);
            i = next;
        }
        return std::move(lines_);
    }

  private:
    Line& begin_line(const Item& first, std::size_t indent, Role role) {
        Line& line = lines_.emplace_back();
        line.indent = indent;
        line.role = role;
        line.blank_before = first.breaks > 1;
        must_break_ = false;
        return line;
    }

    Line& continue_statement() {
        const Line before = lines_.back();
        Line& line = lines_.emplace_back();
        line.indent = before.continues ? before.indent : before.indent + 2 * kIndent;
        line.role = before.role;
        line.continues = true;
        must_break_ = false;
        return line;
    }

    void add_token(Item& token) {
        if (line_begun_) {
            line_begun_ = false;
        } else if (token.starts_line || lines_.empty()) {
            begin_line(token, token.level * kIndent, token.role);
        } else if (must_break_) {
            continue_statement();
        }
        lines_.back().code.push_back(&token);
    }

    /// Adds the comments `first` to `next`, which are followed by the token `next` or the end.
    void add_comments(std::size_t first, std::size_t next) {
        const bool at_end = next == items_.size();
        if (!lines_.empty() && !at_end && !items_[next].starts_line) {
            for (; first < next; ++first) add_inside(items_[first]);
            return;
        }
        while (!lines_.empty() && first < next && items_[first].breaks == 0)
            lines_.back().comments.push_back(&items_[first++]);
        column_of_next_ = at_end ? 0 : items_[start_of_source_line(next)].column;
        while (first < next) {
            std::size_t last = first + 1;
            while (last < next && items_[last].breaks == 0) ++last;
            if (last == next && !at_end && items_[next].breaks == 0) {
                lead(first, next);
            } else {
                add_own(first, last, next);
            }
            first = last;
        }
    }

    /// Index of the first comment before the token `i` on its line, or the token itself.
    std::size_t start_of_source_line(std::size_t i) const {
        while (i > 0 && items_[i].breaks == 0 && items_[i - 1].is_comment()) --i;
        return i;
    }

    /// Comments before the first word of a line.
    void lead(std::size_t first, std::size_t next) {
        const Item& token = items_[next];
        Line& line = begin_line(items_[first], token.level * kIndent, token.role);
        for (; first < next; ++first) line.code.push_back(&items_[first]);
        line_begun_ = true;
    }

    void add_own(std::size_t first, std::size_t last, std::size_t next) {
        if (continues_comment(items_[first]) && last == first + 1)
            return add_continued_comment(items_[first]);
        Line& line = begin_line(items_[first], level_of_comment(items_[first], next) * kIndent, Role::plain);
        line.is_own_comment = true;
        for (; first < last; ++first) line.code.push_back(&items_[first]);
    }

    std::size_t level_of_comment(const Item& comment, std::size_t next) const {
        if (next == items_.size()) return 0;
        const Item& token = items_[next];
        const bool is_deeper =
            token.role == Role::closer || (token.role == Role::middle && comment.column > column_of_next_);
        return token.level + (is_deeper ? 1U : 0U);
    }

    /// Comments within a statement: a line comment ends the line, other comments are handled like a word.
    void add_inside(Item& comment) {
        if (comment.kind == Kind::line_comment && continues_comment(comment)) {
            add_continued_comment(comment);
            must_break_ = true;
            return;
        }
        const bool is_behind = comment.kind == Kind::line_comment && comment.breaks == 0 && !must_break_;
        if (is_behind) {
            lines_.back().comments.push_back(&comment);
        } else {
            Line& line =
                must_break_ || comment.kind == Kind::line_comment ? continue_statement() : lines_.back();
            line.code.push_back(&comment);
        }
        must_break_ = comment.kind == Kind::line_comment;
    }

    /// A line comment directly below one after code continues it.
    bool continues_comment(const Item& comment) const {
        if (comment.kind != Kind::line_comment || comment.breaks != 1 || lines_.empty()) return false;
        const Line& before = lines_.back();
        return before.comments.size() == 1 && before.comments.front()->kind == Kind::line_comment &&
               before.comments.front()->column == comment.column;
    }

    void add_continued_comment(const Item& comment) {
        const Line before = lines_.back();
        Line& line = lines_.emplace_back();
        line.indent = before.indent;
        line.role = before.role;
        line.continues = before.continues;
        line.continues_comment = true;
        line.comments.push_back(&comment);
    }

    std::vector<Item>& items_;
    std::vector<Line> lines_;
    std::uint32_t column_of_next_ = 0;
    bool must_break_ = false;
    bool line_begun_ = false;
};

}  // namespace

std::size_t code_width(const Line& line) {
    std::size_t sum = line.code.empty() ? 0 : line.indent;
    for (const Item* item : line.code) {
        if (item != line.code.front()) sum += item->blanks;
        if (item->text.find('\n') != item->text.npos) sum = 0;
        sum += width(item->text);
    }
    return sum;
}

std::vector<Line> lines_of(Document& document) {
    return Assembler(document).run();
}

}  // namespace nplc::seqc::layout
