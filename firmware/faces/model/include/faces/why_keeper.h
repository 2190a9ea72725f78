#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "causes/why.h"
#include "faces/image.h"

namespace nplc::faces {

/// The motor's registers that causes are judged by, read one after the other.
struct Survey {
    base::Instant taken{};  ///< the last of them, by the clock that faces read
    registers::Model model = registers::Model::mac140;
    causes::Snapshot before{};
    causes::Snapshot now{};
};

/// Why nothing moves: as `macreg why` finds it, what to mend first in front.
using Findings = std::vector<causes::Finding>;

/// Judges the axis for all faces, once for each survey and state of the gateway. For any thread.
class WhyKeeper {
  public:
    /// A survey is good for so long.
    static constexpr base::Milliseconds kGood{30'000};

    /// Null: not known (yet). Never empty.
    std::shared_ptr<const Findings> look(const AxisImage& image, base::Instant now,
                                         const std::shared_ptr<const Survey>& survey);

  private:
    struct Key {
        const Survey* survey = nullptr;
        std::uint32_t status = 0;
        std::uint32_t reason = 0;
        bool moves = false;
        std::optional<causes::MidiState> midi{};
        bool operator==(const Key&) const = default;
    };

    std::mutex mutex_;
    Key key_;
    std::shared_ptr<const Survey> survey_;  ///< that key_ names
    std::shared_ptr<const Findings> findings_;
};

}  // namespace nplc::faces
