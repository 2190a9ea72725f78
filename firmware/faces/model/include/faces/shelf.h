#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace nplc::faces {

/// Passes rarely changing data from an axis's loop to the faces, which keep them as long as they hold the
/// pointer. The loop only tries the lock.
template <class T>
class Shelf {
  public:
    Shelf() : shown_(std::make_shared<const T>()), last_(shown_) {}

    std::shared_ptr<const T> get() const {
        const std::lock_guard lock(mutex_);
        return shown_;
    }
    /// False: retry. From the loop only.
    bool put(std::shared_ptr<const T> next) {
        std::shared_ptr<const T> before;  // destroyed outside of the lock
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) return false;
        last_ = next;
        before = std::exchange(shown_, std::move(next));
        return true;
    }
    /// The value of the last put(). From the loop only.
    const T& last() const { return *last_; }

  private:
    mutable std::mutex mutex_;
    std::shared_ptr<const T> shown_;
    std::shared_ptr<const T> last_;
};

}  // namespace nplc::faces
