#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/error.h"
#include "sequencer/term.h"

namespace nplc::sequencer {

/// Terms a table may hold, its end term not counted. The manual gives no limit.
inline constexpr std::size_t kMaxTerms = 1024;

/// Why a table is refused, and at which term (counted from 0). The reason in words: `describe`.
struct TableFault {
    base::Error error;
    std::uint16_t term;
};

std::string_view describe(base::Error table_error);

/// What makes a table acceptable, a term at a time: for tables that do not lie in memory as a whole.
/// Faults as of Table::load.
class TableRules {
  public:
    /// Not to be called again once ended().
    std::optional<TableFault> take(TermView term);
    bool ended() const { return ended_; }           ///< the end term has come
    std::uint16_t terms() const { return terms_; }  ///< taken, the end term not counted

    /// The bytes end here, `rest` of them behind the last whole term.
    std::optional<TableFault> finish(std::size_t rest) const;

  private:
    std::uint16_t terms_ = 0;
    bool ended_ = false;
};

/// A validated sequence table, used where it lies: the bytes must outlive the Table and stay as they are.
/// A small index by step (256 bytes) leads a scan to the span from the step's first term to its last; terms
/// of one step need not stand together, but a scan is quickest when they do.
class Table {
  public:
    struct Range {
        std::uint16_t begin = 0;
        std::uint16_t end = 0;
    };

    Table() = default;

    /// Reads terms up to the first whose STATE bits are 63; what follows is ignored. On a fault the table
    /// stays empty. Faults: table_ragged (ends inside a term), table_no_end, no_space (over kMaxTerms),
    /// bad_next_step (FastMAC format, NEXT_STATE 3Fh), bad_register (FlexMAC format, register 0).
    struct LoadResult;
    [[nodiscard]] static LoadResult load(std::span<const std::uint8_t> bytes);
    /// The same into this table, whatever it was; the fault if there is one.
    [[nodiscard]] std::optional<TableFault> assign(std::span<const std::uint8_t> bytes);

    void clear() {
        size_ = 0;
        begin_.fill(0);
        end_.fill(0);
    }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    TermView term(std::size_t index) const { return TermView(bytes_ + index * kTermBytes, kTermBytes); }

    /// First and last + 1 of the terms whose STATE names `step`; other steps' terms may stand between them.
    Range terms_of(std::uint8_t step) const { return {begin_[step & 63U], end_[step & 63U]}; }

  private:
    void note(std::uint8_t step, std::uint16_t index);

    const std::uint8_t* bytes_ = nullptr;
    std::uint16_t size_ = 0;
    std::array<std::uint16_t, 64> begin_{};
    std::array<std::uint16_t, 64> end_{};
};

struct Table::LoadResult {
    bool ok = false;
    Table table;         ///< when ok
    TableFault fault{};  ///< when not ok
};

}  // namespace nplc::sequencer
