#include "input_file.h"
#include "outside.h"

namespace nplc::sim {
namespace {

class Nothing final : public Outside {
  public:
    ports::Storage* flash() override { return nullptr; }
    void run(Session&, const volatile std::sig_atomic_t&) override {}
};

}  // namespace

std::unique_ptr<Outside> open_outside(const RunOptions& options, const Program&) {
    if (options.realtime || options.flash) {
        throw InputError(
            "nanoplc-sim: the one that tools/demo builds has neither --realtime nor --flash; "
            "`cmake --preset release` and `cmake --build --preset release` build the whole one");
    }
    return std::make_unique<Nothing>();
}

}  // namespace nplc::sim
