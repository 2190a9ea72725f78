#pragma once

#include <memory>
#include <string>
#include <vector>

#include "axis.h"
#include "config.h"
#include "journal.h"
#include "panel/panel.h"

namespace nplc::boards {

/// Symbol files of each axis's table: the one that came with an upload, in the axis's folder, and the one
/// that the configuration names. Both name the table that they belong to.
class StoredNames final : public panel::SymbolShelf {
  public:
    explicit StoredNames(const Config& config) : config_(config) {}

    Found find(std::size_t axis, std::uint32_t crc) override;
    std::string keep(std::size_t axis, std::uint32_t crc, std::string_view text) override;

  private:
    std::string kept_file(std::size_t axis) const;

    const Config& config_;
};

/// The panel of all axes; empty if the configuration has none or it cannot be started: the axes run without
/// it.
class PanelPart {
  public:
    PanelPart(const Config& config, Journal& journal) : config_(config), journal_(journal), names_(config) {}

    /// Before the axes' loop begins, and before the thread gets real-time priority. It must end before the
    /// axes.
    void open(const std::vector<std::unique_ptr<Axis>>& axes);
    void close() { panel_.reset(); }

  private:
    /// Reads the first line of a secret file. False: the error was logged.
    bool read_secret(const LocatedText& file, std::string& secret);

    const Config& config_;
    Journal& journal_;
    StoredNames names_;
    std::unique_ptr<panel::Panel> panel_;
};

}  // namespace nplc::boards
