#include "modbus/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "registers/layout.h"

namespace nplc::modbus {

namespace gw = registers::gateway;
using faces::Command;
using faces::Completion;
using faces::Quality;
using faces::Result;

namespace {

constexpr unsigned kMostWindow = 8;  ///< motor registers per request
constexpr std::array kCoilCommands{gw::Command::run,  gw::Command::stop, gw::Command::safe,
                                   gw::Command::hold, gw::Command::step, gw::Command::scan};

bool is_stop(std::uint16_t command) {
    return Command::of(static_cast<gw::Command>(command), {}).is_stop();
}

/// Other commands need functions that a PLC does not have: an upload, kept settings.
bool is_for_plant(std::uint16_t command) {
    return command >= static_cast<std::uint16_t>(gw::Command::run) &&
           command <= static_cast<std::uint16_t>(gw::Command::hold);
}

std::int64_t in_steps(const ValueRow& row, double value) {
    const double bits = 16.0 * row.words;
    const double low = row.is_signed ? -std::exp2(bits - 1) : 0;
    const double high = std::exp2(row.is_signed ? bits - 1 : bits) - 1;
    return std::llround(std::clamp(value * row.steps, low, high));
}

/// One of the two words of a value, in the configured word order.
std::uint16_t word_of(std::int64_t value, unsigned index, bool low_first) {
    const bool low = (index == 0) == low_first;
    return static_cast<std::uint16_t>(low ? value : value >> 16);
}

/// A 32-bit value from two words of a request.
std::uint32_t long_in(const Request& request, std::size_t word, bool low_first) {
    const std::uint32_t one = request.word(word);
    const std::uint32_t two = request.word(word + 1);
    return low_first ? one | two << 16 : one << 16 | two;
}

bool asks_motor(const Request& request) {
    if (request.writes) return false;
    const auto rows = value_rows();
    return std::any_of(rows.begin(), rows.end(), [&request](const ValueRow& row) {
        return row.point->of_motor && row.space == request.space &&
               row.address < request.address + unsigned{request.count} &&
               row.address + unsigned{row.words} > request.address;
    });
}

/// Begins or ends between the two words of a value.
bool cuts_a_value(const Request& request) {
    const unsigned end = request.address + unsigned{request.count};
    return is_second_word(request.space, request.address) || is_second_word(request.space, end);
}

Exception exception_of(const Completion& ended) {
    if (ended.result == Result::done) return Exception::none;
    if (ended.result == Result::busy) return Exception::busy;
    return ended.result == Result::link_down ? Exception::target_failed : Exception::device_failure;
}

}  // namespace

SetPointLook Session::set_points_of(const Look& look) {
    return {*look.book, look.image, look.unit.settings.low_word_first};
}

bool Session::is_old(const Look& look) {
    return look.image.number == 0 || look.now - look.image.taken > faces::AxisModel::kOld;
}

Handshake& Unit::handshake(const std::string& address) {
    auto found = std::find_if(handshakes_.begin(), handshakes_.end(),
                              [&](const Handshake& one) { return one.address == address; });
    if (found == handshakes_.end() && handshakes_.size() < kMostAddresses) {
        handshakes_.push_back({.address = address});
        found = handshakes_.end() - 1;
    } else if (found == handshakes_.end()) {
        found = std::min_element(handshakes_.begin(), handshakes_.end(),
                                 [](const auto& a, const auto& b) { return a.used < b.used; });
        *found = Handshake{.address = address};
    }
    found->used = ++uses_;
    return *found;
}

void Unit::follow_start(const faces::AxisImage& image) {
    if (image.number == 0 || std::exchange(restarts_, image.restarts) == image.restarts) return;
    handshakes_.clear();
    acknowledged = 0;
}

std::optional<Command> Unit::due(base::Instant now) {
    if (master == 0 || settings.on_silence == Silence::nothing || now - heard <= settings.silence)
        return std::nullopt;
    master = 0;
    const bool stops = settings.on_silence == Silence::stop;
    const std::string how = heard == base::Instant{}
                                ? "has left"
                                : fmt::format("has said nothing for {} ms", settings.silence.count());
    if (settings.tell)
        settings.tell(model.name(), fmt::format("{}, which operated last, {}: {}", master_name, how,
                                                stops ? "stop" : "safe"));
    return Command::of(stops ? gw::Command::stop : gw::Command::safe, now);
}

Session::Session(std::vector<std::unique_ptr<Unit>>& units, std::string name, faces::Bell& bell)
    : units_(units),
      name_(std::move(name)),
      bell_(bell),
      clients_(units.size()),
      staged_(units.size()),
      written_(units.size()) {}

/// If the session is the master, or may be without having heard so, it counts as silent at once.
Session::~Session() {
    for (const auto* one : {&waiting_, &aside_}) {
        if (!*one || !(*one)->operates) continue;
        units_[(*one)->index]->master = number_;
        units_[(*one)->index]->master_name = name_;
    }
    for (const auto& unit : units_) {
        if (unit->master == number_) unit->heard = base::Instant{};
    }
}

Unit* Session::find(std::uint8_t unit) {
    constexpr std::uint8_t kAny = 255;
    if ((unit == 0 || unit == kAny) && units_.size() == 1) return units_.front().get();
    const auto found =
        std::find_if(units_.begin(), units_.end(), [unit](const auto& one) { return one->number == unit; });
    return found == units_.end() ? nullptr : found->get();
}

std::optional<Answer> Session::serve(std::uint8_t number, std::span<const std::uint8_t> pdu,
                                     const Moment& moment) {
    const base::Instant now = moment.now;
    size_ = std::min(pdu.size(), pdu_.size());
    std::copy_n(pdu.begin(), size_, pdu_.begin());
    const auto [request, exception] = decode(std::span(pdu_).first(size_));
    Unit* unit = find(number);
    if (unit == nullptr) return Answer::refusal(request.function, Exception::target_failed);
    if (unit->master == number_) unit->heard = now;
    if (exception != Exception::none) return Answer::refusal(request.function, exception);
    const auto place =
        std::find_if(units_.begin(), units_.end(), [&](const auto& one) { return one.get() == unit; });
    std::shared_ptr<const faces::Findings> why;
    const bool asks_why = request.space == Space::input_register && request.address < kWhyEnd &&
                          request.address + request.count > kWhy;
    const faces::AxisImage image = asks_why ? unit->model.image_with_why(now, &why) : unit->model.image(now);
    unit->follow_start(image);
    if (asks_motor(request)) unit->model.want_motor(now);
    const Look look{.unit = *unit,
                    .index = static_cast<std::size_t>(place - units_.begin()),
                    .image = image,
                    .book = unit->model.set_points(),
                    .why = why,
                    .now = now,
                    .arrived = moment.arrived};
    if (request.space == Space::holding_register && request.address >= kMotorWindow)
        return use_window(look, request);
    if (!request.writes) return read(look, request);
    return request.space == Space::coil ? write_coils(look, request) : write_holding(look, request);
}

Answer Session::read(const Look& look, const Request& request) {
    if (cuts_a_value(request)) return Answer::refusal(request.function, Exception::illegal_address);
    Answer answer(request);
    for (unsigned i = 0; i < request.count; ++i) {
        const Exception exception =
            put(look, request.space, static_cast<std::uint16_t>(request.address + i), answer);
        if (exception != Exception::none) return Answer::refusal(request.function, exception);
    }
    return answer;
}

Exception Session::put(const Look& look, Space space, std::uint16_t address, Answer& answer) const {
    if (space == Space::coil) {
        answer.put_bit((handshake_of(look.unit).coils >> (address & 7U) & 1) != 0);
        return address < kCoils ? Exception::none : Exception::illegal_address;
    }
    if (space == Space::holding_register) {
        if (address >= kHoldings) return Exception::illegal_address;
        const Word word = holding_word(look, address);
        answer.put_word(word.value);
        return word.exception;
    }
    if (space == Space::input_register) {
        if (const auto own = own_word(look, address)) {
            answer.put_word(own->value);
            return own->exception;
        }
        if (address > kWhy && address < kWhyEnd) {
            const Word word = why_word(look, address);
            answer.put_word(word.value);
            return word.exception;
        }
        if (const auto word = set_point_input(set_points_of(look), address)) {
            answer.put_word(word->value);
            return is_old(look) ? Exception::target_failed : word->exception;
        }
    }
    const ValueRow* row = find_row(space, address);
    if (row == nullptr && !(space == Space::input_register && address == kStatusWord))
        return Exception::illegal_address;
    const auto value = row == nullptr ? status_word(look)
                                      : row->point->take(look.image, look.now, look.unit.model.scaling());
    if (value.quality != Quality::good) return Exception::target_failed;
    if (space == Space::discrete_input) {
        answer.put_bit(value.value != 0);
    } else if (row == nullptr || row->words == 1) {
        answer.put_word(static_cast<std::uint16_t>(row == nullptr ? std::llround(value.value)
                                                                  : in_steps(*row, value.value)));
    } else {
        answer.put_word(word_of(in_steps(*row, value.value), address - unsigned{row->address},
                                look.unit.settings.low_word_first));
    }
    return Exception::none;
}

Word Session::why_word(const Look& look, std::uint16_t address) {
    if (look.why == nullptr) return {Exception::target_failed, 0};
    const causes::Finding& first = look.why->front();
    if (address == kWhySeverity) return {Exception::none, static_cast<std::uint16_t>(first.severity)};
    return text_word(first.sentence, address - std::size_t{kWhyText});
}

/// The discrete inputs as a bit mask.
faces::PointValue Session::status_word(const Look& look) const {
    faces::PointValue word{Quality::good, 0};
    for (const ValueRow& row : value_rows()) {
        if (row.space != Space::discrete_input) continue;
        const auto value = row.point->take(look.image, look.now, look.unit.model.scaling());
        word.quality = std::max(word.quality, value.quality);
        if (value.value != 0) word.value += std::exp2(row.address);
    }
    return word;
}

std::optional<Word> Session::own_word(const Look& look, std::uint16_t address) const {
    const auto value = own_value(look, address);
    if (!value) return std::nullopt;
    const bool is_of_axis = address == kMySeat || address == kNewEvents;
    return Word{is_of_axis && is_old(look) ? Exception::target_failed : Exception::none, *value};
}

std::optional<std::uint16_t> Session::own_value(const Look& look, std::uint16_t address) const {
    constexpr std::int64_t kMost = 0xFFFF;
    switch (address) {
        case kMapVersion:
            return kMapNumber;
        case kMySeat:
            return clients_[look.index] && clients_[look.index]->number() == look.image.holder ? 1 : 0;
        case kNewEvents:
            return static_cast<std::uint16_t>(
                std::min<std::int64_t>(look.image[gw::LOG_COUNT] - look.unit.acknowledged, kMost));
        case kDoneNumber:
            return handshake_of(look.unit).done_number;
        case kResult:
            return handshake_of(look.unit).result;
        case kResultDetail:
            return handshake_of(look.unit).detail;
        case kImageAge:
            return static_cast<std::uint16_t>(
                std::clamp<std::int64_t>((look.now - look.image.taken).count() / 1000, 0, kMost));
        default:
            return std::nullopt;
    }
}

Word Session::holding_word(const Look& look, std::uint16_t address) const {
    const auto known = [](std::uint32_t value) {
        return Word{Exception::none, static_cast<std::uint16_t>(value)};
    };
    const auto of_axis = [&look](Word word) {
        return is_old(look) ? Word{Exception::target_failed, 0} : word;
    };
    switch (address) {
        case kCommand:
            return known(handshake_of(look.unit).command);
        case kCommandNumber:
            return known(handshake_of(look.unit).number);
        case kForceInputs:
            return of_axis(known(look.image[gw::FORCE_IN]));
        case kForceOutputs:
            return of_axis(known(look.image[gw::FORCE_OUT]));
        case kRecipe:
            return known(handshake_of(look.unit).recipe);
        case kSetPointsWritten:
            return known(staged_[look.index].written());
        default:
            return of_axis(staged_[look.index].word(set_points_of(look), address));
    }
}

/// Level 1 of a stop coil always stops; all other coils act on the change from 0, which must have been seen
/// since the start.
std::optional<Answer> Session::write_coils(const Look& look, const Request& request) {
    if (request.address + request.count > kCoils)
        return Answer::refusal(request.function, Exception::illegal_address);
    std::vector<Command> stops;
    std::vector<Command> others;
    Handshake& shake = handshake_of(look.unit);
    std::uint8_t& own = written_[look.index].coils;
    for (unsigned i = 0; i < request.count; ++i) {
        const unsigned coil = request.address + i;
        const auto bit = static_cast<std::uint8_t>(1U << coil);
        const bool rises =
            request.bit(i) && ((shake.coils | own) & bit) == 0 && (shake.coils_were_off & bit) != 0;
        if (!request.bit(i)) shake.coils_were_off |= bit;
        for (std::uint8_t* coils : {&shake.coils, &own})
            *coils = static_cast<std::uint8_t>(request.bit(i) ? *coils | bit : *coils & ~bit);
        if (coil == kAcknowledge) {
            if (request.bit(i)) look.unit.acknowledged = look.image[gw::LOG_COUNT];
            continue;
        }
        const Command command = coil == kResetError ? Command::reset_error(look.arrived)
                                                    : Command::of(kCoilCommands[coil], look.arrived);
        if (command.is_stop() && request.bit(i)) stops.push_back(command);
        if (!command.is_stop() && rises) others.push_back(command);
    }
    return begin(look, request, stops.empty() ? others : stops, false);
}

std::optional<Answer> Session::write_holding(const Look& look, const Request& request) {
    if (request.address + request.count > kHoldings)
        return Answer::refusal(request.function, Exception::illegal_address);
    const bool stops = request.address == kCommand && is_stop(request.word(0));
    if (cuts_a_value(request) && !stops) return Answer::refusal(request.function, Exception::illegal_address);
    stage(look, request);
    std::vector<Command> commands;
    for (unsigned i = 0; i < request.count; ++i) {
        const unsigned address = request.address + i;
        if (address < kForceInputs || address > kForceOutputs) continue;
        const std::uint8_t reg = address == kForceInputs ? gw::FORCE_IN : gw::FORCE_OUT;
        if (request.word(i) != look.image[static_cast<gw::Number>(reg)] || request.word(i) != 0)
            commands.push_back(Command::own(reg, request.word(i), look.arrived));
    }
    const auto command = handshake(look, request);
    if (command && command->is_stop()) commands.clear();
    if (command) commands.insert(commands.begin(), *command);
    return begin(look, request, commands, command.has_value());
}

/// The command of the handshake registers, if any.
std::optional<Command> Session::handshake(const Look& look, const Request& request) {
    Handshake& shake = handshake_of(look.unit);
    const auto written = [&request](unsigned address) -> std::optional<std::uint16_t> {
        if (request.address > address || request.address + request.count <= address) return std::nullopt;
        return request.word(address - request.address);
    };
    if (const auto command = written(kCommand)) shake.command = *command;
    const std::optional<std::uint16_t> number = written(kCommandNumber);
    std::optional<std::uint16_t>& own = written_[look.index].number;
    const bool is_new = number && *number != shake.number && number != own;
    if (number) own = shake.number = *number;
    const Command command = Command::of(static_cast<gw::Command>(shake.command), look.arrived);
    if (number == std::uint16_t{0}) {
        shake.is_armed = true;
        shake.done_number = 0;
    }
    if (written(kCommand) && is_stop(shake.command)) return command;
    if (!is_new || *number == 0) return std::nullopt;
    return shake.is_armed ? ordered(look, shake) : end_handshake(shake, Result::too_late);
}

std::optional<Command> Session::end_handshake(Handshake& shake, Result result) {
    shake.result = static_cast<std::uint16_t>(result);
    shake.detail = 0;
    shake.done_number = shake.number;
    return std::nullopt;
}

/// The axis command for the handshake; empty: it has already ended.
std::optional<Command> Session::ordered(const Look& look, Handshake& shake) {
    StagedSetPoints& staged = staged_[look.index];
    switch (shake.command) {
        case kAcknowledgeEvents:
            look.unit.acknowledged = look.image[gw::LOG_COUNT];
            return end_handshake(shake, Result::done);
        case kResetMotorError:
            return Command::reset_error(look.arrived);
        case kTakeSetPoints: {
            if (staged.written() == 0) return end_handshake(shake, Result::bad_value);
            if (!staged.are_of(*look.book)) return end_handshake(shake, Result::other_table);
            const auto request = staged.request(set_points_of(look));
            if (!request.empty()) return Command::set_points(request, gw::Origin::modbus, look.arrived);
            staged.forget();
            return end_handshake(shake, Result::done);
        }
        case kLoadRecipe:
            if (look.book->find_recipe(shake.recipe) == nullptr)
                return end_handshake(shake, Result::no_recipe);
            return Command::set_points(
                set_points::encode_request(look.book->record, gw::SetPointRequest::load_recipe, {},
                                           {.number = static_cast<std::uint8_t>(shake.recipe)}),
                gw::Origin::modbus, look.arrived);
        default:
            if (is_for_plant(shake.command))
                return Command::of(static_cast<gw::Command>(shake.command), look.arrived);
            return end_handshake(shake, Result::bad_value);
    }
}

/// Values of set-points are staged until a command takes them.
void Session::stage(const Look& look, const Request& request) {
    StagedSetPoints& staged = staged_[look.index];
    for (unsigned i = 0; i < request.count; ++i) {
        const unsigned address = request.address + i;
        if (address == kRecipe) handshake_of(look.unit).recipe = request.word(i);
        if (address == kSetPointsWritten && request.word(i) == 0) staged.forget();
        if (address < kSetPointsNew || (address - kSetPointsNew) % 2 != 0 || i + 1 >= request.count) continue;
        const auto value = static_cast<std::int32_t>(long_in(request, i, look.unit.settings.low_word_first));
        staged.write(set_points_of(look), (address - kSetPointsNew) / 2, value);
    }
}

/// Complete motor registers, in the configured word order.
std::optional<Answer> Session::use_window(const Look& look, const Request& request) {
    const auto refuse = [&request](Exception exception) {
        return Answer::refusal(request.function, exception);
    };
    const unsigned first = (request.address - unsigned{kMotorWindow}) / 2;
    const unsigned count = request.count / 2U;
    const bool whole = request.address % 2 == 0 && request.count % 2 == 0;
    if (!whole || first == 0 || request.address + request.count > kMotorWindowEnd)
        return refuse(Exception::illegal_address);
    if (count > kMostWindow) return refuse(Exception::illegal_value);
    const registers::Model model = faces::model_of(look.image);
    std::vector<Command> commands;
    for (unsigned i = 0; i < count; ++i) {
        const auto number = static_cast<std::uint8_t>(first + i);
        const registers::Register* reg = registers::find(model, number);
        if (reg == nullptr) return refuse(Exception::illegal_address);
        const bool longword = registers::bytes_of(model, *reg) == 4;
        if (!request.writes) {
            commands.push_back(Command::motor_read(number, longword, look.arrived));
            continue;
        }
        const std::uint32_t value = long_in(request, std::size_t{2} * i, look.unit.settings.low_word_first);
        const auto number_of = static_cast<std::int32_t>(value);
        if (number_of < reg->min || number_of > reg->max) return refuse(Exception::illegal_value);
        commands.push_back(
            Command::motor_write(number, longword, longword ? value : value & 0xFFFF, look.arrived));
    }
    return begin(look, request, commands, false);
}

std::optional<Answer> Session::begin(const Look& look, const Request& request,
                                     const std::vector<Command>& commands, bool is_handshake) {
    if (commands.empty()) return Answer::echo(std::span(pdu_).first(size_));
    const bool operates =
        std::any_of(commands.begin(), commands.end(), [](const Command& c) { return c.operates(); });
    auto& client = clients_[look.index];
    if (!client) client = look.unit.model.join(faces::Side::plant, name_, bell_);
    if (!client) return Answer::refusal(request.function, Exception::busy);
    if (operates && !look.unit.settings.writes) {
        if (is_handshake) {
            end_handshake(handshake_of(look.unit), Result::not_allowed);
            return Answer::echo(std::span(pdu_).first(size_));
        }
        return Answer::refusal(request.function, Exception::device_failure);
    }
    waiting_ = Waiting{.request = request,
                       .index = look.index,
                       .is_handshake = is_handshake,
                       .operates = operates,
                       .begun = look.now};
    if (is_handshake) {
        const Handshake& shake = handshake_of(look.unit);
        waiting_->number = shake.number;
        waiting_->has_number = request.address + request.count > kCommandNumber;
        waiting_->takes_set_points = shake.command == kTakeSetPoints;
        if (waiting_->has_number) aside_.reset();
    }
    for (const Command& command : commands) {
        if (const auto id = client->submit(command)) waiting_->ids.push_back(*id);
    }
    waiting_->is_whole = waiting_->ids.size() == commands.size();
    return std::nullopt;
}

bool Session::asks_stop(std::span<const std::uint8_t> pdu) {
    const auto [request, exception] = decode(pdu);
    if (exception != Exception::none || !request.writes) return false;
    if (request.space == Space::holding_register)
        return request.address == kCommand && is_stop(request.word(0));
    if (request.space != Space::coil || request.address + request.count > kCoils) return false;
    for (unsigned i = 0; i < request.count; ++i) {
        const unsigned coil = request.address + i;
        if (request.bit(i) && (coil == kStop || coil == kSafe || coil == kHold)) return true;
    }
    return false;
}

void Session::take_ended(base::Instant now) {
    for (std::size_t i = 0; i < clients_.size(); ++i) {
        while (clients_[i]) {
            const auto ended = clients_[i]->take(now);
            if (!ended) break;
            for (auto* one : {&waiting_, &aside_}) {
                if (!*one || (*one)->index != i) continue;
                const auto& ids = (*one)->ids;
                if (std::find(ids.begin(), ids.end(), ended->id) != ids.end())
                    (*one)->ended.push_back(*ended);
            }
        }
    }
}

std::optional<Answer> Session::take(base::Instant now) {
    if (!waiting_ && !aside_) return std::nullopt;
    take_ended(now);
    if (aside_ && aside_->ended.size() == aside_->ids.size()) {
        note_master(*aside_, now);
        enter(*aside_);
        aside_.reset();
    }
    if (!waiting_) return std::nullopt;
    if (waiting_->ended.size() < waiting_->ids.size()) {
        const bool is_long = waiting_->is_handshake && now - waiting_->begun >= kLongestAnswer;
        return is_long && !is_stop(handshake_of(*units_[waiting_->index]).command)
                   ? std::optional(put_aside())
                   : std::nullopt;
    }
    note_master(*waiting_, now);
    const Answer answer = finished();
    waiting_.reset();
    return answer;
}

Answer Session::put_aside() {
    Waiting waiting = *std::exchange(waiting_, std::nullopt);
    if (!waiting.is_handshake && !waiting.request.writes)
        return Answer::refusal(waiting.request.function, Exception::target_failed);
    if (!waiting.is_handshake) {
        handshake_of(*units_[waiting.index]).result = static_cast<std::uint16_t>(Result::too_late);
        return Answer::refusal(waiting.request.function, Exception::device_failure);
    }
    if (waiting.has_number) aside_ = std::move(waiting);
    return Answer::echo(std::span(pdu_).first(size_));
}

void Session::note_master(const Waiting& waiting, base::Instant now) {
    const auto is_done = [](const Completion& ended) { return ended.result == Result::done; };
    if (!waiting.operates || std::none_of(waiting.ended.begin(), waiting.ended.end(), is_done)) return;
    Unit& unit = *units_[waiting.index];
    unit.master = number_;
    unit.master_name = name_;
    unit.heard = now;
}

void Session::enter(const Waiting& waiting) {
    Handshake& shake = handshake_of(*units_[waiting.index]);
    const Completion first =
        waiting.ended.empty() ? Completion{.result = Result::busy} : waiting.ended.front();
    if (waiting.takes_set_points && first.result == Result::done) staged_[waiting.index].forget();
    if (waiting.has_number && shake.number != waiting.number) return;
    if (!waiting.has_number && aside_ && first.result == Result::done) return;
    shake.result = static_cast<std::uint16_t>(first.result);
    shake.detail = first.detail;
    shake.done_number = shake.number;
}

Answer Session::finished() {
    const Request& request = waiting_->request;
    Unit& unit = *units_[waiting_->index];
    if (waiting_->is_handshake) {
        enter(*waiting_);
        return Answer::echo(std::span(pdu_).first(size_));
    }
    if (!waiting_->is_whole) return Answer::refusal(request.function, Exception::busy);
    for (const Completion& ended : waiting_->ended) {
        if (const Exception exception = exception_of(ended); exception != Exception::none) {
            Handshake& shake = handshake_of(unit);
            shake.result = static_cast<std::uint16_t>(ended.result);
            shake.detail = ended.detail;
            return Answer::refusal(request.function, exception);
        }
    }
    if (request.writes) return Answer::echo(std::span(pdu_).first(size_));
    return window_answer(unit);
}

Answer Session::window_answer(const Unit& unit) const {
    const Request& request = waiting_->request;
    const registers::Model model = faces::model_of(unit.model.board().get());
    Answer answer(request);
    unsigned number = (request.address - unsigned{kMotorWindow}) / 2;
    for (const Completion& ended : waiting_->ended) {
        const registers::Register* reg = registers::find(model, static_cast<std::uint8_t>(number++));
        std::int64_t value = static_cast<std::int32_t>(ended.value);
        if (reg != nullptr && registers::bytes_of(model, *reg) == 2)
            value = reg->min < 0 ? std::int64_t{static_cast<std::int16_t>(ended.value)}
                                 : std::int64_t{static_cast<std::uint16_t>(ended.value)};
        for (unsigned word = 0; word < 2; ++word)
            answer.put_word(word_of(value, word, unit.settings.low_word_first));
    }
    return answer;
}

}  // namespace nplc::modbus
