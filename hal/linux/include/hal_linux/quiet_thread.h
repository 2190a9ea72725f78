#pragma once

#include <functional>
#include <thread>

namespace nplc::hal_linux {

/// A thread beside the loops of axes: without their real-time priority, and no signal comes to it.
std::thread start_quiet_thread(std::function<void()> work);

}  // namespace nplc::hal_linux
