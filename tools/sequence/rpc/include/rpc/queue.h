#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace nplc::rpc {

/// Queue from reading or working threads to the answering thread.
template <class Item>
class Queue {
  public:
    void put(Item item) {
        put(std::move(item), [](const Item&, const std::deque<Item>&) {});
    }
    /// `look` is called with the item and the queued ones, before it is added.
    template <class Look>
    void put(Item item, const Look& look) {
        const std::lock_guard lock(mutex_);
        look(item, items_);
        items_.push_back(std::move(item));
        changed_.notify_all();
    }
    bool empty() const {
        const std::lock_guard lock(mutex_);
        return items_.empty();
    }
    /// Empty on timeout; waits without limit if `patience` is empty.
    std::optional<Item> take(std::optional<std::chrono::milliseconds> patience) {
        std::unique_lock lock(mutex_);
        const auto has_item = [this] { return !items_.empty(); };
        if (patience && !changed_.wait_for(lock, *patience, has_item)) return std::nullopt;
        if (!patience) changed_.wait(lock, has_item);
        Item item = std::move(items_.front());
        items_.pop_front();
        return item;
    }

  private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Item> items_;
};

}  // namespace nplc::rpc
