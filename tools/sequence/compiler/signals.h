#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "compiler/name_table.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// Inputs and outputs by their names or addresses.
class Signals {
  public:
    Signals(NameTable& names, Report& report) : names_(names), report_(report) {}

    void declare(const ast::Program& program, Symbols& symbols);
    /// Its bit, 0..5; reports an unknown one.
    std::optional<std::size_t> input(const ast::Name& name);
    /// Its bit, 0..3.
    std::optional<std::size_t> output(const ast::Name& name);

  private:
    void declare_all(const std::vector<ast::Variable>& declared, std::vector<DeclaredName>& variables,
                     char direction, std::size_t count);
    std::optional<std::size_t> find(const ast::Name& name, const std::vector<DeclaredName>& variables,
                                    char direction, std::size_t count);

    NameTable& names_;
    Report& report_;
};

}  // namespace nplc::seqc
