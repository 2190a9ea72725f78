#pragma once

#include <functional>

#include "course.h"

namespace nplc::soak {

/// True: the course still breaks what the long one did.
using Fails = std::function<bool(const Course&)>;

/// The shortest course that can be found from one that fails: its last disturbances alone if that does, then
/// without each part that it does not need (Zeller's ddmin), then with each pause as short as it may be.
/// `fails` is asked some hundred times, of long courses seldom.
Course shrink(const Course& course, const Fails& fails);

}  // namespace nplc::soak
