#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "macreg/motor.h"
#include "registers/details.h"

namespace nplc::macreg {

/// The registers of a model with what was read of them, one of them selected, and of that one a field.
class RegisterList {
  public:
    explicit RegisterList(registers::Model model);

    registers::Model model() const { return model_; }
    const std::vector<const registers::Register*>& rows() const { return rows_; }
    std::size_t selected_row() const { return row_; }
    const registers::Register& selected() const { return *rows_[row_]; }
    /// The registers of the page around the selected one.
    std::span<const registers::Register* const> visible() const;
    std::size_t page() const { return page_; }
    /// Of the selected register.
    std::span<const registers::Field> fields() const;
    std::size_t selected_field() const { return field_; }
    /// As it was read last.
    std::optional<std::int64_t> raw_of(std::uint8_t number) const;
    bool has_error() const;
    /// Mode and errors, or that they are being read.
    std::string state_words() const;

    void store(const Snapshot& values);
    /// The rows per page.
    void set_page(std::size_t rows) { page_ = std::max<std::size_t>(1, rows); }
    /// No further than to the ends.
    void move(int steps);
    void move_field(int steps);

    /// A search starts from the row that is selected now, and goes back there if it is given up.
    void begin_search() { row_before_search_ = row_; }
    void give_up_search() { row_ = row_before_search_; }
    /// Down from where the search began, or from below the selected row, and around; names first, then
    /// titles. False: nothing has the text, and nothing moved but back to where the search began.
    bool search(const std::string& text, bool next);

  private:
    registers::Model model_;
    std::vector<const registers::Register*> rows_;
    std::map<std::uint8_t, std::int64_t> values_;
    std::size_t row_ = 0;
    std::size_t field_ = 0;
    std::size_t page_ = 10;
    std::size_t row_before_search_ = 0;
};

}  // namespace nplc::macreg
