#pragma once

#include <array>

#include "sequencer/table.h"
#include "store/content.h"

namespace nplc::store {

/// What a table's terms must be beside well formed, such as orders that the motor has.
class TermCheck {
  public:
    virtual bool accepts(sequencer::TermView term) const = 0;

  protected:
    ~TermCheck() = default;
};

/// The rules of Table::load on what is to become the stored table; with `terms`, not_for_motor for one that
/// it does not accept. What follows the end term is not looked at.
class TableCheck final : public Content {
  public:
    explicit TableCheck(const TermCheck* terms = nullptr) : terms_(terms) {}

    void begin() override;
    base::Status take(std::span<const std::uint8_t> bytes) override;
    base::Status end() override;

    /// The term, counted from 0, of the error that take() or end() answered last.
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
