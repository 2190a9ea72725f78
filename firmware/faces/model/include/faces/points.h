#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "faces/image.h"

namespace nplc::faces {

/// What one of the axis's units is, for position and velocity.
struct Scaling {
    std::string unit = "rev";
    double per_revolution = 1;  ///< units
};

/// Of all values of an image but the motor's.
Quality quality_of(const AxisImage& image, base::Instant now);

/// One value of an axis as a face shows it.
struct PointValue {
    Quality quality = Quality::unknown;
    double value = 0;  ///< exact for whole numbers
};

enum class PointType : std::uint8_t { boolean, whole, real };

/// A named value that can be read of an axis.
struct Point {
    std::string_view name;  ///< lower_case
    std::string_view unit;  ///< "unit": the axis's own; "unit/s"
    PointType type;
    bool of_motor;  ///< may be old or unknown while the rest is good
    std::string_view text;
    PointValue (*take)(const AxisImage& image, base::Instant now, const Scaling& scaling);
};

/// In the order of documents.
std::span<const Point> points();
/// Null: there is none.
const Point* find_point(std::string_view name);
/// The unit in words, for an axis.
std::string unit_of(const Point& point, const Scaling& scaling);

}  // namespace nplc::faces
