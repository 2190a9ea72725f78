#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "seqc/seqc.h"
#include "views/machine.h"

namespace nplc::seqc {

/// What a drawing of a table shows, as plain text.
struct GraphModel {
    /// One way along an arrow.
    struct Way {
        std::string condition;
        std::string actions;  ///< without what the boxes at both ends say already
    };
    /// All ways from one step to another, those on ERROR apart.
    struct Arrow {
        std::uint8_t from = 0;
        std::uint8_t to = 0;
        bool on_error = false;
        bool leads_far_back = false;
        std::vector<Way> ways;
    };
    struct Box {
        std::uint8_t step = 0;
        std::string name;
        bool shows_number = false;
        bool reachable = false;
        std::vector<std::string> outputs;  ///< "OUT Grip", "OUT Lamp WHEN IN3"
        std::string entry;                 ///< "ENTRY STOP"; in step 0 what POWER_UP writes
        std::vector<Way> every_scan;       ///< what it does while it stays
    };
    /// The same on ERROR in several steps, drawn once.
    struct ErrorNote {
        std::uint8_t to = 0;
        std::string where;  ///< "in every other step"
        std::string actions;
    };

    std::string title;
    std::string motor;   ///< empty where unknown
    std::string footer;  ///< what tells this table from others
    std::vector<Box> boxes;
    std::vector<ErrorNote> notes;
    std::vector<Arrow> arrows;
};

GraphModel graph_model_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                          const std::string& title);

}  // namespace nplc::seqc
