#include "update/layout.h"

#include <algorithm>

namespace nplc::update {

std::uint32_t Layout::one_programming(std::uint32_t address, std::uint32_t bytes) const {
    return std::min(bytes, page_ - address % page_);
}

bool Layout::fits(const ImageHeader& header, unsigned slot, std::uint32_t board) const {
    return header.board == board && header.address == address(slot) && header.length != 0 &&
           header.length <= capacity() - kImageAt;
}

}  // namespace nplc::update
