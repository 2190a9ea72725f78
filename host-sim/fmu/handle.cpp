#include "handle.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace nplc::sim::fmu {
namespace {

struct Living {
    std::mutex mutex;
    std::vector<void*> instances;
};

Living& all() {
    static Living living;
    return living;
}

}  // namespace

Instance* enlist(Instance* instance) {
    if (instance == nullptr) return nullptr;
    const std::lock_guard lock(all().mutex);
    all().instances.push_back(instance);
    return instance;
}

Instance* living(void* handle) {
    const std::lock_guard lock(all().mutex);
    const std::vector<void*>& instances = all().instances;
    const bool lives = std::find(instances.begin(), instances.end(), handle) != instances.end();
    return lives ? static_cast<Instance*>(handle) : nullptr;
}

void discharge(void* handle) {
    Instance* instance = living(handle);
    if (instance == nullptr) return;
    {
        const std::lock_guard lock(all().mutex);
        std::erase(all().instances, handle);
    }
    delete instance;
}

}  // namespace nplc::sim::fmu
