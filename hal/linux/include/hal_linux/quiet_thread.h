#pragma once

#include <functional>
#include <thread>

namespace nplc::hal_linux {

/// A background thread: without the axes' real-time priority, and with all signals blocked.
std::thread start_quiet_thread(std::function<void()> work);

}  // namespace nplc::hal_linux
