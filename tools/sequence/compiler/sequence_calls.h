#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "language/ast.h"
#include "seqc/sources.h"

namespace nplc::seqc {

/// The steps of SEQUENCEs, in the words of the program.
class SequenceCalls {
  public:
    /// Both must stay valid; `program` after expand_sequences().
    SequenceCalls(const ast::Program& program, const Sources& sources)
        : program_(program), sources_(sources) {}

    /// Where a step belongs to, by its name in the table; null if it does not belong to a SEQUENCE.
    const ast::Origin* origin_of(std::string_view step) const;

    /// A step as the program names it: "'Idle'", or "'Down' of SEQUENCE Press".
    std::string shown(std::string_view step) const;

    /// "in the call on line 12", "in the calls on lines 12, 20 and wiring.seqi:3"; each line once, and of
    /// many the first ones.
    std::string lines(std::vector<Span> calls) const;

  private:
    const ast::Program& program_;
    const Sources& sources_;
};

}  // namespace nplc::seqc
