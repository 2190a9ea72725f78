// Any text is a scenario, a stimulus, a line at a simulator's control port and a device's memory, or is
// refused with a place in it and a reason.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "fuzz.h"
#include "host/files.h"
#include "input_file.h"
#include "scan_command.h"
#include "sim/bench_line.h"
#include "sim/device_memory.h"
#include "sim/scenario.h"

namespace {

using namespace nplc;

sim::Names names() {
    sim::Names names;
    names.inputs = {"Start", "Guard", "Air", "", "", ""};
    names.outputs = {"Clamp", "Lamp", "", ""};
    names.steps = {{0, "POWER_UP"}, {1, "Idle"}, {2, "Go"}};
    names.machine = {"mm", 5};
    set_points::SetPoint length;
    length.name = "Length";
    length.unit = "mm";
    length.steps_per_unit = 819.2;
    length.lowest = 8192;
    length.highest = 163840;
    length.reg = 51;
    names.set_points.values = {length};
    return names;
}

void scenario(std::string_view text) {
    static const sim::Names kNames = names();
    const sim::ParsedScenario parsed = sim::parse_scenario(text, "f.scn", kNames);
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    for (const sim::Mistake& mistake : parsed.mistakes)
        require(!mistake.message.empty() && mistake.line >= 0 && mistake.line <= lines &&
                mistake.column >= 0);
    if (!parsed.mistakes.empty()) return;
    for (const sim::Expectation& expectation : parsed.scenario.expectations)
        require(expectation.line > 0 && expectation.least <= expectation.most);
}

void stimulus(std::string_view text) {
    try {
        const auto rows = sim::parse_stimulus(text, "f.csv");
        require(rows.size() <= text.size());
    } catch (const sim::InputError& error) {
        require(std::string_view(error.what()).starts_with("f.csv"));
    }
}

void bench_line(std::string_view text) {
    bool is_done = false;
    const sim::ControlPort::Answer answer = sim::carry_out(
        text.substr(0, text.find('\n')), names(), [] { return std::string("stands"); },
        [&](const sim::Actions&) {
            is_done = true;
            return std::string();
        });
    require(answer.done || (!is_done && !answer.text.empty()));
}

/// Values of three names, each within its range.
class Memory final : public sim::DeviceMemory {
  public:
    std::string heading() const override { return "# Memory"; }
    std::string form() const override { return "NAME = VALUE"; }
    std::vector<sim::NamedValue> values() const override { return kept_; }
    std::uint32_t writes() const override { return 1; }
    bool take(const sim::NamedValue& value) override {
        const bool is_good = (value.name == "a" || value.name == "b") && value.value >= 0;
        if (is_good) kept_.push_back(value);
        return is_good;
    }
    void restore() override { restored_ = true; }
    bool restored() const { return restored_; }

  private:
    std::vector<sim::NamedValue> kept_;
    bool restored_ = false;
};

void device_memory(std::string_view text) {
    static const std::string kPath = "/dev/shm/fuzz_device_memory." + std::to_string(::getpid());
    std::ofstream(kPath, std::ios::binary) << text;
    auto memory = std::make_unique<Memory>();
    const Memory& held = *memory;
    sim::MemoryFiles files;
    const std::string mistake = files.add(kPath, 1, std::move(memory));
    require(mistake.empty() == held.restored());
    require(mistake.empty() || mistake.starts_with(kPath + ":"));
    require(host::read_file(kPath, text.size() + 1).bytes == text);
    std::filesystem::remove(kPath);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    scenario(text);
    stimulus(text);
    bench_line(text);
    device_memory(text);
    return 0;
}
