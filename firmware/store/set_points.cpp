#include "store/set_points.h"

#include <algorithm>

#include "base/bytes.h"
#include "base/crc32.h"

namespace nplc::store {
namespace {

constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kPiece = 128;

std::uint8_t capital(std::uint8_t sign) {
    return sign >= 'a' && sign <= 'z' ? static_cast<std::uint8_t>(sign - 'a' + 'A') : sign;
}

bool is_same_name(const std::uint8_t* one, const std::uint8_t* other) {
    for (std::size_t i = 0; i < kRecipeNameBytes; ++i) {
        if (capital(one[i]) != capital(other[i])) return false;
        if (one[i] == 0) return true;
    }
    return true;
}

}  // namespace

void ValueSet::clear() {
    std::fill_n(bytes_, kBytes, std::uint8_t{0});
}

void ValueSet::copy_from(const ValueSet& other) {
    std::copy_n(other.bytes_, kBytes, bytes_);
}

KeptValue ValueSet::read(std::size_t index) const {
    const std::uint8_t* at = bytes_ + index * kValueBytes;
    return {.name_hash = base::load_u32(at),
            .value = static_cast<std::int32_t>(base::load_u32(at + 4)),
            .unit = at[8]};
}

void ValueSet::add(const KeptValue& value) {
    for (std::size_t i = 0; i < registers::set_points::kMost; ++i) {
        const std::uint32_t there = read(i).name_hash;
        if (there != 0 && there != value.name_hash) continue;
        std::uint8_t* at = bytes_ + i * kValueBytes;
        base::store_u32(at, value.name_hash);
        base::store_u32(at + 4, static_cast<std::uint32_t>(value.value));
        at[8] = value.unit;
        return;
    }
}

bool ValueSet::find(const registers::set_points::Entry& entry, std::int32_t& value) const {
    for (std::size_t i = 0; i < registers::set_points::kMost; ++i) {
        const KeptValue kept = read(i);
        if (kept.name_hash != entry.name_hash() || kept.unit != entry.unit() || !entry.allows(kept.value))
            continue;
        value = kept.value;
        return true;
    }
    return false;
}

void SetPointImage::clear() {
    bytes_.fill(0);
    bytes_[0] = kVersion;
    bytes_[1] = static_cast<std::uint8_t>(kRecipes);
}

bool SetPointImage::is_sound() const {
    return bytes_[0] == kVersion && bytes_[1] == kRecipes && bytes_[2] <= kRecipes;
}

std::uint8_t SetPointImage::recipe_named(const std::uint8_t* name) {
    for (std::size_t number = 1; number <= kRecipes; ++number) {
        if (is_same_name(recipe(number).data(), name)) return static_cast<std::uint8_t>(number);
    }
    return 0;
}

base::Status SetPointStore::mount() {
    if (const auto status = slots_.mount(); !status) return status;
    const auto status = drop_changes();
    if (!status) return status;
    return slots_.is_fallback() ? base::Status{base::Error::damaged} : base::Status{};
}

base::Status SetPointStore::drop_changes() {
    image_.clear();
    if (slots_.current().length == 0) return {};
    const auto length = slots_.load(image_.bytes());
    if (length.ok() && length.value() == SetPointImage::kBytes && image_.is_sound()) return {};
    image_.clear();
    return length.ok() ? base::Error::damaged : length.error();
}

void SetPointStore::poll() {
    slots_.poll();
    if (slots_.phase() != Phase::receiving) return;
    const auto bytes = image_.bytes();
    const std::uint32_t sent = slots_.received();
    if (sent < bytes.size()) {
        static_cast<void>(
            slots_.write(sent, bytes.subspan(sent, std::min<std::size_t>(kPiece, bytes.size() - sent))));
    } else {
        static_cast<void>(slots_.finish(sent, base::crc32(bytes)));
    }
}

}  // namespace nplc::store
