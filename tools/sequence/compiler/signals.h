#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "compiler/name_table.h"
#include "compiler/truth.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// What a name or address of an input tests.
struct InputTest {
    std::size_t bit = 0;  ///< 0..5
    bool level = true;    ///< of the wire when it holds; false: declared with AT NOT
    Truth truth() const { return level ? truth_of_bit(bit) : ~truth_of_bit(bit); }
};

/// Inputs and outputs by their names or addresses.
class Signals {
  public:
    Signals(NameTable& names, Report& report) : names_(names), report_(report) {}

    void declare(const ast::Program& program, Symbols& symbols);
    /// Reports an unknown one. An address is the wire, however a name of it is declared.
    std::optional<InputTest> input(const ast::Name& name);
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
