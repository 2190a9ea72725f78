#pragma once

#include <vector>

#include "views/graph_model.h"
#include "views/graph_picture.h"

namespace nplc::seqc {

/// A box that has no place yet: its texts and rules count from its own corner, its width is the least.
struct Card {
    Picture::Box box;
    std::vector<double> way_heights;  ///< where lines of its ways begin
    double entry_height = 0;          ///< where lines beside it end
};

/// For each step, by the order of the model. Conditions are broken after some `letters`.
std::vector<Card> step_cards(const GraphModel& model, std::size_t letters);

/// For each step that notes lead to, with all of them, by its number.
std::vector<Card> note_cards(const GraphModel& model, std::size_t letters);

/// Makes a step `width` wide, and uses that; gives all texts their places across.
void widen(Card& card, double width, const GraphModel& model, std::size_t letters);

}  // namespace nplc::seqc
