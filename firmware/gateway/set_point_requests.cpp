// A write to SET_POINT_WRITE: checked and stored as a whole; then its values are the wanted ones.
#include <algorithm>

#include "base/bytes.h"
#include "gateway/set_points.h"

namespace nplc::gateway {

using namespace registers::gateway;
using registers::set_points::Entry;

namespace {

constexpr std::size_t kHead = 12;
constexpr std::size_t kOwnNumberAt = 8;

std::size_t bits_in(std::uint16_t mask) {
    std::size_t count = 0;
    for (; mask != 0; mask = static_cast<std::uint16_t>(mask & (mask - 1U))) ++count;
    return count;
}

CommandResult refused(Result result, std::size_t index) {
    return {result, static_cast<std::uint16_t>(index)};
}

bool is_done(const CommandResult& outcome) {
    return outcome.word() == CommandResult().word();
}

}  // namespace

CommandResult SetPoints::read_request(std::span<const std::uint8_t> bytes, Request& request) {
    if (bytes.size() < kHead) return {Result::bad_length};
    request.kind = static_cast<SetPointRequest>(bytes[4]);
    request.recipe = bytes[5];
    request.mask = base::load_u16(&bytes[6]);
    if (bytes[4] < static_cast<std::uint8_t>(SetPointRequest::change) ||
        bytes[4] > static_cast<std::uint8_t>(SetPointRequest::delete_recipe))
        return {Result::bad_value};
    const bool changes = request.kind == SetPointRequest::change;
    const bool saves =
        request.kind == SetPointRequest::save_recipe || request.kind == SetPointRequest::put_recipe;
    if (request.recipe > ((changes || saves) ? 0 : store::kRecipes)) return {Result::no_recipe};
    if (base::load_u32(bytes.data()) != record_crc_ || record_.count() == 0) return {Result::other_table};
    const bool valued = changes || request.kind == SetPointRequest::put_recipe;
    const std::size_t count = bits_in(request.mask);
    const std::size_t name = changes ? 0 : store::kRecipeNameBytes;
    if ((request.mask >> record_.count()) != 0 || valued != (count != 0)) return {Result::bad_value};
    const std::size_t wanted = (kHead + name + 5 * count + 3) / 4 * 4;
    if (bytes.size() != wanted) return {Result::bad_length};
    request.name = bytes.subspan(kHead, name);
    request.values = bytes.subspan(kHead + name, 4 * count);
    request.units = bytes.subspan(kHead + name + 4 * count, count);
    const bool is_cut = !request.name.empty() && request.name.back() != 0;
    if (is_cut || (saves && request.name[0] == 0)) return {Result::bad_value};
    if (const CommandResult outcome = check_values(request); changes || !is_done(outcome)) return outcome;
    return find_recipe(request, saves);
}

/// Checks all values before anything is changed.
CommandResult SetPoints::check_values(const Request& request) const {
    std::size_t at = 0;
    for (std::size_t i = 0; i < record_.count(); ++i) {
        if (((request.mask >> i) & 1U) == 0) continue;
        const Entry entry = record_.entry(i);
        const auto value = static_cast<std::int32_t>(base::load_u32(&request.values[4 * at]));
        if (request.units[at] != entry.unit()) return refused(Result::wrong_unit, i);
        if (!entry.allows(value)) return refused(Result::out_of_range, i);
        if (!motor_takes(entry, value)) return refused(Result::not_for_motor, i);
        ++at;
    }
    return {};
}

/// Finds the recipe by its current name; a new one gets the first free number.
CommandResult SetPoints::find_recipe(Request& request, bool saves) {
    store::SetPointImage& image = store_.image();
    std::uint8_t number = request.recipe;
    if (request.name[0] != 0) number = image.recipe_named(request.name.data());
    if (saves) {
        constexpr std::uint8_t kFree = 0;
        if (number == 0) number = image.recipe_named(&kFree);
        if (number == 0) return {Result::no_recipe_left};
    } else if (number == 0 || !image.has_recipe(number)) {
        return {Result::no_recipe};
    } else if (request.recipe != 0 && request.recipe != number) {
        return {Result::other_recipe};
    }
    request.recipe = number;
    return {};
}

/// Writes the request into the image to be stored next, and into `after_`.
void SetPoints::prepare(Request& request) {
    store::SetPointImage& image = store_.image();
    after_ = wanted_;
    Values given = wanted_;
    std::size_t at = 0;
    for (std::size_t i = 0; i < record_.count(); ++i) {
        if (((std::uint32_t{request.mask} >> i) & 1U) == 0) continue;
        given[i] = static_cast<std::int32_t>(base::load_u32(&request.values[4 * at++]));
    }
    const std::size_t number = request.recipe;
    switch (request.kind) {
        case SetPointRequest::change:
            after_ = given;
            return keep(image.wanted(), after_);
        case SetPointRequest::save_recipe:
        case SetPointRequest::put_recipe:
            std::copy(request.name.begin(), request.name.end(), image.recipe(number).begin());
            return keep(image.values_of(number), given);
        case SetPointRequest::load_recipe:
            request.dropped = find_values(image.values_of(number), after_);
            keep(image.wanted(), after_);
            return image.set_active(request.recipe);
        case SetPointRequest::delete_recipe:
            std::fill(image.recipe(number).begin(), image.recipe(number).end(), std::uint8_t{0});
            if (image.active() == number) image.set_active(0);
            return;
    }
}

void SetPoints::keep(store::ValueSet set, const Values& values) const {
    set.clear();
    for (std::size_t i = 0; i < record_.count(); ++i) {
        const Entry entry = record_.entry(i);
        set.add({.name_hash = entry.name_hash(), .value = values[i], .unit = entry.unit()});
    }
}

PendingResult SetPoints::serve(Writer& writer, std::span<const std::uint8_t> bytes, base::Instant now) {
    if (!available_) return CommandResult{Result::no_register};
    if (writer.request == 0) {
        const std::uint32_t own_number = bytes.size() < kHead ? 0 : base::load_u32(&bytes[kOwnNumberAt]);
        for (std::uint32_t i = 0; own_number != 0 && i < kKeptRequests; ++i) {
            if (asked_[i].own_number == own_number) return asked_[i].outcome;
        }
        if (saving_) {
            if (now - writer.since > kLongestWait) return CommandResult{Result::busy};
            return std::nullopt;
        }
        writer.request = ++last_asked_;
        Asked& asked = asked_[last_asked_ % kKeptRequests];
        asked = {own_number, std::nullopt};
        const CommandResult refusal = begin_request(bytes, writer.origin);
        if (!saving_) asked.outcome = refusal;
    }
    return asked_[writer.request % kKeptRequests].outcome;
}

CommandResult SetPoints::begin_request(std::span<const std::uint8_t> bytes, Origin origin) {
    request_ = {};
    request_.origin = origin;
    if (const CommandResult outcome = read_request(bytes, request_); !is_done(outcome)) return outcome;
    prepare(request_);
    is_for_other_table_ = false;
    if (const base::Status begun = store_.save(); !begun) {
        static_cast<void>(store_.drop_changes());
        return {result_of(begun.error())};
    }
    saving_ = true;
    return {};
}

/// Completes a request, whether its client still waits or not.
void SetPoints::end_request() {
    const bool failed = store_.phase() == store::Phase::failed;
    if (!saving_ || (!failed && store_.phase() != store::Phase::done)) return;
    saving_ = false;
    ++edition_;
    asked_[last_asked_ % kKeptRequests].outcome =
        failed ? CommandResult{result_of(store_.error())} : CommandResult{};
    if (failed) static_cast<void>(store_.drop_changes());
    if (!failed) damaged_ = false;
    if (is_for_other_table_)
        find_values(store_.image().wanted(), wanted_);
    else if (!failed)
        finish_request();
}

/// The request is stored: its values are now the wanted ones.
void SetPoints::finish_request() {
    const auto who = static_cast<std::uint16_t>(static_cast<unsigned>(request_.origin) << 8);
    const auto recipe = static_cast<std::uint16_t>(who | request_.recipe);
    switch (request_.kind) {
        case SetPointRequest::change:
            gateway_.note(Event::set_points_changed,
                          static_cast<std::uint16_t>(who | bits_in(request_.mask)));
            return note_changes();
        case SetPointRequest::save_recipe:
        case SetPointRequest::put_recipe:
            return gateway_.note(Event::recipe_saved, recipe);
        case SetPointRequest::load_recipe:
            gateway_.note(Event::recipe_loaded, recipe);
            dropped_ = request_.dropped;
            return note_changes();
        case SetPointRequest::delete_recipe:
            return gateway_.note(Event::recipe_deleted, recipe);
    }
}

void SetPoints::note_changes() {
    for (std::size_t i = 0; i < record_.count(); ++i) {
        if (after_[i] == wanted_[i]) continue;
        ring_[changes_ % kKeptChanges] = {.milliseconds = gateway_.uptime(),
                                          .index = static_cast<std::uint8_t>(i),
                                          .origin = request_.origin,
                                          .recipe = request_.recipe,
                                          .before = wanted_[i],
                                          .now = after_[i]};
        ++changes_;
    }
    wanted_ = after_;
}

}  // namespace nplc::gateway
