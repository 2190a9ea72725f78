#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compiler/model.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// The steps of a program by name and number.
class StepNames {
  public:
    explicit StepNames(Report& report) : report_(report) {}

    /// Each gets its number: that of its AT, or the lowest free one.
    void declare(const ast::Program& program, Symbols& symbols);

    /// In order of declaration.
    const std::vector<const ast::Step*>& all() const { return steps_; }
    /// The number of `all()[index]`; 62, which is no valid step, if there are too many.
    std::uint8_t number_at(std::size_t index) const { return numbers_[index]; }
    /// Null if no named step has this number.
    const ast::Step* numbered(std::uint8_t number) const;
    bool has(std::string_view name) const;
    /// Null if there is none.
    const ast::Step* named(std::string_view name) const;
    /// Reports an unknown one; `groups` could have been meant as well.
    std::optional<std::uint8_t> number_of(const ast::Name& name, const std::vector<std::string_view>& groups);

  private:
    void number_all(Symbols& symbols);
    std::optional<std::uint8_t> written_number(const ast::Step& step);
    std::string help_for(std::string_view name) const;
    bool is_group(std::string_view name) const;

    Report& report_;
    std::vector<const ast::Step*> steps_;
    std::unordered_map<std::string, std::size_t> places_;  ///< upper-case name to index in `steps_`
    std::vector<std::uint8_t> numbers_;
    bool steps_missing_ = false;
    std::vector<std::string_view> sequences_;
    std::vector<std::pair<std::string_view, std::string_view>> inner_steps_;  ///< and the SEQUENCE of each
    std::vector<std::string_view> groups_;
};

}  // namespace nplc::seqc
