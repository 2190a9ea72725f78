#pragma once

#include <string>

#include "analysis/course.h"
#include "analysis/verify.h"

/// A course as text, and as files that can be executed scan by scan.
namespace nplc::verify {

std::string input_name(const Names& names, unsigned input);
/// Whether the input of this name is on: of an inverted one the bit of the image is off.
bool input_holds(const Names& names, unsigned input, std::uint8_t image);
std::string output_name(const Names& names, unsigned output);
std::string step_name(const Names& names, std::uint8_t step);
/// The inputs that are on; - for none.
std::string outputs_text(std::uint8_t outputs, const Names& names);

/// With names and units where `names` has them: "POSITION(Near)", "Near := 52 mm"; else "14h", "49=0".
std::string order_text(const sequencer::MotorOrder& order, const Names& names);

/// A line for each scan that did something or saw something new: time, image, step, what it did; where it
/// breaks, and the helper steps on the way. The result must have a course.
std::string story_of(const Result& result, const Names& names);

/// For `nanoplc-sim scan`: a row a scan, below the presets of set-points with other values than the table's.
/// The result must have a course.
std::string stimulus_of(const Result& result);

/// For `tools/plot_trace`: a row a scan, with the state after it; where the shaft is stays empty.
std::string trace_of(const Course& course);

}  // namespace nplc::verify
