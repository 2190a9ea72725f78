#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "base/crc32.h"
#include "bench_board.h"
#include "gateway/controller.h"
#include "instant_line.h"
#include "sim/sim_storage.h"

namespace nplc::gateway {

namespace reg = registers::gateway;
namespace mactalk = protocol::mactalk;

/// A gateway on BenchBoard with its user's port and store, and the client that asks it.
struct PortBench {
    static constexpr std::uint8_t kMotor = 7;
    static constexpr ports::StorageGeometry kFlash{
        .size = 32 * 1024, .erase_block = 2048, .program_page = 256, .program_unit = 8};
    static constexpr store::Area kTables{.begin = 0, .slot_bytes = 5 * 2048};
    static constexpr store::Area kSettings{.begin = 10 * 2048, .slot_bytes = 2048};
    static constexpr store::Area kSetPoints{.begin = 12 * 2048, .slot_bytes = 2048};

    explicit PortBench(const Settings& settings = {.autostart = false}) { start(settings); }

    void start(const Settings& settings) {
        store::SettingValues initial = values_of(settings);
        static_cast<void>(initial.set(store::Setting::motor_address, kMotor));
        manager.emplace(flash, kSettings);
        manager->start(initial);
        const Controller::Ports ports{.inputs = board,
                                      .outputs = board,
                                      .watchdog = board,
                                      .motor = board,
                                      .storage = flash,
                                      .user_line = &line,
                                      .motor_mactalk_line = wired ? &motor_line : nullptr,
                                      .shown_lines = shown_lines,
                                      .set_points = &kSetPoints};
        controller.emplace(ports, kTables, memory, *manager, cause);
        gateway = &controller->sequence();
        tables = &controller->tables();
        gateway->observe(&board);
        if (keeps_mark) manager->keep_mark(cause == StartCause::watchdog);
        tables->start(board.now);
    }

    void poll() {
        board.now += base::Microseconds(250);
        controller->poll(board.now);
    }
    /// With `only_when_due` not before Controller::next_poll, but at once where something has just happened;
    /// a motor that is being asked has a deadline of its own.
    void step(base::Instant end) {
        if (!only_when_due) return poll();
        const base::Instant motors =
            motor::is_open(board.access) ? board.now + base::Milliseconds(1) : base::kNever;
        const base::Instant due = controller->next_poll(board.now, motors);
        board.now = std::min(end, std::max(due, board.now + base::Microseconds(1)));
        controller->poll(board.now);
    }
    void run(base::Microseconds duration) {
        const auto end = board.now + duration;
        poll();
        while (board.now < end) step(end);
    }

    void put(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) line.received.push_back({byte, false});
    }
    void ask(const mactalk::Request& request) { put(mactalk::encode(request).view()); }

    /// The bytes that come within `wait`.
    std::vector<std::uint8_t> heard(base::Microseconds wait = std::chrono::seconds(2)) {
        line.sent.clear();
        const auto end = board.now + wait;
        poll();
        while (board.now < end && line.sent.empty()) step(end);
        return std::exchange(line.sent, {});
    }

    static std::vector<std::uint8_t> accept() {
        const auto bytes = mactalk::encode_accept();
        return {bytes.view().begin(), bytes.view().end()};
    }

    std::optional<mactalk::Reply> reply(std::size_t bytes) {
        mactalk::ReplyDecoder decoder;
        decoder.expect(mactalk::Answer::registers, bytes);
        std::optional<mactalk::Reply> found;
        for (const std::uint8_t byte : heard()) {
            if (const auto whole = decoder.receive(byte)) found = whole;
        }
        return found;
    }

    /// What a register reads; nothing without an answer.
    std::optional<std::uint32_t> read(std::uint8_t number, std::uint8_t address = reg::kDefaultAddress) {
        ask({.kind = mactalk::Kind::read, .address = address, .reg = number});
        const auto answer = reply(4);
        if (!answer || answer->reg != number) return std::nullopt;
        return base::load_u32(answer->data.data());
    }
    std::optional<mactalk::Reply> block(std::uint8_t number, std::uint8_t address = reg::kDefaultAddress) {
        ask({.kind = mactalk::Kind::read_block, .address = address, .reg = number});
        return reply(64);
    }
    /// Was it accepted?
    bool write(std::uint8_t number, std::uint32_t value, std::uint8_t length = 4,
               std::uint8_t address = reg::kDefaultAddress) {
        ask({.kind = mactalk::Kind::write,
             .address = address,
             .reg = number,
             .length = length,
             .value = value});
        return heard() == accept();
    }
    bool command(reg::Command command) { return write(reg::COMMAND, static_cast<std::uint32_t>(command)); }
    bool send(std::span<const std::uint8_t> piece) {
        put(mactalk::encode_long_write(reg::kDefaultAddress, reg::TABLE_DATA, piece).view());
        return heard() == accept();
    }
    /// Result, register and detail of the last write.
    std::uint32_t result() { return read(reg::RESULT).value_or(0xFFFF'FFFF); }
    static std::uint32_t result_of(reg::Result code, std::uint8_t number, std::uint32_t detail = 0) {
        return static_cast<std::uint32_t>(code) | (std::uint32_t{number} << 8) | (detail << 16);
    }
    std::uint32_t status() { return read(reg::STATUS).value_or(0); }
    reg::RunState state() { return static_cast<reg::RunState>(status() & reg::kRunState); }

    /// Begins, sends all in pieces of 128 bytes, commits; true if it ends stored.
    bool upload(std::span<const std::uint8_t> table) {
        if (!command(reg::Command::upload_begin)) return false;
        for (std::size_t at = 0; at < table.size(); at += mactalk::kMaxLongWrite) {
            if (!send(table.subspan(at, std::min(mactalk::kMaxLongWrite, table.size() - at)))) return false;
        }
        if (!write(reg::UPLOAD_BYTES, static_cast<std::uint32_t>(table.size())) ||
            !write(reg::UPLOAD_CRC, base::crc32(table)) || !command(reg::Command::upload_commit))
            return false;
        run(std::chrono::milliseconds(100));
        return read(reg::UPLOAD_STATE) == 4U;
    }
    bool upload_and_activate(std::span<const std::uint8_t> table) {
        return upload(table) && command(reg::Command::activate);
    }

    BenchBoard board;
    sim::SimStorage flash{kFlash};
    std::array<std::uint8_t, kTableMemory> memory{};
    GatewayRegisters::Lines shown_lines{};
    std::optional<SettingsManager> manager;
    std::optional<Controller> controller;
    Gateway* gateway = nullptr;
    TableManager* tables = nullptr;
    InstantLine line;
    InstantLine motor_line;
    StartCause cause = StartCause::power_up;  ///< of the next start()
    bool keeps_mark = false;                  ///< that run has been commanded, as boards without Linux do
    bool wired = false;
    bool only_when_due = false;
};

}  // namespace nplc::gateway
