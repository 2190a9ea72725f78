#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/time.h"
#include "faces/axis_model.h"

namespace nplc::deployment {

/// The axis's latest image, and the table that is active in it.
class ActiveTable {
  public:
    void read(faces::AxisModel& axis, base::Instant now);

    const faces::AxisImage& image() const { return image_; }
    /// The axis has reported the table that it gives: no change of it is in progress.
    bool is_known() const { return is_known_; }
    /// The latest one that was known; null: none yet.
    const faces::AxisTable* table() const { return table_.get(); }
    /// As it was uploaded; empty: no table.
    const std::string& sha256() const { return sha256_; }
    bool is(std::string_view sha256) const { return !sha256_.empty() && sha256_ == sha256; }

  private:
    faces::AxisImage image_{};
    std::shared_ptr<const faces::AxisTable> table_;
    std::string sha256_;
    bool is_known_ = false;
};

}  // namespace nplc::deployment
