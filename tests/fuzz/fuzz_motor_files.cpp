// Any text is a motor's parameters, a path of several axes, a condition of a recording, or is refused with a
// reason; values that are taken lie in their registers' ranges and come back from what is written of them.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz.h"
#include "macreg/midi/path_file.h"
#include "macreg/parameters.h"
#include "macreg/recorder.h"
#include "registers/mac.h"

namespace {

using namespace nplc;

void parameters(std::string_view text) {
    const macreg::ParsedFile file = macreg::parse_parameters(text);
    for (const macreg::FileProblem& problem : file.problems) require(!problem.text.empty());
    if (!file.problems.empty()) return;
    std::string again = "model = ";
    again += file.set.model == registers::Model::mac800 ? "MAC800\n" : "MAC140\n";
    for (const auto& [number, value] : file.set.values) {
        const registers::Register* reg = registers::find(file.set.model, number);
        require(reg != nullptr && value >= reg->min && value <= reg->max);
        again += macreg::value_line(file.set.model, *reg, value);
    }
    for (const auto& [number, value] : macreg::parse_parameters(again).set.values)
        require(file.set.values.at(number) == value);
}

void path(std::string_view text) {
    const macreg::midi::PathFile file = macreg::midi::read_path(text, {});
    for (const std::string& problem : file.problems) require(!problem.empty());
    if (!file.problems.empty()) return;
    require(!file.addresses.empty() && !file.path.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    parameters(text);
    path(text);
    (void)macreg::read_condition(text, registers::Model::mac140);
    return 0;
}
