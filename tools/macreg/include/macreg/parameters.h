#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "macreg/motor.h"

/// A motor's parameters as readable text, to store, compare and restore them.
namespace nplc::macreg {

/// The parameters that the motor keeps in its flash: no measurement, target or state. Of ERR_STAT and
/// CNTRL_BITS only the bits that are settings.
bool is_parameter(registers::Model model, const registers::Register& reg);

struct ParameterSet {
    registers::Model model = registers::Model::mac140;
    bool model_is_known = false;  ///< else any of MAC50 to MAC141
    std::map<std::string, std::string> header{};
    std::map<std::uint8_t, std::int64_t> values{};
    std::string incomplete{};  ///< why the file ends early; empty: it is complete
};

/// Called after each block: the new values, and how many of how many registers have been read.
using Received = std::function<void(const std::map<std::uint8_t, std::int64_t>& values, std::size_t done,
                                    std::size_t all)>;

/// Reads block by block. When `goes_on` returns false between two: mactalk_client::Interrupted.
ParameterSet read_parameters(Motor& motor, const Received& received, const std::function<bool()>& goes_on);
/// The same for all registers of the map, measurements too.
ParameterSet read_everything(Motor& motor, const Received& received, const std::function<bool()>& goes_on);

/// The text before the first value: kind of file, model, serial number, version, `date`.
std::string header_text(Motor& motor, std::string_view model_name, std::string_view date);
/// A line of the file: "V_SOLL = 762.94 rpm   # 5, raw 1600: ...". A register that is no parameter becomes a
/// comment.
std::string value_line(registers::Model model, const registers::Register& reg, std::int64_t raw);
/// The last line of a complete file. A file without it, or with another number of registers, counts as
/// incomplete.
std::string end_text(std::size_t registers);
/// The last line of an incomplete file.
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
    std::optional<std::int64_t> left, right;  ///< nullopt: that side does not have the register
};
/// By number. Both are of one family.
std::vector<Difference> differences(const ParameterSet& left, const ParameterSet& right);

}  // namespace nplc::macreg
