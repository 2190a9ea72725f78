#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/fmu/fmi2.h"
#include "sim/fmu/fmi3.h"
#include "sim/fmu/fmu_file.h"
#include "sim/fmu/variables.h"

namespace nplc::sim::fmu {

/// An FMU as an importer has it: unpacked into a folder of its own, its library loaded. As the standard says
/// it, and with nothing of ours but the FMU's bytes.
class UnpackedFmu {
  public:
    explicit UnpackedFmu(const std::string& bytes);
    UnpackedFmu(const UnpackedFmu&) = delete;
    UnpackedFmu& operator=(const UnpackedFmu&) = delete;
    ~UnpackedFmu();

    const std::map<std::string, std::string>& files() const { return files_; }
    std::string description() const { return files_.at("modelDescription.xml"); }
    std::string token() const;
    std::string folder() const { return folder_.string(); }
    std::string resources() const { return (folder_ / "resources").string() + "/"; }

    /// A function of the library's, which is loaded then.
    template <class Function>
    Function* function(const char* name) const {
        return reinterpret_cast<Function*>(symbol(name));
    }
    void* symbol(const char* name) const;

  private:
    std::filesystem::path folder_;
    std::map<std::string, std::string> files_;
    void* library_ = nullptr;
};

#define NPLC_CALL(fmu, name) (fmu).function<decltype(name)>(#name)

/// An instance spoken to in FMI 3.0.
class Fmu3 {
  public:
    explicit Fmu3(const UnpackedFmu& fmu, const char* token = nullptr, const char* resources = nullptr);
    Fmu3(const Fmu3&) = delete;
    Fmu3& operator=(const Fmu3&) = delete;
    ~Fmu3();

    fmi3Instance instance() const { return instance_; }
    const UnpackedFmu& fmu() const { return fmu_; }
    /// From instantiated to step mode.
    void start(double start_time = 0);
    fmi3Status step(double size);
    double time() const { return time_; }

    double real(Id id) const;
    std::int32_t integer(Id id) const;
    std::uint32_t bits(Id id) const;
    bool truth(Id id) const;
    fmi3Status set(Id id, double value);
    fmi3Status set(Id id, std::int32_t value);
    fmi3Status set(Id id, bool value);

    /// All outputs, by name.
    std::map<std::string, double> outputs(const std::vector<Variable>& variables) const;

    std::vector<std::string> messages;
    std::string last_message() const { return messages.empty() ? "" : messages.back(); }

  private:
    const UnpackedFmu& fmu_;
    fmi3Instance instance_;
    double time_ = 0;
};

/// fmu_file(), packed once.
const std::string& packed(const FmuOptions& options);

/// Of this program in tools/sequence/examples; without one the motor alone.
FmuOptions options_of(const std::string& example, registers::Model motor = registers::Model::mac140);

}  // namespace nplc::sim::fmu
