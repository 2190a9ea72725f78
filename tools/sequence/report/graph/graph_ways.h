#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "report/graph/graph_model.h"
#include "report/written_text.h"

namespace nplc::seqc {

/// The transitions of a table's steps, as written in the program or, without one, derived from the terms.
class GraphWays {
  public:
    struct Way {
        GraphModel::Way shown;
        Truth when;
        bool is_written = false;
        std::size_t place = SIZE_MAX;  ///< in the order of evaluation of a written step
    };

    GraphWays(const Machine& machine, const Symbols* symbols, const GraphSource& source);

    /// All steps of the table that are drawn as one box, `step` first: the copies of a step of the program.
    /// None if it is drawn in another one's box. Without a program every step has its own.
    GraphModel::Steps drawn_with(std::uint8_t step) const;

    /// In the order of evaluation; for a table they are mutually exclusive.
    std::vector<Way> of(std::uint8_t step) const;
    /// The statements of ENTRY, one line each; for step 0 the writes of POWER_UP.
    std::vector<std::string> entry(std::uint8_t step) const;
    std::vector<std::string> outputs(std::uint8_t step) const;
    std::string made_as(std::uint8_t step) const;
    /// "IN Moving EXCEPT Turn" if an ON condition of the program has it; empty: no such condition.
    std::optional<std::string> where_of(std::string_view condition) const;

  private:
    std::uint8_t box_of(std::uint8_t step) const;
    std::vector<Way> ways_of(std::uint8_t step) const;
    std::vector<StepTransition> simplest_first(std::vector<StepTransition> reactions, Truth told,
                                               std::uint8_t step) const;
    std::size_t blanks_of(const StepTransition& reaction, const Truth& told) const;
    std::optional<StepTransition> part_before(const StepTransition& next,
                                              const std::vector<StepTransition>& reactions, const Truth& told,
                                              std::uint8_t step) const;
    std::size_t place_of(const Written::Branch& branch) const;
    const Written::Step* written_step(std::uint8_t step) const;
    /// Texts of a step, with the arguments of its sequence.
    WrittenText text_of(const Written::Step& step) const;
    GraphModel::Way shown(const Written::Step& step, const Written::Branch& branch, const Truth& told) const;
    Truth cases_with(const Written::Step& step, const Written::Branch& branch) const;
    bool is_needed(const Written::Step& step, const Written::Branch& idle, const Truth& reads) const;
    std::string actions(std::uint8_t step, const StepTransition& reaction) const;
    std::string condition_of(const OutputRule& rule, std::uint8_t step) const;
    std::string blinking_text(std::uint8_t step) const;
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
