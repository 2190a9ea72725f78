#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "registers/mac.h"
#include "sim/snapshot.h"

namespace nplc::sim {

inline constexpr unsigned kInputs = 6;
inline constexpr unsigned kOutputs = 4;

/// What a program calls its steps and signals. Without names, `IN0`, `OUT0` and the step's number serve.
struct Names {
    std::array<std::string, kInputs> inputs;
    std::array<std::string, kOutputs> outputs;
    std::map<std::uint8_t, std::string> steps;
    registers::Model motor = registers::Model::mac140;

    std::string input(unsigned index) const;
    std::string output(unsigned index) const;
    std::string step(std::uint8_t number) const;
};

/// `POSITION(P2)`, `RESET_ERROR`, `V1 := 3146`.
std::string in_words(const SentOrder& order, registers::Model motor);

/// Two hex digits, or `65=3146`: register and value in decimal.
std::string in_numbers(const SentOrder& order);
/// Space separated, in the order given; empty without orders.
std::string in_numbers(const std::vector<SentOrder>& orders);

}  // namespace nplc::sim
