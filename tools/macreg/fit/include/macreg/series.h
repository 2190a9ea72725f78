#pragma once

#include <optional>
#include <string>
#include <vector>

#include "macreg/recording.h"
#include "registers/mac.h"

namespace nplc::macreg {

/// A recording in the motor's own units, a value for each sample of the outer loop.
struct Series {
    std::string name{};
    std::vector<double> torque{};  ///< VF_OUT: requested at the end of the sample
    std::vector<double>
        counts{};  ///< position of the shaft at the end of the sample, relative to the first one
    std::vector<char>
        at_rest{};  ///< samples in which static friction holds the shaft; they are not used for the plant
    std::vector<double>
        sine{};  ///< of the field's angle in the middle of the sample, relative to the first one's position
    std::vector<double> cosine{};
    std::size_t size() const { return torque.size(); }
    /// Counts in sample `i`, from 1.
    double velocity(std::size_t i) const { return counts[i] - counts[i - 1]; }
};

inline constexpr std::size_t kFewestSamples = 100;

struct SeriesReading {
    Series series{};
    registers::Model model = registers::Model::mac140;
    std::string motor{};  ///< "MAC140", or for any of MAC50 to MAC141 "MAC50-141"
    std::string error{};  ///< one line with what to record instead; empty if it can be fitted
};

/// Of a recording with VF_OUT and P_IST, or V_IST in its place, at the position loop's rate. `name` is the
/// file's, for messages; `model` says which motor it is where the recording does not.
SeriesReading series_of(const Recording& recording, const std::string& name,
                        std::optional<registers::Model> model = {});

}  // namespace nplc::macreg
