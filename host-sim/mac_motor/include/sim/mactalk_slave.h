#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "protocol/mactalk.h"
#include "registers/mac.h"

namespace nplc::sim {

inline constexpr std::size_t kSampledRegisters = 4;  ///< SAMPLE1..SAMPLE4 (001 §3.2.112)

/// Interface of the user line to its motor (001 §5.1, §4.4.16).
class MacTalkTarget {
  public:
    virtual std::uint8_t my_address() const = 0;
    virtual std::uint32_t read_register(std::uint8_t reg, bool longword) const = 0;
    virtual void write_register(std::uint8_t reg, std::uint32_t value, bool longword) = 0;
    virtual bool enter_safe_mode() = 0;  ///< false if the motor is not in INIT
    virtual void go_to_init() = 0;       ///< the only exit from SAFE
    virtual bool write_flash() = 0;      ///< and reset; false if the motor is not in SAFE
    virtual bool reset() = 0;            ///< false if the motor is neither in INIT nor in SAFE
    /// The next recorded sample; increments REC_CNT; zeros where nothing was recorded.
    virtual std::array<std::uint32_t, kSampledRegisters> next_sample() = 0;

  protected:
    ~MacTalkTarget() = default;
};

/// The motor's end of its MacTalk line (001 §5.1): answers messages for its own address and for 255.
class MacTalkSlave {
  public:
    explicit MacTalkSlave(registers::Model model) : model_(model) {}

    /// A character from the line; `framing_error` drops the message it belongs to.
    void receive(std::uint8_t byte, bool framing_error, MacTalkTarget& motor);
    /// The next byte of an answer; empty if there is none.
    std::optional<std::uint8_t> transmit();

    /// Discards a partly received message and a partly sent answer.
    void power_up();

  private:
    void execute(const protocol::mactalk::Request& request, MacTalkTarget& motor);
    void write(const protocol::mactalk::Request& request, MacTalkTarget& motor);
    void answer_registers(std::uint8_t reg, std::size_t bytes, const MacTalkTarget& motor);
    void answer_sample(MacTalkTarget& motor);
    void accept();
    void send(const protocol::mactalk::EncodedReply& reply);

    registers::Model model_;
    protocol::mactalk::RequestDecoder decoder_;
    std::deque<std::uint8_t> answer_;
};

}  // namespace nplc::sim
