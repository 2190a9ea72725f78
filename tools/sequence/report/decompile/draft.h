#pragma once

#include <array>
#include <bitset>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "registers/mac.h"
#include "report/decompile/layout.h"
#include "report/decompile/shape.h"

namespace nplc::seqc {

/// What failed in an earlier draft.
struct Exclusions {
    std::bitset<64> shape;  ///< the step must be TERMs
    std::bitset<64> entry;  ///< the step must have no ENTRY
    bool on_error = false;
    bool power_up = false;
    bool given_names = false;
    bool operator==(const Exclusions&) const = default;
};

/// How to write a table as a program.
struct Draft {
    Surroundings around;
    std::optional<PowerUp> power_up;           ///< empty: step 0 is a step with AT 0
    std::vector<std::optional<Shape>> shapes;  ///< as in Layout::steps
    std::array<Action, 64> entries;            ///< by step number
    std::bitset<64> says_outputs;              ///< steps whose OUT should be written
};

/// Makes drafts of one table; more exclusions give simpler programs.
class Drafter {
  public:
    Drafter(const Layout& layout, registers::Model motor);
    Draft draft(const Exclusions& exclusions);

  private:
    std::vector<std::uint8_t> voted_outputs() const;
    std::optional<Action> voted_fault(const Surroundings& around) const;
    void find_shapes(const Exclusions& exclusions, Draft& draft);
    const std::optional<Shape>& shape_of(std::size_t index, const Surroundings& around);
    void find_entries(const Exclusions& exclusions, Draft& draft) const;
    std::vector<const Action*> ways_into(std::uint8_t step, const Draft& draft) const;
    void take_entry_from_values(Draft& draft) const;
    void note_outputs(Draft& draft) const;

    const Layout& layout_;
    std::vector<std::vector<Group>> groups_;  ///< as in Layout::steps
    /// Cache: by place in Layout::steps, with or without ON ERROR, and OUT of step 0. The rest of the
    /// surroundings is the same in all drafts.
    std::map<std::tuple<std::size_t, bool, std::uint8_t>, std::optional<Shape>> found_;
};

}  // namespace nplc::seqc
