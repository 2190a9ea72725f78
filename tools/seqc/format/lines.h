#pragma once

#include "format/item.h"

namespace nplc::seqc::layout {

/// A line of the result. Either part may be empty, not both.
struct Line {
    std::vector<Item*> code;            ///< comments between its words included
    std::vector<const Item*> comments;  ///< behind the code
    std::size_t indent = 0;
    Role role = Role::plain;
    bool blank_before = false;
    bool is_own_comment = false;     ///< `code` is a comment of its own, between statements
    bool continues = false;          ///< the statement of the line before
    bool continues_comment = false;  ///< the comment behind the line before
};

/// Its indentation included; 0 without code.
std::size_t code_width(const Line& line);

/// The lines of a shaped document, comments where they belong.
std::vector<Line> lines_of(Document& document);

/// Breaks lines over 120 columns before AND, OR, XOR and WHEN and behind commas; a TERM stays whole.
void wrap(std::vector<Line>& lines);

/// Leaves blank lines where they help: none at the edges of a block, one around blocks of several lines.
void space_out(std::vector<Line>& lines);

/// Pads the declarations of each block so that AT, and the type or value, stand in columns.
void align_declarations(std::vector<Line>& lines);

/// The lines as text; comments behind code in column 41, or further right where their run needs it.
std::string print(const std::vector<Line>& lines);

}  // namespace nplc::seqc::layout
