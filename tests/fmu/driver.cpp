#include "driver.h"

#include <dlfcn.h>
#include <minizip/unzip.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <regex>

#include "program.h"

namespace nplc::sim::fmu {
namespace {

namespace fs = std::filesystem;

fs::path new_folder() {
    std::string name = (fs::temp_directory_path() / "nplc-fmu-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for an FMU");
    return name;
}

std::map<std::string, std::string> unzip(const fs::path& file) {
    std::map<std::string, std::string> files;
    const unzFile zip = unzOpen64(file.c_str());
    if (zip == nullptr) return files;
    for (int code = unzGoToFirstFile(zip); code == UNZ_OK; code = unzGoToNextFile(zip)) {
        unz_file_info64 info{};
        char name[256];
        unzGetCurrentFileInfo64(zip, &info, name, sizeof name, nullptr, 0, nullptr, 0);
        std::string content(info.uncompressed_size, '\0');
        unzOpenCurrentFile(zip);
        const int length = unzReadCurrentFile(zip, content.data(), static_cast<unsigned>(content.size()));
        EXPECT_EQ(unzCloseCurrentFile(zip), UNZ_OK) << name;
        EXPECT_EQ(static_cast<std::size_t>(length), content.size()) << name;
        files[name] = content;
    }
    unzClose(zip);
    return files;
}

void write(const fs::path& path, const std::string& content) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
}

void collect(fmi3InstanceEnvironment environment, fmi3Status, fmi3String, fmi3String message) {
    static_cast<Fmu3*>(environment)->messages.emplace_back(message);
}

}  // namespace

UnpackedFmu::UnpackedFmu(const std::string& bytes) : folder_(new_folder()) {
    write(folder_ / "whole.fmu", bytes);
    files_ = unzip(folder_ / "whole.fmu");
    for (const auto& [name, content] : files_) write(folder_ / name, content);
    for (const auto& [name, content] : files_) {
        if (name.starts_with("binaries/") && name.ends_with(".so"))
            library_ = dlopen((folder_ / name).c_str(), RTLD_NOW | RTLD_LOCAL);
    }
    if (library_ == nullptr) throw std::runtime_error(dlerror());
}

UnpackedFmu::~UnpackedFmu() {
    if (library_ != nullptr) dlclose(library_);
    fs::remove_all(folder_);
}

std::string UnpackedFmu::token() const {
    std::smatch found;
    const std::string text = description();
    std::regex_search(text, found, std::regex("(?:instantiationToken|guid)=\"([^\"]*)\""));
    return found[1];
}

void* UnpackedFmu::symbol(const char* name) const {
    void* found = dlsym(library_, name);
    if (found == nullptr) throw std::runtime_error(std::string(name) + " is not exported");
    return found;
}

Fmu3::Fmu3(const UnpackedFmu& fmu, const char* token, const char* resources) : fmu_(fmu) {
    const std::string own_token = fmu.token();
    const std::string own_resources = fmu.resources();
    instance_ = NPLC_CALL(fmu, fmi3InstantiateCoSimulation)(
        "one", token == nullptr ? own_token.c_str() : token,
        resources == nullptr ? own_resources.c_str() : resources, false, true, false, false, nullptr, 0, this,
        collect, nullptr);
}

Fmu3::~Fmu3() {
    if (instance_ != nullptr) NPLC_CALL(fmu_, fmi3FreeInstance)(instance_);
}

void Fmu3::start(double start_time) {
    time_ = start_time;
    ASSERT_EQ(NPLC_CALL(fmu_, fmi3EnterInitializationMode)(instance_, false, 0, start_time, false, 0), fmi3OK)
        << last_message();
    ASSERT_EQ(NPLC_CALL(fmu_, fmi3ExitInitializationMode)(instance_), fmi3OK) << last_message();
}

fmi3Status Fmu3::step(double size) {
    bool event = true;
    bool ends = true;
    bool early = true;
    double reached = -1;
    const fmi3Status status =
        NPLC_CALL(fmu_, fmi3DoStep)(instance_, time_, size, true, &event, &ends, &early, &reached);
    if (status == fmi3OK) {
        EXPECT_FALSE(event || ends || early);
        EXPECT_EQ(reached, time_ + size);
        time_ = reached;
    }
    return status;
}

double Fmu3::real(Id id) const {
    const auto reference = static_cast<fmi3ValueReference>(id);
    double value = 0;
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3GetFloat64)(instance_, &reference, 1, &value, 1), fmi3OK) << last_message();
    return value;
}

std::int32_t Fmu3::integer(Id id) const {
    const auto reference = static_cast<fmi3ValueReference>(id);
    std::int32_t value = 0;
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3GetInt32)(instance_, &reference, 1, &value, 1), fmi3OK) << last_message();
    return value;
}

std::uint32_t Fmu3::bits(Id id) const {
    const auto reference = static_cast<fmi3ValueReference>(id);
    std::uint32_t value = 0;
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3GetUInt32)(instance_, &reference, 1, &value, 1), fmi3OK) << last_message();
    return value;
}

bool Fmu3::truth(Id id) const {
    const auto reference = static_cast<fmi3ValueReference>(id);
    bool value = false;
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3GetBoolean)(instance_, &reference, 1, &value, 1), fmi3OK) << last_message();
    return value;
}

fmi3Status Fmu3::set(Id id, double value) {
    const auto reference = static_cast<fmi3ValueReference>(id);
    return NPLC_CALL(fmu_, fmi3SetFloat64)(instance_, &reference, 1, &value, 1);
}

fmi3Status Fmu3::set(Id id, std::int32_t value) {
    const auto reference = static_cast<fmi3ValueReference>(id);
    return NPLC_CALL(fmu_, fmi3SetInt32)(instance_, &reference, 1, &value, 1);
}

fmi3Status Fmu3::set(Id id, bool value) {
    const auto reference = static_cast<fmi3ValueReference>(id);
    return NPLC_CALL(fmu_, fmi3SetBoolean)(instance_, &reference, 1, &value, 1);
}

std::map<std::string, double> Fmu3::outputs(const std::vector<Variable>& variables) const {
    std::map<std::string, double> all;
    for (const Variable& variable : variables) {
        if (variable.causality != Causality::output) continue;
        double& value = all[variable.name];
        switch (variable.kind) {
            case Kind::real:
                value = real(variable.id);
                break;
            case Kind::integer:
                value = integer(variable.id);
                break;
            case Kind::bits:
                value = bits(variable.id);
                break;
            case Kind::truth:
                value = truth(variable.id) ? 1 : 0;
                break;
        }
    }
    return all;
}

const std::string& packed(const FmuOptions& options) {
    static std::map<std::pair<std::string, int>, std::string> files;
    std::string& file = files[{token_of(options.setup), options.fmi}];
    if (file.empty()) file = fmu_file(options);
    return file;
}

FmuOptions options_of(const std::string& example, registers::Model motor) {
    FmuOptions options;
    options.setup.motor = motor;
    options.model_name = "test";
    if (example.empty()) return options;
    const Program program = load_program(std::string(NPLC_EXAMPLES "/") + example);
    options.setup.motor = program.names.motor;
    options.setup.table = program.content();
    options.names = program.names;
    return options;
}

}  // namespace nplc::sim::fmu
