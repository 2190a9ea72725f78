#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "deployment/file.h"
#include "disk.h"
#include "record.h"

namespace nplc::deployment {

/// The record of an axis's orders and the last good table, in memory and in the axis's folder.
class Ledger {
  public:
    /// A one-line message for the operator; an error or news.
    using Note = std::function<void(bool is_error, const std::string&)>;

    Ledger(std::string folder, Note note) : folder_(std::move(folder)), note_(std::move(note)) {}

    /// Reads what an earlier process has stored.
    void read();
    /// Damage of the stored files: no order may be accepted; empty: none.
    const std::string& damage() const { return damage_; }
    const Record& record() const { return record_; }
    /// Including the record that is being written.
    std::uint64_t last_counter() const;

    /// Writes `files`, then `next`. `next` is the record once it is on the disk; `then` is called after that.
    /// Failed writes are retried. Not while a write is in progress.
    void save(const Record& next, std::vector<File> files, std::function<void()> then);
    bool is_saving() const { return next_.has_value(); }
    /// Why the last write failed; empty: it did not.
    const std::string& error() const { return error_; }
    /// To be called regularly.
    void look_at_disk(base::Instant now);

    /// Changes the active table in the record; written with the next save().
    void set_running(const std::string& sha256, const std::string& name, std::uint64_t since);
    bool has_unsaved() const { return has_unsaved_; }

    std::string former_path() const { return path(kFormerFile); }
    /// No value: see read_file().
    std::optional<std::vector<std::uint8_t>> read_former(bool& is_missing) const;

  private:
    std::string path(const char* file) const { return folder_ + "/" + file; }

    std::string folder_;
    Note note_;
    Disk disk_;
    Record record_;
    std::string damage_;
    bool has_unsaved_ = false;
    // The write in progress.
    std::optional<Record> next_;
    std::vector<File> files_;
    std::function<void()> then_;
    std::string error_;
    base::Instant not_before_{};
};

}  // namespace nplc::deployment
