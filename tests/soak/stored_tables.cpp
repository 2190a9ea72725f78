#include "stored_tables.h"

#include <fmt/format.h>

namespace nplc::soak {

std::string StoredTables::check() {
    const store::Header header = world_.tables().stored();
    const std::uint32_t stored = header.length == 0 ? 0 : header.crc;
    std::string wrong;
    if (!possible_.contains(stored))
        wrong = fmt::format("table {:08X} is stored, which was not uploaded last", stored);
    else if (was_stored_ && world_.tables().fell_back())
        wrong = "the stored table is damaged or gone";
    possible_ = {stored};
    return wrong;
}

std::string StoredTables::watch(bool has_committed, bool is_uploading) {
    if (has_committed) possible_.insert(uploading_);
    if (is_uploading) return {};
    is_uploading_ = false;
    using store::Phase;
    const auto phase = static_cast<Phase>(world_.tables().upload_state() & 0xFF);
    if (phase == Phase::done) {
        was_stored_ = true;
        ++count_;
        possible_ = {uploading_};
    }
    const bool has_ended = phase == Phase::done || phase == Phase::failed || phase == Phase::idle;
    return has_ended ? check() : std::string();
}

}  // namespace nplc::soak
