#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "seqc/seqc.h"

namespace nplc::seqc {

/// Parts of a program's source as one line each, as written except for comments and line ends.
class WrittenText {
  public:
    explicit WrittenText(std::string_view source) : source_(source) {}
    /// With arguments in place of parameters.
    WrittenText(std::string_view source, const std::vector<Written::Argument>& arguments)
        : source_(source), arguments_(&arguments) {}

    std::string of(Span span) const;
    /// "Start AND NOT Guard"; "ELSE"; "always" if the program has no condition.
    std::string condition(const Written::Branch& branch) const;
    /// "POSITION(Press); TIMER := T#2s"
    std::string statements(const std::vector<Span>& spans) const;
    /// "Home := 0 mm" for the declaration "Home AT P1 := 0 mm"
    std::string value(Span declaration) const;

  private:
    std::string limit_behind(Span condition) const;

    std::string_view word(std::string_view text) const;

    std::string_view source_;
    const std::vector<Written::Argument>* arguments_ = nullptr;
};

}  // namespace nplc::seqc
