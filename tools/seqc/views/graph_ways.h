#pragma once

#include <array>
#include <optional>
#include <vector>

#include "views/graph_model.h"
#include "views/written_text.h"

namespace nplc::seqc {

/// What the steps of a table do, as a program says it or, where there is none, as the terms do.
class GraphWays {
  public:
    struct Way {
        GraphModel::Way shown;
        Truth when;
        bool is_written = false;
    };

    GraphWays(const Machine& machine, const Symbols* symbols, const GraphSource& source);

    /// In the order in which they are judged; of a table they exclude each other.
    std::vector<Way> of(std::uint8_t step) const;
    /// What ENTRY says, a line each; for step 0 what POWER_UP writes.
    std::vector<std::string> entry(std::uint8_t step) const;
    std::vector<std::string> outputs(std::uint8_t step) const;
    std::string made_as(std::uint8_t step) const;
    /// "IN Moving EXCEPT Turn" where an ON condition of the program says so; nothing: no such condition.
    std::optional<std::string> where_of(std::string_view condition) const;

  private:
    const Written::Step* written_step(std::uint8_t step) const;
    /// Texts of a step, with what its sequence was called with.
    WrittenText text_of(const Written::Step& step) const;
    GraphModel::Way shown(const Written::Step& step, const Written::Branch& branch, const Truth& told) const;
    std::string actions(std::uint8_t step, const Reaction& reaction) const;
    std::string condition_of(const OutputRule& rule, std::uint8_t step) const;
    bool leads_to_several(const Written::Step& step, const std::string& condition) const;
    void name_the_rest(std::vector<Way>& ways) const;
    bool is_true(const Written::Branch& branch, std::uint8_t step) const;

    const Machine& machine_;
    const Symbols* symbols_;
    const Written* written_;
    std::string_view source_;
    WrittenText text_;
    std::vector<sequencer::MotorOrder> power_up_;
    std::array<Entry, kStepNumbers> entries_;
};

}  // namespace nplc::seqc
