#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace nplc::rpc {

/// From threads that read or work to the one that answers.
template <class Item>
class Queue {
  public:
    void put(Item item) {
        put(std::move(item), [](const Item&, const std::deque<Item>&) {});
    }
    /// `look` sees the item and those that wait, before it joins them.
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
    /// Nothing if none came within `patience`; without patience it waits.
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
