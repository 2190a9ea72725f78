#include "store/table_check.h"

namespace nplc::store {

void TableCheck::begin() {
    rules_ = {};
    have_ = 0;
    fault_term_ = 0;
}

base::Status TableCheck::take(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
        if (rules_.ended()) return {};
        term_[have_] = byte;
        if (++have_ < term_.size()) continue;
        have_ = 0;
        if (const auto status = take_term(); !status) return status;
    }
    return {};
}

base::Status TableCheck::take_term() {
    fault_term_ = rules_.terms();
    if (const auto fault = rules_.take(term_)) return fault->error;
    if (rules_.ended() || terms_ == nullptr || terms_->accepts(term_)) return {};
    return base::Error::not_for_motor;
}

base::Status TableCheck::end() {
    const auto fault = rules_.finish(have_);
    if (!fault) return {};
    fault_term_ = fault->term;
    return fault->error;
}

}  // namespace nplc::store
