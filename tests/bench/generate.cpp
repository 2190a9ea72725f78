// Writes the measured logic twice: as sequence tables, and as the switch that a compiler makes of IEC ST
//     CASE step OF 0: IF <condition> THEN <commands> ELSIF ...
// with all constants in the code. The conditions of a step exclude each other, so "the first true one" and
// "the last true one" are the same term.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "shapes.h"

namespace nplc::bench {
namespace {

constexpr std::uint64_t kSeed = 20'240'607;

class Dice {
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    unsigned below(unsigned limit) { return static_cast<unsigned>(engine_() % limit); }
    bool one_in(unsigned n) { return below(n) == 0; }

  private:
    std::mt19937_64 engine_;
};

struct Rule {
    unsigned step = 0;
    unsigned care = 0;  // of HW_INP; bit 7 always set
    unsigned input = 0;
    bool timer_zero = false;
    bool counter_zero = false;
    unsigned next = 0x3E;
    bool flex = false;
    bool sends = false;
    unsigned number = 0;  // command or register
    std::uint32_t value = 0;
    unsigned outputs = 0;
    bool clears = false;
    bool counts_down = false;
    bool presets_counter = false;
    unsigned preset = 0;
};

template <class T>
void shuffle(std::vector<T>& items, Dice& dice) {
    for (std::size_t i = items.size(); i > 1; --i) {
        std::swap(items[i - 1], items[dice.below(static_cast<unsigned>(i))]);
    }
}

void add_commands(Rule& rule, unsigned steps, Dice& dice) {
    if (rule.flex) {
        rule.number = 1 + dice.below(127);
        rule.value = dice.below(65536);
        return;
    }
    if (!dice.one_in(8)) rule.next = dice.below(steps);
    rule.sends = dice.one_in(2);
    rule.number = rule.sends ? dice.below(128) : 0;
    rule.outputs = dice.below(16);
    rule.counts_down = dice.one_in(4);
    rule.clears = dice.one_in(16);
    if (dice.one_in(4)) {
        rule.preset = 1 + dice.below(10);
    } else if (dice.one_in(6)) {
        rule.presets_counter = true;
        rule.preset = 1 + dice.below(3);
    }
}

struct Leaf {
    unsigned care = 0x80;
    unsigned input = 0;
};

/// Splits `leaf` until there are `count` (a power of two) leaves, by bits 6..0 that it does not test yet.
/// With `same_bits` all leaves of a level are split by the same bit, as when a recipe is chosen by a few
/// switches.
void split(std::vector<Leaf>& leaves, unsigned count, bool same_bits, Dice& dice) {
    while (leaves.size() < count) {
        std::vector<Leaf> next;
        unsigned bit = 0;
        for (const Leaf& leaf : leaves) {
            if (!same_bits) bit = 0;
            while (bit == 0 || (leaf.care & bit) != 0) bit = 1U << dice.below(7);
            next.push_back({leaf.care | bit, leaf.input});
            next.push_back({leaf.care | bit, leaf.input | bit});
        }
        leaves = next;
    }
}

/// `terms` rules that exclude each other, each of which tests ERROR and at least three of the other inputs,
/// as the example of 001 §6.1.5 does. The first leads to `successor`, whatever the counter, so that every
/// step is reached. With several rules the last is what the step does on ERROR.
void add_step(std::vector<Rule>& rules, unsigned step, unsigned successor, Size size, Dice& dice) {
    const auto terms = static_cast<unsigned>(size.terms);
    std::vector<Leaf> leaves{Leaf{}};
    split(leaves, std::max(8U, 2 * terms), dice.one_in(2), dice);
    shuffle(leaves, dice);
    for (unsigned i = 0; i < terms; ++i) {
        Rule rule;
        rule.step = step;
        rule.care = leaves[i].care;
        rule.input = leaves[i].input;
        if (i != 0 && i + 1 == terms) {
            rule.care = 0x80;
            rule.input = 0x80;
        }
        rule.timer_zero = dice.one_in(6);
        rule.counter_zero = i != 0 && dice.one_in(12);
        rule.flex = i != 0 && rule.care != 0x80 && dice.one_in(16);
        add_commands(rule, static_cast<unsigned>(size.steps), dice);
        if (i == 0) rule.next = successor;
        rules.push_back(rule);
    }
}

void print_term(const Rule& r) {
    const unsigned state = r.step | (r.counter_zero ? 0U : 0x40U) | (r.timer_zero ? 0U : 0x80U);
    std::printf("    0x%02X, 0x%02X, 0x%02X, ", state, r.input, (r.care & 0x7F) | (r.flex ? 0x80U : 0U));
    if (r.flex) {
        std::printf("0x%02X, 0x%02X, 0x%02X, 0, 0,\n", r.number, r.value % 256, r.value / 256);
        return;
    }
    std::printf("0x%02X, 0x%02X, 0x%02X, %u, %u,\n", r.next | (r.presets_counter ? 0x40U : 0U),
                r.number | (r.sends ? 0U : 0x80U),
                r.outputs | (r.clears ? 0x40U : 0U) | (r.counts_down ? 0x80U : 0U), r.preset % 256,
                r.preset / 256);
}

void print_counter_and_timer(const Rule& r) {
    if (r.clears) {
        std::printf("                m.counter = 0;\n");
    } else if (r.presets_counter) {
        std::printf("                m.counter = %u;\n", r.preset);
    } else if (r.counts_down) {
        std::printf("                if (m.counter != 0) --m.counter;\n");
    }
    if (!r.presets_counter && r.preset != 0) std::printf("                m.timer = %u;\n", r.preset);
}

void print_commands(const Rule& r, bool bools) {
    if (r.flex) {
        std::printf("                sink(MotorOrder{.is_register_write = true, .reg = %u, .value = %u});\n",
                    r.number, r.value);
        return;
    }
    if (r.sends) std::printf("                sink(MotorOrder{.command = %u});\n", r.number);
    if (r.next != 0x3E) std::printf("                m.step = %u;\n", r.next);
    if (bools) {
        for (unsigned i = 0; i < 4; ++i) {
            std::printf("                m.out[%u] = %u;\n", i, r.outputs >> i & 1);
        }
    } else {
        std::printf("                m.outputs = %u;\n", r.outputs);
    }
    print_counter_and_timer(r);
}

void print_condition(const Rule& r, bool bools) {
    std::printf("if (");
    if (bools) {
        const char* between = "";
        for (unsigned i = 0; i < 8; ++i) {
            if ((r.care >> i & 1) == 0) continue;
            std::printf("%s%sin[%u]", between, (r.input >> i & 1) != 0 ? "" : "!", i);
            between = " && ";
        }
    } else {
        std::printf("(in & 0x%02X) == 0x%02X", r.care, r.input);
    }
    if (r.timer_zero) std::printf(" && m.timer == 0");
    if (r.counter_zero) std::printf(" && m.counter == 0");
    std::printf(") {\n");
}

void print_switch(const std::vector<Rule>& rules, const std::string& name, bool bools) {
    std::printf("struct %s_%s {\n    template <class Sink>\n", bools ? "Case" : "Switch", name.c_str());
    std::printf("    static void scan(%s, Sink& sink) {\n    switch (m.step) {\n",
                bools ? "Variables& m, const Bools& in" : "State& m, unsigned in");
    for (std::size_t i = 0; i < rules.size(); ++i) {
        const Rule& r = rules[i];
        const bool first = i == 0 || rules[i - 1].step != r.step;
        const bool last = i + 1 == rules.size() || rules[i + 1].step != r.step;
        if (first) std::printf("        case %u:\n            ", r.step);
        print_condition(r, bools);
        print_commands(r, bools);
        std::printf(last ? "            }\n            break;\n" : "            } else ");
    }
    std::printf("        default:\n            break;\n    }\n    }\n};\n\n");
}

void print(Size size, Dice& dice) {
    std::vector<unsigned> ring;
    for (int step = 0; step < size.steps; ++step) ring.push_back(static_cast<unsigned>(step));
    shuffle(ring, dice);
    std::vector<unsigned> successor(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) successor[ring[i]] = ring[(i + 1) % ring.size()];

    std::vector<Rule> rules;
    for (unsigned step = 0; step < successor.size(); ++step) {
        add_step(rules, step, successor[step], size, dice);
    }
    const std::string name = name_of(size);
    std::printf("inline constexpr std::uint8_t kTable_%s[] = {\n", name.c_str());
    for (const Rule& rule : rules) print_term(rule);
    std::printf("    0x3F, 0, 0, 0, 0, 0, 0, 0};\n\n");
    print_switch(rules, name, true);
    print_switch(rules, name, false);
}

}  // namespace
}  // namespace nplc::bench

int main() {
    nplc::bench::Dice dice(nplc::bench::kSeed);
    std::printf("// Written by generate.cpp.\n#pragma once\n\n#include <cstdint>\n\n");
    std::printf("#include \"variables.h\"\n\nnamespace nplc::bench {\n\n");
    for (const auto size : nplc::bench::kSizes) nplc::bench::print(size, dice);
    std::printf("}  // namespace nplc::bench\n");
}
