#include <algorithm>

#include "format/layout.h"

namespace nplc::seqc::layout {
namespace {

constexpr std::size_t kCommentColumn = 40;
constexpr std::size_t kGap = 2;
constexpr std::size_t kWidestInRun = 72;  // a longer line does not move its neighbours' comments

class Printer {
  public:
    explicit Printer(const std::vector<Line>& lines) : lines_(lines) {}

    std::string run() {
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (i == run_end_) begin_run(i);
            print_line(lines_[i]);
        }
        return std::move(text_);
    }

  private:
    /// Adjacent lines with comments after code share a column.
    void begin_run(std::size_t first) {
        column_ = kCommentColumn;
        for (run_end_ = first; run_end_ < lines_.size(); ++run_end_) {
            const Line& line = lines_[run_end_];
            if (line.comments.empty() || (run_end_ > first && line.blank_before)) break;
            const std::size_t own = code_width(line);
            if (own <= kWidestInRun) column_ = std::max(column_, own + kGap);
        }
        run_end_ = std::max(run_end_, first + 1);
    }

    void print_line(const Line& line) {
        if (line.blank_before) text_ += '\n';
        print_code(line);
        if (!line.comments.empty()) print_comments(line, code_width(line));
        text_ += '\n';
    }

    void print_code(const Line& line) {
        if (!line.code.empty()) text_.append(line.indent, ' ');
        for (const Item* item : line.code) {
            if (item != line.code.front()) text_.append(item->blanks, ' ');
            text_ += item->text;
        }
    }

    void print_comments(const Line& line, std::size_t own) {
        if (!line.continues_comment) last_column_ = std::max(column_, own + kGap);
        text_.append(last_column_ - own, ' ');
        for (const Item* comment : line.comments) {
            if (comment != line.comments.front()) text_ += ' ';
            text_ += comment->text;
        }
    }

    const std::vector<Line>& lines_;
    std::string text_;
    std::size_t run_end_ = 0;
    std::size_t column_ = kCommentColumn;
    std::size_t last_column_ = kCommentColumn;
};

}  // namespace

std::string print(const std::vector<Line>& lines) {
    return Printer(lines).run();
}

}  // namespace nplc::seqc::layout
