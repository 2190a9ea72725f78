#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "macreg/motor.h"

/// A motor's parameters as readable text, to keep, to compare and to bring back.
namespace nplc::macreg {

/// What the motor keeps in its flash: no measurement, no target, no state. ERR_STAT and CNTRL_BITS count with
/// the bits that are settings.
bool is_parameter(registers::Model model, const registers::Register& reg);

struct ParameterSet {
    registers::Model model = registers::Model::mac140;
    bool model_is_known = false;  ///< else any of MAC50 to MAC141
    std::map<std::string, std::string> header{};
    std::map<std::uint8_t, std::int64_t> values{};
    std::string incomplete{};  ///< why the file ends early; empty: it is whole
};

/// Told after each block: what is new, and how many of how many registers are read.
using Received = std::function<void(const std::map<std::uint8_t, std::int64_t>& values, std::size_t done,
                                    std::size_t all)>;

/// Reads block by block. `goes_on` false between two: mactalk_client::Interrupted.
ParameterSet read_parameters(Motor& motor, const Received& received, const std::function<bool()>& goes_on);
/// The same for all registers of the map, measurements too.
ParameterSet read_everything(Motor& motor, const Received& received, const std::function<bool()>& goes_on);

/// The text before the first value: what it is, model, serial number, version, `date`.
std::string header_text(Motor& motor, std::string_view model_name, std::string_view date);
/// A line of the file: "V_SOLL = 762.94 rpm   # 5, raw 1600: ...". What is no parameter becomes a comment.
std::string value_line(registers::Model model, const registers::Register& reg, std::int64_t raw);
/// What stands at the end of a whole file. One without it, or with another number of registers, counts as
/// incomplete.
std::string end_text(std::size_t registers);
/// What stands at the end of a file that is not whole.
std::string incomplete_text(std::string_view why);

struct FileProblem {
    unsigned line = 0;
    std::string text{};
};
struct ParsedFile {
    ParameterSet set{};
    std::vector<FileProblem> problems{};  ///< all of them
};
ParsedFile parse_parameters(std::string_view text);

struct Difference {
    const registers::Register* reg;
    std::optional<std::int64_t> left, right;  ///< nothing: that side does not have it
};
/// By number. Both are of one family.
std::vector<Difference> differences(const ParameterSet& left, const ParameterSet& right);

}  // namespace nplc::macreg
