#include "scan_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <iterator>

#include "input_file.h"
#include "sequencer/engine.h"

namespace nplc::sim {
namespace {

void append_word(std::string& words, const std::string& word) {
    if (!words.empty()) words += ' ';
    words += word;
}

}  // namespace

std::string scan_csv(std::span<const std::uint8_t> bytes, const std::vector<StimulusRow>& rows) {
    const auto loaded = sequencer::Table::load(bytes);
    sequencer::Engine engine(loaded.table);
    std::string csv = "scan,step,timer,counter,outputs,fastmac,flexmac\n";
    std::size_t scan = 0;
    for (const StimulusRow& row : rows) {
        std::string fast;
        std::string flex;
        engine.scan(row.image, [&](const sequencer::MotorOrder& order) {
            if (order.is_flex) {
                append_word(flex, fmt::format("{}={}", order.reg, order.value));
            } else {
                append_word(fast, fmt::format("{:02X}", order.command));
            }
        });
        engine.elapse(row.dt_ms);
        const sequencer::State& state = engine.state();
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{}\n", ++scan, state.step, state.timer,
                       state.counter, state.outputs, fast, flex);
    }
    return csv;
}

void run_scan(const std::string& table_file, const std::string& stimulus_file) {
    const auto table = read_table(table_file);
    const std::string stimulus =
        read_long_input(stimulus_file, "a CSV file with a stimulus, or - for standard input");
    const std::string name = stimulus_file == "-" ? "standard input" : stimulus_file;
    const std::string csv = scan_csv(table, parse_stimulus(stimulus, name));
    std::fwrite(csv.data(), 1, csv.size(), stdout);
}

}  // namespace nplc::sim
