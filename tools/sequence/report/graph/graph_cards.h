#pragma once

#include <vector>

#include "report/graph/graph_model.h"
#include "report/graph/graph_picture.h"

namespace nplc::seqc {

/// A box without a position: its texts and rules are relative to its corner, its width is the minimum.
struct Card {
    Picture::Box box;
    std::vector<double> way_heights;  ///< where lines of its transitions begin
    double entry_height = 0;          ///< where incoming lines at its side end
};

/// One per step, in the order of the model. Conditions are wrapped after about `letters` characters.
std::vector<Card> step_cards(const GraphModel& model, std::size_t letters);

/// One per step that is the target of notes, with all of them, in the order of step numbers.
std::vector<Card> note_cards(const GraphModel& model, std::size_t letters);

/// Makes a card `width` wide and positions all texts horizontally.
void widen(Card& card, double width, const GraphModel& model, std::size_t letters);

}  // namespace nplc::seqc
