#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "registers/set_points.h"
#include "store/slots.h"

/// Stored set-point values and recipes: one content of a slot, so that after a power cut either the old or
/// the new one is complete.
namespace nplc::store {

#ifndef NPLC_RECIPES
#define NPLC_RECIPES 8
#endif
inline constexpr std::size_t kRecipes = NPLC_RECIPES;
inline constexpr std::size_t kRecipeNameBytes = 16;

/// A set-point's value, independent of a table.
struct KeptValue {
    std::uint32_t name_hash = 0;
    std::int32_t value = 0;
    std::uint8_t unit = 0;
};

/// Up to 16 values, in their stored form.
class ValueSet {
  public:
    static constexpr std::size_t kValueBytes = 9;
    static constexpr std::size_t kBytes = registers::set_points::kMost * kValueBytes;

    explicit ValueSet(std::uint8_t* bytes) : bytes_(bytes) {}
    void clear();
    /// Ignored beyond kMost.
    void add(const KeptValue& value);
    /// The value of this entry if it has one of the same name and unit within the range.
    bool find(const registers::set_points::Entry& entry, std::int32_t& value) const;
    void copy_from(const ValueSet& other);
    bool is_empty() const { return read(0).name_hash == 0; }
    const std::uint8_t* bytes() const { return bytes_; }

  private:
    KeptValue read(std::size_t index) const;
    std::uint8_t* bytes_;
};

/// The whole stored content, in its stored form.
class SetPointImage {
  public:
    static constexpr std::size_t kHeaderBytes = 8;
    static constexpr std::size_t kRecipeBytes = kRecipeNameBytes + ValueSet::kBytes;
    static constexpr std::size_t kBytes = kHeaderBytes + ValueSet::kBytes + kRecipes * kRecipeBytes;

    SetPointImage() { clear(); }
    void clear();
    /// The bytes have this firmware's format.
    bool is_sound() const;
    std::span<std::uint8_t> bytes() { return bytes_; }

    ValueSet wanted() { return ValueSet(&bytes_[kHeaderBytes]); }
    /// The recipe that was loaded last, 1 and on; 0: none.
    std::uint8_t active() const { return bytes_[2]; }
    void set_active(std::uint8_t recipe) { bytes_[2] = recipe; }
    /// `recipe` 1 to kRecipes. An empty name means no recipe.
    std::span<std::uint8_t> recipe(std::size_t recipe) {
        return std::span(bytes_).subspan(kHeaderBytes + ValueSet::kBytes + (recipe - 1) * kRecipeBytes,
                                         kRecipeBytes);
    }
    bool has_recipe(std::size_t number) { return recipe(number)[0] != 0; }
    /// The recipe with this name, ended by 0, case-insensitive; for an empty name the first free one. 0:
    /// none.
    std::uint8_t recipe_named(const std::uint8_t* name);
    ValueSet values_of(std::size_t number) { return ValueSet(recipe(number).data() + kRecipeNameBytes); }

  private:
    std::array<std::uint8_t, kBytes> bytes_;
};

/// Stores the image in two slots of its own, as a whole.
class SetPointStore {
  public:
    SetPointStore(ports::Storage& storage, const Area& area)
        : slots_(storage, area, Kind::set_points, content_) {}

    /// For the start-up. Error damaged: the stored image is damaged, and an older one or an empty one is
    /// used.
    base::Status mount();
    SetPointImage& image() { return image_; }
    /// Restores image() from the store. Errors as mount(), then it is empty.
    base::Status drop_changes();

    /// Begins to store image(); call poll() until phase() is `done` or `failed`, and do not change it
    /// meanwhile.
    base::Status save() { return slots_.begin(); }
    void poll();
    base::Instant next_poll(base::Instant now) {
        return slots_.phase() == Phase::receiving ? now : slots_.next_poll(now);
    }
    Phase phase() const { return slots_.phase(); }
    base::Error error() const { return slots_.error(); }
    bool is_saving() const {
        return phase() == Phase::erasing || phase() == Phase::receiving || phase() == Phase::closing;
    }

  private:
    AnyContent content_;
    Slots slots_;
    SetPointImage image_;
};

}  // namespace nplc::store
