#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "sim/world.h"

namespace nplc::soak {

/// Which tables the gateway's store may contain, after uploads and power cuts. The checks return what is
/// wrong; empty: nothing.
class StoredTables {
  public:
    explicit StoredTables(const sim::World& world) : world_(world) {}

    void begin_upload(std::uint32_t crc) {
        uploading_ = crc;
        is_uploading_ = true;
    }
    void power_cut() { is_uploading_ = false; }
    bool is_uploading() const { return is_uploading_; }
    /// From the commit on the store may contain the new table; once the upload has ended it is known which.
    std::string watch(bool has_committed, bool is_uploading);
    std::string check();
    std::uint64_t count() const { return count_; }  ///< of stored tables

  private:
    const sim::World& world_;
    bool is_uploading_ = false;
    std::uint32_t uploading_ = 0;          ///< CRC-32
    std::set<std::uint32_t> possible_{0};  ///< CRC-32; 0: no table
    bool was_stored_ = false;
    std::uint64_t count_ = 0;
};

}  // namespace nplc::soak
