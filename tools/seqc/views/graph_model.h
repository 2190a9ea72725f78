#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "seqc/seqc.h"
#include "views/machine.h"

namespace nplc::seqc {

/// What a drawing of a table shows, as plain text.
struct GraphModel {
    /// What a step does under a condition.
    struct Way {
        std::string condition = {};
        std::string actions = {};             ///< without what the boxes at both ends say already
        std::uint8_t to = 0;                  ///< the own step: it stays
        std::optional<std::uint8_t> by = {};  ///< a helper step on the way
        bool on_error = false;                ///< on nothing else
    };
    struct Box {
        std::uint8_t step = 0;
        std::string name = {};
        bool shows_number = false;
        bool reachable = false;
        std::string made_as = {};               ///< "helper step", "copy of Fault", "of SEQUENCE Stamp"
        bool is_of_compiler = false;            ///< a helper step or copy
        std::vector<std::string> outputs = {};  ///< "OUT Grip", "OUT Lamp WHEN IN3"
        std::vector<std::string> entry = {};    ///< "ENTRY STOP"; in step 0 what POWER_UP writes
        std::vector<Way> ways = {};             ///< the first one that holds counts
    };
    /// The same way out of several steps, drawn once. It comes before what the boxes say.
    struct Note {
        Way way;
        std::string where;  ///< "in every other step"
    };

    std::string title;
    std::string motor;   ///< empty where unknown
    std::string scale;   ///< "1 rev = 10 mm"; empty where there is none
    std::string footer;  ///< what tells this table from others
    std::size_t terms = 0;
    std::uint32_t crc32 = 0;
    std::vector<std::pair<std::string, std::string>> terminals;  ///< "IN0", "Pedal"; those that have names
    std::vector<Box> boxes;
    std::vector<Note> notes;
};

/// A program, for which its conditions and statements are shown as they stand in it.
struct GraphSource {
    const Written* written = nullptr;  ///< nothing: a table alone
    std::string_view text;
};

GraphModel graph_model_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                          const std::string& title, const GraphSource& source = {});

}  // namespace nplc::seqc
