#pragma once

#include <array>

#include "sequencer/table.h"
#include "store/content.h"

namespace nplc::store {

/// A further condition for a table's terms, such as orders that the motor supports.
class TermCheck {
  public:
    virtual bool accepts(sequencer::TermView term) const = 0;

  protected:
    ~TermCheck() = default;
};

/// Applies the rules of Table::load to the table to be stored; with `terms`, error not_for_motor for a term
/// that it does not accept. Bytes after the end term are not checked.
class TableCheck final : public Content {
  public:
    explicit TableCheck(const TermCheck* terms = nullptr) : terms_(terms) {}

    void begin() override;
    base::Status take(std::span<const std::uint8_t> bytes) override;
    base::Status end() override;

    /// The term, counted from 0, of the last error of take() or end().
    std::uint16_t fault_term() const { return fault_term_; }

  private:
    base::Status take_term();

    const TermCheck* terms_;
    sequencer::TableRules rules_;
    std::array<std::uint8_t, sequencer::kTermBytes> term_{};
    std::uint8_t have_ = 0;
    std::uint16_t fault_term_ = 0;
};

}  // namespace nplc::store
