#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/machine.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// The contents of a table's drawing, as plain text.
struct GraphModel {
    using Steps = std::vector<std::uint8_t>;
    /// The action of a step under a condition.
    struct Way {
        std::string condition = {};
        std::string actions = {};             ///< without what the boxes at both ends show
        std::uint8_t to = 0;                  ///< its own step: it stays
        std::optional<std::uint8_t> by = {};  ///< a helper step on the way
        bool on_error = false;                ///< only on ERROR
    };
    struct Box {
        std::uint8_t step = 0;
        Steps steps = {};  ///< of the table: itself, and its copies, which the program does not have
        std::string name = {};
        bool shows_number = false;
        bool reachable = false;
        std::string made_as = {};               ///< "helper step", "copy of Fault", "of SEQUENCE Stamp"
        bool is_of_compiler = false;            ///< a helper step or copy
        std::vector<std::string> outputs = {};  ///< "OUT Grip", "OUT Lamp WHEN IN3", "OUT Lamp BLINKING T#1s"
        std::vector<std::string> entry = {};    ///< "ENTRY STOP"; in step 0 the writes of POWER_UP
        std::vector<Way> ways = {};             ///< the first one that is true applies
    };
    /// The same exit of several steps, drawn once. It has priority over the boxes.
    struct Note {
        Way way;
        std::string where;  ///< "in every other step"
    };

    std::string title;
    std::string motor;   ///< empty if unknown
    std::string scale;   ///< "1 rev = 10 mm"; empty without one
    std::string footer;  ///< identification of the table
    std::size_t terms = 0;
    std::uint32_t crc32 = 0;
    std::vector<std::pair<std::string, std::string>> terminals;  ///< "IN0", "Pedal"; those that have names
    std::vector<std::string> set_points;  ///< "Set-point Speed: 1000 rpm, 500 rpm to 2500 rpm"
    std::vector<Box> boxes;
    std::vector<Note> notes;
};

/// A program whose conditions and statements are shown as written.
struct GraphSource {
    const Written* written = nullptr;  ///< null: a table without a program
    std::string_view text;
};

/// "steps 3, 5 to 9"
std::string numbers_text(const GraphModel::Steps& steps);

GraphModel graph_model_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                          const std::string& title, const GraphSource& source = {});

/// For the foot: which of several conditions counts; empty if no step has more than one.
std::string_view legend_of(const GraphModel& model);

}  // namespace nplc::seqc
