#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "faces/image.h"

namespace nplc::faces {

/// The axis's unit of position and velocity.
struct Scaling {
    std::string unit = "rev";
    double per_revolution = 1;  ///< units
};

/// Quality of an image's values, except those of the motor.
Quality quality_of(const AxisImage& image, base::Instant now);

/// A value of an axis as shown by faces.
struct PointValue {
    Quality quality = Quality::unknown;
    double value = 0;  ///< exact for whole numbers
};

enum class PointType : std::uint8_t { boolean, whole, real };

/// A named readable value of an axis.
struct Point {
    std::string_view name;  ///< lower_case
    std::string_view unit;  ///< "unit": the axis's own; "unit/s"
    PointType type;
    bool of_motor;  ///< may be stale or unknown while the rest is good
    std::string_view text;
    PointValue (*take)(const AxisImage& image, base::Instant now, const Scaling& scaling);
};

/// In the order of the documentation.
std::span<const Point> points();
/// Null: there is none.
const Point* find_point(std::string_view name);
/// The text of the unit, for an axis.
std::string unit_of(const Point& point, const Scaling& scaling);

}  // namespace nplc::faces
