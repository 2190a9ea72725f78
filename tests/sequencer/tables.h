#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "sequencer/engine.h"
#include "sequencer/table.h"

namespace nplc::sequencer {

/// Tables written down byte by byte, as the manual counts them.
using Bytes = std::vector<std::uint8_t>;

inline constexpr TermBytes kEndTerm{0x3F, 0, 0, 0, 0, 0, 0, 0};

inline Bytes bytes_of(std::initializer_list<TermBytes> terms) {
    Bytes bytes;
    for (const TermBytes& term : terms) bytes.insert(bytes.end(), term.begin(), term.end());
    return bytes;
}

/// The terms and an end term.
inline Bytes table_of(std::initializer_list<TermBytes> terms) {
    Bytes bytes = bytes_of(terms);
    bytes.insert(bytes.end(), kEndTerm.begin(), kEndTerm.end());
    return bytes;
}

/// A loaded table with an engine, and what the last scan sent.
class Bench {
  public:
    explicit Bench(std::initializer_list<TermBytes> terms)
        : bytes_(table_of(terms)), table_(Table::load(bytes_).table), engine(table_) {}
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    ScanEffect scan(InputImage image = 0) {
        orders.clear();
        return engine.scan(image, [this](const MotorOrder& order) { orders.push_back(order); });
    }

    const State& state() const { return engine.state(); }
    const Table& table() const { return table_; }

  private:
    Bytes bytes_;
    Table table_;

  public:
    Engine engine;
    std::vector<MotorOrder> orders;
};

}  // namespace nplc::sequencer
