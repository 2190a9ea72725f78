#include "compiler/copy_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "compiler/helper_steps.h"

namespace nplc::seqc {
namespace {

/// "Clamp on, Start seen off": the difference of `key` to the first copy.
class Difference {
  public:
    Difference(const StepPlan& step, const CopyKey& first, const CopyKey& key, const Symbols& symbols) {
        for (std::size_t bit = 0; bit < 4; ++bit) {
            if ((((first.latched ^ key.latched) >> bit) & 1) != 0)
                add(symbols.outputs[bit], ((key.latched >> bit) & 1) != 0 ? "on" : "off");
        }
        const Memory& memory = step.memory;
        for (std::size_t i = 0; i < memory.edges.size(); ++i) {
            if (!Memory::is_armed(key.memory, i)) continue;
            const Edge& edge = memory.edges[i];
            const bool was_on = edge.rising == is_inverted(symbols, edge.bit);
            add(symbols.inputs[edge.bit], was_on ? "on" : "off", "was ");
        }
        if (memory.runs(key.memory)) {
            name_ += "_timed";
            append("the time of FOR running");
        }
        if (key.is_dark()) {
            std::size_t bit = 0;
            while (((memory.blinking >> bit) & 1) == 0) ++bit;
            add(symbols.outputs[bit], "dark");
        }
        if (const int round = key.half / 2 + 1; round > 1) {
            name_ += fmt::format("_{}", round);
            append(fmt::format("round {} of BLINKING", round));
        }
    }

    const std::string& name() const { return name_; }
    const std::string& text() const { return text_; }

  private:
    void add(const std::string& signal, const char* level, const char* before = "") {
        name_ += fmt::format("_{}_{}", signal, level);
        append(fmt::format("{} {}{}", signal, before, level));
    }
    void append(const std::string& part) { text_ += (text_.empty() ? "" : ", ") + part; }

    std::string name_;
    std::string text_;
};

}  // namespace

void name_copies(Plan& plan, const std::vector<CopyKey>& keys, std::vector<StepPlan>& made,
                 Compilation& result) {
    for (std::size_t i = 0; i < made.size(); ++i) {
        StepPlan& copy = made[i];
        if (!copy.is_copy) continue;
        const StepPlan& step = plan.steps[keys[i].step];
        const auto first = std::find_if(keys.begin(), keys.end(),
                                        [&](const CopyKey& key) { return key.step == keys[i].step; });
        const Difference difference(step, *first, keys[i], result.symbols);
        copy.name =
            plan.names.emplace_back(free_step_name(made, fmt::format("{}{}", step.name, difference.name())));
        result.symbols.steps[copy.number] = copy.name;
        result.symbols.copy_of[copy.number] = result.symbols.copy_of[step.number].value_or(step.number);
        result.symbols.made_for[copy.number] =
            fmt::format("copy of '{}' for: {}", step.name, difference.text());
    }
}

}  // namespace nplc::seqc
