#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/time.h"
#include "deployment/settings.h"
#include "faces/image.h"

namespace nplc::deployment {

/// Judges by the axis's images whether a newly activated table is healthy.
class Trial {
  public:
    enum class Verdict : std::uint8_t { open, healthy, failed };
    struct Judgement {
        Verdict verdict = Verdict::open;
        std::string text{};  ///< why it failed, or what an open one waits for
    };

    /// `settings` must outlive it.
    explicit Trial(const Settings& settings) : settings_(settings) {}

    void reset() { *this = Trial(settings_); }
    /// The time until `now` does not count.
    void go_on_at(base::Instant now) { watched_ = now; }
    /// To be called regularly while the table of the trial is active.
    Judgement watch(const faces::AxisImage& image, base::Instant now);

  private:
    std::reference_wrapper<const Settings> settings_;
    base::Microseconds ran_{};
    base::Microseconds healthy_{};  ///< since the last ERROR
    std::string error_{};           ///< the last error
    bool was_in_step_ = false;
    base::Instant watched_{};                      ///< last
    std::optional<std::uint32_t> first_reason_{};  ///< SAFE_REASON from before the trial
};

}  // namespace nplc::deployment
